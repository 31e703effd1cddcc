// Gauss-Legendre collocation with one, two or three stages (Butcher 1964; Hairer & Wanner, Solving
// Ordinary Differential Equations II, IV.5, tables 5.1 and 5.2), for q'' = a(q, v, t):
//
//   A_i = a(q + h c_i v + h^2 sum (A^2)_ij A_j,  v + h sum A_ij A_j,  t + c_i h)
//   v1 = v + h sum b_i A_i,    q1 = q + h v + h^2 sum b_i (1 - c_i) A_i
//
// Order 2 (the implicit midpoint rule), 4 and 6; symplectic, time-reversible, A-stable; conserves
// quadratic invariants, has bounded energy error over any time, treats damping and gyroscopic terms
// like any other. The stages are found by fixed-point iteration started from the previous step's
// polynomial, typically two to five iterations; where that contracts too slowly (stiff systems) by
// simplified Newton; where that does not converge either, in up to 16 sub-steps. If these fail too,
// the state is unchanged and kNotConverged is returned. It does not damp stiff modes (it is not
// L-stable), and it does not detect discontinuities inside a step.
#pragma once

#include <cmath>

#include "integration/erased_ode.h"
#include "integration/motion_state.h"
#include "integration/simd_vector.h"
#include "integration/stage_solver.h"

namespace whirl_twin {

namespace gauss_legendre {

/// Nodes c, weights b and coefficients a of the method with s stages.
template <std::size_t s>
struct Tableau;

template <>
struct Tableau<1> {
  static constexpr const char* kName = "implicit_midpoint";
  static constexpr std::array<double, 1> kNodes{0.5};
  static constexpr std::array<double, 1> kWeights{1.0};
  static constexpr std::array<std::array<double, 1>, 1> kA{{{0.5}}};
};

template <>
struct Tableau<2> {
  static constexpr const char* kName = "gauss_legendre_4";
  static constexpr double kRoot3 = 1.7320508075688772935;
  static constexpr std::array<double, 2> kNodes{0.5 - kRoot3 / 6.0, 0.5 + kRoot3 / 6.0};
  static constexpr std::array<double, 2> kWeights{0.5, 0.5};
  static constexpr std::array<std::array<double, 2>, 2> kA{
      {{0.25, 0.25 - kRoot3 / 6.0}, {0.25 + kRoot3 / 6.0, 0.25}}};
};

template <>
struct Tableau<3> {
  static constexpr const char* kName = "gauss_legendre_6";
  static constexpr double kRoot15 = 3.872983346207416885;
  static constexpr std::array<double, 3> kNodes{0.5 - kRoot15 / 10.0, 0.5, 0.5 + kRoot15 / 10.0};
  static constexpr std::array<double, 3> kWeights{5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
  static constexpr std::array<std::array<double, 3>, 3> kA{
      {{5.0 / 36.0, 2.0 / 9.0 - kRoot15 / 15.0, 5.0 / 36.0 - kRoot15 / 30.0},
       {5.0 / 36.0 + kRoot15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - kRoot15 / 24.0},
       {5.0 / 36.0 + kRoot15 / 30.0, 2.0 / 9.0 + kRoot15 / 15.0, 5.0 / 36.0}}};
};

template <std::size_t s>
using Table = std::array<std::array<double, s>, s>;

/// A^2, for q.
template <std::size_t s>
constexpr Table<s> squared() {
  Table<s> result{};
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) {
      for (std::size_t k = 0; k < s; ++k) {
        result[i][j] += Tableau<s>::kA[i][k] * Tableau<s>::kA[k][j];
      }
    }
  }
  return result;
}
template <std::size_t s>
inline constexpr Table<s> kAA = squared<s>();

/// The polynomial through the values at the nodes of a step, at the nodes of the step after it.
template <std::size_t s>
constexpr Table<s> continued() {
  constexpr auto c = Tableau<s>::kNodes;
  Table<s> result{};
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) {
      result[i][j] = 1.0;
      for (std::size_t k = 0; k < s; ++k) {
        result[i][j] *= k == j ? 1.0 : (1.0 + c[i] - c[k]) / (c[j] - c[k]);
      }
    }
  }
  return result;
}
template <std::size_t s>
inline constexpr Table<s> kContinued = continued<s>();

}  // namespace gauss_legendre

