// A rigid disc that tilts on a round shaft, in the fixed frame of its bearings (rigid_disc.h).
//
//   T = m |v_G|^2 / 2 + Id |b'|^2 / 2 + (Id - Ip) tau w Re[conj(b') i e^(i theta)]
//   D = c |v_S|^2 / 2 + c_r |b'|^2 / 2 + eta u^T K u / 2,   u: (x, b_x) and (y, b_y) as seen from
//       the turning shaft change, q' - w x q
//   Q = i Ip w b'   on the slopes
//
// The tilt splits into a forward whirl that the spin stiffens and a backward one that it softens.
#pragma once

#include <array>

#include "mechanics/rotors/rigid_disc.h"

namespace whirl_twin {

struct RigidDiscRotor : RigidDisc {
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "of the shaft's centre at the disc, from the bearings' line"},
       {"y", "m", "likewise, up, 90 degrees ahead of x"},
       {"alpha", "rad", "tilt of the disc about x, right-handed"},
       {"beta", "rad", "tilt of the disc about y, right-handed"}}};

  static constexpr auto parameters() { return inherited<RigidDiscRotor>(RigidDisc::parameters()); }
  /// [rad], that the phase counts from.
  double phaseMark() const { return phase_mark; }
  /// Without synchronous forces.
  RigidDiscRotor balanced() const {
    RigidDiscRotor same = *this;
    same.eccentricity = same.skew = 0.0;
    return same;
  }

  std::array<Input<kDof>, 4> inputs() const {
    return {{{"force_x", "N", {1.0, 0.0, 0.0, 0.0}, "on the disc, along x"},
             {"force_y", "N", {0.0, 1.0, 0.0, 0.0}, "on the disc, along y"},
             {"moment_alpha", "N m", {0.0, 0.0, 1.0, 0.0}, "on the disc, about x"},
             {"moment_beta", "N m", {0.0, 0.0, 0.0, 1.0}, "on the disc, about y"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>& at) const {
    return kineticOf(v[0], v[1], v[3], -v[2], at.angle, at.speed);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return bending(q[0], q[3]) + bending(q[1], -q[2]) + (mass * gravity) * q[1];
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>& at) const {
    const S external = (0.5 * damping_displacement) * (v[0] * v[0] + v[1] * v[1]) +
                       (0.5 * damping_rotation) * (v[2] * v[2] + v[3] * v[3]);
    if (internal_damping == 0.0) {
      return external;
    }
    const S& w = at.speed;
    return external + internal_damping * (bending(v[0] + w * q[1], v[3] - w * q[2]) +
                                          bending(v[1] - w * q[0], -v[2] - w * q[3]));
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>&,
                                              const std::array<S, kDof>& v,
                                              const EvaluationPoint<S>& at) const {
    const S spin = polar_inertia * at.speed;
    return {S(0.0), S(0.0), -(spin * v[3]), spin * v[2]};
  }
};

// A rigid disc that tilts on a shaft that need not be round, in the shaft-fixed rotating frame
// (rigid_disc.h): there the two stiffnesses k (1 + mu) along xi and k (1 - mu) along eta are
// constant, and a synchronous whirl is stationary.
//
// xi, eta and the tilts alpha, beta are components along axes at the shaft's angle; velocities in
// the energies are those in the fixed frame, q' + w x q. The bearings are isotropic. Without
// external damping the rotor is unstable between its two critical speeds, k (1 -+ mu) = m w^2 for a
// disc that does not tilt (Smith, Proc. Royal Society A 142, 1933).

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
                              const EvaluationPoint<S>& at) const {
    const S& w = at.speed;
    return kineticOf(v[0] - w * q[1], v[1] + w * q[0], v[3] + w * q[2], w * q[3] - v[2], S(0.0), w);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>& at) const {
    const S bent = stiff() * bending(q[0], q[3]) + soft() * bending(q[1], -q[2]);
    return gravity == 0.0 ? bent
                          : bent + (mass * gravity) * (q[0] * sin(at.angle) + q[1] * cos(at.angle));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>& at) const {
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
                                              const EvaluationPoint<S>& at) const {
    const S& w = at.speed;
    const S spin = polar_inertia * w;
    return {S(0.0), S(0.0), -(spin * (v[3] + w * q[2])), spin * (v[2] - w * q[3])};
  }

 private:
  double stiff() const { return 1.0 + stiffness_asymmetry; }
  double soft() const { return 1.0 - stiffness_asymmetry; }
};

}  // namespace whirl_twin
