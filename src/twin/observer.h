// Computes the published states from the twin's records: whirl radius and phase, angles, energies.
// It processes the records in order (the phase is unwrapped, the energy residual needs the start),
// in the publisher's thread, not in the real-time thread. Its tracks are classes:
// WhirlPhaseTracker, EnergyAudit, ErrorTrack, MotorTrack; observed_states.h fills the messages.
//
// observe() computes everything, for published steps. look() costs a few nanoseconds and keeps
// track of what must not be missed in between: the direction in which the whirl passes the centre,
// the work of a motor, new error estimates. Phases are bit-identical whichever steps were observed,
// but for whole turns where a radius was below 1e-9 of the largest one; the energy residual is
// relative to the largest energy observed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "messages/controller_state.h"
#include "messages/states.h"
#include "realtime/state_image.h"
#include "signal/orbit_window.h"
#include "twin/motor_track.h"
#include "twin/stop_text.h"
#include "twin/system_generations.h"
#include "twin/twin.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

// Energy balance of a system over its records: the gain of h = v dL/dv - L beyond the work audited
// by the steps, relative to the largest energy so far.

class EnergyAudit {
 public:
  /// The next record; the first one is the start.
  void observe(const Energies& energies, double work);
  double residual() const { return residual_; }  ///< [-]

 private:
  bool started_ = false;
  double start_ = 0.0;     // [J], h less the work
  double scale_ = 0.0;     // [J], largest T + |V| so far
  double residual_ = 0.0;  // [-]
};

// Error estimate of a method over a system's horizon: the sum of the step errors, of which one step
// in several is measured, with exponential forgetting (time constant: the horizon).

class ErrorTrack {
 public:
  /// The next record: time [s], sum of the step errors since the system was set [-], which was
  /// `restarted` since the last record. Initially the sum may also fall: it is relative to a
  /// growing motion.
  void observe(double time, double sum, double horizon, bool restarted);
  double estimate() const { return estimate_; }  ///< [-]; NaN: none

 private:
  double estimate_ = 0.0;
  double sum_ = 0.0;   // of the newest record
  double time_ = 0.0;  // [s], of this record
};

class Observer {
 public:
  /// The twin must outlive the observer; only its constant members are read. generations: for a
  /// twin whose parameters change while it runs.
  explicit Observer(const Twin& twin, std::shared_ptr<SystemGenerations> generations = nullptr);

  /// The next record. A lower step count means that the twin was reset.
  void observe(const double* record);
  /// Processes the next record without publishing it. False: it must be observed, because it is not
  /// the next one, a parameter or status has changed, an error was measured, its phase cannot be
  /// tracked, or energies have not been observed for mostPassed() steps.
  bool look(const double* record);

  /// Likewise without a record, for a twin stepped and commanded by this thread only. The caller
  /// must check for systems that have just stopped.
  bool look(const Twin& now);
  /// look() must be called for every step; false: for none.
  bool looks() const { return has_motors_ || !rotors_.empty(); }
  /// Maximum number of steps between observed ones.
  std::int64_t mostPassed() const { return most_passed_; }

  /// Serializes the state of the past; restore that of the twin first. Not real-time safe.
  void exchange(StateImage& image);

  /// [ns], stamp of the following states.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }

  std::int64_t step() const;
  std::size_t systemCount() const { return tracks_.size(); }
  StepStatus status(std::size_t system) const;
  /// The stopText() of a system that has stopped; "" while it runs.
  const std::string& stopReason(std::size_t system) const { return tracks_[system].stop_reason; }
  bool isRotor(std::size_t system) const;

