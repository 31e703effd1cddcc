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

/// Of the rotor with its unbalance and these masses at the outer discs.
Eigen::VectorXcd readingsWith(const Eigen::VectorXcd& masses) {
  RotorUnderTest r = chainRotor(3, 5.0e5, 1.2);
  addUnbalance(r, 0, kFirst + masses[0]);
  addUnbalance(r, 2, kSecond + masses[1]);
  return readings(r);
}

Runs simulatedRuns() {
  Runs runs{readingsWith(Eigen::VectorXcd::Zero(2)), {}};
  for (const Eigen::Index plane : {0, 1}) {
    Eigen::VectorXcd masses = Eigen::VectorXcd::Zero(2);
    masses[plane] = std::polar(1.0e-5, 0.3 + static_cast<double>(plane));
    runs.trials.push_back({masses, readingsWith(masses)});
  }
  return runs;
}

/// The trial run of the first plane, for a job of that plane alone.
std::vector<TrialRun> firstPlaneAlone(const Runs& runs) {
  return {{runs.trials[0].masses.head(1), runs.trials[0].readings}};
}

TEST(Balancing, FindsTheUnbalanceFromThreeRuns) {
  const Runs runs = simulatedRuns();
  const auto influence = influenceOfPlanes(runs.initial, runs.trials);
  const auto correction = balance(influence.coefficients, runs.initial, Eigen::VectorXd::Ones(4));
  EXPECT_LT(std::abs(correction.mass_radius[0] + kFirst), 1.0e-9 * std::abs(kFirst));
  EXPECT_LT(std::abs(correction.mass_radius[1] + kSecond), 1.0e-9 * std::abs(kSecond));
  EXPECT_LT(correction.rms, 1.0e-9 * runs.initial.norm());
}

// With one plane for two unbalances a residual remains, equal to the predicted one.
TEST(Balancing, PredictsTheResidual) {
  const Runs runs = simulatedRuns();
  const auto influence = influenceOfPlanes(runs.initial, firstPlaneAlone(runs));
  const auto correction = balance(influence.coefficients, runs.initial, Eigen::VectorXd::Ones(4));
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
  const auto influence = influenceOfPlanes(runs.initial, firstPlaneAlone(runs));
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(4);
  const auto even = balance(influence.coefficients, runs.initial, weights);
  weights[2] = 1.0e6;
  const auto weighted = balance(influence.coefficients, runs.initial, weights);
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
        const auto influence = influenceOfPlanes(runs.initial, runs.trials);
        const auto correction = balance(influence.coefficients, runs.initial, weights);
        const auto spread = correctionSpread(influence, weights, correction, stated);
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
      balance(influenceOfPlanes(runs.initial, runs.trials).coefficients, runs.initial, weights)
          .condition));
}

TEST(Balancing, WithoutSpareReadingsNothingIsKnownOfErrors) {
  const Runs runs = simulatedRuns();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(4);
  weights.head(2).setOnes();
  const auto influence = influenceOfPlanes(runs.initial, runs.trials);
  const auto correction = balance(influence.coefficients, runs.initial, weights);
  EXPECT_FALSE(correctionSpread(influence, weights, correction, 0.0));
  EXPECT_TRUE(correctionSpread(influence, weights, correction, 1.0e-7));
}

// The first trial mass stays in during the second run; the masses of the second are those of both.
TEST(Balancing, TakesTrialMassesThatAreLeftIn) {
  Runs runs = simulatedRuns();
  runs.trials[1].masses += runs.trials[0].masses;
  runs.trials[1].readings = readingsWith(runs.trials[1].masses);
  const auto influence = influenceOfPlanes(runs.initial, runs.trials);
  const auto correction = balance(influence.coefficients, runs.initial, Eigen::VectorXd::Ones(4));
  EXPECT_LT(std::abs(correction.mass_radius[0] + kFirst), 1.0e-9 * std::abs(kFirst));
  EXPECT_LT(std::abs(correction.mass_radius[1] + kSecond), 1.0e-9 * std::abs(kSecond));
}

/// The chain of three equal discs is the same seen from either end.
Reflection endForEnd() {
  return {{1, 0, 3, 2}, {1, 0}};
}

TEST(Balancing, OfASymmetricRotorNeedsOneTrialRun) {
  const Runs runs = simulatedRuns();
  const auto both = influenceOfPlanes(runs.initial, runs.trials);
  const auto one = influenceOfPlanes(runs.initial, {runs.trials[0]}, endForEnd());
  EXPECT_LT((one.coefficients - both.coefficients).norm(), 1.0e-9 * both.coefficients.norm());
}

