// Linear-quadratic regulators: the gain of a double integrator in closed form, minimum cost among
// neighbouring gains, the same cost from measurements as from the states, an estimate that
// converges to the states also in saturation, and errors.
#include <gtest/gtest.h>

#include <cmath>

#include "algebra/dense.h"
#include "analysis/riccati.h"
#include "example_controllers.h"

namespace whirl_twin {
namespace quadratic_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// x'' = u, both measured, at a rate [Hz].
ControllerPlan planOfIntegrators(double rate) {
  ControllerPlan plan = planOf(rate, 2, 1);
  plan.plant = LinearPlant{(MatrixXd(2, 2) << 0, 1, 0, 0).finished(), Eigen::Vector2d(0, 1),
                           MatrixXd::Identity(2, 2)};
  return plan;
}

MatrixXd gainOf(const Controller& lqr) {
  return -lqr.linear(0.0)->d;
}

// q = diag(1, 0), r = 1: k = [1, sqrt(2)] (J. P. Hespanha, Linear Systems Theory; by hand).
TEST(Lqr, HasTheGainOfADoubleIntegrator) {
  Settings settings = matrices({{"q", row({1, 0})}, {"r", row({1})}});
  settings.choices["cost"] = "continuous";
  const MatrixXd expected = row({1.0, std::sqrt(2.0)});
  EXPECT_LT((gainOf(*made("lqr", {}, settings, planOfIntegrators(10.0))) - expected).norm(), 1e-12);
  settings.choices["cost"] = "sampled";
  const auto off = [&](double rate) {
    return (gainOf(*made("lqr", {}, settings, planOfIntegrators(rate))) - expected).norm();
  };
  EXPECT_GT(off(1.0), 0.1);
  EXPECT_NEAR(off(1e3) / off(1e4), 10.0, 0.1) << "in dense samples it comes to that of continuous";
}

/// Cost of twoMasses() from x0 under u = -gain x, held between samples, counted over 60 s.
double costOf(const MatrixXd& gain, double rate, const Settings& settings) {
  const LinearPlant plant = twoMasses();
  const MatrixXd q = settings.matrices.at("q").row(0).asDiagonal();
  const MatrixXd r = settings.matrices.at("r").row(0).asDiagonal();
  constexpr int kParts = 200;  // of a sample: Euler's rule would need many more
  const double h = 1.0 / (rate * kParts);
  VectorXd x = Eigen::Vector4d(1.0, -0.5, 0.2, 0.0);
  double cost = 0.0;
  for (int k = 0; k < static_cast<int>(60.0 * rate); ++k) {
    const VectorXd u = -gain * x;
    for (int i = 0; i < kParts; ++i) {
      const VectorXd rate_now = plant.a * x + plant.b * u;
      const VectorXd middle = x + 0.5 * h * rate_now;
      cost += h * (middle.dot(q * middle) + u.dot(r * u));
      x += h * (plant.a * middle + plant.b * u);
    }
  }
  return cost;
}

TEST(Lqr, CostsLeastAmongItsNeighbours) {
  constexpr double kRate = 5.0;
  const Settings settings = regulatorOfTwoMasses("sampled");
  const MatrixXd gain = gainOf(*made("lqr", {}, settings, planOfTwoMasses(kRate, 4)));
  const double least = costOf(gain, kRate, settings);
  for (Index i = 0; i < gain.size(); ++i) {
    for (const double change : {-0.02, 0.02}) {
      MatrixXd other = gain;
      other(i) += change;
      EXPECT_GT(costOf(other, kRate, settings), least) << i << " " << change;
    }
  }
  const MatrixXd continuous =
      gainOf(*made("lqr", {}, regulatorOfTwoMasses("continuous"), planOfTwoMasses(kRate, 4)));
  EXPECT_GT(costOf(continuous, kRate, settings), 1.01 * least);
}

TEST(Lqr, GoesByWhatIsMeasuredWhateverItsOrder) {
  const Settings settings = regulatorOfTwoMasses("sampled");
  ControllerPlan plan = planOfTwoMasses(20.0, 4);
  const MatrixXd gain = gainOf(*made("lqr", {}, settings, plan));
  MatrixXd mixed = MatrixXd::Zero(4, 4);
  mixed << 0, 0, 2, 0, 1, 0, 0, 0, 0, 0, 0, -1, 1, 1, 0, 0;
  plan.plant->c = mixed;
  EXPECT_LT((gainOf(*made("lqr", {}, settings, plan)) * mixed - gain).norm(), 1e-12);
}

TEST(Lqr, RefusesAtTheSettingThatIsWrong) {
  const auto refused = [](const std::string& name, const Settings& settings,
                          const ControllerPlan& plan) {
    const auto [setting, text] = inputError(name, {}, settings, plan);
    return setting + ": " + text;
  };
  const ControllerPlan plan = planOfTwoMasses(20.0, 4);
  const auto with = [](const char* name, const MatrixXd& matrix) {
    Settings settings = regulatorOfTwoMasses("sampled", 4);
    settings.matrices[name] = matrix;
    return settings;
  };
  EXPECT_EQ(refused("lqr", with("q", row({1, 2})), plan),
            "q: must be 1 x 4, a number per state, or a row and a column per state, found 1 x 2");
  EXPECT_EQ(refused("lqr", with("r", row({1, -1})), plan),
            "r: diagonal must be >= 0, found -1 at index 1");
  EXPECT_EQ(refused("lqr", with("r", (MatrixXd(2, 2) << 1, 2, 0, 1).finished()), plan),
            "r: must be symmetric");
  EXPECT_EQ(refused("lqr", with("q", row({1, 1, 1, 1})), planOfTwoMasses(20.0, 3)),
            "q: an lqr must measure all 4 states, found 3 signals with 3 states; lqg estimates the "
            "others");
  EXPECT_EQ(refused("lqr", with("q", row({1, 1, 1, 1})), planOf(20.0, 4)).substr(0, 47),
            "q: needs a linear plant: the systems it acts on");
  EXPECT_EQ(refused("lqg", with("sensor_noise", row({1, 1})), plan),
            "sensor_noise: must be 1 x 4, a number per measured signal, found 1 x 2");
  // Nothing moves the unstable mass: no gain holds it.
  ControllerPlan lost = plan;
  lost.plant->b.setZero();
  EXPECT_EQ(refused("lqr", regulatorOfTwoMasses("sampled"), lost).substr(0, 3), "q: ");
}

/// twoMasses() from sample to sample.
SampledPlant sampledMasses(double rate) {
  const LinearPlant plant = twoMasses();
  return sampledPlant(plant.a, plant.b, {MatrixXd::Zero(4, 4), MatrixXd::Identity(2, 2)},
                      1.0 / rate);
}

// The eigenvalues of the loop are those of regulator and filter (the separation principle).
TEST(Lqg, HasThePolesOfItsRegulatorAndOfItsFilter) {
  constexpr double kRate = 50.0;
  const ControllerPlan plan = planOfTwoMasses(kRate, 2);
  const SampledPlant plant = sampledMasses(kRate);
  const DiscreteStateSpace law =
      *made("lqg", {}, regulatorOfTwoMasses("sampled", 2), plan)->linear(0.0);
  const MatrixXd c = plan.plant->c;
  MatrixXd loop(8, 8);
  loop << plant.a + plant.b * law.d * c, plant.b * law.c, law.b * c, law.a;
  const EigenPairs all = eigenvalues(loop);

  const MatrixXd gain =
      gainOf(*made("lqr", {}, regulatorOfTwoMasses("sampled"), planOfTwoMasses(kRate, 4)));
  const EigenPairs regulator = eigenvalues(plant.a - plant.b * gain);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_LT((all.values.array() - regulator.values[i]).abs().minCoeff(), 1e-9);
  }
  EXPECT_LT(all.values.cwiseAbs().maxCoeff(), 1.0);
}

