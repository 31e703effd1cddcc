// The controllers of a running scene: at their sample instants they read their sensors, and their
// outputs are applied to the systems after their delay, with a zero-order hold.
//
// At an instant outputs that are due are applied first; then all controllers sample the same state;
// outputs without delay are applied at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "control/actuator.h"
#include "control/drive.h"
#include "control/inputs.h"
#include "control/sensor.h"
#include "controllers/controller.h"
#include "controllers/external.h"
#include "integration/stepper.h"
#include "realtime/state_image.h"
#include "scene/built_scene.h"
#include "scene/control_parts.h"

namespace whirl_twin {

/// Counters of a controller since the start.
struct ControlCount {
  std::int64_t samples = 0;
  std::int64_t saturated = 0;  ///< samples with a saturated output
  std::int64_t missed = 0;     ///< samples with a non-finite output: the last one is held
};

/// One controller.
class RunningController {
 public:
  /// The inputs of all systems must outlive it.
  RunningController(const ControllerSpec& spec, const BuiltScene& built,
                    std::vector<Inputs>& inputs);

  // Real-time safe. `running`: the stepper of each system; `drive`: the drive of the controller's
  // shaft.

  /// Resets: the next instant is the first one from `time` [ns] on.
  void start(std::int64_t time, const std::vector<Stepper*>& running) noexcept;
  std::int64_t nextInstant() const noexcept { return instants_.next(); }  ///< [ns]
  /// Applies outputs that are due.
  void actAt(std::int64_t time) noexcept;
  /// Takes a sample if due, and applies its output if it has no delay; `offset` [s] after the start
  /// of the step.
  void sampleAt(std::int64_t time, double offset, const std::vector<Stepper*>& running,
                const Drive& drive) noexcept;
  /// May simulated time advance to `until` [ns], or does it wait for the answer of an external
  /// controller? `elapsed` [ns]: wall time since the last call. True unless the controller is in
  /// lockstep.
  bool mayGoOn(std::int64_t until, std::int64_t elapsed) noexcept;
  /// Sets the status of the systems it acts on to stopped, if it is lost and configured to stop
  /// them.
  void stop(std::vector<StepStatus>& status) const noexcept;
  /// The state has advanced to an instant: updates the sensors' filters between samples.
  void follow(std::int64_t time, const std::vector<Stepper*>& running) noexcept;

  /// Serializes its state at a simulated time [ns]; a replaced control law must be in place before.
  void exchange(StateImage& image, std::int64_t time) noexcept;

  /// Bumpless replacement of the control law by another one of the same kind, with a positive
  /// generation, until the next start(). Returns the law that is no longer used.
  std::unique_ptr<Controller> replace(std::unique_ptr<Controller> next,
                                      std::int64_t generation) noexcept;

  std::size_t drive() const { return drive_; }  ///< of Twin::drive()
  /// 0: with the scene's parameters.
  std::int64_t generation() const noexcept { return generation_; }
  const ControlCount& count() const noexcept { return count_; }
  /// nullptr: in this process.
  ExternalController* external() const noexcept { return external_; }
  state::Supervision supervision() const noexcept { return law_->supervision(); }
  std::size_t measured() const { return channels_.size(); }
  std::size_t outputs() const { return acted_.size(); }
  /// Values of the last sample, and the applied outputs, at the start of the step.
  const double* shown() const noexcept { return shown_.data(); }
  double acting(std::size_t output) const noexcept {
    return acted_[output].inputs->value(acted_[output].input, 0.0);
  }

 private:
  struct Channel {
    std::size_t system;
    std::size_t dof;
    bool of_rates;
    std::vector<double> along;  ///< of q or of v
    Sensor sensor;
    double value = 0.0, rate = 0.0;  ///< at `followed_`

    void exchange(StateImage& image) noexcept { image(sensor, value, rate); }
  };
  struct Acted {
    std::size_t system;
    Inputs* inputs;
    std::size_t input;
    Actuator actuator;

    void exchange(StateImage& image) noexcept { image(actuator); }
  };

  void read(const std::vector<Stepper*>& running) noexcept;
  void give(const double* outputs, std::int64_t time) noexcept;
  void giveAnswer(const double* outputs, std::int64_t time) noexcept;
  bool isNumber(const double* outputs) const noexcept;
  void giveNothing(std::int64_t time) noexcept;

  std::unique_ptr<Controller> law_;          ///< the scene's
  std::unique_ptr<Controller> replacement_;  ///< the latest; null: none yet
  Controller* running_;                      ///< law_ or replacement_
  std::int64_t generation_ = 0;              ///< of running_
  ExternalController* external_;             ///< law_, if it is one
  bool lockstep_ = false;
  ControlInstants instants_;
  bool at_once_;   ///< no delay
  bool filtered_;  ///< its sensors have filters
  std::size_t drive_;
  std::vector<Channel> channels_;
  std::vector<Acted> acted_;
  std::int64_t followed_ = 0;  ///< [ns]
  std::int64_t first_ = 0;     ///< sample
  std::vector<double> shown_;
  std::vector<double> outputs_;      ///< pending outputs, a ring buffer
  std::size_t under_way_;            ///< its capacity
  std::vector<double> motion_;       ///< work space for q and v of the largest system
  std::vector<double> now_, rates_;  ///< signals and their derivatives
  ControlCount count_;
};

class ControlLoop {
 public:
  ControlLoop() = default;
  ControlLoop(const BuiltScene& built, std::vector<Inputs>& inputs);

  bool any() const { return !controllers_.empty(); }
  const std::vector<RunningController>& controllers() const { return controllers_; }
  /// Is a system measured or acted on, so that its steps are split at sample instants?
  bool controls(std::size_t system) const noexcept { return controlled_[system] != 0; }

  // Real-time safe.

  void start(std::int64_t time, const std::vector<Stepper*>& running) noexcept;
  /// As RunningController::replace(), for one of them.
  std::unique_ptr<Controller> replace(std::size_t controller, std::unique_ptr<Controller> next,
                                      std::int64_t generation) noexcept {
    return controllers_[controller].replace(std::move(next), generation);
  }
  void exchange(StateImage& image, std::int64_t time) noexcept {
    for (RunningController& controller : controllers_) {
      controller.exchange(image, time);
    }
  }
  std::int64_t nextInstant() const noexcept;  ///< [ns], simulated
  /// All that is due at an instant, `offset` [s] after the start of the step.
  void act(std::int64_t time, double offset, const std::vector<Stepper*>& running,
           const std::vector<Drive>& drives) noexcept;
  /// As RunningController::mayGoOn(), for all.
  bool mayGoOn(std::int64_t until, std::int64_t elapsed) noexcept;
  /// As RunningController::stop(), for all.
  void stop(std::vector<StepStatus>& status) const noexcept;
  /// The systems have advanced to an instant.
  void follow(std::int64_t time, const std::vector<Stepper*>& running) noexcept;

 private:
  std::vector<RunningController> controllers_;
  std::vector<char> controlled_;  ///< of each system
};

}  // namespace whirl_twin
