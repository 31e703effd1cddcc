// The twin's output of one step as plain values, before conversion to ROS messages or LCM types.
// Units and meaning are documented at each field; an undefined value is NaN. (They have a separate
// namespace because the generated ROS messages are whirl_twin::WhirlState and so on.)
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"

namespace whirl_twin::state {

/// When a state holds.
struct Instant {
  std::int64_t step = 0;   ///< steps since the start
  double time = 0.0;       ///< [s], simulated
  std::int64_t stamp = 0;  ///< [ns], stamp of the ROS header: wall clock, or simulated time
};

/// A rotor's disc centre in the frame of its bearings.
struct WhirlState {
  static constexpr MessageKind kKind{"whirl", "WhirlState", "*/whirl",
                                     MessageKind::kSeries | MessageKind::kJointStates};

  Instant at;
  std::string system;
  double radius = 0.0;           ///< [m]
  double phase = 0.0;            ///< [rad], unwrapped lag of the whirl relative to the phase
                                 ///< reference
  bool phase_valid = false;      ///< the radius is large enough for an angle
  double whirl_angle = 0.0;      ///< [rad], -pi..pi
  double whirl_rate = 0.0;       ///< [rad/s]
  double speed = 0.0;            ///< [rad/s], of the shaft
  double shaft_angle = 0.0;      ///< [rad], total
  double x = 0.0;                ///< [m]
  double y = 0.0;                ///< [m]
  double x_rate = 0.0;           ///< [m/s]
  double y_rate = 0.0;           ///< [m/s]
  double orbit_major = 0.0;      ///< [m], semi-major axis of the orbit, assuming purely synchronous
                                 ///< motion
  double orbit_minor = 0.0;      ///< [m], semi-minor axis
  bool forward = true;           ///< that orbit runs in the direction of rotation
  double energy_residual = 0.0;  ///< [-]

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(system));
    visit(TWIN_FIELD(radius), "m");
    visit(TWIN_FIELD(phase), "rad");
    visit(TWIN_FIELD(phase_valid), "", requireFlag);
    visit(TWIN_FIELD(whirl_angle), "rad");
    visit.numbers("rad/s", TWIN_FIELD(whirl_rate), TWIN_FIELD(speed));
    visit(TWIN_FIELD(shaft_angle), "rad");
    visit.numbers("m", TWIN_FIELD(x), TWIN_FIELD(y));
    visit.numbers("m/s", TWIN_FIELD(x_rate), TWIN_FIELD(y_rate));
    visit.numbers("m", TWIN_FIELD(orbit_major), TWIN_FIELD(orbit_minor));
    visit(TWIN_FIELD(forward), "", requireFlag);
    visit(TWIN_FIELD(energy_residual), "-");
  }
};

/// A pendulum or oscillator: one entry per coordinate, in the model's order.
struct PendulumState {
  static constexpr MessageKind kKind{"pendulum", "PendulumState", "*/pendulum",
                                     MessageKind::kSeries | MessageKind::kJointStates};

  Instant at;
  std::string system;
  std::vector<std::string> name;
  std::vector<double> angle;     ///< [rad], or [m] for a sliding coordinate
  std::vector<double> rate;      ///< [rad/s] or [m/s]
  double kinetic = 0.0;          ///< [J]
  double potential = 0.0;        ///< [J]
  double energy_residual = 0.0;  ///< [-]

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(system));
    visit.array(TWIN_FIELD(coordinates), TWIN_FIELD(name), "", each(requireName), Stays::kSame);
    visit.along(TWIN_FIELD(name), TWIN_FIELD(angle), "rad");
    visit.along(TWIN_FIELD(name), TWIN_FIELD(rate), "rad/s");
    visit.numbers("J", TWIN_FIELD(kinetic), TWIN_FIELD(potential));
    visit(TWIN_FIELD(energy_residual), "-");
  }
};

/// A shaft that turns.
struct DriveState {
  static constexpr MessageKind kKind{"drive", "DriveState", "drives/*", MessageKind::kSeries};

  Instant at;
  std::string drive;
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s^2]
  double jerk = 0.0;          ///< [rad/s^3]
  double target_speed = 0.0;  ///< [rad/s], where the present move ends
  std::int64_t turns = 0;     ///< whole turns since angle 0
  double remainder = 0.0;     ///< [rad], 0..2 pi
  double shaft_angle = 0.0;   ///< [rad], total

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(drive));
    visit(TWIN_FIELD(speed), "rad/s");
    visit(TWIN_FIELD(acceleration), "rad/s^2");
    visit(TWIN_FIELD(jerk), "rad/s^3");
    visit(TWIN_FIELD(target_speed), "rad/s");
    visit(TWIN_FIELD(turns), "");
    visit.numbers("rad", TWIN_FIELD(remainder), TWIN_FIELD(shaft_angle));
  }
};

