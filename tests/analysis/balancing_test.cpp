// Two-plane balancing from three simulated runs recovers the simulated unbalance.
#include "analysis/balancing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/synchronous_response.h"
#include "messages/input_error.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace balancing_test {

using Complex = std::complex<double>;

/// x of the probes at the outer discs, at two speeds [rad/s], as phasors.
Eigen::VectorXcd readings(const RotorUnderTest& r) {
  Eigen::VectorXcd v(4);
  Eigen::Index i = 0;
  for (const double speed : {300.0, 520.0}) {
    const auto response = synchronousResponse(r.rotor, r.stations, speed);
    v[i++] = response.orbits.front().x;
    v[i++] = response.orbits.back().x;
  }
  return v;
}

struct Runs {
  Eigen::VectorXcd initial;
  std::vector<TrialRun> trials;
};

const Complex kFirst = std::polar(3.0e-5, 0.7);
const Complex kSecond = std::polar(2.0e-5, -2.1);

Runs simulatedRuns() {
  RotorUnderTest r = chainRotor(3, 5.0e5, 1.2);
  addUnbalance(r, 0, kFirst);
  addUnbalance(r, 2, kSecond);
  Runs runs{readings(r), {}};
  for (const Eigen::Index plane : {0, 1}) {
    RotorUnderTest with = r;
    const Complex trial = std::polar(1.0e-5, 0.3 + static_cast<double>(plane));
    addUnbalance(with, plane == 0 ? 0 : 2, trial);
    runs.trials.push_back({plane, trial, readings(with)});
  }
  return runs;
}

TEST(Balancing, FindsTheUnbalanceFromThreeRuns) {
  const Runs runs = simulatedRuns();
  const auto influence = influenceOfPlanes(runs.initial, runs.trials, 2);
  const auto correction = balance(influence, runs.initial, Eigen::VectorXd::Ones(4));
  EXPECT_LT(std::abs(correction.mass_radius[0] + kFirst), 1.0e-9 * std::abs(kFirst));
  EXPECT_LT(std::abs(correction.mass_radius[1] + kSecond), 1.0e-9 * std::abs(kSecond));
  EXPECT_LT(correction.rms, 1.0e-9 * runs.initial.norm());
}

// With one plane for two unbalances a residual remains, equal to the predicted one.
TEST(Balancing, PredictsTheResidual) {
  const Runs runs = simulatedRuns();
  const auto influence = influenceOfPlanes(runs.initial, {runs.trials[0]}, 1);
  const auto correction = balance(influence, runs.initial, Eigen::VectorXd::Ones(4));
  RotorUnderTest r = chainRotor(3, 5.0e5, 1.2);
  addUnbalance(r, 0, kFirst + correction.mass_radius[0]);
  addUnbalance(r, 2, kSecond);
  EXPECT_LT((readings(r) - correction.residual).norm(), 1.0e-9 * runs.initial.norm());
  EXPECT_GT(correction.rms, 0.0);
  EXPECT_LT(correction.residual.norm(), runs.initial.norm());
}

// A reading of great weight is met at the cost of the others.
TEST(Balancing, HonoursTheWeights) {
  const Runs runs = simulatedRuns();
  const auto influence = influenceOfPlanes(runs.initial, {runs.trials[0]}, 1);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(4);
  const auto even = balance(influence, runs.initial, weights);
  weights[2] = 1.0e6;
  const auto weighted = balance(influence, runs.initial, weights);
  EXPECT_LT(std::abs(weighted.residual[2]), 1.0e-2 * std::abs(even.residual[2]));
}

