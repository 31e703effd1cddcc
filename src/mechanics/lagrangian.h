// The Lagrangian engine: everything the twin needs of a system, derived from its T, V, D and Q.
//
//   d/dt (dL/dv) - dL/dq + dD/dv = Q,  L = T - V     (lecture notes, "Lagrange's equations"; E06)
//
// gives M(q) q'' = dL/dq - (d2L/dv dq) v - d2L/dv dt - dD/dv + Q, and with the Jacobi integral
// h = v . dL/dv - L the energy audit  dh/dt = -dL/dt|explicit - v . dD/dv + Q . v.
// A model supplies kinetic(q, v, at), potential(q, at), dissipation(q, v, at) and force(q, v, at)
// as templates over the number type; no equation of motion is written by hand.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

#include "mechanics/energies.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/gradient.h"
#include "mechanics/lagrangian_dual.h"

namespace whirl_twin {

/// Equations of motion at one state: mass . q'' = force.
template <class B, std::size_t n>
struct EquationsOfMotion {
  std::array<B, n*(n + 1) / 2> mass{};  ///< packed lower triangle of M(q)
  std::array<B, n> force{};             ///< everything but M q''
  B power{};                            ///< [W], dh/dt
};

/// Quantities of a step: q'' and the rate of the Jacobi integral.
template <std::size_t n>
struct Derivative {
  std::array<double, n> acceleration{};
  double power = 0.0;  ///< [W]
};

/// M q'' + (C + G) q' + (K + N) q = 0 for small deviations; C, K symmetric, G, N skew. [n x n]
template <std::size_t n>
struct FixedLinearization {
  Eigen::Matrix<double, n, n> mass, damping, gyroscopic, stiffness, circulatory;
};

template <class Model, class B, std::size_t n>
WHIRL_TWIN_INLINE EquationsOfMotion<B, n> equationsOfMotion(const Model& model,
                                                            const std::array<B, n>& q,
                                                            const std::array<B, n>& v,
                                                            const EvaluationPoint<double>& at) {
  using Kinetic = LagrangianDual<B, n>;
  std::array<Kinetic, n> q_of_t;
  std::array<Kinetic, n> v_of_t;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
    q_of_t[j] = Kinetic::coordinate(q[j], v[j], j);
    v_of_t[j] = Kinetic::velocity(v[j], j);
  });
  const EvaluationPoint<Kinetic> moment{
      Kinetic::known(B(at.time), B(1.0)), Kinetic::known(B(at.angle), B(at.speed)),
      Kinetic::known(B(at.speed), B(at.acceleration)), Kinetic::known(B(at.acceleration), B(0.0))};
  const Kinetic t = model.kinetic(q_of_t, v_of_t, moment);

  using Potential = Gradient<B, n + 1>;  // by the coordinates and by explicit time
  std::array<Potential, n> q_of_potential;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT { q_of_potential[j] = Potential(q[j], j); });
  EvaluationPoint<Potential> moment_of_potential{Potential(B(at.time), n), Potential(at.angle),
                                                 Potential(at.speed), Potential(at.acceleration)};
  moment_of_potential.angle.slope[n] = B(at.speed);
  moment_of_potential.speed.slope[n] = B(at.acceleration);
  const Potential u = model.potential(q_of_potential, moment_of_potential);

  using Dissipation = Gradient<B, n>;  // by the rates
  std::array<Dissipation, n> q_of_dissipation;
  std::array<Dissipation, n> v_of_dissipation;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
    q_of_dissipation[j].value = q[j];
    v_of_dissipation[j] = Dissipation(v[j], j);
  });
  const EvaluationPoint<Dissipation> moment_of_dissipation{at.time, at.angle, at.speed,
                                                           at.acceleration};
  const Dissipation d =
      model.dissipation(q_of_dissipation, v_of_dissipation, moment_of_dissipation);

  const EvaluationPoint<B> moment_of_force{B(at.time), B(at.angle), B(at.speed),
                                           B(at.acceleration)};
  const std::array<B, n> applied = model.force(q, v, moment_of_force);

  EquationsOfMotion<B, n> r;
  unrolled<n*(n + 1) / 2>([&](auto p) WHIRL_TWIN_FLAT { r.mass[p] = t.by_vv[p]; });
  r.power = u.slope[n] - t.by_t;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
    r.force[j] = t.by_q[j] - u.slope[j] - t.by_v_rate[j] - d.slope[j] + applied[j];
    r.power = r.power + v[j] * (applied[j] - d.slope[j]);
  });
  return r;
}

