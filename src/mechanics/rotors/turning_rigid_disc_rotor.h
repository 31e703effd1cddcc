// A rigid disc that tilts on a shaft that need not be round, in the frame that turns with the shaft
// (rigid_disc.h): there the two stiffnesses k (1 + mu) along xi and k (1 - mu) along eta stand
// still, and so does a synchronous whirl.
//
// xi, eta and the tilts alpha, beta are components along axes that stand at the shaft's angle;
// velocities in the energies are those seen from the bearings, q' + w x q. The bearings are alike
// in all directions. Without external damping the rotor is unstable between its two critical
// speeds, k (1 -+ mu) = m w^2 for a disc that does not tilt (Smith, Proc. Royal Society A 142,
// 1933).
#pragma once

#include <array>

#include "mechanics/rotors/rigid_disc.h"

namespace whirl_twin {

struct TurningRigidDiscRotor : RigidDisc {
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"xi", "m", "of the shaft's centre at the disc, along the rotating stiffer axis"},
       {"eta", "m", "90 degrees ahead of xi"},
       {"alpha", "rad", "tilt about xi, right-handed"},
       {"beta", "rad", "tilt about eta, right-handed"}}};

  static constexpr auto parameters() {
    return inherited<TurningRigidDiscRotor>(RigidDisc::parameters());
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force_xi", "N", {1.0, 0.0, 0.0, 0.0}, "on the disc, rotating with it, along xi"},
             {"force_eta", "N", {0.0, 1.0, 0.0, 0.0}, "on the disc, rotating with it, along eta"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const Moment<S>& at) const {
    const S& w = at.speed;
    return kineticOf(v[0] - w * q[1], v[1] + w * q[0], v[3] + w * q[2], w * q[3] - v[2], S(0.0), w);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const Moment<S>& at) const {
    const S bent = stiff() * bending(q[0], q[3]) + soft() * bending(q[1], -q[2]);
    return gravity == 0.0 ? bent
                          : bent + (mass * gravity) * (q[0] * sin(at.angle) + q[1] * cos(at.angle));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const Moment<S>& at) const {
    const S& w = at.speed;
    const S x = v[0] - w * q[1];
    const S y = v[1] + w * q[0];
    const S alpha = v[2] - w * q[3];
    const S beta = v[3] + w * q[2];
    return (0.5 * damping_displacement) * (x * x + y * y) +
           (0.5 * damping_rotation) * (alpha * alpha + beta * beta) +
           internal_damping * (stiff() * bending(v[0], v[3]) + soft() * bending(v[1], -v[2]));
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>& v,
                                              const Moment<S>& at) const {
    const S& w = at.speed;
    const S spin = polar_inertia * w;
    return {S(0.0), S(0.0), -(spin * (v[3] + w * q[2])), spin * (v[2] - w * q[3])};
  }

 private:
  double stiff() const { return 1.0 + stiffness_asymmetry; }
  double soft() const { return 1.0 - stiffness_asymmetry; }
};

}  // namespace whirl_twin
