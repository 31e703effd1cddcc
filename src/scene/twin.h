// The running twin: the systems and drives of a scene, stepped together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "control/drive.h"
#include "mechanics/dynamics.h"
#include "scene/model_info.h"
#include "scene/record.h"
#include "scene/scene.h"
#include "scene/system.h"

namespace whirl_twin {

class Twin {
 public:
  /// One system of the twin, as built.
  struct Member {
    SystemSpec spec;
    const ModelInfo* model;
    ModelSetup setup;
    std::shared_ptr<const Dynamics> dynamics;  ///< of the setup
    std::string integrator;                    ///< the method it steps with
    std::string integrator_reason;             ///< why, where `auto` chose
    std::size_t drive;  ///< of drive(); a system at constant speed has its own
  };

  /// Builds what the scene names, at its start. Throws std::invalid_argument for a scene that
  /// readScene() would have refused.
  explicit Twin(const Scene& scene);
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;

  const Scene& scene() const { return scene_; }
  const std::vector<Member>& members() const { return members_; }
  const RecordLayout& layout() const { return layout_; }
  /// Drives of the scene first, in its order; then those of systems at constant speed.
  std::size_t driveCount() const { return drives_.size(); }

  // Real-time safe.

  /// One step of everything that has not stopped.
  void step() noexcept;
  /// Back to the scene's start.
  void reset() noexcept;
  std::int64_t stepCount() const noexcept { return steps_; }
  /// [s], simulated: start + steps x step, from a whole number of nanoseconds.
  double time() const noexcept { return seconds(steps_); }
  double seconds(std::int64_t steps) const noexcept;
  /// The present state, as laid out by layout(); kScheduled is left alone.
  void write(double* record) const noexcept;
  const Drive& drive(std::size_t index) const noexcept { return drives_[index]; }
  /// Sends a drive to a new speed from where it is now. False for values out of range.
  bool setSpeed(std::size_t drive, double speed, double max_acceleration, double max_jerk) noexcept;
  StepStatus status(std::size_t system) const noexcept { return status_[system]; }

 private:
  Scene scene_;
  std::vector<Drive> drives_;
  std::vector<Member> members_;
  std::vector<std::unique_ptr<System>> systems_;
  std::vector<StepStatus> status_;
  RecordLayout layout_;
  std::int64_t steps_ = 0;
};

/// "state not finite" or "implicit step did not converge"; "" while running.
const char* describe(StepStatus status);

}  // namespace whirl_twin
