// A histogram of durations with fixed buckets, for the latencies of a real-time loop without
// allocation. Up to 64 ns a bucket is 1 ns wide; above, every octave has 32 buckets, so a
// percentile has a relative error of at most 1/32, from nanoseconds to 2^34 ns = 17 s. Longer
// durations go into an overflow bin. (The log-linear layout is that of HdrHistogram,
// hdrhistogram.org.)
//
// One thread adds and resets; any thread may copy at the same time, without a lock: all fields are
// atomic. A copy taken in the middle of an add may lack that sample in some fields; FixedRateLoop
// guards its histograms with a sequence count, so that its copies are consistent.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace whirl_twin {

class TimingHistogram {
 public:
  /// Durations of this and more [ns] are counted in the overflow bin.
  static constexpr std::int64_t kOverflow = std::int64_t{1} << 34;

  TimingHistogram() = default;
  TimingHistogram(const TimingHistogram& other) noexcept;
  TimingHistogram& operator=(const TimingHistogram& other) noexcept;

  /// Counts one duration [ns]; a negative one counts as 0. Real-time safe.
  void add(std::int64_t duration) noexcept;

  /// Resets the histogram. Real-time safe.
  void reset() noexcept;

  std::uint64_t count() const noexcept;     ///< samples, the overflow bin's included
  std::uint64_t overflow() const noexcept;  ///< samples in the overflow bin
  std::int64_t min() const noexcept;        ///< [ns], exact; 0 when empty
  std::int64_t max() const noexcept;        ///< [ns], exact; 0 when empty

  double mean() const noexcept;  ///< [ns]; 0 when empty

  /// The smallest duration [ns] that `percent` (0..100) of the samples do not exceed (nearest
  /// rank), rounded up to its bucket's upper end but never above max(): at most 1/32 too long,
  /// never too short. 0 when empty; max() when the rank lies in the overflow bin.
  std::int64_t percentile(double percent) const noexcept;

 private:
  static constexpr int kBitsPerOctave = 5;
  static constexpr std::size_t kPerOctave = std::size_t{1} << kBitsPerOctave;
  static constexpr std::size_t kBuckets = (34 - kBitsPerOctave + 1) * kPerOctave;

  static std::size_t bucketOf(std::int64_t duration) noexcept;
  static std::int64_t longestIn(std::size_t bucket) noexcept;

  std::array<std::atomic<std::uint64_t>, kBuckets + 1> buckets_{};  // the last: overflow
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> min_{0};
  std::atomic<std::int64_t> max_{0};
  std::atomic<std::int64_t> sum_{0};  // [ns]
};

}  // namespace whirl_twin
