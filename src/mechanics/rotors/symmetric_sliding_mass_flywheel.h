// The flywheel with two sliding masses kept at equal radii: rho1 = rho2 = rho.
//
//   T = J phi'^2 / 2 + m (rho'^2 + rho^2 phi'^2),   V = k (rho - a)^2
#pragma once

#include "mechanics/rotors/sliding_mass_flywheel.h"

namespace whirl_twin {

struct SymmetricSlidingMassFlywheel : SlidingMassFlywheel {
  static constexpr std::size_t kDof = 2;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"rho", "m", "from the axis to each mass, outwards"},
       {"phi", "rad", "of the wheel, counterclockwise"}}};

  static constexpr std::array<Parameter<SymmetricSlidingMassFlywheel>, 4> parameters() {
    return inherited<SymmetricSlidingMassFlywheel>(SlidingMassFlywheel::parameters());
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {0.0, 1.0}, "on the wheel's shaft"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const Moment<S>& at) const {
    return SlidingMassFlywheel::kinetic(both(q), both(v), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const Moment<S>& at) const {
    return SlidingMassFlywheel::potential(both(q), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>&,
                                  const Moment<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>&, const std::array<S, 2>&,
                                           const Moment<S>&) const {
    return {};
  }

  std::vector<Condition> conditions(const std::array<double, 2>& q, const std::array<double, 2>& v,
                                    const std::array<double, 2>& a,
                                    const Moment<double>& at) const {
    return SlidingMassFlywheel::conditions(both(q), both(v), both(a), at);
  }
  Sketch sketch(const std::array<double, 2>& q, const Moment<double>& at) const {
    return SlidingMassFlywheel::sketch(both(q), at);
  }

 private:
  template <class S>
  WHIRL_TWIN_INLINE static std::array<S, 3> both(const std::array<S, 2>& x) {
    return {x[0], x[0], x[1]};
  }
};

}  // namespace whirl_twin
