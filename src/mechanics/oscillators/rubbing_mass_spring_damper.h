// The mass on a spring and a damper with Coulomb friction on the ground.
//
//   D = c x'^2 / 2 + F |x'|
//
// A free swing loses 4 F / k in every turn and ends where |x| <= F / k, held for good
// (dry_friction.h). A `friction_width` w > 0 rounds the change of sign off, D = F sqrt(x'^2 + w^2):
// a body that would stick then creeps, with the rate k w / F, and is damped at F / (m w), which an
// explicit step has to resolve.
#pragma once

#include "mechanics/dry_friction.h"
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
    return (0.5 * damping) * (v[0] * v[0]) + dryDissipation(friction_force, friction_width, v[0]);
  }
  DryContacts<kDof> dryContacts() const {
    DryContacts<kDof> contacts;
    contacts.add({"on the ground", "N", {1.0}, friction_force}, friction_width);
    return contacts;
  }
};

}  // namespace whirl_twin
