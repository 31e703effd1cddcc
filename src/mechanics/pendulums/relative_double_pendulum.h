// The double pendulum in relative coordinates: the lower arm's angle counts from the upper arm,
// theta3 = theta2 - theta1 (lecture notes, "double pendulum", second form; errata E11).
//
// The energies are those of the absolute form at theta2 = theta1 + theta3; so M_rel = A^T M A with
// A = [[1, 0], [1, 1]].
#pragma once

#include "mechanics/pendulums/double_pendulum.h"

namespace whirl_twin {

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
                              const Moment<S>& at) const {
    return DoublePendulum::kinetic(absolute(q), absolute(v), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const Moment<S>& at) const {
    return DoublePendulum::potential(absolute(q), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>& v,
                                  const Moment<S>&) const {
    return jointDissipation(v[0], v[1]);
  }
  DryContacts<kDof> dryContacts() const { return jointContacts({0.0, 1.0}); }

  std::vector<Reaction> reactions(const std::array<double, 2>& q, const std::array<double, 2>& v,
                                  const std::array<double, 2>& a, const Moment<double>& at) const {
    return DoublePendulum::reactions(absolute(q), absolute(v), absolute(a), at);
  }
  Sketch sketch(const std::array<double, 2>& q, const Moment<double>& at) const {
    return DoublePendulum::sketch(absolute(q), at);
  }

 protected:
  template <class S>
  WHIRL_TWIN_INLINE static std::array<S, 2> absolute(const std::array<S, 2>& x) {
    return {x[0], x[0] + x[1]};
  }
};

}  // namespace whirl_twin
