#include "analysis/sampled_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/sampled_stability.h"
#include "loops_under_test.h"
#include "messages/input_error.h"
#include "simulated_loop.h"

namespace whirl_twin {
namespace sampled_loop_test {

using Eigen::MatrixXd;

double radius(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  return sampledStability(sampledLoop(plant, controllers)).spectral_radius;
}

TEST(SampledLoop, ADelayIsAsManyStatesAsItsSamples) {
  const LoopPlant plant = unstableMass();
  for (const auto& [late, states] :
       {std::pair{0.0, 3}, {0.4, 4}, {1.0, 4}, {1.5, 5}, {2.0, 5}, {2.001, 6}}) {
    const SampledLoop loop = sampledLoop(plant, {levitation(2.0, 1.0, 0.1, late)});
    EXPECT_EQ(loop.transition.rows(), states) << late;
    EXPECT_EQ(loop.samples, std::vector<int>{1});
    EXPECT_NEAR(loop.period, 0.1, 1e-16);
  }
}

struct Levitation {
  double kp, kd;
  double largest_period[3], radius[3];  // 0, 1 and 2 samples late; at a period of 0.1
};

TEST(SampledLoop, LevitatesAsLongAsItIsKnownTo) {
  const double root = std::sqrt(2.0);
  const Levitation known[] = {
      {2.0, root, {0.693014776, 0.310526720, 0.201302337}, {0.926077894, 0.926013966, 0.931151178}},
      {1.5, 1.0, {0.856490960, 0.359661218, 0.226701684}, {0.949893757, 0.953405746, 0.959262159}}};
  const LoopPlant plant = unstableMass();
  for (const Levitation& k : known) {
    for (int late = 0; late < 3; ++late) {
      EXPECT_NEAR(radius(plant, {levitation(k.kp, k.kd, 0.1, late)}), k.radius[late], 6e-10);
      // To the last of its digits, which is a nanosecond.
      const double longest = k.largest_period[late];
      const auto verdict = [&](double period) {
        return sampledStability(sampledLoop(plant, {levitation(k.kp, k.kd, period, late)})).verdict;
      };
      EXPECT_EQ(verdict(longest - 1e-9), Verdict::kAsymptoticallyStable) << late;
      EXPECT_EQ(verdict(longest + 1e-9), Verdict::kUnstable) << late;
    }
  }
}

TEST(SampledLoop, TheAcrobotFallsWhenItsRegulatorIsFiveSamplesLate) {
  MatrixXd gain(1, 4);
  gain << -170.165268754, -73.476956765, -34.977341113, -16.733364712;
  const auto late = [&](int samples) {
    return radius(seenAcrobot(), {stateFeedback(gain, 500.0, 0.002 * samples)});
  };
  EXPECT_NEAR(late(0), 0.997291, 6e-7);
  EXPECT_NEAR(late(3), 0.997317, 6e-7);
  EXPECT_NEAR(late(5), 1.020753, 6e-7);
}

TEST(SampledLoop, ADelayOfASensorIsOneOfTheOutput) {
  const LoopPlant plant = unstableMass();
  LoopController sensor = levitation(2.0, 1.0, 0.1, 0.0);
  sensor.sensor_delay = 0.13;
  EXPECT_NEAR(radius(plant, {sensor}), radius(plant, {levitation(2.0, 1.0, 0.1, 1.3)}), 1e-14);
}

TEST(SampledLoop, APoleOfASensorOrAnActuatorIsAStateOfThePlant) {
  LoopController sensed = levitation(2.0, 1.0, 0.1, 0.3);
  const LoopController bare = sensed;
  sensed.sensor_bandwidth = sensed.actuator_bandwidth = 3.0;
  const double pole = 3.0 * 2.0 * M_PI;
  LoopPlant with{MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 1), MatrixXd::Zero(1, 4)};
  with.a << 0, 1, 0, 0, 1, 0, 0, 1, pole, 0, -pole, 0, 0, 0, 0, -pole;
  with.b << 0, 0, 0, pole;
  with.c << 0, 0, 1, 0;
  const SampledLoop loop = sampledLoop(unstableMass(), {sensed});
  const SampledLoop same = sampledLoop(with, {bare});
  EXPECT_EQ(loop.transition.rows(), same.transition.rows());
  EXPECT_LT((loop.transition - same.transition).norm(), 1e-15);
}

TEST(SampledLoop, TwoHalvesOfAControllerAreTheWhole) {
  // Each gives half of the output; their states are one motion twice, the difference of which is 0.
  const LoopPlant plant = unstableMass();
  LoopController half = levitation(2.0, 1.0, 0.1, 0.7);
  const double whole = radius(plant, {half});
  half.law.c *= 0.5;
  half.law.d *= 0.5;
  EXPECT_NEAR(radius(plant, {half, half}), whole, 1e-14);
}

TEST(SampledLoop, AControllerByItselfIsItsOwnLaw) {
  LoopPlant nothing{MatrixXd(0, 0), MatrixXd(0, 1), MatrixXd(1, 0)};
  const LoopController alone = levitation(2.0, 1.0, 0.1, 0.0);
  const SampledLoop loop = sampledLoop(nothing, {alone});
  EXPECT_EQ(loop.transition, alone.law.a);
  LoopController constant = alone;
  constant.law = {MatrixXd(0, 0), MatrixXd(0, 1), MatrixXd(1, 0), MatrixXd::Ones(1, 1)};
  EXPECT_EQ(sampledLoop(nothing, {constant}).transition.rows(), 0);
  EXPECT_EQ(sampledStability(sampledLoop(nothing, {constant})).verdict,
            Verdict::kAsymptoticallyStable);
}

/// A weakly damped oscillation under two controllers that drive it on: its amplitude after 1e5
/// samples is the initial one. Rounding of a transition matrix, 1e-16, shifts the phase by as much
/// in each of its powers.
TEST(SampledLoop, ItsPowersAreTheMotionSampleBySample) {
  LoopPlant plant{MatrixXd::Zero(3, 3), MatrixXd::Zero(3, 2), MatrixXd::Zero(2, 3)};
  plant.a << 0, 1, 0, -400.0, -2e-6, 3.0, 0, 0, -5.0;
  plant.b << 0, 0, 1, 0, 0, 2;
  plant.c << 1, 0, 0, 0, 1, 0;
  struct Rates {
    double first, second, late_first, late_second;
    int samples_first, samples_second;
  };
  for (const Rates& r : {Rates{700.0, 300.0, 0.0, 0.0, 7, 3},
                         {700.0, 300.0, 4.1e-4, 5.7e-3, 7, 3},
                         {1000.0, 1000.0, 1.5e-3, 1e-3, 1, 1},
                         {20e3, 1000.0, 8e-5, 0.0, 20, 1},
                         {300.0, 700.0, 1.0 / 300.0, 1e-7, 3, 7}}) {
    LoopController first = levitation(1e-3, 0.0, 1.0 / r.first, r.late_first * r.first);
    first.acts_on = {0};
    LoopController second = levitation(2e-3, 1e-6, 1.0 / r.second, r.late_second * r.second);
    second.measures = {1};
    second.acts_on = {1};
    const SampledLoop loop = sampledLoop(plant, {first, second});
    EXPECT_EQ(loop.samples, (std::vector<int>{r.samples_first, r.samples_second}));
    EXPECT_TRUE(loop.whole_nanoseconds);
    SimulatedLoop::Matrix start(3, 1);
    start << 1.0, 0.0, 0.0;
    SimulatedLoop simulated(plant, {first, second}, start);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(loop.transition.rows());
    state[0] = 1.0;
    const auto period = std::llround(1e9 * loop.period);
    const int periods = 100000 / std::max(r.samples_first, r.samples_second);
    double worst = 0.0;
    for (int i = 1; i <= periods; ++i) {
      state = (loop.transition * state).eval();
      simulated.runTo(i * period);
      const Eigen::VectorXd exact = simulated.plantState().cast<double>();
      const Eigen::Array3d size(1.0, 20.0, 1.0);  // of a swing of 20 rad/s
      worst = std::fmax(worst, ((state.head(3) - exact).array() / size).matrix().norm() /
                                   (exact.array() / size).matrix().norm());
    }
    EXPECT_GT(state.head(3).norm(), 1e-3);
    EXPECT_LT(worst, 1e-11) << r.first << " " << r.late_first;
  }
}

TEST(SampledLoop, ItsPowersAreTheMotionThatDiesOut) {
  const LoopPlant plant = unstableMass();
  LoopController slow = levitation(1.0, 0.5, 1.0 / 30.0, 0.4);
  const LoopController fast = levitation(1.0, 1.0, 1.0 / 70.0, 1.7);
  const SampledLoop loop = sampledLoop(plant, {fast, slow});
  EXPECT_EQ(loop.samples, (std::vector<int>{7, 3}));
  SimulatedLoop simulated(plant, {fast, slow}, SimulatedLoop::Matrix::Ones(2, 1));
  Eigen::VectorXd state = Eigen::VectorXd::Zero(loop.transition.rows());
  state.head(2).setOnes();
  for (int i = 1; i <= 100000 / 7; ++i) {
    state = (loop.transition * state).eval();
    simulated.runTo(i * std::llround(1e9 * loop.period));
    ASSERT_LT((state.head(2) - simulated.plantState().cast<double>()).norm(), 1e-14) << i;
  }
  EXPECT_LT(state.norm(), 1e-100);
}

TEST(SampledLoop, TakesInstantsAsTheyAreRoundedWhereThatRepeats) {
  const LoopPlant plant = unstableMass();
  EXPECT_TRUE(sampledLoop(plant, {levitation(2, 1, 1e-3, 0)}).whole_nanoseconds);
  EXPECT_FALSE(sampledLoop(plant, {levitation(2, 1, 1.0 / 3.0, 0)}).whole_nanoseconds);
  // 7 and 3 samples in 10 ms.
  EXPECT_TRUE(sampledLoop(plant, {levitation(1, 1, 1 / 700.0, 0), levitation(1, 1, 1 / 300.0, 0)})
                  .whole_nanoseconds);
}

TEST(SampledLoop, SaysWhereRatesHaveNothingInCommon) {
  const LoopPlant plant = unstableMass();
  try {
    sampledLoop(plant, {levitation(1, 1, 1e-3, 0), levitation(1, 1, M_SQRT2 * 1e-3, 0)});
    FAIL() << "judged";
  } catch (const RunFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("must have a common period of at most 1000 samples"),
              std::string::npos);
  }
  EXPECT_THROW(sampledLoop(plant, {levitation(1, 1, 1.0, 0), levitation(1, 1, 1.0 / 1001.0, 0)}),
               RunFailure);
  EXPECT_NO_THROW(sampledLoop(plant, {levitation(1, 1, 1.0, 0), levitation(1, 1, 1.0 / 999, 0)}));
}

TEST(SampledLoop, RefusesWhatCannotBeMeant) {
  const LoopPlant plant = unstableMass();
  EXPECT_THROW(sampledLoop(plant, {}), InputError);
  LoopController c = levitation(1, 1, 0.1, 0);
  c.rate = 0.0;
  EXPECT_THROW(sampledLoop(plant, {c}), InputError);
  c.rate = NAN;
  EXPECT_THROW(sampledLoop(plant, {c}), InputError);
  EXPECT_THROW(sampledLoop(plant, {levitation(1, 1, 0.1, -0.1)}), InputError);
  EXPECT_THROW(sampledLoop(plant, {levitation(1, 1, 0.1, 4001.0)}), RunFailure);
  c = levitation(1, 1, 0.1, 0);
  c.acts_on = {1};
  EXPECT_THROW(sampledLoop(plant, {c}), std::logic_error);
}

}  // namespace sampled_loop_test
}  // namespace whirl_twin
