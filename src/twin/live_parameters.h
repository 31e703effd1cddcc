// Changes of parameters while the twin runs, of its systems and of its controllers: checked in the
// words of a scene file, built beside the loop, swapped in between two steps with coordinates and
// rates as they are; a controller takes over from the one before. A change may go in a
// ramp: linear in simulated time, in updates kRampUpdate apart. Belongs to the thread that sends
// the commands.
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

/// Which numbers of a system or a controller to change, all at the same instant.
struct ParameterRequest {
  std::string system;              ///< or controller: no two have the same name
  std::vector<std::string> names;  ///< paths: `damping`, `discs[1].mass`
  std::vector<double> values;      ///< in the units of the model or the controller
  double ramp = 0.0;               ///< [s], simulated; 0: at once
};

struct ParameterAnswer {
  bool done = false;
  std::string message;           ///< what happens, or why nothing does
  std::vector<double> previous;  ///< of the names
  std::int64_t step = 0;         ///< the step reached
};

/// How far a move of a drive takes it [rad/s].
struct SpeedReach {
  double target;  ///< where it ends
  double lowest;
  double highest;
};

class LiveParameters {
 public:
  /// [s], simulated: a ramp is a staircase of so long steps.
  static constexpr double kRampUpdate = 0.02;

  /// To be made before the loop starts. wait() returns when every command sent is carried out;
  /// false: the loop ended first.
  LiveParameters(LiveTwin& twin, std::function<bool()> wait);

  ParameterAnswer set(const ParameterRequest& request);

  /// Carries the ramps on that are under way, as far as simulated time has come. Returns what was
  /// wrong with those that had to be given up.
  std::vector<std::string> continueRamps();
  bool ramping() const { return !ramps_.empty(); }
  /// How many steps from the one reached a ramp has its next update, at least 1; none under way:
  /// no bound.
  std::uint64_t stepsToUpdate() const;

  /// Of a move that is sound (faultOf), were it to start now: to its speed, or to the edge of a
  /// band that the drive avoids. Nothing: the loop ended.
  std::optional<SpeedReach> reachOf(std::size_t drive, const SpeedMove& move);

  /// Why a drive cannot be sent there: an ensemble on it is not prepared for that, or a system on
  /// it would stop at the target; "" if it can.
  std::string objectionTo(std::size_t drive, const SpeedReach& reach) const;
  std::string objectionToSpeed(std::size_t drive, double speed) const {
    return objectionTo(drive, {speed, speed, speed});
  }

  /// Makes every system on a drive ready for a move, to be called before the command that starts
  /// it. False: the loop ended.
  bool prepareFor(std::size_t drive, const SpeedMove& move);

  /// The loop has carried out a kReset: the scene's parameters hold again.
  void restored();

  /// All that has been changed since the start, for a checkpoint, of the state that the twin has
  /// while nothing is sent.
  YAML::Node saved() const;
  /// Before the loop runs: changes all that again. Throws what making systems and laws throws, and
  /// YAML::Exception for what saved() has not made.
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
  std::string objectionTo(const ParameterRequest& request) const;
  /// Puts the system as changed in its place. Throws where its steps cannot be prepared.
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
  std::vector<SharedSystem> systems_;                // as they are now
  std::vector<ControllerSpec> controllers_;          // likewise
  std::vector<std::int64_t> generations_;            // of all, as they are now; 0: the scene's
  std::vector<std::vector<SpeedRange>> made_ready_;  // what each system has been since it was made
  std::vector<SpeedRange> scene_speed_ranges_;
  std::vector<SpeedRange> speed_ranges_;        // of the drives since the start
  std::vector<std::optional<double>> targets_;  // [rad/s], of their last moves beyond the scene
  std::vector<Ramp> ramps_;
  double ramped_at_ = 0.0;  // [s], simulated
};

}  // namespace whirl_twin
