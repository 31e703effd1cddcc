// The exact step of a linear system driven by a turning shaft.
//
// At constant speed w the state x = (q, v) and the forcing's phasor (cos, sin) of the shaft angle
// form one linear system y' = A y with constant A: y1 = e^(A h) y0, for any step, stiff or not,
// damped or not, at resonance or not. There is no truncation error; the step adds the increment
// (e^(A h) - I) y0 by compensated summation, so a million small steps are as good as one large one.
// The audited work is y0' W y0 with W = integral of e^(A't) S e^(At), exact likewise.
//
// While the speed changes the free motion is still advanced by its propagator, and the forcing is
// integrated by Gauss-Legendre quadrature with four nodes at the drive's exact angle (variation of
// constants): order 8 in h while the highest frequency times h stays below about 1. A synchronous
// force is given by a few amplitudes (synchronous_force.h), any other by evaluating the equations.
// It requires matrices that do not depend on speed: rotating damping excludes it on a drive that
// changes speed. Inputs are integrated likewise; systems that step exactly with inputs use their
// matrices (linear_rotor_stepper.h, linear_stepper.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "integration/matrix_exponential.h"
#include "integration/motion_state.h"
#include "integration/shaft_phasor.h"
#include "integration/synchronous_force.h"
#include "mechanics/lagrangian.h"

namespace whirl_twin {

template <std::size_t n_>
class Exponential {
 public:
  static constexpr const char* kName = "exponential";

  void restart() {
    phasor_.restart();
    known_ = false;
  }

  /// Advances by h [s] from offset [s] after the start of the twin's step. Equation also gives
  /// moment(offset), evaluate(q, v, moment), jacobian(q, v, offset), hasInputs() and
  /// constantSpeed(offset). Real-time safe; a step that finds a new speed or step size prepares its
  /// propagator first, which costs many times a step.
  template <class Equation>
  StepStatus step(const Equation& equation, double offset, double h, MotionState<n_>& state) {
    if (equation.constantSpeed(offset + h)) {
      exactStep(equation, offset, h, state);
    } else {
      quadratureStep(equation, offset, h, state);
    }
    return StepStatus::kOk;
  }

 private:
  static constexpr int n = static_cast<int>(n_);
  static constexpr int kStates = 2 * n;
  static constexpr int kAll = kStates + 3;  // and cos, sin, 1
  static constexpr int kNodes = 4;
  using Array = std::array<double, n_>;
  using Augmented = Eigen::Matrix<double, kAll, 1>;
  using AugmentedMatrix = Eigen::Matrix<double, kAll, kAll>;
  using States = Eigen::Matrix<double, kStates, 1>;
  using StatesMatrix = Eigen::Matrix<double, kStates, kStates>;

  static constexpr double kPi = 3.14159265358979323846;
  static constexpr std::array<double, kNodes> kGaussNodes{
      0.069431844202973712388, 0.33000947820757186760, 0.66999052179242813240,
      0.93056815579702628761};
  static constexpr std::array<double, kNodes> kGaussWeights{
      0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
      0.17392742256872692869};

  template <class Equation>
  void exactStep(const Equation& equation, double offset, double h, MotionState<n_>& state) {
    const EvaluationPoint<double> at = equation.moment(offset);
    if (h != exact_step_ || at.speed != exact_speed_) {
      prepareExact(equation, at, h);
    }
    Augmented y;
    for (int i = 0; i < n; ++i) {
      y[i] = state.q[i];
      y[n + i] = state.v[i] / rate_scale_;
    }
    phasor_.turnTo(at.angle);
    y[kStates] = phasor_.cosine();
    y[kStates + 1] = phasor_.sine();
    y[kStates + 2] = 1.0;
    const States increment = increment_ * y;
    const double work = y.dot(work_ * y);
    advance(state, increment, work);
  }

  void advance(MotionState<n_>& state, const States& increment, double work) const {
    Array dq;
    Array dv;
    for (int i = 0; i < n; ++i) {
      dq[i] = increment[i];
      dv[i] = rate_scale_ * increment[n + i];
    }
    state.advance(dq, dv, work);
  }

  /// The free system in the scaled states (q, v / rate_scale).
  template <class Equation>
  StatesMatrix freeMatrix(const Equation& equation, double offset) {
    const auto jacobian = equation.jacobian(Array{}, Array{}, offset);
    const double stiffest = std::sqrt(jacobian.by_q.cwiseAbs().maxCoeff());
    rate_scale_ = powerOfTwo(stiffest);
    StatesMatrix a = StatesMatrix::Zero();
    a.template topRightCorner<n, n>().diagonal().setConstant(rate_scale_);
    a.template bottomLeftCorner<n, n>() = jacobian.by_q / rate_scale_;
    a.template bottomRightCorner<n, n>() = jacobian.by_v;
    return a;
  }

