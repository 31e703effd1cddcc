// When something is sampled that has a rate of its own: sample k at k / rate after simulated time
// 0, to the nearest nanosecond, whatever the step of the twin.
#pragma once

#include <cstdint>

namespace whirl_twin {

class SampleInstants {
 public:
  explicit SampleInstants(double rate);  ///< [Hz], > 0

  /// The nanoseconds from one sample to the next; 0 where that is not a whole number.
  std::int64_t period() const { return period_; }

  // Real-time safe.

  std::int64_t at(std::int64_t k) const noexcept;            ///< [ns]
  std::int64_t firstFrom(std::int64_t time) const noexcept;  ///< sample, not before `time` [ns]

 private:
  double rate_;
  std::int64_t period_;
};

}  // namespace whirl_twin
