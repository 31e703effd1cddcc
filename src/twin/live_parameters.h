// Live changes of the parameters of systems and controllers: checked as in a scene file, built
// outside the loop, exchanged between two steps with unchanged coordinates and rates; for a
// controller by bumpless transfer. A change may be a ramp: linear in simulated time, with updates
// every kRampUpdate. Belongs to the thread that sends the commands.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/changed_controller.h"
#include "twin/live_twin.h"

namespace whirl_twin {

/// Parameters of a system or controller to change at the same instant.
struct ParameterRequest {
  std::string system;              ///< or controller; names are unique
  std::vector<std::string> names;  ///< paths: `damping`, `discs[1].mass`
  std::vector<double> values;      ///< in the units of the model or the controller
  double ramp = 0.0;               ///< [s], simulated; 0: step change
};

struct ParameterAnswer {
  bool done = false;
  std::string message;           ///< result, or why nothing is done
  std::vector<double> previous;  ///< values before
  std::int64_t step = 0;         ///< current step
};

/// Speed range of a move of a drive [rad/s].
struct SpeedReach {
  double target;  ///< final speed
  double lowest;
  double highest;
};

class LiveParameters {
 public:
  /// Update period of a ramp [s], simulated.
  static constexpr double kRampUpdate = 0.02;

  /// Must be created before the loop starts. wait() returns when all commands have been executed;
  /// false: the loop has ended.
  LiveParameters(LiveTwin& twin, std::function<bool()> wait);

  ParameterAnswer set(const ParameterRequest& request);

  /// Updates the ramps under way to the current simulated time. Returns the errors of aborted
  /// ramps.
  std::vector<std::string> continueRamps();
  bool ramping() const { return !ramps_.empty(); }
  /// Steps from the current one to the next ramp update, at least 1; without ramps: unlimited.
  std::uint64_t stepsToUpdate() const;

  /// The range of a valid move (faultOf) if it started now: to its speed, or to the edge of a
  /// barred speed range. Empty: the loop has ended.
  std::optional<SpeedReach> reachOf(std::size_t drive, const SpeedMove& move);

  /// Why a drive cannot move there: an ensemble on it is not prepared for the speed, or a system on
  /// it would stop at the target; "" if it can.
  std::string diagnosticOf(std::size_t drive, const SpeedReach& reach) const;
  std::string speedDiagnostic(std::size_t drive, double speed) const {
    return diagnosticOf(drive, {speed, speed, speed});
  }

  /// Prepares all systems on a drive for a move; to be called before the command that starts it.
  /// False: the loop has ended.
  bool prepareFor(std::size_t drive, const SpeedMove& move);

  /// The loop has executed a kReset: the scene's parameters are in effect again.
  void restored();

  /// All changes since the start, for a checkpoint, consistent with the twin's state while no
  /// command is sent.
  YAML::Node saved() const;
  /// Before the loop runs: repeats these changes. Throws the exceptions of creating systems and
  /// control laws, and YAML::Exception for data that is not from saved().
  void resume(const YAML::Node& saved);

 private:
  /// Systems of the scene first, then its controllers.
  using Which = std::size_t;
  struct Ramp {
    Which which;
    std::string name;
    double from;
    double to;
    double start;     // [s], simulated
    double duration;  // [s]
  };
  using SpeedRange = std::pair<double, double>;  // [rad/s]

  double time() const;
  std::string diagnosticOf(const ParameterRequest& request) const;
  /// Replaces a system by the changed one. Throws if its steps cannot be prepared.
  bool change(std::size_t system, SharedSystem next, const std::vector<std::string>& names);
  bool change(std::size_t controller, ChangedController next,
              const std::vector<std::string>& names);
  bool takeOver(std::size_t system, std::unique_ptr<Stepper> next, SystemGeneration generation);
  std::vector<std::string> names() const;
  bool isSystem(Which which) const { return which < systems_.size(); }
  ControllerSpec& controller(Which which) { return controllers_[which - systems_.size()]; }
  ChangedController changedController(Which which, const std::vector<std::string>& names,
                                      const std::vector<double>& values);
  ParameterAnswer begin(Which which, const ParameterRequest& request);
  void continueRamps(Which which, double now);
  bool prepare(std::size_t system, bool range_covered);
  Which whichOf(const YAML::Node& name) const;
  void resumeChange(const YAML::Node& saved);

  LiveTwin& twin_;
  std::function<bool()> wait_;
  std::vector<SharedSystem> systems_;                // current ones
  std::vector<ControllerSpec> controllers_;          // likewise
  std::vector<std::int64_t> generations_;            // of all current ones; 0: the scene's
  std::vector<std::vector<SpeedRange>> made_ready_;  // prepared ranges of each system
  std::vector<SpeedRange> scene_speed_ranges_;
  std::vector<SpeedRange> speed_ranges_;        // of the drives since the start
  std::vector<std::optional<double>> targets_;  // [rad/s], of their last moves, if not the scene's
  std::vector<Ramp> ramps_;
  double ramped_at_ = 0.0;  // [s], simulated
};

}  // namespace whirl_twin