  template <class Equation>
  void prepareExact(const Equation& equation, const EvaluationPoint<double>& at, double h) {
    AugmentedMatrix a = AugmentedMatrix::Zero();
    a.template topLeftCorner<kStates, kStates>() = freeMatrix(equation, 0.0);
    const auto at_angle = [&](double angle, const Array& q, const Array& v) {
      return equation.evaluate(q, v, {at.time, angle, at.speed, 0.0});
    };
    const auto ahead = at_angle(0.0, {}, {});
    const auto aside = at_angle(0.5 * kPi, {}, {});
    const auto behind = at_angle(kPi, {}, {});
    for (int i = 0; i < n; ++i) {
      const double steady =
          steadyPart(ahead.acceleration[i], aside.acceleration[i], behind.acceleration[i]);
      a(n + i, kStates) = 0.5 * (ahead.acceleration[i] - behind.acceleration[i]) / rate_scale_;
      a(n + i, kStates + 1) = (aside.acceleration[i] - steady) / rate_scale_;
      a(n + i, kStates + 2) = steady / rate_scale_;
    }
    a(kStates, kStates + 1) = -at.speed;
    a(kStates + 1, kStates) = at.speed;
    increment_ = exponentialLessIdentity<kAll>(AugmentedMatrix(h * a)).template topRows<kStates>();
    work_ = quadraticIntegral<kAll>(a, powerForm(at_angle), h);
    phasor_.prepare(at.speed * h);
    exact_step_ = h;
    exact_speed_ = at.speed;
  }

  /// dh/dt as a quadratic form of the augmented state, by evaluating it on a basis.
  template <class AtAngle>
  AugmentedMatrix powerForm(const AtAngle& at_angle) const {
    const auto power = [&](double angle, int i, double xi, int j, double xj) {
      Array q{};
      Array v{};
      (i < n ? q[i % n] : v[i % n]) += (i < n ? xi : rate_scale_ * xi);
      (j < n ? q[j % n] : v[j % n]) += (j < n ? xj : rate_scale_ * xj);
      return at_angle(angle, q, v).power;
    };
    const double none = power(0.0, 0, 0.0, 0, 0.0);
    const auto quadratic = [&](int i, int j) {
      const double other = i == j ? 0.0 : 1.0;
      return 0.5 * (power(0.0, i, 1.0, j, other) + power(0.0, i, -1.0, j, -other)) - none;
    };
    const auto linear = [&](double angle, int i) {
      return 0.5 * (power(angle, i, 1.0, i, 0.0) - power(angle, i, -1.0, i, 0.0));
    };
    AugmentedMatrix s = AugmentedMatrix::Zero();
    for (int i = 0; i < kStates; ++i) {
      s(i, i) = quadratic(i, i);
      for (int j = 0; j < i; ++j) {
        s(i, j) = s(j, i) = 0.5 * (quadratic(i, j) - quadratic(i, i) - quadratic(j, j));
      }
      const double ahead = linear(0.0, i);
      const double behind = linear(kPi, i);
      const double aside = linear(0.5 * kPi, i);
      const double steady = steadyPart(ahead, aside, behind);
      s(i, kStates) = s(kStates, i) = 0.25 * (ahead - behind);
      s(i, kStates + 1) = s(kStates + 1, i) = 0.5 * (aside - steady);
      s(i, kStates + 2) = s(kStates + 2, i) = 0.5 * steady;
    }
    // At equilibrium: a bow rotating between unequal springs, 2X.
    const double half_aside = power(0.25 * kPi, 0, 0.0, 0, 0.0);
    const double aside = power(0.5 * kPi, 0, 0.0, 0, 0.0);
    s(kStates, kStates) = none;
    s(kStates + 1, kStates + 1) = aside;
    s(kStates, kStates + 1) = s(kStates + 1, kStates) = half_aside - 0.5 * (none + aside);
    return s;
  }

  template <class Equation>
  void quadratureStep(const Equation& equation, double offset, double h, MotionState<n_>& state) {
    if (h != quadrature_step_) {
      prepareQuadrature(equation, offset, h);
    }
    const MotionState<n_> from = state;
    const Derivative<n_> start = atStart(equation, offset, from);
    States x;
    for (int i = 0; i < n; ++i) {
      x[i] = from.q[i];
      x[n + i] = from.v[i] / rate_scale_;
    }
    States increment = free_increment_ * x;
    for (int k = 0; k < kNodes; ++k) {
      const Array forced = forcedAcceleration(equation, offset + kGaussNodes[k] * h);
      for (int i = 0; i < n; ++i) {
        increment += forced[i] * forced_[k].col(i);
      }
    }
    advance(state, increment, 0.0);
    known_q_ = state.q;
    known_v_ = state.v;
    known_at_ = equation.moment(offset + h);
    known_derivative_ = equation(state.q, state.v, offset + h);
    known_ = !equation.hasInputs();  // which may jump at the end
    state.work.add(
        lobattoWork(equation, offset, h, from, start, state.q, state.v, known_derivative_));
  }