/// The same, not inlined, one copy per model: for code outside the innermost loop of a step.
template <class Model, std::size_t n>
[[gnu::noinline]] EquationsOfMotion<double, n> equationsAt(
    const Model& model, const std::array<double, n>& q, const std::array<double, n>& v,
    const EvaluationPoint<double>& at) noexcept {
  return equationsOfMotion(model, q, v, at);
}

/// x with M x = b for a symmetric positive definite M in packed storage (L D L^T, no pivoting).
template <class B, std::size_t n>
WHIRL_TWIN_INLINE std::array<B, n> solveMass(const std::array<B, n*(n + 1) / 2>& mass,
                                             const std::array<B, n>& b) {
  const auto at = [](std::size_t row, std::size_t column) { return row * (row + 1) / 2 + column; };
  // Entry by entry: a copy of the whole would go through memory.
  std::array<B, n*(n + 1) / 2> l;
  unrolled<n*(n + 1) / 2>([&](auto p) WHIRL_TWIN_FLAT { l[p] = mass[p]; });
  std::array<B, n> inverse_pivot;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
    unrolled<decltype(j)::value>([&](auto k) WHIRL_TWIN_FLAT {
      const B ratio = l[at(j, k)] * inverse_pivot[k];
      unrolled<n - decltype(j)::value>([&](auto below) WHIRL_TWIN_FLAT {
        const std::size_t i = j + below;
        l[at(i, j)] = l[at(i, j)] - l[at(i, k)] * ratio;
      });
    });
    inverse_pivot[j] = 1.0 / l[at(j, j)];
  });
  std::array<B, n> x;
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT { x[j] = b[j]; });
  unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
    unrolled<n - decltype(j)::value - 1>([&](auto below) WHIRL_TWIN_FLAT {
      const std::size_t i = j + 1 + below;
      x[i] = x[i] - l[at(i, j)] * (inverse_pivot[j] * x[j]);
    });
  });
  unrolled<n>([&](auto from_last) WHIRL_TWIN_FLAT {
    constexpr std::size_t j = n - 1 - decltype(from_last)::value;
    unrolled<n - 1 - j>([&](auto below) WHIRL_TWIN_FLAT {
      constexpr std::size_t i = j + 1 + decltype(below)::value;
      x[j] = x[j] - l[at(i, j)] * x[i];
    });
    x[j] = x[j] * inverse_pivot[j];
  });
  return x;
}

/// q'' and dh/dt at a state: the right-hand side of every step. Real-time safe.
template <class Model, std::size_t n>
WHIRL_TWIN_INLINE Derivative<n> derivative(const Model& model, const std::array<double, n>& q,
                                           const std::array<double, n>& v,
                                           const EvaluationPoint<double>& at) {
  const EquationsOfMotion<double, n> eom = equationsOfMotion(model, q, v, at);
  return {solveMass<double, n>(eom.mass, eom.force), eom.power};
}

/// A state whose rates are the variables to differentiate by.
template <std::size_t n>
struct ByRates {
  using Rates = Gradient<double, n>;
  std::array<Rates, n> q, v;
  EvaluationPoint<Rates> at;

  ByRates(const std::array<double, n>& q_now, const std::array<double, n>& v_now,
          const EvaluationPoint<double>& now)
      : at{now.time, now.angle, now.speed, now.acceleration} {
    for (std::size_t j = 0; j < n; ++j) {
      q[j].value = q_now[j];
      v[j] = Rates(v_now[j], j);
    }
  }
};

