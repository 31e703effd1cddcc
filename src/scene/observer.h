// Turns the twin's records into what users see: whirl radius and phase, angles, energies. It
// follows the records in order (the phase is unwrapped, the energy residual needs the start), on
// the side of the publisher, not in the real-time thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/states.h"
#include "scene/twin.h"

namespace whirl_twin {

class Observer {
 public:
  /// The twin outlives the observer; only what does not change while it runs is read from it.
  explicit Observer(const Twin& twin);

  /// Takes the next record. A step count that goes back means the twin was reset.
  void observe(const double* record);

  /// [ns], what states carry as their stamp from now on.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }

  std::int64_t step() const;
  std::size_t systemCount() const { return tracks_.size(); }
  StepStatus status(std::size_t system) const;
  /// "rotor: stopped after step 41 (t = 0.041 s), state not finite; last good state x = ..., ...";
  /// "" while the system runs.
  const std::string& stopReason(std::size_t system) const { return tracks_[system].stop_reason; }
  bool isRotor(std::size_t system) const;

  state::WhirlState whirl(std::size_t system) const;        ///< of a rotor
  state::PendulumState pendulum(std::size_t system) const;  ///< of any other model
  state::DriveState drive(std::size_t drive) const;         ///< of a drive of the scene
  /// Whirl radius [m] and unwrapped phase lag [rad] of a rotor (NaN while undefined).
  double whirlRadius(std::size_t system) const;
  double whirlPhase(std::size_t system) const;
  const double* coordinates(std::size_t system) const;  ///< q
  const double* rates(std::size_t system) const;        ///< q'
  /// Energy gained beyond the work done, relative to the largest energy in play so far.
  double energyResidual(std::size_t system) const;
  Energies energies(std::size_t system) const;
  /// Time, and the motion of the system's shaft, at the newest record.
  Moment<double> moment(std::size_t system) const;

 private:
  struct Track {
    bool started = false;
    double jacobi = 0.0;         // [J], h at the start
    double scale = 0.0;          // [J], largest T + |V| so far
    double residual = 0.0;       // [-]
    double slowest_orbit = 0.0;  // [rad/s], below which there is no 1X orbit to speak of
    double largest_radius = 0;   // [m]
    double phase = 0.0;          // [rad], last valid, unwrapped
    bool phase_known = false;
    bool phase_valid = false;
    std::string stop_reason;
  };

  const double* driveRecord(std::size_t drive) const;
  void restart(std::size_t system);
  void trackPhase(std::size_t system);
  void trackEnergy(std::size_t system);
  std::string describeStop(std::size_t system) const;
  state::Instant instant() const;

  const Twin& twin_;
  std::vector<double> record_;
  std::vector<Track> tracks_;
  std::int64_t stamp_ = 0;
};

}  // namespace whirl_twin
