// Stability of motions with periodic coefficients. References: a transition matrix by Runge-Kutta's
// method of order 4 in long double, written here (Mathieu's chart, an anisotropic shaft on unequal
// supports), closed forms (multipliers of constant coefficients, Smith's limits), and published
// thresholds of the pendulum with an oscillating pivot.

#include "analysis/floquet.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "algebra/dense.h"
#include "analysis/equilibria.h"
#include "analysis/linearized_motion.h"
#include "mechanics/dynamics.h"
#include "mechanics/lagrangian_dynamics.h"
#include "models_under_test.h"

namespace whirl_twin {

namespace floquet_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.80665;

using Row = std::array<long double, 4>;
/// q'' = -C q' - K q of up to two coordinates: entries of K, then C, at a time.
using Coefficients = std::function<std::array<long double, 8>(long double)>;

/// The transition matrix over a period of q'' + C(t) q' + K(t) q = 0, columns in turn.
Eigen::MatrixXd transition(int n, double period, const Coefficients& at, int steps) {
  const auto slope = [&](long double t, const Row& x) {
    const std::array<long double, 8> m = at(t);
    Row rate{x[2], x[3], 0.0L, 0.0L};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        rate[2 + i] -= m[2 * i + j] * x[j] + m[4 + 2 * i + j] * x[2 + j];
      }
    }
    return rate;
  };
  const auto plus = [](const Row& x, long double h, const Row& rate) {
    Row sum = x;
    for (std::size_t i = 0; i < 4; ++i) {
      sum[i] += h * rate[i];
    }
    return sum;
  };
  Eigen::MatrixXd all(2 * n, 2 * n);
  const long double h = static_cast<long double>(period) / steps;
  for (int column = 0; column < 2 * n; ++column) {
    Row x{};
    x[static_cast<std::size_t>(column < n ? column : 2 + column - n)] = 1.0L;
    for (int i = 0; i < steps; ++i) {
      const long double t = i * h;
      const Row a = slope(t, x);
      const Row b = slope(t + h / 2, plus(x, h / 2, a));
      const Row c = slope(t + h / 2, plus(x, h / 2, b));
      const Row d = slope(t + h, plus(x, h, c));
      for (std::size_t k = 0; k < 4; ++k) {
        x[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
      }
    }
    for (int row = 0; row < n; ++row) {
      all(row, column) = static_cast<double>(x[static_cast<std::size_t>(row)]);
      all(n + row, column) = static_cast<double>(x[static_cast<std::size_t>(2 + row)]);
    }
  }
  return all;
}

std::shared_ptr<const Dynamics> shaken(double length, double amplitude, double frequency,
                                       double damping, double mass = 1.0,
                                       double gravity = kGravity) {
  return dynamicsOf("kapitza_pendulum",
                    {{"mass", mass},
                     {"length", length},
                     {"damping", damping},
                     {"amplitude", amplitude},
                     {"frequency", frequency}},
                    gravity);
}

SteadyMotion at(double theta) {
  return {Eigen::VectorXd::Constant(1, theta), Eigen::VectorXd::Zero(1)};
}

PeriodicMotion motionAt(const Dynamics& dynamics, double theta) {
  const auto period = timeDependence(dynamics, 0.0).period;
  EXPECT_TRUE(period);
  const auto motion = periodicMotionNear(dynamics, 0.0, *period, at(theta));
  EXPECT_TRUE(motion);
  return *motion;
}

// Hanging, shaken at twice its frequency (cases of E. I. Butikov, Am. J. Phys. 86, 2018).
TEST(Floquet, AHangingPendulumShakenAtTwiceItsFrequencyGrows) {
  const auto hanging = shaken(0.5, 0.02, 8.857494, 0.025);
  const PeriodicMotion motion = motionAt(*hanging, 0.0);
  EXPECT_NEAR(motion.multipliers.front().real(), -1.09429, 1.0e-5);
  const auto point =
      operatingPoint(*hanging, Eigen::VectorXd::Constant(1, 0.01), Eigen::VectorXd::Zero(1), 0.0);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->q[0], 0.0);
  EXPECT_EQ(point->stability.routh.verdict, Verdict::kUnstable);
  EXPECT_NEAR(point->stability.decay_rate, -0.12703, 1.0e-5);
  // It grows at half the frequency of the pivot, at that of the pendulum.
  EXPECT_NEAR(std::fabs(point->stability.eigenvalues.front().imag()), 0.5 * 8.857494, 1.0e-9);
}

