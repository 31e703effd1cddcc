// The parts in which the twin takes steps of what controllers measure and act on: from instant to
// instant of theirs.
#pragma once

#include <cstdint>
#include <vector>

#include "control/sensor.h"
#include "scene/scene.h"

namespace whirl_twin {

/// When a controller samples and when its outputs begin to act, one instant after the other; also
/// the outputs of samples that were never taken, before the start, are among them, so that the
/// parts are the same throughout. Where the delay has jitter, no output overtakes the one before.
class ControlInstants {
 public:
  static constexpr std::int64_t kNever = INT64_MAX;

  /// From simulated time `start` [ns] on.
  ControlInstants(const ControllerSpec& controller, std::int64_t start);

  // Real-time safe.

  void start(std::int64_t start) noexcept;
  /// The sample, and the sample whose output acts, that come next.
  std::int64_t sample() const noexcept { return sample_; }
  std::int64_t output() const noexcept { return output_; }
  std::int64_t sampleTime() const noexcept { return sample_time_; }  ///< [ns]
  std::int64_t outputTime() const noexcept { return output_time_; }  ///< [ns]
  std::int64_t next() const noexcept {
    return sample_time_ < output_time_ ? sample_time_ : output_time_;
  }
  /// Does it come to its next instants from `time` [ns], all before that being passed?
  bool isAt(std::int64_t time) const noexcept;
  void passSample() noexcept { sample_time_ = instants_.at(++sample_); }
  void passOutput() noexcept {
    const std::int64_t due = dueAt(++output_);
    output_time_ = due > output_time_ ? due : output_time_;
  }

 private:
  std::int64_t dueAt(std::int64_t output) const noexcept;

  SampleInstants instants_;
  std::int64_t delay_;   ///< [ns]
  std::int64_t jitter_;  ///< [ns]
  CounterNoise noise_;
  std::int64_t sample_ = 0, output_ = 0;
  std::int64_t sample_time_ = 0, output_time_ = 0;
};

/// Lengths [ns] that all parts are sums of, longest first: each part is one of a few, where the
/// instants come again after not too many; else powers of two are among them. Empty: every step is
/// taken whole.
std::vector<std::int64_t> partLengths(const Scene& scene);

/// Does it measure a system or act on it?
bool involves(const ControllerSpec& controller, std::size_t system);
/// Does any?
bool isControlled(const Scene& scene, std::size_t system);
/// Does one make a system's motion hang on another's?
bool isTiedToOthers(const Scene& scene, std::size_t system);

}  // namespace whirl_twin
