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
  /// Prepares the steps of what is built, at the scene's start. Throws SceneError for a scene whose
  /// steps cannot be prepared.
  explicit Twin(BuiltScene built);
  /// Of a scene that is built for it: build().
  explicit Twin(const Scene& scene);
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;

  const BuiltScene& built() const { return built_; }
  const Scene& scene() const { return built_.scene; }
  /// As the scene says, whatever has been put in their places since.
  const std::vector<SharedSystem>& systems() const { return built_.systems; }
  const RecordLayout& layout() const { return layout_; }
  /// Drives of the scene first, in its order; then those of systems at constant speed.
  std::size_t driveCount() const { return drives_.size(); }
  static constexpr std::size_t kNoSystem = static_cast<std::size_t>(-1);
  /// The system whose spin a drive's motion is, if the drive is a motor; else kNoSystem.
  std::size_t turnedBy(std::size_t drive) const noexcept { return turned_by_[drive]; }
  bool isMotor(std::size_t drive) const noexcept { return turned_by_[drive] != kNoSystem; }
  /// Also steps the ensembles of the scene from now on, which a twin that is only analysed, or
  /// followed, does without. Before the first step. Throws SceneError for members whose parameters
  /// do not fit together or whose steps cannot be prepared.
  void buildEnsembles();
  /// The ensemble of a system; nullptr: it has none, or they were not built.
  Ensemble* ensemble(std::size_t system) noexcept { return ensembles_[system].get(); }
  const Ensemble* ensemble(std::size_t system) const noexcept { return ensembles_[system].get(); }
  /// What steps a system, on its drive and with its inputs; its state is yet to be set. Throws
  /// RunFailure where its steps cannot be prepared.
  std::unique_ptr<Stepper> stepperOf(const BuiltSystem& system) const;

  // Real-time safe.

  /// May it step, or does simulated time wait for a controller in another process, `elapsed` [ns]
  /// of wall time after this was asked last? Who does not ask has none.
  bool mayStep(std::int64_t elapsed) noexcept {
    return !control_.any() || control_.mayGoOn(now() + scene().step, elapsed);
  }
  /// One step of everything that has not stopped.
  void step() noexcept;
  /// Up to `count` > 0 steps, ending with one in which a system stops; how many were taken.
  std::int64_t steps(std::int64_t count) noexcept;
  /// One step, with what each system and the controllers take of it: timedParts() parts.
  void step(StepTimes& times) noexcept;
  std::size_t timedParts() const noexcept { return running_.size() + (control_.any() ? 1 : 0); }
  /// Back to the scene's start, with the scene's own systems.
  void reset() noexcept;
  /// Puts another in the place of a system, with its coordinates and rates as they are, known from
  /// now on by a generation > 0. Returns the one it has no more use for.
  std::unique_ptr<Stepper> replace(std::size_t system, std::unique_ptr<Stepper> next,
                                   std::int64_t generation) noexcept;
  /// Lets a controller go on with another law of its kind (RunningController::replace()).
  std::unique_ptr<Controller> replaceLaw(std::size_t controller, std::unique_ptr<Controller> next,
                                         std::int64_t generation) noexcept {
    return control_.replace(controller, std::move(next), generation);
  }
  /// All that its next steps hang on, but what the scene says and what replace() and replaceLaw()
  /// have put in the places of what it says: that has to be there before a state is put back.
  void exchange(StateImage& image) noexcept;
  std::int64_t stepCount() const noexcept { return steps_; }
  /// [s], simulated: start + steps x step, from a whole number of nanoseconds.
  double time() const noexcept { return seconds(steps_); }
  double seconds(std::int64_t steps) const noexcept;
  /// The present state, as laid out by layout(); kScheduled is left alone.
  void write(double* record) const noexcept;
  const Drive& drive(std::size_t index) const noexcept { return drives_[index]; }
  /// Sends a drive to a new speed from where it is now. False for values out of range, and for a
  /// motor: its speed is an outcome.
  bool setSpeed(std::size_t drive, double speed, double max_acceleration, double max_jerk) noexcept;
  /// Sets an input of a system, in the order of its dynamics, from the next step on and for
  /// `duration` [ns] of simulated time; then its own value returns. False, with nothing changed, as
  /// Inputs::set() and for a duration that is not positive.
  bool setInput(std::size_t system, std::size_t input, double value,
                std::int64_t duration) noexcept;
  const ControlLoop& control() const noexcept { return control_; }
  const Inputs& inputs(std::size_t system) const noexcept { return inputs_[system]; }
  StepStatus status(std::size_t system) const noexcept { return status_[system]; }
  /// What steps in the place of a system.
  const Stepper& running(std::size_t system) const noexcept { return *running_[system]; }

 private:
  /// [ns], simulated.
  std::int64_t now() const noexcept { return scene().time + steps_ * scene().step; }
  void beginStep() noexcept;
  void beginDrives() noexcept;
  template <class Marks>
  bool stepMarked(const Marks& marks) noexcept;
  template <class Marks>
  void goOnAccompanied(double time, const Marks& marks) noexcept;
  template <class Marks>
  bool stepControlled(double time, const Marks& marks) noexcept;

  BuiltScene built_;
  std::vector<Drive> drives_;                           // steppers keep references to them
  std::vector<Inputs> inputs_;                          // of each system, likewise
  ControlLoop control_;                                 // acts by inputs_
  std::vector<std::size_t> turned_by_;                  // of each drive
  std::vector<std::unique_ptr<Stepper>> steppers_;      // the scene's
  std::vector<std::unique_ptr<Stepper>> replacements_;  // latest of each system; null: none yet
  std::vector<Stepper*> running_;                       // of steppers_ or replacements_
  std::vector<std::int64_t> generation_;                // of running_; 0: the scene's
  std::vector<std::unique_ptr<Ensemble>> ensembles_;    // of each system; null: none
  std::vector<Ensemble*> stepped_ensembles_;            // those that there are
  std::vector<std::size_t> stepped_of_;                 // the systems that have them
  std::vector<Inputs*> begun_inputs_;                   // of inputs_, of systems that have any
  bool accompanied_ = false;                            // by ensembles or inputs
  std::vector<double> state_;                           // room for q, v and work of the largest
  std::vector<StepStatus> status_;
  RecordLayout layout_;
  std::int64_t steps_ = 0;
};

/// Of the records of a scene's twin.
RecordLayout layoutOf(const BuiltScene& scene);

}  // namespace whirl_twin
