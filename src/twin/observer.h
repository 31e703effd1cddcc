// Turns the twin's records into what users see: whirl radius and phase, angles, energies. It
// follows the records in order (the phase is unwrapped, the energy residual needs the start), on
// the side of the publisher, not in the real-time thread. What it follows has a class each:
// FollowedWhirl, EnergyAudit, ErrorTrack, MotorTrack; observed_states.h fills the messages.
//
// observe() works out everything, for a step that somebody is told of. look() costs a few
// nanoseconds and keeps what must not be missed between such steps: which way round the centre the
// whirl goes, what a motor gives, that an error was found.
// Phases are the same to the last bit whichever steps were observed, and from where a radius has
// been 1e-9 of the largest one on but for whole turns; the energy residual is in parts of the
// largest energy observed.
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

// The energy balance of a system over its records: what h = v dL/dv - L has gained beyond the work
// that the steps have audited, in parts of the largest energy in play so far.

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

// What a method has got wrong over a system's horizon: the errors of its steps, of which the last
// one in so many is measured, added up and forgotten with the horizon as time constant.

class ErrorTrack {
 public:
  /// The next record: time [s], sum of the steps' errors since the system was set [-], which was
  /// `anew` since the last record. At the beginning the sum may also fall: it counts in parts of a
  /// motion that grows.
  void observe(double time, double sum, double horizon, bool anew);
  double estimate() const { return estimate_; }  ///< [-]; NaN: not estimated

 private:
  double estimate_ = 0.0;
  double sum_ = 0.0;   // of the newest record
  double time_ = 0.0;  // [s], of it
};

class Observer {
 public:
  /// The twin outlives the observer; only what does not change while it runs is read from it.
  /// generations: of a twin whose parameters change while it runs.
  explicit Observer(const Twin& twin, std::shared_ptr<SystemGenerations> generations = nullptr);

  /// Takes the next record. A step count that goes back means the twin was reset.
  void observe(const double* record);
  /// Looks at the next record, which nobody is told of. False: it has to be observed, for it is not
  /// the next, or another parameter or status holds, or an error was found, or its phase is not
  /// known from a look, or energies have not been observed for mostPassed() steps.
  bool look(const double* record);

  /// Likewise, of a twin that this thread steps and whose commands are its own: without a record. A
  /// system that has just stopped is the caller's to notice.
  bool look(const Twin& now);
  /// Every step has to be looked at; else none.
  bool looks() const { return has_motors_ || !rotors_.empty(); }
  /// Steps from one that is observed to the next.
  std::int64_t mostPassed() const { return most_passed_; }

  /// What it knows of the past; put back, of the twin where that is. Not real-time safe.
  void exchange(StateImage& image);

  /// [ns], what states carry as their stamp from now on.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }

  std::int64_t step() const;
  std::size_t systemCount() const { return tracks_.size(); }
  StepStatus status(std::size_t system) const;
  /// The stopText() of a system that has stopped; "" while it runs.
  const std::string& stopReason(std::size_t system) const { return tracks_[system].stop_reason; }
  bool isRotor(std::size_t system) const;

  /// Of a rotor, at the station published first, or at that one of its stations().
  state::WhirlState whirl(std::size_t system, std::size_t station = 0) const;
  /// Where a rotor's whirl is published: SYSTEM first, then SYSTEM_STATION for each further one.
  const std::vector<std::string>& stations(std::size_t system) const { return stations_[system]; }
  state::PendulumState pendulum(std::size_t system) const;  ///< of any other model
  state::DriveState drive(std::size_t drive) const;         ///< of a drive of the scene
  state::MotorState motor(std::size_t drive) const;         ///< of a drive that is a motor
  state::ControllerState controller(std::size_t controller) const;
  /// Whirl radius [m] and unwrapped phase lag [rad] of a rotor (NaN while undefined).
  double whirlRadius(std::size_t system) const;
  WhirlMotion whirlOf(std::size_t system, std::size_t station = 0) const;
  /// What probes there and a keyphasor at the phase mark would know at a record, which need not be
  /// the newest but has its parameters. Not finite where the system has stopped.
  OrbitSample orbitSample(const double* record, std::size_t system, std::size_t station) const;
  double whirlPhase(std::size_t system) const;
  const double* coordinates(std::size_t system) const;  ///< q
  const double* rates(std::size_t system) const;        ///< q'
  /// Energy gained beyond the work done, relative to the largest energy in play so far, since the
  /// start or the last change of parameters: the change itself does work.
  double energyResidual(std::size_t system) const;
  Energies energies(std::size_t system) const;
  /// What its method has got wrong over its horizon [-] (error_track.h). As `tolerance`, in parts
  /// of the largest coordinates; where the motion magnifies errors the true one is larger. NaN: not
  /// estimated.
  double errorEstimate(std::size_t system) const { return tracks_[system].error.estimate(); }
  /// The parameters the system has now and what of them changed last, without the instant.
  const state::ParameterChange& parameters(std::size_t system) const {
    return tracks_[system].parameters;
  }
  /// Of the newest record; another number, perhaps other parameters.
  std::int64_t generation(std::size_t system) const { return tracks_[system].generation; }
  /// Likewise, of a controller.
  const state::ParameterChange& controllerParameters(std::size_t controller) const {
    return controller_tracks_[controller].parameters;
  }
  std::int64_t controllerGeneration(std::size_t controller) const {
    return controller_tracks_[controller].generation;
  }
  /// The newest record has the step of the one before: it tells of a change of parameters, at the
  /// state that is known.
  bool tellsOnlyChange() const { return tells_only_change_; }
  /// Of the newest record, with the stamp last set.
  state::Instant instant() const;
  /// Time, and the motion of the system's shaft, at the newest record.
  Moment<double> moment(std::size_t system) const;

 private:
  struct Track {
    FollowedWhirl whirl;  // of a rotor
    std::int64_t generation = -1;
    std::shared_ptr<const Dynamics> dynamics;
    state::ParameterChange parameters;
    double slowest_orbit = 0.0;  // [rad/s], below which there is no 1X orbit to speak of
    EnergyAudit energy;
    ErrorTrack error;
    std::string stop_reason;
    std::int64_t motor_generation = -1;  // that the motor's work is counted from
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
  /// anew: its sums have begun again since the last record.
  void follow(std::size_t system, bool anew);
  void prepareLooks();
  void followMotors(const double* record);
  bool errorFound(std::size_t system, double sum);

  const Twin& twin_;
  std::shared_ptr<SystemGenerations> generations_;
  std::vector<double> record_;
  std::vector<Track> tracks_;
  std::vector<ControllerTrack> controller_tracks_;
  std::vector<std::vector<std::string>> stations_;  // names, as at the start
  std::vector<MotorTrack> motors_;                  // of each drive
  std::vector<std::size_t> rotors_;
  std::vector<double> looked_errors_;  // of each system: sum, when last looked at
  std::vector<double> looked_;         // room for a record
  double fastest_ = 0.0;               // [rad/s], of the drives that are no motors
  bool has_motors_ = false;
  std::int64_t most_passed_ = 1;
  std::int64_t stamp_ = 0;
  bool tells_only_change_ = false;
};

}  // namespace whirl_twin