// The exact stability threshold of the upright pendulum, above that of its mean motion, 46.6825
// rad/s.
TEST(Floquet, UprightItStandsFromTheExactThresholdOn) {
  double low = 46.0;
  double high = 49.0;
  while (high - low > 1.0e-7) {
    const double middle = 0.5 * (low + high);
    (grows(motionAt(*shaken(0.1, 0.03, middle, 0.0, 0.1), kPi)) ? low : high) = middle;
  }
  EXPECT_NEAR(low, 47.55646, 1.0e-2);
  const Stability below = stabilityOf(motionAt(*shaken(0.1, 0.03, 47.0, 0.0, 0.1), kPi), {});
  const Stability above = stabilityOf(motionAt(*shaken(0.1, 0.03, 47.8, 1.0e-6, 0.1), kPi), {});
  EXPECT_EQ(below.routh.verdict, Verdict::kUnstable);
  EXPECT_EQ(above.routh.verdict, Verdict::kAsymptoticallyStable);
  EXPECT_NEAR(above.decay_rate, 0.5 * 1.0e-6 / (0.1 * 0.1 * 0.1), 1.0e-8);
}

// With a too large amplitude of the pivot it falls again.
TEST(Floquet, UprightItFallsWhereItIsShakenTooWide) {
  double low = 0.4;
  double high = 0.5;
  while (high - low > 1.0e-7) {
    const double middle = 0.5 * (low + high);
    (grows(motionAt(*shaken(0.1, 0.1 * middle, 300.0, 0.0, 0.1), kPi)) ? high : low) = middle;
  }
  EXPECT_NEAR(low, 0.455852, 1.0e-5);
}

// Mathieu's equation x'' + (d + 2 e cos 2 t) x = 0 as a shaken pendulum, hanging and upright:
// d = 4 g / (l W^2), e = -2 a / l.
TEST(Floquet, MathieusChartIsThatOfAnIndependentIntegrator) {
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) {
      const double d = 0.02 + 0.1 * i;
      const double e = 0.013 + 0.05 * k;
      const double frequency = 10.0;
      const double theta = (i + k) % 3 == 0 ? kPi : 0.0;
      const double sign = theta == 0.0 ? 1.0 : -1.0;
      const double gravity = 0.25 * d * frequency * frequency;
      const auto pendulum = shaken(1.0, 0.5 * e, frequency, 0.0, 1.0, gravity);
      const Eigen::MatrixXd reference = transition(
          1, 2.0 * kPi / frequency,
          [&](long double t) {
            const long double stiffness =
                sign * (gravity - 0.5L * e * frequency * frequency * std::cos(frequency * t));
            return std::array<long double, 8>{stiffness, 0, 0, 0, 0, 0, 0, 0};
          },
          800);
      const double distance = std::fabs(reference.trace()) - 2.0;
      if (std::fabs(distance) < 1.0e-6) {
        continue;
      }
      const Stability s = stabilityOf(motionAt(*pendulum, theta), {});
      EXPECT_EQ(s.routh.verdict, distance > 0.0 ? Verdict::kUnstable : Verdict::kMarginal)
          << "d = " << sign * d << ", e = " << e << ", trace " << reference.trace();
      ++judged;
    }
  }
  EXPECT_GT(judged, 3590);
}

// x'' + ... with a load: linear, so that the multipliers are e^(root T) and the response is exact.
TEST(Floquet, ConstantCoefficientsHaveTheExponentialsOfTheirRoots) {
  const auto cart = dynamicsOf("cart_pendulum",
                               {{"cart_mass", 2.0},
                                {"rod_mass", 0.5},
                                {"rod_length", 0.4},
                                {"stiffness", 300.0},
                                {"damping", 4.0},
                                {"force_amplitude", 1.0e-7},
                                {"force_frequency", 7.0}},
                               kGravity);
  const auto all = equilibria(*cart, 0.0);
  const auto rest = std::find_if(all.begin(), all.end(),
                                 [](const Equilibrium& e) { return e.q.norm() < 1.0e-9; });
  ASSERT_NE(rest, all.end());
  ASSERT_TRUE(rest->periodic);
  const auto roots = eigenvalues(linearizationAtRest(*cart, rest->q, 0.0));
  ASSERT_EQ(rest->stability.eigenvalues.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    // The load is so small that it changes nothing but the place.
    EXPECT_NEAR(std::abs(rest->stability.eigenvalues[i] - roots[i]), 0.0, 1.0e-7);
  }
  EXPECT_EQ(rest->stability.routh.verdict, Verdict::kAsymptoticallyStable);
}

/// A disc on a shaft that is not round, in supports that are stiffer along x than along y: in the
/// fixed frame its stiffness alternates twice a turn.
struct UnroundShaft {
  static constexpr const char* kName = "unround_shaft";
  static constexpr const char* kSummary = "disc on a shaft that is not round, on unequal supports";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = true;
  static constexpr bool kHasShaft = true;
  static constexpr std::array<Coordinate, kDof> kCoordinates{{{"x", "m"}, {"y", "m"}}};

  double stiffness = 1.0e4;  // N/m, of 1 kg
  double unround = 0.1;      // k (1 +- it) along axes that turn
  double unequal = 0.0;      // k (1 +- it) along x and y
  double damping = 0.0;      // N s/m

