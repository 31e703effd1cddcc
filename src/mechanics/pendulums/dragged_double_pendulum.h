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
#pragma once

#include "mechanics/pendulums/air_drag.h"
#include "mechanics/pendulums/double_pendulum.h"

namespace whirl_twin {

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
                                  const Moment<S>& at) const {
    return DoublePendulum::dissipation(q, v, at) + airDissipation(*this, q, v);
  }
};

}  // namespace whirl_twin
