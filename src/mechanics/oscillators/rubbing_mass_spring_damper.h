// The mass on a spring and a damper with Coulomb friction on the ground.
//
//   D = c x'^2 / 2 + F sqrt(x'^2 + w^2)
//
// A free swing loses 4 F / k in every turn and ends where |x| <= F / k. Regularised is the change
// of sign within speeds of w, `friction_width`: a body that would stick creeps there, with the rate
// k w / F, and is damped at F / (m w), which an explicit step has to resolve.
#pragma once

#include "mechanics/oscillators/mass_spring_damper.h"

namespace whirl_twin {

struct RubbingMassSpringDamper : MassSpringDamper {
  static constexpr bool kLinear = false;

  static constexpr std::array<Parameter<RubbingMassSpringDamper>, 6> parameters() {
    return inherited<RubbingMassSpringDamper>(MassSpringDamper::parameters());
  }

  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const Moment<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]) +
           friction_force * sqrt(v[0] * v[0] + friction_width * friction_width);
  }
};

}  // namespace whirl_twin