  template <class S>
  S kinetic(const std::array<S, 2>&, const std::array<S, 2>& v, const EvaluationPoint<S>&) const {
    return 0.5 * (v[0] * v[0] + v[1] * v[1]);
  }
  template <class S>
  S potential(const std::array<S, 2>& q, const EvaluationPoint<S>& at) const {
    const S along = q[0] * cos(at.angle) + q[1] * sin(at.angle);
    const S across = q[1] * cos(at.angle) - q[0] * sin(at.angle);
    return (0.5 * stiffness) * ((1.0 + unequal) * (q[0] * q[0]) + (1.0 - unequal) * (q[1] * q[1]) +
                                unround * (along * along - across * across));
  }
  template <class S>
  S dissipation(const std::array<S, 2>&, const std::array<S, 2>& v,
                const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0] + v[1] * v[1]);
  }
  template <class S>
  std::array<S, 2> force(const std::array<S, 2>&, const std::array<S, 2>&,
                         const EvaluationPoint<S>&) const {
    return {};
  }
};

Stability judged(const UnroundShaft& shaft, double speed) {
  const LagrangianDynamics<UnroundShaft> dynamics(shaft);
  const auto all = equilibria(dynamics, speed);
  EXPECT_EQ(all.size(), 1u);
  return all.front().stability;
}

// D. M. Smith, Proc. Royal Society A 142 (1933): unstable between the two critical speeds.
TEST(Floquet, AShaftThatIsNotRoundIsUnstableBetweenItsCriticalSpeeds) {
  UnroundShaft shaft;
  const double low = 100.0 * std::sqrt(0.9);
  const double high = 100.0 * std::sqrt(1.1);
  for (const double speed : {0.5 * low, 0.999 * low, 1.001 * high, 2.3 * high}) {
    EXPECT_EQ(judged(shaft, speed).routh.verdict, Verdict::kMarginal) << speed;
  }
  for (const double speed : {1.001 * low, 100.0, 0.999 * high}) {
    EXPECT_EQ(judged(shaft, speed).routh.verdict, Verdict::kUnstable) << speed;
  }
}

TEST(Floquet, OnUnequalSupportsItIsJudgedAsByAnIndependentIntegrator) {
  int unstable = 0;
  for (const double unequal : {0.02, 0.15}) {
    for (const double damping : {0.0, 0.4, 4.0}) {
      for (double speed = 40.0; speed < 160.0; speed += 3.7) {
        const UnroundShaft shaft{1.0e4, 0.1, unequal, damping};
        const Eigen::MatrixXd reference = transition(
            2, 2.0 * kPi / speed,
            [&](long double t) {
              const long double c = 1.0e3L * std::cos(2.0L * speed * t);
              const long double s = 1.0e3L * std::sin(2.0L * speed * t);
              return std::array<long double, 8>{1.0e4L * (1.0L + unequal) + c,
                                                s,
                                                s,
                                                1.0e4L * (1.0L - unequal) - c,
                                                damping,
                                                0,
                                                0,
                                                damping};
            },
            3000);
        const double modulus = eigenPairs(reference).values.cwiseAbs().maxCoeff();
        const Stability s = judged(shaft, speed);
        EXPECT_NEAR(-s.decay_rate, std::log(modulus) * speed / (2.0 * kPi), 2.0e-6)
            << unequal << " " << damping << " " << speed;
        if (modulus > 1.0 + 1.0e-6) {
          EXPECT_EQ(s.routh.verdict, Verdict::kUnstable) << speed;
          ++unstable;
        } else if (modulus < 1.0 - 1.0e-6) {
          EXPECT_EQ(s.routh.verdict, Verdict::kAsymptoticallyStable) << speed;
        }
      }
    }
  }
  EXPECT_GT(unstable, 10);
}

// Two loads without a common period: the mean motion is evaluated, and the result states so.
TEST(Floquet, LoadsWithoutACommonPeriodHaveNone) {
  const auto cart = [](double of_force) {
    return dynamicsOf("cart_pendulum",
                      {{"cart_mass", 2.0},
                       {"rod_mass", 0.5},
                       {"rod_length", 0.4},
                       {"stiffness", 300.0},
                       {"force_amplitude", 1.0},
                       {"force_frequency", of_force},
                       {"support_amplitude", 1.0e-3},
                       {"support_frequency", 6.0}},
                      kGravity);
  };
  EXPECT_NEAR(timeDependence(*cart(9.0), 0.0).period.value(), 2.0 * kPi / 3.0, 1.0e-12);
  const TimeDependence apart = timeDependence(*cart(6.0 * std::sqrt(2.0)), 0.0);
  EXPECT_TRUE(apart.varies);
  EXPECT_FALSE(apart.period);
  EXPECT_FALSE(
      timeDependence(
          *dynamicsOf("double_pendulum",
                      {{"mass1", 1.0}, {"mass2", 1.0}, {"length1", 1.0}, {"length2", 1.0}}),
          0.0)
          .varies);
}

}  // namespace floquet_test

}  // namespace whirl_twin