// Four readings for two planes, each run with independent errors: in 1000 jobs 93 to 97 % of the
// intervals contain the true component, with errors from the residual and from the stated error
// alike, with equal and unequal weights.
TEST(Balancing, IntervalsHoldTheTruthIn95Of100) {
  const Runs exact = simulatedRuns();
  const double error = 0.002 * exact.initial.norm();
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0.0, error);
  const auto disturbed = [&](Eigen::VectorXcd v) {
    for (Complex& one : v) {
      one += Complex(normal(random), normal(random));
    }
    return v;
  };
  Eigen::VectorXd uneven(4);
  uneven << 1.0, 0.5, 2.0, 1.0;
  for (const bool even : {true, false}) {
    const Eigen::VectorXd weights = even ? Eigen::VectorXd(Eigen::VectorXd::Ones(4)) : uneven;
    for (const double stated : {0.0, error}) {
      if (stated == 0.0 && !even) {
        continue;  // errors from the residual alone: weights act as relative error sizes
      }
      int held = 0, all = 0;
      for (int job = 0; job < 1000; ++job) {
        Runs runs{disturbed(exact.initial), exact.trials};
        for (TrialRun& run : runs.trials) {
          run.readings = disturbed(run.readings);
        }
        const auto influence = influenceOfPlanes(runs.initial, runs.trials, 2);
        const auto correction = balance(influence, runs.initial, weights);
        const auto spread = correctionSpread(influence, runs.trials, weights, correction, stated);
        ASSERT_TRUE(spread.has_value());
        for (const Eigen::Index plane : {0, 1}) {
          const Complex off = correction.mass_radius[plane] + (plane == 0 ? kFirst : kSecond);
          const double bound = spread->within95 * spread->deviation[plane];
          held += (std::fabs(off.real()) < bound ? 1 : 0) + (std::fabs(off.imag()) < bound ? 1 : 0);
          all += 2;
        }
      }
      EXPECT_GT(held, 0.93 * all) << even << ", " << stated;
      EXPECT_LT(held, 0.97 * all) << even << ", " << stated;
    }
  }
}

// One reading of two planes: infinitely many pairs of masses bring it to zero.
TEST(Balancing, OfFewerReadingsThanPlanesIsUndetermined) {
  Eigen::MatrixXcd influence(1, 2);
  influence << 1.0e-2, 1.0e-2;
  const Eigen::VectorXcd initial = Eigen::VectorXcd::Constant(1, {1.0e-6, 5.0e-7});
  const auto correction = balance(influence, initial, Eigen::VectorXd::Ones(1));
  EXPECT_TRUE(std::isinf(correction.condition));
  EXPECT_LT(correction.rms, 1.0e-18);
  // As few that have a weight.
  const Runs runs = simulatedRuns();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(4);
  weights[0] = 1.0;
  EXPECT_TRUE(std::isinf(
      balance(influenceOfPlanes(runs.initial, runs.trials, 2), runs.initial, weights).condition));
}

TEST(Balancing, WithoutSpareReadingsNothingIsKnownOfErrors) {
  const Runs runs = simulatedRuns();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(4);
  weights.head(2).setOnes();
  const auto influence = influenceOfPlanes(runs.initial, runs.trials, 2);
  const auto correction = balance(influence, runs.initial, weights);
  EXPECT_FALSE(correctionSpread(influence, runs.trials, weights, correction, 0.0));
  EXPECT_TRUE(correctionSpread(influence, runs.trials, weights, correction, 1.0e-7));
}

TEST(Balancing, RefusesWhatDoesNotFit) {
  const Runs runs = simulatedRuns();
  EXPECT_THROW(influenceOfPlanes(runs.initial, {runs.trials[0]}, 2), InputError);
  EXPECT_THROW(influenceOfPlanes(runs.initial, {{0, 0.0, runs.initial}}, 1), InputError);
  EXPECT_THROW(influenceOfPlanes(runs.initial, {{0, 1.0, runs.initial.head(2)}}, 1), InputError);
  EXPECT_THROW(balance(Eigen::MatrixXcd::Identity(4, 2), runs.initial, Eigen::VectorXd::Ones(3)),
               InputError);
}

}  // namespace balancing_test

}  // namespace whirl_twin
