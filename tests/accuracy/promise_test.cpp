// Error bounds in difficult cases: coarse steps, narrow dry friction, chaos, speeds that no step
// resolves, and run-ups of linear rotors. Each is checked with a method that the twin does not
// have; where no bound can be known, none is given.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../scene/scenes.h"
#include "accuracy/error_bound.h"
#include "accuracy/step_choice.h"
#include "independent_motion.h"
#include "scene/built_scene.h"

namespace whirl_twin {
namespace promise_test {

/// The error of a choice over the horizon, at the scene's own samples.
double trueError(const Scene& one, const StepChoice& choice) {
  const double steps = one.systems.front().horizon / one.stepSeconds();
  const auto samples = 1 + static_cast<std::size_t>(std::llround(std::ceil(steps)));
  const IndependentMotion truth = independentMotion(one, one.step, samples, 1.0e6);
  EXPECT_LT(truth.own.position(samples - 1), 1.0e-9) << "the judge must be better";
  const Trajectory chosen =
      motion(withSetting(one, {choice.integrator, one.step, choice.substeps}), one.step, samples);
  return ErrorCurve(chosen, truth.trajectory).position(samples - 1);
}

void expectKept(const Scene& one) {
  const StepChoice choice = chooseStep(one);
  EXPECT_TRUE(choice.promise.kept) << choice.reason;
  EXPECT_EQ(choice.promise.known_until, one.systems.front().horizon);
  const double error = trueError(one, choice);
  EXPECT_LE(error, one.systems.front().tolerance) << choice.reason;
  EXPECT_GE(5.0 * choice.promise.error + 1.0e-12, error) << choice.reason;
}

Scene pendulum(const std::string& step, const std::string& more) {
  return sceneOf("{step: " + step +
                 ", systems: {p: {model: double_pendulum, parameters: {mass1: 1, mass2: 1, "
                 "length1: 1, length2: 1}, initial: {theta1: 1.0}" +
                 more + "}}}");
}

TEST(ErrorBound, IsKeptAtStepsFarTooCoarseForAnyMethodByItself) {
  for (const char* step : {"0.1", "0.5", "1.0", "10.0"}) {
    SCOPED_TRACE(step);
    expectKept(pendulum(step, ""));
    expectKept(pendulum(step, ", tolerance: 1.0e-3"));
  }
}

TEST(ErrorBound, IsKeptInRunUpsOfLinearRotorsAtCoarseSteps) {
  for (const char* step : {"0.005", "0.02"}) {
    for (const char* more : {"", ", internal_damping: 6, stiffness_y: 2.2e4"}) {
      for (const char* tolerance : {"1.0e-6", "1.0e-9"}) {
        SCOPED_TRACE(std::string(step) + more + ", " + tolerance);
        expectKept(sceneOf(std::string("{step: ") + step +
                           ", drives: {shaft: {speed: 0, profile: [{speed: 250, "
                           "max_acceleration: 100, dwell: 10}]}}, systems: {r: {model: "
                           "jeffcott_rotor, drive: shaft, horizon: 3, tolerance: " +
                           tolerance +
                           ", parameters: {mass: 2, stiffness: 2.0e4, damping: 10, eccentricity: "
                           "1.0e-4" +
                           more + "}}}}"));
      }
    }
  }
}

TEST(ErrorBound, OfNarrowDryFrictionEndsWhereItIsNotKnown) {
  for (const char* width : {"3.0e-6", "1.0e-6", "1.0e-8"}) {
    SCOPED_TRACE(width);
    const StepChoice choice = chooseStep(sceneOf(
        std::string("{step: 0.001, systems: {p: {model: friction_oscillator, tolerance: 1.0e-6, "
                    "parameters: {mass: 1, friction_coefficient: 0.3, half_spacing: 0.0762, "
                    "height: 0.0127, roller_speed: 0.2, regularization: ") +
        width + "}, initial: {x: 0.05}}}}"));
    const ErrorBound& p = choice.promise;
    EXPECT_TRUE(!p.kept) << choice.reason << ": no step there is resolves it";
    EXPECT_GT(p.kept_until, 0.09) << "it slides until then";
    EXPECT_LT(p.kept_until, 0.3) << "and sticks";
    EXPECT_NE(choice.integrator, "velocity_verlet") << "friction is nothing but rates";
  }
}

// The plank is as fast as the roller 19 us before 0.059 s, and neither of the two methods that are
// the reference has a node so late in its step.
TEST(ErrorBound, IsNotMadeAcrossACornerThatOnlyTheNextStepSees) {
  const BuiltScene built = build(sceneOf(
      "{step: 0.001, systems: {p: {model: friction_oscillator, tolerance: 1.0e-8, horizon: 0.059, "
      "parameters: {mass: 1, friction_coefficient: 0.47376499481537815, half_spacing: 0.0762, "
      "height: 0.0127, roller_speed: 0.2, regularization: 6.0405771733914061e-8}, initial: {x: "
      "0.053245293475055397}}}}"));
  const Scene& one = built.scene;
  const ModelSetup& setup = built.systems.front()->setup();
  EvaluationBudget budget(1.0e6, one, setup);
  const std::size_t samples = 60;
  const ReferenceTrajectory reference = referenceOf(one, setup, one.step, samples, 1.0e-9, budget);
  const std::size_t last = reference.lastWithin(1.0e-9);
  EXPECT_GE(last, 57U) << "it slides until then";
  const IndependentMotion truth = independentMotion(one, one.step, samples, 1.0e6);
  EXPECT_LT(truth.own.position(last), 1.0e-12) << "the judge must be better";
  EXPECT_LE(ErrorCurve(reference.trajectory, truth.trajectory).position(last), 1.0e-9);
}

// Here it sticks 31 us after 0.086 s; in a reference step across this instant the even and the odd
// nodes follow two different smooth curves.
TEST(ErrorBound, IsKeptWhereAPlankSticksEarlyInAStep) {
  const Scene one = sceneOf(
      "{step: 0.001, systems: {p: {model: friction_oscillator, tolerance: 1.0e-6, horizon: 0.088, "
      "parameters: {mass: 1, friction_coefficient: 0.46405828272795668, half_spacing: 0.0762, "
      "height: 0.0127, roller_speed: 0.2, regularization: 3.1921213156597557e-7}, initial: {x: "
      "0.038951550173368266}}}}");
  const StepChoice choice = chooseStep(one);
  EXPECT_GT(choice.promise.kept_until, 0.0865) << choice.reason;
  const IndependentMotion truth = independentMotion(one, one.step, 88, 1.0e6);
  const ErrorCurve error(
      motion(withSetting(one, {choice.integrator, one.step, choice.substeps}), one.step, 88),
      truth.trajectory);
  EXPECT_LE(error.position(87), 1.0e-6) << choice.reason;
}

// Two references that round their forces to doubles may diverge from the motion alike, and would
// report a violated bound: for point masses they use 64-bit significands in every form of the
// scene.
TEST(ErrorBound, OfChaosIsKeptAsLongAsItSays) {
  Scene one = sceneOf(
      "{step: 0.567410386, systems: {p: {model: double_pendulum, tolerance: 1.0e-6, horizon: 60, "
      "parameters: {mass1: 1, mass2: 0.52718821580643216, length1: 1, length2: 2.7049801047934161, "
      "center1: 1, center2: 2.7049801047934161, gear_ratio1: 1, gear_ratio2: 1, coulomb_rate: "
      "0.01}, initial: {theta1: 0.99585360434487402, theta2: -2.1518722002766495}}}}");
  const StepChoice choice = chooseStep(one);
  EXPECT_GT(choice.promise.kept_until, 45.0) << choice.reason;
  const auto kept =
      static_cast<std::size_t>(std::floor(choice.promise.kept_until / one.stepSeconds() + 1.0e-9));
  const IndependentMotion truth = independentMotion(one, one.step, kept + 1, 1.0e6);
  EXPECT_LT(truth.own.position(kept), 1.0e-7) << "the judge must be better";
  const Trajectory chosen =
      motion(withSetting(one, {choice.integrator, one.step, choice.substeps}), one.step, kept + 1);
  EXPECT_LE(ErrorCurve(chosen, truth.trajectory).position(kept), 1.0e-6) << choice.reason;
}

/// Three samples alike.
Trajectory even() {
  Trajectory t;
  t.interval = 1.0;
  t.dof = 1;
  t.angular = {true};
  t.coordinates = t.rates = {1.0, 1.0, 1.0};
  return t;
}

// A disturbance that has grown beyond measure gives no information on the effect of rounding after
// that.
TEST(ErrorBound, IsNotMadeBeyondWhereADisturbedMotionParted) {
  const Trajectory right = even();
  Trajectory parted = right;
  parted.keep(2);
  ReferenceTrajectory reference;
  reference.difference = ErrorCurve(right, right);
  EXPECT_EQ(reference.error(2), 0.0) << "a motion that magnifies nothing";
  reference.disturbed = ErrorCurve(parted, right);
  EXPECT_EQ(reference.error(1), 0.0);
  EXPECT_TRUE(std::isinf(reference.error(2)));
  EXPECT_TRUE(std::isinf(reference.rateError(2)));
}

// A limit on the growth of a disturbance, such as an actuator's slew rate, does not limit rounding
// errors in proportion.
TEST(ErrorBound, HasNoPartOfADisturbanceWhereRoundingBecomesAsLarge) {
  const Trajectory right = even();
  const auto off = [&](double first, double then) {
    Trajectory t = right;
    t.coordinates[1] = t.rates[1] = 1.0 + first;
    t.coordinates[2] = t.rates[2] = 1.0 + then;
    return ErrorCurve(t, right);
  };
  ReferenceTrajectory reference;
  reference.difference = ErrorCurve(right, right);
  reference.disturbed = off(1.0e-8, 4.0e-5);
  EXPECT_NEAR(reference.error(2), 0.02 * 4.0e-5, 1.0e-9) << "in proportion";
  reference.disturbed_by_rounding = off(2.0e-10, 3.0e-5);
  EXPECT_NEAR(reference.error(1), 2.0e-10, 1.0e-12) << "in proportion still";
  EXPECT_GE(reference.error(2), 4.0e-5);
  EXPECT_GE(reference.rateError(2), 4.0e-5);
}

// Their errors grow by e 2.4 times a second, whatever the tolerance.
TEST(ErrorBound, OfChaosDoesNotDependOnTheHorizon) {
  const auto promised = [](const std::string& tolerance, const std::string& horizon) {
    Scene one = pendulum("0.001", ", tolerance: " + tolerance + ", horizon: " + horizon);
    one.systems.front().q = {2.0, 2.5};
    const ErrorBound p = chooseStep(one).promise;
    EXPECT_FALSE(p.kept) << tolerance << ", " << horizon;
    EXPECT_LT(p.known_until, 25.0) << tolerance << ", " << horizon;
    return p.kept_until;
  };
  const double short_sighted = promised("1.0e-6", "20");
  EXPECT_NEAR(promised("1.0e-6", "100"), short_sighted, 0.02 * short_sighted);
  EXPECT_GT(promised("1.0e-2", "60"), short_sighted);
}

TEST(ErrorBound, IsNotMadeOfMotionsThatNoStepResolves) {
  const StepChoice fast = chooseStep(
      sceneOf("{step: 0.001, systems: {p: {model: spinning_pendulum, parameters: {mass: 1, length: "
              "0.2, speed: 1.0e5}, initial: {theta: 0.5}}}}"));
  EXPECT_FALSE(fast.promise.kept) << fast.reason;
  EXPECT_LT(fast.promise.kept_until, 0.1) << fast.reason;
  const StepChoice lopsided = chooseStep(
      sceneOf("{step: 0.001, systems: {p: {model: double_pendulum, parameters: {mass1: 1, mass2: "
              "1.0e9, length1: 1, length2: 1.0e-3}, initial: {theta1: 1.0, theta2: 0.3}}}}"));
  EXPECT_FALSE(lopsided.promise.kept) << lopsided.reason;
  EXPECT_LT(lopsided.promise.kept_until, 1.0) << lopsided.reason;
}

TEST(ErrorBound, OfAMethodThatTheSceneNamesIsItsOwnError) {
  const Scene rough = pendulum("0.01", ", integrator: velocity_verlet, horizon: 3");
  const StepChoice named = judgeStep(rough);
  EXPECT_EQ(named.integrator, "velocity_verlet");
  EXPECT_FALSE(named.promise.kept);
  const double error = trueError(rough, named);
  EXPECT_NEAR(named.promise.error, error, 0.01 * error);
  EXPECT_LT(named.promise.kept_until, 0.5);
  EXPECT_EQ(named.promise.known_until, 3.0);
  EXPECT_GT(named.promise.rate_error, 0.1 * error);
}

TEST(ErrorBound, OfExactStepsHoldsOverAMonth) {
  const StepChoice month = chooseStep(
      sceneOf("{step: 0.001, systems: {r: {model: jeffcott_rotor, horizon: 2.6e6, parameters: "
              "{mass: 1, stiffness: 1.0e4, damping: 10, speed: 50, eccentricity: 1.0e-4}}}}"));
  EXPECT_TRUE(month.promise.kept) << month.reason;
  EXPECT_LT(month.promise.error, 1e-6);
}

}  // namespace promise_test
}  // namespace whirl_twin