  /// Of a rotor, at its first published station, or at another one of stations().
  state::WhirlState whirl(std::size_t system, std::size_t station = 0) const;
  /// Names of the stations with a published whirl: SYSTEM first, then SYSTEM_STATION for each
  /// further one.
  const std::vector<std::string>& stations(std::size_t system) const { return stations_[system]; }
  state::PendulumState pendulum(std::size_t system) const;  ///< of a system that is no rotor
  state::DriveState drive(std::size_t drive) const;         ///< of a drive of the scene
  state::MotorState motor(std::size_t drive) const;         ///< of a drive that is a motor
  state::ControllerState controller(std::size_t controller) const;
  /// Whirl radius [m] and unwrapped phase lag [rad] of a rotor (NaN while undefined).
  double whirlRadius(std::size_t system) const;
  WhirlMotion whirlOf(std::size_t system, std::size_t station = 0) const;
  /// Readings of ideal probes at a station and a keyphasor at the phase reference at a record,
  /// which need not be the newest but must have its parameters. Not finite if the system has
  /// stopped.
  OrbitSample orbitSample(const double* record, std::size_t system, std::size_t station) const;
  double whirlPhase(std::size_t system) const;
  const double* coordinates(std::size_t system) const;  ///< q
  const double* rates(std::size_t system) const;        ///< q'
  /// Energy gained beyond the work done, relative to the largest energy so far, since the start or
  /// the last change of parameters (the change itself does work).
  double energyResidual(std::size_t system) const;
  Energies energies(std::size_t system) const;
  /// Estimated error of its method over its horizon [-] (ErrorTrack). Like `tolerance`, relative to
  /// the largest coordinates; if the motion amplifies errors the true one is larger. NaN: not
  /// estimated.
  double errorEstimate(std::size_t system) const { return tracks_[system].error.estimate(); }
  /// The current parameters of the system and the last changed ones, without the instant.
  const state::ParameterChange& parameters(std::size_t system) const {
    return tracks_[system].parameters;
  }
  /// Of the newest record; a different number may mean different parameters.
  std::int64_t generation(std::size_t system) const { return tracks_[system].generation; }
  /// Likewise for a controller.
  const state::ParameterChange& controllerParameters(std::size_t controller) const {
    return controller_tracks_[controller].parameters;
  }
  std::int64_t controllerGeneration(std::size_t controller) const {
    return controller_tracks_[controller].generation;
  }
  /// The newest record has the step of the one before: it publishes a change of parameters at a
  /// known state.
  bool tellsOnlyChange() const { return tells_only_change_; }
  /// Of the newest record, with the last stamp.
  state::Instant instant() const;
  /// Time and motion of the system's shaft at the newest record.
  EvaluationPoint<double> moment(std::size_t system) const;

 private:
  struct Track {
    WhirlPhaseTracker whirl;  // of a rotor
    std::int64_t generation = -1;
    std::shared_ptr<const Dynamics> dynamics;
    state::ParameterChange parameters;
    double slowest_orbit = 0.0;  // [rad/s], below it the 1X orbit is undefined
    EnergyAudit energy;
    ErrorTrack error;
    std::string stop_reason;
    std::int64_t motor_generation = -1;  // since which the motor's work is counted
  };

  struct ControllerTrack {
    std::int64_t generation = -1;
    state::ParameterChange parameters;
  };

  SystemView view(std::size_t system) const;
  ShaftView shaft(std::size_t drive) const;
  ShaftView shaftOf(std::size_t system) const;
  std::string whyStopped(std::size_t system) const;
  bool takeGeneration(std::size_t system);
  bool takeControllers();
  void takeStations(std::size_t system);
  /// restarted: its sums have restarted since the last record.
  void follow(std::size_t system, bool restarted);
  void prepareLooks();
  void followMotors(const double* record);
  bool errorFound(std::size_t system, double sum);

  const Twin& twin_;
  std::shared_ptr<SystemGenerations> generations_;
  std::vector<double> record_;
  std::vector<Track> tracks_;
  std::vector<ControllerTrack> controller_tracks_;
  std::vector<std::vector<std::string>> stations_;  // at the start
  std::vector<MotorTrack> motors_;                  // of each drive
  std::vector<std::size_t> rotors_;
  std::vector<double> looked_errors_;  // last sums of each system
  std::vector<double> looked_;         // work space for a record
  double fastest_ = 0.0;               // [rad/s], of drives other than motors
  bool has_motors_ = false;
  std::int64_t most_passed_ = 1;
  std::int64_t stamp_ = 0;
  bool tells_only_change_ = false;
};

}  // namespace whirl_twin
