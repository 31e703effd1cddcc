// A Jeffcott rotor with a shaft of hysteretic material, or that rubs on a stator round it.
//
// Hysteresis (Kimball, Physical Review 21, 1923, and 1924; Dimentberg, Flexural Vibrations of
// Rotating Shafts, 1961; Genta, Dynamics of Rotating Systems, 2005): a loss factor eta that does
// not depend on the rate, in the shaft, so that with u = v - w x r
//
//   F = -eta k |r| u / |u|,   D = eta k |r| sqrt(|u|^2 + (kStill p |r|)^2),   p = sqrt(k / m)
//
// rounded off where the shaft holds its shape, and homogeneous: no amplitude is special. Gravity
// sags a turning shaft sideways by eta of its sag; a synchronous whirl feels nothing; above p a
// forward whirl at p is unstable unless c p > eta k, and beside a synchronous whirl of radius r it
// stays at about r eta k / (c p) even then. At r = 0 F has no slope; there it is replaced by what
// it is for circular whirls at +-p, so that the linearization at rest has that verdict.
//
// Rub (Muszynska, Rotordynamics, 2005): where |r| > clearance
//
//   N = k_r (|r| - clearance), a damper d_r across it, friction mu N u_s / sqrt(u_s^2 + kSlip^2)
//
// against the sliding of the surface, u_s = v_tangential + w R. The stator's energy is in V. A step
// must resolve the contact, p_r = sqrt((k + k_r) / m): p_r h <= 0.1 keeps the energy within 1e-3
// (no method locates the instant of contact, so that the order is 2 there).
#pragma once

#include <array>
#include <cmath>

#include "mechanics/rotors/jeffcott_rotor.h"

namespace whirl_twin {

struct NonlinearJeffcottRotor : JeffcottRotor {
  static constexpr bool kLinear = false;
  static constexpr double kStill = 1.0e-3;  ///< [-], part of p |r| within which |u| is rounded off
  static constexpr double kSlip = 1.0e-3;   ///< [m/s], sliding within which friction is rounded off

  static constexpr auto parameters() {
    return inherited<NonlinearJeffcottRotor>(JeffcottRotor::parameters());
  }
  NonlinearJeffcottRotor balanced() const { return withoutUnbalance(*this); }

  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const EvaluationPoint<S>& at) const {
    const S v = JeffcottRotor::potential(q, at);
    const S squared = q[0] * q[0] + q[1] * q[1];
    if (!touches(squared)) {
      return v;
    }
    const S depth = sqrt(squared) - rub_clearance;
    return v + (0.5 * rub_stiffness) * (depth * depth);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>& at) const {
    S d = JeffcottRotor::dissipation(q, v, at);
    const S squared = q[0] * q[0] + q[1] * q[1];
    if (loss_factor > 0.0) {
      d = d + (loss_factor * stiffness) * hysteresis(q, v, at, squared);
    }
    if (touches(squared)) {
      d = d + rub(q, v, at, squared);
    }
    return d;
  }

 private:
  template <class S>
  bool touches(const S& squared) const {
    return rub_stiffness > 0.0 && squared > rub_clearance * rub_clearance;
  }

  template <class S>
  WHIRL_TWIN_INLINE S hysteresis(const std::array<S, 2>& q, const std::array<S, 2>& v,
                                 const EvaluationPoint<S>& at, const S& squared) const {
    const double p = std::sqrt(stiffness / mass);
    if (squared > 0.0) {
      const S x = v[0] + at.speed * q[1];
      const S y = v[1] - at.speed * q[0];
      return sqrt(squared) * sqrt(x * x + y * y + (kStill * kStill * p * p) * squared);
    }
    const S moving = v[0] * v[0] + v[1] * v[1];
    if (moving > 0.0) {
      return S(0.0);  // straight through the middle, where the shaft is not bent
    }
    // Drives (or brakes) a forward whirl at p, and a backward one: circulatory and viscous.
    const double forward = at.speed > p ? 1.0 : at.speed < p ? -1.0 : 0.0;
    const double backward = at.speed > -p ? 1.0 : at.speed < -p ? -1.0 : 0.0;
    return (0.5 * (forward + backward)) * (v[0] * q[1] - v[1] * q[0]) +
           (0.25 * (backward - forward) / p) * moving;
  }

  template <class S>
  WHIRL_TWIN_INLINE S rub(const std::array<S, 2>& q, const std::array<S, 2>& v,
                          const EvaluationPoint<S>& at, const S& squared) const {
    const S r = sqrt(squared);
    const S radial = (q[0] * v[0] + q[1] * v[1]) / r;
    const S sliding = (q[0] * v[1] - q[1] * v[0]) / r + rotor_radius * at.speed;
    const S limit = (rub_friction * rub_stiffness) * (r - rub_clearance);
    return (0.5 * rub_damping) * (radial * radial) +
           limit * sqrt(sliding * sliding + kSlip * kSlip);
  }
};

}  // namespace whirl_twin