/// A motor that drives a rotor, and the balance of its work: motor_work = dissipated_work + the
/// increase of `energy`, up to the energy residual.
struct MotorState {
  static constexpr MessageKind kKind{"motor", "MotorState", "drives/*/motor", MessageKind::kSeries};

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

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(drive));
    visit(TWIN_FIELD(system), "", requireName, Stays::kSame);
    visit(TWIN_FIELD(speed), "rad/s");
    visit(TWIN_FIELD(acceleration), "rad/s^2");
    visit(TWIN_FIELD(torque), "N m");
    visit.numbers("W", TWIN_FIELD(motor_power), TWIN_FIELD(drag_power),
                  TWIN_FIELD(dissipated_power));
    visit.numbers("J", TWIN_FIELD(energy), TWIN_FIELD(motor_work), TWIN_FIELD(dissipated_work));
  }
};

/// The spread of an ensemble: `count` samples of a system, each with different parameters. One
/// entry per quantity: a rotor's radius, or the coordinates of any other model. Only samples that
/// still run count; the peaks are each sample's largest magnitude since the start.
struct EnsembleState {
  static constexpr MessageKind kKind{"ensemble", "EnsembleState", "*/ensemble"};

  Instant at;
  std::string system;
  std::int64_t count = 0;    ///< samples
  std::int64_t running = 0;  ///< of them, not stopped
  std::vector<std::string> quantity;
  std::vector<std::string> unit;  ///< "m" or "rad"
  std::vector<double> mean, standard_deviation;
  std::vector<double> smallest, percentile_5, percentile_25, median, percentile_75, percentile_95,
      largest;
  std::vector<double> peak_mean, peak_standard_deviation;
  std::vector<double> peak_percentile_5, peak_median, peak_percentile_95, peak_largest;

  template <class Visit>
  static void fields(Visit& visit) {
    const auto members = between(1, std::numeric_limits<std::int64_t>::max());
    const auto at_most_all = [](const char* name, std::int64_t value, const auto& message) {
      requireRange(name, value, 0, message.count);
    };
    const auto quantity = TWIN_FIELD(quantity);
    visit.head(TWIN_FIELD(system));
    visit(TWIN_FIELD(count), "", members, Stays::kSame);
    visit(TWIN_FIELD(running), "", at_most_all);
    visit.array(TWIN_FIELD(quantities), quantity, "", each(requireName), Stays::kSame);
    visit.along(quantity, TWIN_FIELD(unit), "", each(requireCoordinateUnit));
    visit.numbersAlong(quantity, "m or rad", TWIN_FIELD(mean), TWIN_FIELD(standard_deviation),
                       TWIN_FIELD(smallest), TWIN_FIELD(percentile_5), TWIN_FIELD(percentile_25),
                       TWIN_FIELD(median), TWIN_FIELD(percentile_75), TWIN_FIELD(percentile_95),
                       TWIN_FIELD(largest), TWIN_FIELD(peak_mean),
                       TWIN_FIELD(peak_standard_deviation), TWIN_FIELD(peak_percentile_5),
                       TWIN_FIELD(peak_median), TWIN_FIELD(peak_percentile_95),
                       TWIN_FIELD(peak_largest));
  }
};

/// The parameters of a system from an instant on, and those that changed then.
struct ParameterChange {
  static constexpr MessageKind kKind{"parameter", "ParameterChange", "*/parameters",
                                     MessageKind::kLatched};

  Instant at;
  std::string system;
  std::vector<std::string> names;    ///< every parameter: `damping`, `discs[1].mass`
  std::vector<double> values;        ///< of each, in the units of the model
  std::vector<std::string> changed;  ///< some of `names`; none at the start
  std::vector<double> previous;      ///< values of those before

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(system));
    visit.array(TWIN_FIELD(parameters), TWIN_FIELD(names), "", each(requirePath), Stays::kSame);
    visit.along(TWIN_FIELD(names), TWIN_FIELD(values), "");
    visit.array(TWIN_FIELD(changes), TWIN_FIELD(changed), "", each(requirePath));
    visit.along(TWIN_FIELD(changed), TWIN_FIELD(previous), "");
  }
};

}  // namespace whirl_twin::state
