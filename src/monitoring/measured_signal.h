// A system that is measured: two displacement probes at one of its stations and a keyphasor of its
// drive, which the scene's `sensors` name. Of their messages (Measurement) it makes the motion that
// alarms act on, without a model: samples with the angle of the shaft, their orders twenty times a
// second, and whether they can be evaluated at all.
//
// Bad quality, as machine protection has it (data_quality.h): a probe is silent for data_timeout,
// marks a sample as invalid (clipped, say), is not finite or stuck, or the whirl is beyond `range`.
// A message with one such sample is bad as a whole: the remainder of a clipped orbit would pass for
// a small one. Without pulses of a shaft that turned a moment ago quality is bad, too, but
// vibration is still evaluated.
//
// Slow-roll compensation: bow and run-out are subtracted from every sample whose shaft angle is
// known. They are as given, or as measured at the slowest speed of the shaft below a given one.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/measurement.h"
#include "messages/order_state.h"
#include "messages/states.h"
#include "monitoring/data_quality.h"
#include "scene/built_scene.h"
#include "signal/measured_orbit.h"
#include "signal/order_filter.h"

namespace whirl_twin {

/// The sensors at a system's first station that has two probes in different directions, where its
/// drive has a keyphasor; none: it is not measured.
std::optional<MeasuredOrbitSettings> measuredOrbitOf(const BuiltScene& scene, std::size_t system);

class MeasuredSignal {
 public:
  MeasuredSignal(std::string system, const MeasuredOrbitSettings& orbit,
                 const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// Time restarts; the slow roll stays.
  void restart();

  bool listensTo(const std::string& source) const { return orbit_.listensTo(source); }
  /// A message of a source that it listens to came at wall_time [s].
  void take(const state::Measurement& message, double wall_time);
  /// It is measured indeed: messages of a probe have come.
  bool received() const { return probes_[0].received || probes_[1].received; }
  /// The newest samples can be evaluated.
  bool isFit(double wall_time) const;
  /// Why they cannot, or what is missing; "": all is present. paused: the simulation is paused.
  std::string problem(double wall_time, bool paused) const;

  /// What the message taken last has completed.
  const std::vector<state::WhirlState>& motion() const { return motion_; }
  const std::vector<state::OrderState>& orders() const { return orders_; }
  /// [rad/s^2], of the shaft at the last of motion().
  double acceleration() const { return acceleration_; }
  /// The vector subtracted by slow-roll compensation, if there is one.
  const std::optional<OrderVector>& slowRoll() const { return slow_roll_; }

 private:
  struct Probe {
    std::string name;  // SOURCE/CHANNEL
    bool received = false;
    double received_at = 0.0;  // [s, wall]
    std::string why;           // the newest message cannot be evaluated
    StuckChannel samples;
  };

  void check(Probe& probe, const MeasuredProbe& at, const state::Measurement& message,
             double wall_time);
  bool isSilent(const Probe& probe, double wall_time) const;
  void addSample(const OrbitSample& sample);
  void learnSlowRoll(const OrbitSample& sample, bool due);

  std::string system_;
  MeasuredOrbitSettings settings_;
  MeasuredOrbit orbit_;
  OrderFilter filter_;
  OrderFilter slow_filter_;  // of the motion as it is, at slow roll
  std::array<Probe, 2> probes_;
  double timeout_ = 0.0;     // [s, wall]
  double range_ = 0.0;       // [m]
  double slow_below_ = 0.0;  // [rad/s], slow roll is learned; 0: it is not
  std::optional<OrderVector> slow_roll_;
  double slow_at_ =
      std::numeric_limits<double>::infinity();  // [rad/s], the slowest it was learned at
  std::string beyond_;                          // why the newest samples are out of range
  double pulse_at_ = 0.0;                       // [s, wall], of the newest message of the keyphasor
  double turning_ = 0.0;                        // [rad/s], the speed known last
  double published_at_ = 0.0;                   // [s], of the newest orders
  double acceleration_ = 0.0;
  std::vector<OrbitSample> samples_;
  std::vector<state::WhirlState> motion_;
  std::vector<state::OrderState> orders_;
};

}  // namespace whirl_twin
