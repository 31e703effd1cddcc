// Sub-steps of the twin for systems that controllers measure or act on: from one sampling or output
// instant to the next.
#pragma once

#include <cstdint>
#include <vector>

#include "control/sensor.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Sequence of the instants at which a controller samples and its outputs become active. It
/// includes outputs of samples before the start, which were never taken, so that the sub-steps are
/// the same throughout. With jitter of the delay, no output overtakes the previous one.
class ControlInstants {
 public:
  static constexpr std::int64_t kNever = INT64_MAX;

  /// From simulated time `start` [ns] on.
  ControlInstants(const ControllerSpec& controller, std::int64_t start);

  // Real-time safe.

  void start(std::int64_t start) noexcept;
  /// The next sample, and the sample of the next output.
  std::int64_t sample() const noexcept { return sample_; }
  std::int64_t output() const noexcept { return output_; }
  std::int64_t sampleTime() const noexcept { return sample_time_; }  ///< [ns]
  std::int64_t outputTime() const noexcept { return output_time_; }  ///< [ns]
  std::int64_t next() const noexcept {
    return sample_time_ < output_time_ ? sample_time_ : output_time_;
  }
  /// Whether these are the next instants from `time` [ns] on, with all earlier ones passed.
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

/// Lengths [ns] of which every sub-step is a sum, longest first: if the instants repeat soon
/// enough, each sub-step has one of a few lengths; otherwise the list includes powers of two.
/// Empty: no steps are divided.
std::vector<std::int64_t> partLengths(const Scene& scene);

/// Whether a controller measures a system or acts on it.
bool involves(const ControllerSpec& controller, std::size_t system);
/// Whether any controller does.
bool isControlled(const Scene& scene, std::size_t system);
/// Whether a controller couples the system's motion with that of another one.
bool isTiedToOthers(const Scene& scene, std::size_t system);

}  // namespace whirl_twin
