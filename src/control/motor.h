// A motor of limited torque: constant, falling with speed, or a table over speed; and the drag of
// everything it turns besides the rotor's whirl.
//
//   falling: T = stall_torque (1 - w / no_load_speed)       (direct current, or induction near its
//                                                            synchronous speed)
//   table:   T(w) linear between points, constant beyond the ends
//   drag:    d w                                            against the motion
//
// (Dimentberg et al., Physics of Vibrations, 1997; Kononenko, Vibrating Systems with a Limited
// Power Supply, 1969.) Every characteristic is stored as a table, so that a step treats all alike.
#pragma once

#include <array>
#include <cstddef>

namespace whirl_twin {

struct MotorPoint {
  double speed = 0.0;   ///< [rad/s]
  double torque = 0.0;  ///< [N m]
};

struct Motor {
  static constexpr std::size_t kMaxPoints = 32;

  std::array<MotorPoint, kMaxPoints> points{};  ///< ascending in speed
  std::size_t count = 0;                        ///< 0: no torque
  bool extended = false;                        ///< the first and last line extend beyond the ends
  double drag = 0.0;                            ///< [N m s/rad], >= 0

  static Motor constant(double torque, double drag = 0.0) {
    Motor motor;
    motor.points[0] = {0.0, torque};
    motor.count = 1;
    motor.drag = drag;
    return motor;
  }
  static Motor falling(double stall_torque, double no_load_speed, double drag = 0.0) {
    Motor motor;
    motor.points[0] = {0.0, stall_torque};
    motor.points[1] = {no_load_speed, 0.0};
    motor.count = 2;
    motor.extended = true;
    motor.drag = drag;
    return motor;
  }

  /// [N m] at a speed [rad/s]; S is double or a dual number of it that compares by its value.
  template <class S>
  S torque(const S& speed) const {
    if (count == 0) {
      return S(0.0);
    }
    if (count == 1 || (!extended && speed <= points[0].speed)) {
      return S(points[0].torque);
    }
    if (!extended && speed >= points[count - 1].speed) {
      return S(points[count - 1].torque);
    }
    std::size_t i = 0;
    while (i + 2 < count && speed > points[i + 1].speed) {
      ++i;
    }
    const double slope =
        (points[i + 1].torque - points[i].torque) / (points[i + 1].speed - points[i].speed);
    return points[i].torque + slope * (speed - points[i].speed);
  }
};

}  // namespace whirl_twin