// The saturation residual of an output never acts on the plant: the prediction excludes it.
TEST(Lqg, PredictsByWhatTheLimitsLeave) {
  constexpr double kRate = 50.0;
  ControllerPlan plan = planOfTwoMasses(kRate, 2);
  plan.limits = {1.5, 0.5};
  const Eigen::Vector2d limits(1.5, 0.5);
  const MatrixXd b = sampledMasses(kRate).b;
  const auto lqg = made("lqg", {}, regulatorOfTwoMasses("sampled", 2), plan);
  const DiscreteStateSpace law = *lqg->linear(0.0);
  VectorXd predicted = VectorXd::Zero(4);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector2d y(std::sin(k), std::cos(3 * k));
    Eigen::Vector2d u;
    lqg->update(sampleOf(y.data(), k), u.data());
    const Eigen::Vector2d expected = law.c * predicted + law.d * y;
    ASSERT_LT((u - expected).norm(), 1e-10 * (1.0 + expected.norm()));
    const Eigen::Vector2d cut = expected.cwiseMax(-limits).cwiseMin(limits);
    predicted = (law.a * predicted + law.b * y + b * (cut - expected)).eval();
  }
}

TEST(Lqg, KeepsToTheStatesUnderLimits) {
  constexpr double kRate = 50.0;
  ControllerPlan plan = planOfTwoMasses(kRate, 2);
  plan.limits = {1.5, 1.5};
  const SampledPlant plant = sampledMasses(kRate);
  const auto lqg = made("lqg", {}, regulatorOfTwoMasses("sampled", 2), plan);
  VectorXd x = Eigen::Vector4d(0.3, 0.4, 0.0, 0.0);
  bool limited = false;
  for (int k = 0; k < 2000; ++k) {
    const double y[] = {x[0], x[1]};
    Eigen::Vector2d u;
    lqg->update(sampleOf(y, k), u.data());
    limited = limited || u.cwiseAbs().maxCoeff() > 1.5;
    x = (plant.a * x + plant.b * u.cwiseMax(-1.5).cwiseMin(1.5)).eval();
  }
  EXPECT_TRUE(limited);
  EXPECT_LT(x.norm(), 1e-9);
}

}  // namespace quadratic_test
}  // namespace whirl_twin
