// The double pendulum with motors at its joints, in relative coordinates. Each motor adds the
// inertia of its rotor J, which a gear of ratio G turns at G times the joint's rate on top of what
// carries it, the frame at the upper joint and the upper arm at the lower,
//
//   T += J1 (G1 theta1')^2 / 2 + J2 (theta1' + G2 theta3')^2 / 2
//
// (B. Siciliano et al., Robotics, 2009, sec. 7.1.2); a gear that reverses has G < 0. Torques of the
// motors are those at the joints. The air may act on the arms, as in dragged_double_pendulum.h.
#pragma once

#include "mechanics/pendulums/dragged_double_pendulum.h"
#include "mechanics/pendulums/relative_double_pendulum.h"

namespace whirl_twin {

struct MotorDoublePendulum : RelativeDoublePendulum {
  static constexpr std::array<Parameter<MotorDoublePendulum>, 21> parameters() {
    return inherited<MotorDoublePendulum>(RelativeDoublePendulum::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const Moment<S>& at) const {
    return RelativeDoublePendulum::kinetic(q, v, at) +
           (0.5 * (motor_inertia1 * gear_ratio1 * gear_ratio1 + motor_inertia2)) * (v[0] * v[0]) +
           (0.5 * (motor_inertia2 * gear_ratio2 * gear_ratio2)) * (v[1] * v[1]) +
           (motor_inertia2 * gear_ratio2) * (v[0] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const Moment<S>& at) const {
    return RelativeDoublePendulum::dissipation(q, v, at) +
           airDissipation(*this, absolute(q), absolute(v));
  }
};

}  // namespace whirl_twin
