#include "analysis/riccati.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "acrobot.h"
#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace riccati_test {

using Eigen::MatrixXd;

void expectGain(const MatrixXd& gain, const Eigen::RowVectorXd& known, double digit) {
  ASSERT_EQ(gain.cols(), known.size());
  for (Eigen::Index i = 0; i < known.size(); ++i) {
    EXPECT_NEAR(gain(0, i), known[i], digit) << i;
  }
}

double radius(const MatrixXd& m) {
  return eigenvalues(m).values.cwiseAbs().maxCoeff();
}

/// Residual of the equation, relative to its terms.
double continuousResidual(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost,
                          const Regulator& found) {
  const MatrixXd& x = found.cost;
  const MatrixXd residual =
      a.transpose() * x + x * a + cost.state - found.gain.transpose() * cost.input * found.gain;
  return residual.norm() / (2.0 * x.norm() * (a.norm() + b.norm() * found.gain.norm()));
}

MatrixXd random(Eigen::Index rows, Eigen::Index columns, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

/// Numbers here and below: Newton's method in extended precision.
TEST(Riccati, HoldsTheAcrobotUpright) {
  const auto [a, b] = uprightAcrobot();
  const QuadraticCost cost{MatrixXd::Identity(4, 4), MatrixXd::Identity(1, 1)};
  Eigen::RowVectorXd known(4);
  known << -170.165268754907, -73.476956765974, -34.977341113315, -16.733364712606;
  const Regulator found = continuousRegulator(a, b, cost);
  expectGain(found.gain, known, 5e-9);
  EXPECT_LT(continuousResidual(a, b, cost, found), 1e-14);
}

TEST(Riccati, HoldsItInSamplesAsThatCostsLeast) {
  const auto [a, b] = uprightAcrobot();
  constexpr double kPeriod = 0.002;
  const QuadraticCost cost{MatrixXd::Identity(4, 4), MatrixXd::Identity(1, 1)};
  Eigen::RowVectorXd exact(4), naive(4);
  exact << -146.914280009965, -63.291753980720, -30.188526849310, -14.435271021878;
  naive << -146.045347316220, -62.911059692985, -30.009546856855, -14.349399629381;
  expectGain(sampledRegulator(a, b, cost, kPeriod).gain, exact, 5e-9);
  // With the cost at the samples only.
  const SampledPlant held = sampledPlant(a, b, cost, kPeriod);
  expectGain(discreteRegulator(held.a, held.b, {kPeriod * cost.state, kPeriod * cost.input}).gain,
             naive, 5e-9);
}

TEST(Riccati, KnowsTheEquationsThatHaveAClosedForm) {
  // x' = x + u, x^2 + u^2: X^2 - 2 X - 1 = 0. x(k+1) = 2 x + u: X^2 - 4 X - 1 = 0.
  const MatrixXd one = MatrixXd::Identity(1, 1);
  EXPECT_NEAR(continuousRegulator(one, one, {one, one}).gain(0, 0), 1.0 + std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(discreteRegulator(2.0 * one, one, {one, one}).cost(0, 0), 2.0 + std::sqrt(5.0),
              2e-15);
  // A free mass, x^2 + u^2: u = -x - sqrt(2) v.
  MatrixXd a(2, 2), b(2, 1), q(2, 2);
  a << 0, 1, 0, 0;
  b << 0, 1;
  q << 1, 0, 0, 0;
  const Regulator mass = continuousRegulator(a, b, {q, one});
  EXPECT_NEAR(mass.gain(0, 0), 1.0, 4e-15);
  EXPECT_NEAR(mass.gain(0, 1), std::sqrt(2.0), 4e-15);
}

TEST(Riccati, ACrossTermIsAnInputThatIsCountedFromElsewhere) {
  // x' Q x + 2 x' N u + u' R u with u = v - R^-1 N' x has no cross term.
  std::mt19937 generator(5);
  const MatrixXd a = random(3, 3, generator);
  const MatrixXd b = random(3, 2, generator);
  const MatrixXd cross = 0.1 * random(3, 2, generator);
  const MatrixXd one = MatrixXd::Identity(2, 2);
  const MatrixXd q = MatrixXd::Identity(3, 3);
  const Regulator with = continuousRegulator(a, b, {q, one, cross});
  const Regulator without =
      continuousRegulator(a - b * cross.transpose(), b, {q - cross * cross.transpose(), one});
  EXPECT_LT((with.gain - without.gain - cross.transpose()).norm(), 1e-13 * with.gain.norm());
}

TEST(Riccati, SolvesRandomEquationsAndStabilises) {
  std::mt19937 generator(1);
  std::uniform_int_distribution<Eigen::Index> size(1, 10);
  double worst_continuous = 0.0, worst_sampled = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Index n = size(generator);
    const Eigen::Index m = std::min<Eigen::Index>(n, 1 + i % 3);
    const MatrixXd a = random(n, n, generator);
    const MatrixXd b = random(n, m, generator);
    const MatrixXd root = random(n, n, generator);
    const QuadraticCost cost{MatrixXd::Identity(n, n) + root * root.transpose(),
                             MatrixXd::Identity(m, m)};
    const Regulator continuous = continuousRegulator(a, b, cost);
    worst_continuous = std::fmax(worst_continuous, continuousResidual(a, b, cost, continuous));
    const MatrixXd closed = a - b * continuous.gain;
    EXPECT_LT(eigenvalues(closed).values.real().maxCoeff(), 0.0);

    const SampledPlant held = sampledPlant(a, b, cost, 0.1);
    const Regulator sampled = discreteRegulator(held.a, held.b, held.cost);
    const MatrixXd loop = held.a - held.b * sampled.gain;
    EXPECT_LT(radius(loop), 1.0);
    // x' X x is what this period and all later ones cost.
    const MatrixXd later = loop.transpose() * sampled.cost * loop;
    const MatrixXd crossed = held.cost.cross * sampled.gain;
    const MatrixXd now = held.cost.state - crossed - crossed.transpose() +
                         sampled.gain.transpose() * held.cost.input * sampled.gain;
    worst_sampled = std::fmax(worst_sampled,
                              (now + later - sampled.cost).norm() / sampled.cost.norm() /
                                  std::pow(held.a.norm() + held.b.norm() * sampled.gain.norm(), 2));
  }
  EXPECT_LT(worst_continuous, 1e-13);
  EXPECT_LT(worst_sampled, 1e-13);
}

TEST(Riccati, FastSamplesCostWhatNoSamplesDo) {
  const auto [a, b] = uprightAcrobot();
  const QuadraticCost cost{MatrixXd::Identity(4, 4), MatrixXd::Identity(1, 1)};
  const MatrixXd least = continuousRegulator(a, b, cost).cost;
  // The cost of holding the inputs goes as the square of the period.
  const double late = (sampledRegulator(a, b, cost, 2e-3).cost - least).norm();
  const double later = (sampledRegulator(a, b, cost, 4e-3).cost - least).norm();
  EXPECT_NEAR(later / late, 4.0, 0.1);
}

TEST(Riccati, AnEstimatorIsARegulatorOfTheTransposed) {
  // A random walk in noise: P^2 - W P - W V = 0, gain P / (P + V); W = 1, V = 2.
  const MatrixXd one = MatrixXd::Identity(1, 1);
  const Estimator walk = discreteEstimator(one, one, one, 2.0 * one);
  EXPECT_NEAR(walk.covariance(0, 0), 2.0, 1e-14);
  EXPECT_NEAR(walk.gain(0, 0), 0.5, 1e-15);
  // The same in continuous time: P = sqrt(W V).
  const Estimator diffusion = continuousEstimator(0.0 * one, one, one, 4.0 * one);
  EXPECT_NEAR(diffusion.covariance(0, 0), 2.0, 1e-14);
  EXPECT_NEAR(diffusion.gain(0, 0), 0.5, 1e-14);
}

TEST(Riccati, SaysWhereThereIsNoGain) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  const MatrixXd none = MatrixXd::Zero(1, 1);
  EXPECT_THROW(continuousRegulator(one, none, {one, one}), RunFailure);  // not to be moved
  EXPECT_THROW(discreteRegulator(2.0 * one, none, {one, one}), RunFailure);
  MatrixXd swinging(2, 2), b(2, 1);
  swinging << 0, 1, -1, 0;
  b << 0, 1;
  EXPECT_THROW(continuousRegulator(swinging, b, {MatrixXd::Zero(2, 2), one}),
               RunFailure);  // costs nothing
  EXPECT_THROW(continuousRegulator(one, one, {one, none}), InputError);
  EXPECT_THROW(continuousRegulator(one, one, {NAN * one, one}), InputError);
  EXPECT_THROW(sampledRegulator(one, one, {one, one}, 0.0), InputError);
  EXPECT_THROW(continuousRegulator(one, b, {one, one}), std::logic_error);
}

}  // namespace riccati_test
}  // namespace whirl_twin