// Four readings for two planes, each run with independent errors: in 1000 jobs 93 to 97 % of the
// intervals contain the true component, where a trial mass is left in and where one run serves two
// planes of a symmetric rotor.
TEST(Balancing, IntervalsHoldTheTruthWithMassesLeftInAndOfSymmetricRotors) {
  Runs left_in = simulatedRuns();
  left_in.trials[1].masses += left_in.trials[0].masses;
  left_in.trials[1].readings = readingsWith(left_in.trials[1].masses);
  const Runs one{left_in.initial, {left_in.trials[0]}};
  const double error = 0.002 * left_in.initial.norm();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, error);
  const auto disturb = [&](Eigen::VectorXcd& v) {
    for (Complex& reading : v) {
      reading += Complex(normal(random), normal(random));
    }
  };
  for (const bool symmetric : {false, true}) {
    int held = 0, all = 0;
    for (int job = 0; job < 1000; ++job) {
      Runs runs = symmetric ? one : left_in;
      disturb(runs.initial);
      for (TrialRun& run : runs.trials) {
        disturb(run.readings);
      }
      const auto influence =
          influenceOfPlanes(runs.initial, runs.trials,
                            symmetric ? std::optional<Reflection>(endForEnd()) : std::nullopt);
      const Eigen::VectorXd weights = Eigen::VectorXd::Ones(4);
      const auto correction = balance(influence.coefficients, runs.initial, weights);
      const auto spread = correctionSpread(influence, weights, correction, error);
      ASSERT_TRUE(spread.has_value());
      for (const Eigen::Index plane : {0, 1}) {
        const Complex off = correction.mass_radius[plane] + (plane == 0 ? kFirst : kSecond);
        const double bound = spread->within95 * spread->deviation[plane];
        held += (std::fabs(off.real()) < bound ? 1 : 0) + (std::fabs(off.imag()) < bound ? 1 : 0);
        all += 2;
      }
    }
    EXPECT_GT(held, 0.93 * all) << symmetric;
    EXPECT_LT(held, 0.97 * all) << symmetric;
  }
}

// At the least sum of squares within limits the gradient of a limited plane points against its mass
// (Kuhn and Tucker), that of any other plane is zero.
TEST(Balancing, WithinLimitsLeavesTheLeastVibration) {
  const Runs runs = simulatedRuns();
  const Eigen::MatrixXcd a = influenceOfPlanes(runs.initial, runs.trials).coefficients;
  Eigen::VectorXd weights(4);
  weights << 1.0, 0.5, 2.0, 1.0;
  Eigen::VectorXd limits(2);
  limits << 1.0e-5, 1.0;
  const auto free = balance(a, runs.initial, weights);
  const auto limited = balanceWithin(a, runs.initial, weights, limits);
  EXPECT_NEAR(std::abs(limited.mass_radius[0]), 1.0e-5, 1.0e-16);
  EXPECT_GT(std::abs(limited.mass_radius[1] - free.mass_radius[1]), 1.0e-7);
  const Eigen::VectorXcd gradient =
      a.adjoint() * weights.cast<Complex>().cwiseProduct(limited.residual);
  const Complex pull = -gradient[0] / limited.mass_radius[0];
  EXPECT_GT(pull.real(), 0.0);
  EXPECT_LT(std::fabs(pull.imag()), 1.0e-6 * pull.real());
  EXPECT_LT(std::abs(gradient[1]), 1.0e-6 * std::abs(gradient[0]));
  EXPECT_GT(limited.rms, free.rms);
  const auto unlimited = balanceWithin(a, runs.initial, weights, Eigen::VectorXd::Ones(2));
  EXPECT_EQ(unlimited.mass_radius, free.mass_radius);
}

TEST(Balancing, SplitsAMassOverTwoPlaces) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> angle(-4.0, 10.0);
  for (int i = 0; i < 1000; ++i) {
    const Complex mass = std::polar(2.0e-5, angle(random));
    const double first = angle(random);
    std::vector<double> places;
    for (int k = 0; k < 3 + i % 20; ++k) {
      places.push_back(first + 2.0 * M_PI * k / (3 + i % 20));
    }
    Complex sum = 0.0;
    const auto parts = partsAtPlaces(mass, places);
    ASSERT_LE(parts.size(), 2U);
    for (const PartOfMass& part : parts) {
      EXPECT_GE(part.mass_radius, 0.0);
      sum += std::polar(part.mass_radius, part.angle);
    }
    EXPECT_LT(std::abs(sum - mass), 1.0e-4 * std::abs(mass));
  }
  EXPECT_EQ(partsAtPlaces(std::polar(1.0, M_PI), {0.0, 1.0, M_PI, 5.0}).size(), 1U);
  EXPECT_THROW(partsAtPlaces(1.0, {0.0, 1.0, 2.0}), InputError);
  EXPECT_THROW(partsAtPlaces(1.0, {0.0, M_PI}), InputError);
}

TEST(Balancing, RefusesWhatDoesNotFit) {
  const Runs runs = simulatedRuns();
  EXPECT_THROW(influenceOfPlanes(runs.initial, {}), InputError);
  EXPECT_THROW(influenceOfPlanes(runs.initial, {runs.trials[0]}), InputError);
  EXPECT_THROW(influenceOfPlanes(runs.initial, {runs.trials[0], runs.trials[0]}), InputError);
  EXPECT_THROW(
      influenceOfPlanes(runs.initial, {{Eigen::VectorXcd::Zero(1), runs.trials[0].readings}}),
      InputError);
  EXPECT_THROW(influenceOfPlanes(runs.initial, {{Eigen::VectorXcd::Ones(1), runs.initial.head(2)}}),
               InputError);
  EXPECT_THROW(balance(Eigen::MatrixXcd::Identity(4, 2), runs.initial, Eigen::VectorXd::Ones(3)),
               InputError);
}

}  // namespace balancing_test

}  // namespace whirl_twin
