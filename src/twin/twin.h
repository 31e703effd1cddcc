// The running twin: the systems and drives of a built scene, stepped together.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "control/drive.h"
#include "control/inputs.h"
#include "integration/stepper.h"
#include "realtime/state_image.h"
#include "scene/built_scene.h"
#include "twin/control_loop.h"
#include "twin/ensemble.h"
#include "twin/record.h"
#include "twin/step_times.h"

namespace whirl_twin {

class Twin {
 public:
  /// Prepares the steps of a built scene at its start. Throws SceneError if they cannot be
  /// prepared.
  explicit Twin(BuiltScene built);
  /// Builds the scene first: build().
  explicit Twin(const Scene& scene);
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;

  const BuiltScene& built() const { return built_; }
  const Scene& scene() const { return built_.scene; }
  /// The scene's systems, regardless of replacements.
  const std::vector<SharedSystem>& systems() const { return built_.systems; }
  const RecordLayout& layout() const { return layout_; }
  /// Drives of the scene first, in its order; then those of systems at constant speed.
  std::size_t driveCount() const { return drives_.size(); }
  static constexpr std::size_t kNoSystem = static_cast<std::size_t>(-1);
  /// The system driven by a drive, if that is a motor; else kNoSystem.
  std::size_t turnedBy(std::size_t drive) const noexcept { return turned_by_[drive]; }
  bool isMotor(std::size_t drive) const noexcept { return turned_by_[drive] != kNoSystem; }
  /// Also steps the ensembles of the scene from now on; not needed for a twin that is only analysed
  /// or estimated. Before the first step. Throws SceneError for samples whose parameters are
  /// inconsistent or whose steps cannot be prepared.
  void buildEnsembles();
  /// The ensemble of a system; nullptr: it has none, or ensembles were not built.
  Ensemble* ensemble(std::size_t system) noexcept { return ensembles_[system].get(); }
  const Ensemble* ensemble(std::size_t system) const noexcept { return ensembles_[system].get(); }
  /// A stepper for a system, on its drive and with its inputs; its state is not set. Throws
  /// RunFailure if its steps cannot be prepared.
  std::unique_ptr<Stepper> stepperOf(const BuiltSystem& system) const;

  // Real-time safe.

  /// May it step, or does simulated time wait for an external controller? `elapsed` [ns]: wall time
  /// since the last call. Optional for a twin without such controllers.
  bool mayStep(std::int64_t elapsed) noexcept {
    return !control_.any() || control_.mayGoOn(now() + scene().step, elapsed);
  }
  /// One step of all systems that have not stopped.
  void step() noexcept;
  /// Up to `count` > 0 steps, ending with one in which a system stops; returns the number of steps.
  std::int64_t steps(std::int64_t count) noexcept;
  /// One step, with the computing time of each system and the controllers: timedParts() parts.
  void step(StepTimes& times) noexcept;
  std::size_t timedParts() const noexcept { return running_.size() + (control_.any() ? 1 : 0); }
  /// Resets to the scene's start, with the scene's own systems.
  void reset() noexcept;
  /// Replaces a system, with unchanged coordinates and rates and a generation > 0. Returns the
  /// stepper that is no longer used.
  std::unique_ptr<Stepper> replace(std::size_t system, std::unique_ptr<Stepper> next,
                                   std::int64_t generation) noexcept;
  /// Replaces the control law of a controller by another one of its kind
  /// (RunningController::replace()).
  std::unique_ptr<Controller> replaceLaw(std::size_t controller, std::unique_ptr<Controller> next,
                                         std::int64_t generation) noexcept {
    return control_.replace(controller, std::move(next), generation);
  }
  /// Serializes all state, except what the scene defines and what replace() and replaceLaw() have
  /// replaced: the replacements must be in place before a state is restored.
  void exchange(StateImage& image) noexcept;
  std::int64_t stepCount() const noexcept { return steps_; }
  /// [s], simulated: start + steps x step, from a whole number of nanoseconds.
  double time() const noexcept { return seconds(steps_); }
  double seconds(std::int64_t steps) const noexcept;
  /// The current state, in the format of layout(); kScheduled is not written.
  void write(double* record) const noexcept;
  const Drive& drive(std::size_t index) const noexcept { return drives_[index]; }
  /// Moves a drive to a new speed from its current state. False for values out of range, and for a
  /// motor: its speed is a result.
  bool setSpeed(std::size_t drive, double speed, double max_acceleration, double max_jerk) noexcept;
  /// Sets an input of a system, in the order of its dynamics, from the next step on for `duration`
  /// [ns] of simulated time; then its own value applies again. False, without a change, as
  /// Inputs::set() and for a duration that is not positive.
  bool setInput(std::size_t system, std::size_t input, double value,
                std::int64_t duration) noexcept;
  const ControlLoop& control() const noexcept { return control_; }
  const Inputs& inputs(std::size_t system) const noexcept { return inputs_[system]; }
  StepStatus status(std::size_t system) const noexcept { return status_[system]; }
  /// The current stepper of a system.
  const Stepper& running(std::size_t system) const noexcept { return *running_[system]; }

 private:
  /// [ns], simulated.
  std::int64_t now() const noexcept { return scene().time + steps_ * scene().step; }
  void beginStep() noexcept;
  void beginDrives() noexcept;
  template <class Marks>
  bool stepMarked(const Marks& marks) noexcept;
  template <class Marks>
  void advanceAccompanied(double time, const Marks& marks) noexcept;
  template <class Marks>
  bool stepControlled(double time, const Marks& marks) noexcept;

  BuiltScene built_;
  std::vector<Drive> drives_;                           // steppers keep references to them
  std::vector<Inputs> inputs_;                          // of each system, likewise
  ControlLoop control_;                                 // acts by inputs_
  std::vector<std::size_t> turned_by_;                  // of each drive
  std::vector<std::unique_ptr<Stepper>> steppers_;      // of the scene
  std::vector<std::unique_ptr<Stepper>> replacements_;  // latest of each system; null: none yet
  std::vector<Stepper*> running_;                       // of steppers_ or replacements_
  std::vector<std::int64_t> generation_;                // of running_; 0: the scene's
  std::vector<std::unique_ptr<Ensemble>> ensembles_;    // of each system; null: none
  std::vector<Ensemble*> stepped_ensembles_;            // of ensembles_, not null
  std::vector<std::size_t> stepped_of_;                 // their systems
  std::vector<Inputs*> begun_inputs_;                   // of inputs_, of systems with inputs
  bool accompanied_ = false;                            // with ensembles or inputs
  std::vector<double> state_;                           // work space, of the largest system
  std::vector<StepStatus> status_;
  RecordLayout layout_;
  std::int64_t steps_ = 0;
};

/// Layout of the records of a scene's twin.
RecordLayout layoutOf(const BuiltScene& scene);

}  // namespace whirl_twin