/// The forces that have no potential, Q - dD/dv, at a state.
template <class Model, std::size_t n>
std::array<double, n> appliedForce(const Model& model, const std::array<double, n>& q,
                                   const std::array<double, n>& v,
                                   const EvaluationPoint<double>& at) {
  const ByRates<n> by_rates(q, v, at);
  const auto d = model.dissipation(by_rates.q, by_rates.v, by_rates.at);
  std::array<double, n> applied = model.force(q, v, at);
  for (std::size_t j = 0; j < n; ++j) {
    applied[j] -= d.slope[j];
  }
  return applied;
}

/// Generalized momenta dL/dv at a state.
template <class Model, std::size_t n>
std::array<double, n> momenta(const Model& model, const std::array<double, n>& q,
                              const std::array<double, n>& v, const EvaluationPoint<double>& at) {
  const ByRates<n> by_rates(q, v, at);
  const auto t = model.kinetic(by_rates.q, by_rates.v, by_rates.at);
  std::array<double, n> momenta;
  std::copy_n(t.slope, n, momenta.begin());
  return momenta;
}

/// Energies and powers at a state.
template <class Model, std::size_t n>
Energies energies(const Model& model, const std::array<double, n>& q,
                  const std::array<double, n>& v, const EvaluationPoint<double>& at) {
  Energies e;
  const ByRates<n> by_rates(q, v, at);
  const auto t = model.kinetic(by_rates.q, by_rates.v, by_rates.at);
  const auto d = model.dissipation(by_rates.q, by_rates.v, by_rates.at);
  e.kinetic = t.value;
  e.potential = model.potential(q, at);
  e.jacobi = e.potential - e.kinetic;
  for (std::size_t j = 0; j < n; ++j) {
    e.jacobi += v[j] * t.slope[j];
    e.dissipated_power += v[j] * d.slope[j];
  }
  e.input_power = equationsAt(model, q, v, at).power + e.dissipated_power;
  return e;
}

/// Linearization for small deviations from a motion that passes through q, v with q'' = a.
template <class Model, std::size_t n>
FixedLinearization<n> linearization(const Model& model, const std::array<double, n>& q,
                                    const std::array<double, n>& v, const std::array<double, n>& a,
                                    const EvaluationPoint<double>& at) {
  // By the coordinates, then by the rates. Of many coordinates that is one copy of the equations
  // that is passed twice: with all directions it would be what its model takes longest to compile.
  constexpr std::size_t kDirections = n < 3 ? 2 * n : n;
  using B = Gradient<double, kDirections>;
  FixedLinearization<n> r;
  std::array<std::array<double, n>, 2 * n> slopes;
#pragma GCC unroll 1
  for (std::size_t first = 0; first < 2 * n; first += kDirections) {
    std::array<B, n> q_dual;
    std::array<B, n> v_dual;
    for (std::size_t j = 0; j < n; ++j) {
      q_dual[j].value = q[j];
      v_dual[j].value = v[j];
      if constexpr (kDirections == n) {
        q_dual[j].slope[j] = first == 0 ? 1.0 : 0.0;
        v_dual[j].slope[j] = first == 0 ? 0.0 : 1.0;
      } else {
        q_dual[j].slope[j] = 1.0;
        v_dual[j].slope[n + j] = 1.0;
      }
    }
    const EquationsOfMotion<B, n> eom = equationsOfMotion(model, q_dual, v_dual, at);
    for (std::size_t i = 0; i < n; ++i) {
      B residual = -eom.force[i];
      for (std::size_t j = 0; j < n; ++j) {
        const B& entry = i >= j ? eom.mass[i * (i + 1) / 2 + j] : eom.mass[j * (j + 1) / 2 + i];
        r.mass(i, j) = entry.value;
        residual = residual + entry * a[j];
      }
      for (std::size_t k = 0; k < kDirections; ++k) {
        slopes[first + k][i] = residual.slope[k];
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      r.damping(i, j) = 0.5 * (slopes[n + j][i] + slopes[n + i][j]);
      r.gyroscopic(i, j) = 0.5 * (slopes[n + j][i] - slopes[n + i][j]);
      r.stiffness(i, j) = 0.5 * (slopes[j][i] + slopes[i][j]);
      r.circulatory(i, j) = 0.5 * (slopes[j][i] - slopes[i][j]);
    }
  }
  return r;
}

}  // namespace whirl_twin
