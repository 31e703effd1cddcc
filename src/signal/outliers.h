// Robust standard deviation and outlier detection.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace whirl_twin {

/// The standard deviation for which seven of eight of the first `count` deviates, without sign, are
/// as small as they are; further elements are not read. A scale by half of them (the median) would
/// miss a clock whose steps are nearly a fraction of the period: most deviates are then equal.
template <std::size_t N>
double robustScale(std::array<double, N> deviates, std::size_t count) {
  constexpr double kSevenOfEight = 1.534;  // standard deviations of a normal distribution
  const auto place = static_cast<std::ptrdiff_t>(count * 7 / 8);
  std::nth_element(deviates.begin(), deviates.begin() + place,
                   deviates.begin() + static_cast<std::ptrdiff_t>(count));
  return deviates[static_cast<std::size_t>(place)] / kSevenOfEight;
}

// Outliers of a measured channel: single spikes of a converter or a cable. One such sample in ten
// thousand would dominate a least-squares estimate.
//
// A sample is compared with the median of the three before it and with that of the three after it;
// the smaller distance counts, so that a step of the signal is no outlier. It is an outlier where
// that distance is more than 12 times
//   - the standard deviation of the last 128 distances (robustScale),
//   - the median of the distances of its six neighbours, so that a motion may start,
//   - the smallest change that the channel has shown, which is a step of its converter.
// Where more than one of a hundred samples would be outliers, they are part of the signal (for
// instance a scratch of the shaft that passes a probe once per turn) and none is marked: Hampel's
// rule (The influence curve and its role in robust estimation, J. Am. Stat. Assoc. 69 (1974),
// 383-393), for a time-varying signal.

class WildSampleDetector {
 public:
  static constexpr int kBehind = 6;  ///< later samples that the test of a sample needs

  /// Adds the next sample, finite, at an instant [ns] later than the one before. Returns the
  /// instant of the sample kBehind before it where that one is an outlier. Does not allocate.
  std::optional<std::int64_t> take(std::int64_t instant, double value);
  /// Number of outliers so far.
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
  double rate_ = 0.0;  // recent fraction of outliers
  std::int64_t found_ = 0;
};

}  // namespace whirl_twin