template <std::size_t stages, std::size_t n>
class GaussLegendre {
 public:
  static constexpr const char* kName = gauss_legendre::Tableau<stages>::kName;

  /// Discards the history: required after an external change of the state.
  void restart() { warm_ = false; }

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    Stages a;
    if (warm_) {
      a = extrapolated();
    } else {
      // No second copy of the equations for a guess.
      withCalls(equation, [&](const ErasedOde<n>& called) {
        a.fill(SimdVector<n>(called(state.q, state.v, offset).acceleration));
      });
    }
    Powers power;
    if (!fixedPoint(equation, offset, h, state, a, power)) {
      return withCalls(equation, [&](const ErasedOde<n>& called) {
        return stiffStep(called, offset, h, kMaxHalvings, state);
      });
    }
    last_ = a;
    warm_ = true;
    finish(h, a, power, state);
    return StepStatus::kOk;
  }

 private:
  using Tableau = gauss_legendre::Tableau<stages>;
  using Stages = std::array<SimdVector<n>, stages>;
  using Powers = std::array<double, stages>;

  /// A step by Newton's method; where that does not converge, two of half the length. Beside its
  /// matrices a call is nothing.
  [[gnu::noinline, gnu::cold]] StepStatus stiffStep(const ErasedOde<n>& equation, double offset,
                                                    double h, int halvings, MotionState<n>& state) {
    const std::array<double, n> start = equation(state.q, state.v, offset).acceleration;
    Stages a;
    a.fill(SimdVector<n>(start));
    Powers power;
    if (newton(equation, offset, h, state, a, power) && plausible(h, state, start, a)) {
      last_ = a;
      warm_ = halvings == kMaxHalvings;  // the next step is as long as this one
      finish(h, a, power, state);
      return StepStatus::kOk;
    }
    warm_ = false;
    if (halvings == 0) {
      return StepStatus::kNotConverged;
    }
    MotionState<n> half = state;
    StepStatus status = stiffStep(equation, offset, 0.5 * h, halvings - 1, half);
    if (status == StepStatus::kOk) {
      status = stiffStep(equation, offset + 0.5 * h, 0.5 * h, halvings - 1, half);
    }
    if (status == StepStatus::kOk) {
      state = half;
    }
    return status;
  }

  /// The stage equations of a step far too long have solutions that are no motion: they run away
  /// further than ten times what the start suggests, and than ten rad or m.
  static bool plausible(double h, const MotionState<n>& state, const std::array<double, n>& start,
                        const Stages& a) {
    double suggested = 1.0;
    double found = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      suggested = std::fmax(suggested, std::fabs(state.q[i]) + h * std::fabs(state.v[i]) +
                                           h * h * std::fabs(start[i]));
      for (std::size_t k = 0; k < stages; ++k) {
        found = std::fmax(found, h * h * std::fabs(a[k].array()[i]));
      }
    }
    return found <= 10.0 * suggested;
  }

  /// From the stages to the end of the step.
  static WHIRL_TWIN_INLINE void finish(double h, const Stages& a, const Powers& power,
                                       MotionState<n>& state) {
    SimdVector<n> rate{};
    SimdVector<n> position{};
    for (std::size_t k = 0; k < stages; ++k) {
      rate.add(Tableau::kWeights[k], a[k]);
      position.add(Tableau::kWeights[k] * (1.0 - Tableau::kNodes[k]), a[k]);
    }
    SimdVector<n> mean(state.v);
    mean.add(h, position);
    SimdVector<n> dq{};
    SimdVector<n> dv{};
    dq.add(h, mean);
    dv.add(h, rate);
    double mean_power = 0.0;
    for (std::size_t k = 0; k < stages; ++k) {
      mean_power += Tableau::kWeights[k] * power[k];
    }
    state.advance(dq.array(), dv.array(), h * mean_power);
  }

  static constexpr std::size_t kMiddle = stages / 2;  ///< a stage in or near the middle
  static constexpr int kMaxFixedPoint = 16;
  static constexpr int kMaxNewton = 24;
  static constexpr int kMaxJacobians = 3;
  static constexpr int kMaxHalvings = 4;
  /// Iteration ends when the acceleration changes by less than this fraction of its size: the
  /// remaining error enters q and v multiplied by h and is below their rounding.
  static constexpr double kTolerance = 4.0e-16;
  /// [rad/s^2] or [m/s^2]: where the product above would underflow.
  static constexpr double kNothing = 1.0e-290;
  /// If the fixed-point iteration contracts slower than this, Newton is used.
  static constexpr double kSlow = 0.5;
  /// Newton that no longer contracts has reached the rounding of the accelerations themselves,
  /// which is that of a number times the condition of the mass matrix (up to 1e6 or so); where it
  /// diverges the change is as large as the acceleration.
  static constexpr double kRounding = 1.0e-9;
  /// Or that of the coordinates: a change this many roundings large once multiplied by h^2. A stiff
  /// spring makes it a large part of an acceleration that is itself small.
  static constexpr double kRoundingsOfPosition = 512.0 * 2.2e-16;

  /// The previous step's stages, continued by their polynomial to this step's nodes.
  WHIRL_TWIN_INLINE Stages extrapolated() const {
    Stages a{};
    for (std::size_t k = 0; k < stages; ++k) {
      for (std::size_t j = 0; j < stages; ++j) {
        a[k].add(gauss_legendre::kContinued<stages>[k][j], last_[j]);
      }
    }
    return a;
  }

  /// q and v at stage k.
  static WHIRL_TWIN_INLINE void stage(std::size_t k, double h, const MotionState<n>& state,
                                      const Stages& a, std::array<double, n>& q,
                                      std::array<double, n>& v) {
    SimdVector<n> rate{};
    SimdVector<n> position{};
    for (std::size_t j = 0; j < stages; ++j) {
      rate.add(Tableau::kA[k][j], a[j]);
      position.add(gauss_legendre::kAA<stages>[k][j], a[j]);
    }
    const SimdVector<n> v0(state.v);
    SimdVector<n> mean{};
    mean.add(Tableau::kNodes[k], v0);
    mean.add(h, position);
    SimdVector<n> at_stage(state.q);
    at_stage.add(h, mean);
    q = at_stage.array();
    at_stage = v0;
    at_stage.add(h, rate);
    v = at_stage.array();
  }

  template <class Equation>
  WHIRL_TWIN_INLINE void evaluate(const Equation& equation, double offset, double h,
                                  const MotionState<n>& state, const Stages& a, Stages& result,
                                  Powers& power) const {
    // One copy of the equations: what they make of the parameters alone is then computed once.
#pragma GCC unroll 1
    for (std::size_t k = 0; k < stages; ++k) {
      std::array<double, n> q;
      std::array<double, n> v;
      stage(k, h, state, a, q, v);
      const auto d = equation(q, v, offset + Tableau::kNodes[k] * h);
      result[k] = SimdVector<n>(d.acceleration);
      power[k] = d.power;
    }
  }

  /// Largest change and largest size over all stages.
  static WHIRL_TWIN_INLINE void measure(const Stages& now, const Stages& before, double& change,
                                        double& size) {
    change = 0.0;
    size = 0.0;
    for (std::size_t k = 0; k < stages; ++k) {
      const std::array<double, n> changes = (now[k] - before[k]).array();
      const std::array<double, n> sizes = now[k].array();
      for (std::size_t i = 0; i < n; ++i) {
        const double c = std::fabs(changes[i]);
        const double s = std::fabs(sizes[i]);
        change = c > change ? c : change;
        size = s > size ? s : size;
      }
    }
  }

  template <class Equation>
  WHIRL_TWIN_INLINE bool fixedPoint(const Equation& equation, double offset, double h,
                                    const MotionState<n>& state, Stages& a, Powers& power) const {
    double previous = 0.0;
    for (int iteration = 0; iteration < kMaxFixedPoint; ++iteration) {
      Stages next;
      evaluate(equation, offset, h, state, a, next, power);
      double change;
      double size;
      measure(next, a, change, size);
      a = next;
      if (change <= kTolerance * size) {
        return true;
      }
      // Rounding limit: a small change that no longer decreases counts as converged.
      if (iteration > 0 && change > kSlow * previous) {
        return change <= 64.0 * kTolerance * size;
      }
      previous = change;
    }
    return false;
  }

  bool newton(const ErasedOde<n>& equation, double offset, double h, const MotionState<n>& state,
              Stages& a, Powers& power) const {
    // A Jacobian of the step's start serves most steps. Where the motion turns so fast that it does
    // not, one of the middle of the step as found so far does.
    std::array<double, n> q = state.q;
    std::array<double, n> v = state.v;
    double at = offset;
    for (int i = 0; i < kMaxJacobians; ++i) {
      if (iterate(equation, offset, h, state, equation.jacobian(q, v, at), a, power)) {
        return true;
      }
      stage(kMiddle, h, state, a, q, v);
      at = offset + Tableau::kNodes[kMiddle] * h;
    }
    return false;
  }

  /// Simplified Newton with one Jacobian, until it converges or no longer contracts.
  bool iterate(const ErasedOde<n>& equation, double offset, double h, const MotionState<n>& state,
               const AccelerationJacobian<n>& jacobian, Stages& a, Powers& power) const {
    const StageSolver<stages, n> solver(h, Tableau::kA, gauss_legendre::kAA<stages>, jacobian);
    double previous = 0.0;
    for (int iteration = 0; iteration < kMaxNewton; ++iteration) {
      Stages next;
      evaluate(equation, offset, h, state, a, next, power);
      std::array<std::array<double, n>, stages> residual;
      for (std::size_t k = 0; k < stages; ++k) {
        residual[k] = (next[k] - a[k]).array();
      }
      const auto correction = solver.solve(residual);
      double size = 0.0;
      double change = 0.0;
      bool small = true;
      for (std::size_t k = 0; k < stages; ++k) {
        a[k] = a[k] + SimdVector<n>(correction[k]);
        const std::array<double, n> sizes = a[k].array();
        const std::array<double, n> next_sizes = next[k].array();
        for (std::size_t i = 0; i < n; ++i) {
          const double c = correction[k][i];
          change = std::fmax(change, std::fabs(c));
          small = small &&
                  h * h * std::fabs(c) <=
                      kRoundingsOfPosition * (std::fabs(state.q[i]) + h * std::fabs(state.v[i]));
          size = std::fmax(size, std::fmax(std::fabs(sizes[i]), std::fabs(next_sizes[i])));
        }
      }
      if (change <= kTolerance * size + kNothing) {
        return true;
      }
      if (iteration > 1 && change > 0.9 * previous) {
        return change <= kRounding * size || small;
      }
      previous = change;
    }
    return false;
  }

  Stages last_{};
  bool warm_ = false;
};

template <std::size_t n>
using ImplicitMidpoint = GaussLegendre<1, n>;
template <std::size_t n>
using GaussLegendre4 = GaussLegendre<2, n>;
template <std::size_t n>
using GaussLegendre6 = GaussLegendre<3, n>;

}  // namespace whirl_twin
