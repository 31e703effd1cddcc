// The hinged beam at small angles, as the lecture notes print it: (M/3) theta'' + c theta' +
// (k/4) theta = f(t)/2, times l^2.
//
//   T = M l^2 theta'^2 / 6,   V = k (l theta / 2)^2 / 2,   D = c (l theta')^2 / 2
//   Q = f(t) l^2 / 2
#pragma once

#include "mechanics/oscillators/hinged_beam.h"

namespace whirl_twin {

struct SmallHingedBeam : HingedBeam {
  static constexpr bool kLinear = true;

  static constexpr std::array<Parameter<SmallHingedBeam>, 6> parameters() {
    return inherited<SmallHingedBeam>(HingedBeam::parameters());
  }

  SmallHingedBeam atMeanLoad() const {
    SmallHingedBeam mean = *this;
    mean.load_amplitude = loadAlternates() ? 0.0 : load_amplitude;
    return mean;
  }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const Moment<S>&) const {
    return (0.125 * stiffness * length * length) * (q[0] * q[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                                  const Moment<S>&) const {
    return (0.5 * damping * length * length) * (v[0] * v[0]);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>&,
                                              const Moment<S>& at) const {
    return {(0.5 * length * length) * load(at)};
  }
};

}  // namespace whirl_twin
