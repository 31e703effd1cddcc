// What the twin tells the world of one step: plain values, before they become ROS messages or LCM
// types. Units and meanings stand beside each field; a value that can be undefined is NaN then.
// (In a namespace of their own: the generated ROS messages are whirl_twin::WhirlState and so on.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin::state {

/// When a state holds.
struct Instant {
  std::int64_t step = 0;   ///< steps since the start
  double time = 0.0;       ///< [s], simulated
  std::int64_t stamp = 0;  ///< [ns], what the ROS header carries: wall clock, or simulated time
};

/// A rotor's disc centre in the frame of its bearings.
struct WhirlState {
  Instant at;
  std::string system;
  double radius = 0.0;           ///< [m]
  double phase = 0.0;            ///< [rad], unwrapped lag of the whirl behind the unbalance
  bool phase_valid = false;      ///< the radius is large enough for an angle
  double whirl_angle = 0.0;      ///< [rad], -pi..pi
  double whirl_rate = 0.0;       ///< [rad/s]
  double speed = 0.0;            ///< [rad/s], of the shaft
  double shaft_angle = 0.0;      ///< [rad], total
  double x = 0.0;                ///< [m]
  double y = 0.0;                ///< [m]
  double x_rate = 0.0;           ///< [m/s]
  double y_rate = 0.0;           ///< [m/s]
  double orbit_major = 0.0;      ///< [m], semi-major axis of the synchronous orbit
  double orbit_minor = 0.0;      ///< [m], semi-minor axis
  bool forward = true;           ///< the orbit runs in the direction of rotation
  double energy_residual = 0.0;  ///< [-]
};

/// A pendulum or oscillator: one entry per coordinate, in the model's order.
struct PendulumState {
  Instant at;
  std::string system;
  std::vector<std::string> name;
  std::vector<double> angle;     ///< [rad], or [m] for a sliding coordinate
  std::vector<double> rate;      ///< [rad/s] or [m/s]
  double kinetic = 0.0;          ///< [J]
  double potential = 0.0;        ///< [J]
  double energy_residual = 0.0;  ///< [-]
};

/// A shaft that turns.
struct DriveState {
  Instant at;
  std::string drive;
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s^2]
  double jerk = 0.0;          ///< [rad/s^3]
  double target_speed = 0.0;  ///< [rad/s], where the present move ends
  std::int64_t turns = 0;     ///< whole turns since angle 0
  double remainder = 0.0;     ///< [rad], 0..2 pi
  double shaft_angle = 0.0;   ///< [rad], total
};

/// A motor that turns a rotor, and where its work goes: motor_work = dissipated_work + what
/// `energy` has gained, as well as the energy residual says.
struct MotorState {
  Instant at;
  std::string drive;
  std::string system;             ///< the rotor it turns
  double speed = 0.0;             ///< [rad/s]
  double acceleration = 0.0;      ///< [rad/s^2]
  double torque = 0.0;            ///< [N m]
  double motor_power = 0.0;       ///< [W], torque x speed
  double drag_power = 0.0;        ///< [W], lost to the drag on the spin
  double dissipated_power = 0.0;  ///< [W], lost in the whirl: all damping but the drag
  double energy = 0.0;            ///< [J], kinetic and potential
  double motor_work = 0.0;        ///< [J], since the start or the last change of parameters
  double dissipated_work = 0.0;   ///< [J], likewise, drag included
};

/// The spread of an ensemble: a system `count` times over, each with parameters of its own. One
/// entry per quantity: a rotor's radius, or the coordinates of any other model. Of the members that
/// still run; the peaks are each member's largest magnitude since the start.
struct EnsembleState {
  Instant at;
  std::string system;
  std::int64_t count = 0;    ///< members
  std::int64_t running = 0;  ///< of them, not stopped
  std::vector<std::string> quantity;
  std::vector<std::string> unit;  ///< "m" or "rad"
  std::vector<double> mean, standard_deviation;
  std::vector<double> smallest, percentile_5, percentile_25, median, percentile_75, percentile_95,
      largest;
  std::vector<double> peak_mean, peak_standard_deviation;
  std::vector<double> peak_percentile_5, peak_median, peak_percentile_95, peak_largest;
};

/// The parameters of a system from an instant on, and which of them changed then.
struct ParameterChange {
  Instant at;
  std::string system;
  std::vector<std::string> names;    ///< every number: `damping`, `discs[1].mass`
  std::vector<double> values;        ///< of each, in the units of the model
  std::vector<std::string> changed;  ///< some of `names`; none at the start
  std::vector<double> previous;      ///< values of those before
};

}  // namespace whirl_twin::state
