// A standard deviation of which the few that are wild decide nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace whirl_twin {

/// The standard deviation for which seven of eight of the first `count` deviates, without sign, are
/// as small as they are; those after them are not read. Half of them (the median) would not see a
/// clock whose steps are nearly a part of the period: most are then off by the same.
template <std::size_t N>
double robustScale(std::array<double, N> deviates, std::size_t count) {
  constexpr double kSevenOfEight = 1.534;  // standard deviations of a normal distribution
  const auto place = static_cast<std::ptrdiff_t>(count * 7 / 8);
  std::nth_element(deviates.begin(), deviates.begin() + place,
                   deviates.begin() + static_cast<std::ptrdiff_t>(count));
  return deviates[static_cast<std::size_t>(place)] / kSevenOfEight;
}

// Single samples of a measured channel that cannot be of its signal: a spike of a converter or a
// cable. Of a least-squares estimate one such sample in ten thousand would decide.
//
// A sample is compared with the median of the three before it and with that of the three after it;
// the smaller distance counts, so that a step of the signal is none. It is wild where that distance
// is more than 12 times
//   - the standard deviation of the last 128 distances (robust_scale.h),
//   - the median of the distances of its six neighbours, so that the beginning of a motion is none,
//   - the smallest change that the channel has shown, which is a step of its converter.
// Where more than one of a hundred samples would be wild, they are the signal (a scratch of the
// shaft that a probe sees once a turn, say) and none is marked: Hampel's rule (The influence curve
// and its role in robust estimation, J. Am. Stat. Assoc. 69 (1974), 383-393), for a signal that
// moves.

class WildSampleDetector {
 public:
  static constexpr int kBehind = 6;  ///< samples after one that are needed to judge it

  /// The next sample, at an instant [ns] later than the one before; finite. Returns the instant of
  /// the sample kBehind before it where that one is wild. Allocates nothing.
  std::optional<std::int64_t> take(std::int64_t instant, double value);
  /// Those that were wild, so far.
  std::int64_t found() const { return found_; }

 private:
  static constexpr std::size_t kUsual = 128;

  double distance() const;

  std::array<std::int64_t, kBehind + 1> instants_{};  // the newest last
  std::array<double, kBehind + 1> values_{};
  std::array<double, kBehind + 1> distances_{};  // of the samples three before
  std::array<double, kUsual> last_distances_{};
  std::size_t taken_ = 0, judged_ = 0;
  double smallest_change_ = 0.0;
  double rate_ = 0.0;  // share of wild samples, lately
  std::int64_t found_ = 0;
};

}  // namespace whirl_twin
