// Drag of the air on a point that moves fast enough for it to grow with the square of its speed,
// F = -k |v| v with k = rho c_w A / 2 (H. Schlichting, Boundary-Layer Theory, 1979, ch. 1): above a
// Reynolds number of some hundreds, for a rod of 1 cm from some dm/s on.
#pragma once

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"
#include "mechanics/pendulums/double_pendulum.h"

namespace whirl_twin {

/// Of D = k |v|^3 / 3, by the square of the speed. At rest its root would have no derivative.
template <class S>
WHIRL_TWIN_INLINE S dragDissipation(double drag, const S& square_of_speed) {
  constexpr double kStill = 1.0e-100;  // (m/s)^2: beside any speed that moves, nothing, in any unit
  const S s = square_of_speed + kStill;
  return (drag / 3.0) * (s * sqrt(s));
}

// The double pendulum in air. On each arm it acts at one point, at a distance r from the arm's
// upper joint, against that point's velocity u and with the square of its speed,
//
//   D += k1 |u1|^3 / 3 + k2 |u2|^3 / 3,
//   |u1|^2 = (r1 theta1')^2,
//   |u2|^2 = (r2 theta2' + l1 theta1' cos d)^2 + (l1 theta1' sin d)^2,   d = theta1 - theta2
//
// A straight bar of length l is met by the air all along: on its own about the joint that is as at
// r = 0.63 l (of k r^3 = (k / l) l^4 / 4). Unlike friction of a joint, drag of the lower arm damps
// what both arms do together.

/// What the air takes, in absolute angles and rates.
template <class S>
WHIRL_TWIN_INLINE S airDissipation(const DoublePendulum& m, const std::array<S, 2>& q,
                                   const std::array<S, 2>& v) {
  const S upper = m.drag_reach1 * v[0];
  const S joint = m.length1 * v[0];
  const S between = q[0] - q[1];
  const S across = m.drag_reach2 * v[1] + joint * cos(between);  // across and along the lower arm
  const S along = joint * sin(between);
  return dragDissipation<S>(m.drag1, upper * upper) +
         dragDissipation<S>(m.drag2, across * across + along * along);
}

struct DraggedDoublePendulum : DoublePendulum {
  static constexpr std::array<Parameter<DraggedDoublePendulum>, 21> parameters() {
    return inherited<DraggedDoublePendulum>(DoublePendulum::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>& at) const {
    return DoublePendulum::dissipation(q, v, at) + airDissipation(*this, q, v);
  }
};

// The double pendulum in relative coordinates: the lower arm's angle counts from the upper arm,
// theta3 = theta2 - theta1 (lecture notes, "double pendulum", second form; errata E11).
//
// The energies are those of the absolute form at theta2 = theta1 + theta3; so M_rel = A^T M A with
// A = [[1, 0], [1, 1]].

struct RelativeDoublePendulum : DoublePendulum {
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta1", "rad", "of the upper arm, from hanging, its end to the right"},
       {"theta3", "rad", "of the lower arm, from the line of the upper one, theta2 - theta1"}}};

  static constexpr std::array<Parameter<RelativeDoublePendulum>, 21> parameters() {
    return inherited<RelativeDoublePendulum>(DoublePendulum::parameters());
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"torque1", "N m", {1.0, 0.0}, "at the upper joint, on the upper arm"},
             {"torque2",
              "N m",
              {0.0, 1.0},
              "at the lower joint, on the lower arm and back on the upper"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const EvaluationPoint<S>& at) const {
    return DoublePendulum::kinetic(absolute(q), absolute(v), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const EvaluationPoint<S>& at) const {
    return DoublePendulum::potential(absolute(q), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>&) const {
    return jointDissipation(v[0], v[1]);
  }
  DryContacts<kDof> dryContacts() const { return jointContacts({0.0, 1.0}); }

  std::vector<Reaction> reactions(const std::array<double, 2>& q, const std::array<double, 2>& v,
                                  const std::array<double, 2>& a,
                                  const EvaluationPoint<double>& at) const {
    return DoublePendulum::reactions(absolute(q), absolute(v), absolute(a), at);
  }
  Sketch sketch(const std::array<double, 2>& q, const EvaluationPoint<double>& at) const {
    return DoublePendulum::sketch(absolute(q), at);
  }

 protected:
  template <class S>
  WHIRL_TWIN_INLINE static std::array<S, 2> absolute(const std::array<S, 2>& x) {
    return {x[0], x[0] + x[1]};
  }
};

// The double pendulum with motors at its joints, in relative coordinates. Each motor adds the
// inertia of its rotor J, which a gear of ratio G turns at G times the joint's rate on top of what
// carries it, the frame at the upper joint and the upper arm at the lower,
//
//   T += J1 (G1 theta1')^2 / 2 + J2 (theta1' + G2 theta3')^2 / 2
//
// (B. Siciliano et al., Robotics, 2009, sec. 7.1.2); a gear that reverses has G < 0. Torques of the
// motors are those at the joints. The air may act on the arms, as in DraggedDoublePendulum.

struct MotorDoublePendulum : RelativeDoublePendulum {
  static constexpr std::array<Parameter<MotorDoublePendulum>, 21> parameters() {
    return inherited<MotorDoublePendulum>(RelativeDoublePendulum::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const EvaluationPoint<S>& at) const {
    return RelativeDoublePendulum::kinetic(q, v, at) +
           (0.5 * (motor_inertia1 * gear_ratio1 * gear_ratio1 + motor_inertia2)) * (v[0] * v[0]) +
           (0.5 * (motor_inertia2 * gear_ratio2 * gear_ratio2)) * (v[1] * v[1]) +
           (motor_inertia2 * gear_ratio2) * (v[0] * v[1]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>& at) const {
    return RelativeDoublePendulum::dissipation(q, v, at) +
           airDissipation(*this, absolute(q), absolute(v));
  }
};

}  // namespace whirl_twin