  /// The derivative at the start of a step, which is that at the end of the one before unless the
  /// motion or the shaft's was changed between.
  template <class Equation>
  Derivative<n_> atStart(const Equation& equation, double offset, const MotionState<n_>& from) {
    const EvaluationPoint<double> at = equation.moment(offset);
    const auto same = [](double now, double before) {
      return std::fabs(now - before) <= 1.0e-12 * std::fabs(before);
    };
    const double turned = std::remainder(at.angle - known_at_.angle, 2.0 * kPi);
    if (known_ && from.q == known_q_ && from.v == known_v_ && std::fabs(turned) <= 1.0e-12 &&
        same(at.speed, known_at_.speed) && same(at.acceleration, known_at_.acceleration)) {
      return known_derivative_;
    }
    return equation(from.q, from.v, offset);
  }

  template <class Equation>
  Array forcedAcceleration(const Equation& equation, double offset) const {
    return turns_ && !equation.hasInputs() ? force_.at(equation.moment(offset))
                                           : equation(Array{}, Array{}, offset).acceleration;
  }

  template <class Equation>
  void prepareQuadrature(const Equation& equation, double offset, double h) {
    const StatesMatrix a = freeMatrix(equation, offset);
    free_increment_ = exponentialLessIdentity<kStates>(StatesMatrix(h * a));
    for (int k = 0; k < kNodes; ++k) {
      StatesMatrix rest =
          exponentialLessIdentity<kStates>(StatesMatrix((1.0 - kGaussNodes[k]) * h * a));
      rest.diagonal().array() += 1.0;
      forced_[k] = kGaussWeights[k] * h / rate_scale_ * rest.template rightCols<n>();
    }
    turns_ = force_.find(
        [&](const EvaluationPoint<double>& at) {
          return equation.evaluate(Array{}, Array{}, at).acceleration;
        },
        rate_scale_);
    quadrature_step_ = h;
  }

  /// Work over the step by four-point Lobatto quadrature on the quintic Hermite interpolant.
  template <class Equation>
  static double lobattoWork(const Equation& equation, double offset, double h,
                            const MotionState<n_>& from, const Derivative<n_>& start,
                            const Array& end_q, const Array& end_v, const Derivative<n_>& end) {
    double inner = 0.0;
    for (const double s : {0.27639320225002103036, 0.72360679774997896964}) {
      Array q;
      Array v;
      for (int i = 0; i < n; ++i) {
        // Deviation from the start's parabola, matched in value, rate and acceleration at the end.
        const double dq = end_q[i] - from.q[i] - h * (from.v[i] + 0.5 * h * start.acceleration[i]);
        const double dv = h * (end_v[i] - from.v[i] - h * start.acceleration[i]);
        const double da = h * h * (end.acceleration[i] - start.acceleration[i]);
        const double c3 = 10.0 * dq - 4.0 * dv + 0.5 * da;
        const double c4 = -15.0 * dq + 7.0 * dv - da;
        const double c5 = 6.0 * dq - 3.0 * dv + 0.5 * da;
        q[i] = from.q[i] + s * h * (from.v[i] + 0.5 * s * h * start.acceleration[i]) +
               s * s * s * (c3 + s * (c4 + s * c5));
        v[i] = from.v[i] + s * h * start.acceleration[i] +
               s * s / h * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5));
      }
      inner += equation(q, v, offset + s * h).power;
    }
    return h / 12.0 * (start.power + 5.0 * inner + end.power);
  }

  double rate_scale_ = 1.0;  ///< [1/s]
  double exact_step_ = 0.0;  ///< [s], that increment_ and work_ were made for
  double exact_speed_ = 0.0;
  double quadrature_step_ = 0.0;  ///< [s], that free_increment_ and forced_ were made for
  Eigen::Matrix<double, kStates, kAll> increment_;
  AugmentedMatrix work_;
  ShaftPhasor phasor_;
  StatesMatrix free_increment_;
  std::array<Eigen::Matrix<double, kStates, n>, kNodes> forced_;
  SynchronousForce<n_> force_;  ///< on the system at rest
  bool turns_ = false;          ///< it is of that form
  // The end of the last step, if it is known.
  bool known_ = false;
  Array known_q_{}, known_v_{};
  EvaluationPoint<double> known_at_{};
  Derivative<n_> known_derivative_{};
};

}  // namespace whirl_twin
