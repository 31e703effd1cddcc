// The controllers of a scene: all their errors are reported at once, and the sub-steps between
// their instants.
#include "scene/controller_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scene/control_parts.h"
#include "scene/part_of_scene.h"
#include "scene/scene_error.h"
#include "scenes.h"

namespace whirl_twin {
namespace controller_reader_test {

std::string withControllers(const std::string& controllers, const std::string& of_system = "") {
  return "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: "
         "[[1.0]], "
         "stiffness: [[-1.0]]}" +
         of_system +
         "}, r: {model: jeffcott_rotor, parameters: {mass: 1.0, stiffness: 100.0, speed: "
         "5.0}}}, controllers: " +
         controllers + "}";
}

std::vector<std::string> diagnosticsOf(const std::string& yaml) {
  try {
    static_cast<void>(sceneOf(yaml));
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

TEST(ControllerReader, TakesWhatAControllerIs) {
  const Scene scene = sceneOf(withControllers(
      "{pd: {type: pid, rate: 20.0, measures: [s.x, {signal: r, direction: 0.5}], acts_on: "
      "[s.force_x, r.force_y], delay: 0.03, sensor: {noise: 1.0e-6}, actuator: {limit: 5.0}, "
      "parameters: {kp: 2.0, kd: 1.0}}}"));
  ASSERT_EQ(scene.controllers.size(), 1u);
  const ControllerSpec& pd = scene.controllers[0];
  EXPECT_EQ(pd.delay, 30'000'000);
  EXPECT_EQ(pd.measures[1].system, 1u);
  EXPECT_EQ(pd.measures[1].direction, 0.5);
  EXPECT_EQ(pd.acts_on[1].system, 1u);
  EXPECT_EQ(scene.systems[1].inputs.at("force_y").kind, InputSignal::Kind::kControlled);
  EXPECT_EQ(pd.parameters.at("kp"), 2.0);
  EXPECT_TRUE(isTiedToOthers(scene, 0));
}

TEST(ControllerReader, SaysAllThatIsWrongAtOnce) {
  EXPECT_THAT(
      diagnosticsOf(withControllers(
          "{pd: {type: pidd, rate: 0.0, measures: [s.xx, {signal: s.x, direction: 1.0}], acts_on: "
          "[s.force_x, s.force_y], delay: -1, actuator: {limits: 3}, parameters: {kp: 2.0}}, 2x: "
          "{rate: 1.0e5, measures: s.x, acts_on: []}, q: {type: pid, rate: 20.0, measures: [s.x], "
          "acts_on: [r.force_x], parameters: {kpp: 1.0}}, w: {type: pid, rate: 20.0, measures: "
          "[s.x], acts_on: [r.force_x], parameters: {kp: 1.0}}, late: {type: pid, rate: 1.0e6, "
          "measures: [s.x], acts_on: [r.force_y], delay: 1.0, parameters: {kp: 1.0}}}",
          ", inputs: {force_x: 1.0}")),
      testing::ElementsAre(
          testing::HasSubstr("controllers.2x: the name of a controller must have at most"),
          testing::HasSubstr("controllers.pd.type: must be the name of a controller type, found "
                             "'pidd'; did you mean 'pid'?"),
          testing::HasSubstr("controllers.pd.rate: must be from 0.001 to 1e+07 Hz, found 0.0"),
          testing::HasSubstr("controllers.pd.delay: must be from 0 to 1000 s, found -1"),
          testing::HasSubstr("controllers.pd.measures[0]: must be SYSTEM.COORDINATE, "
                             "SYSTEM.COORDINATE_rate, SYSTEM or SYSTEM.STATION (a displacement, "
                             "also with .x or .y), found 's.xx'; did you mean 's.x'?"),
          testing::HasSubstr("controllers.pd.measures[1].direction: needs a rotor"),
          testing::HasSubstr(
              "controllers.pd.acts_on[0]: 's.force_x' is already given by the system's inputs"),
          testing::HasSubstr("controllers.pd.acts_on[1]: must be an input of a system, found "
                             "'s.force_y'; did you mean 's.force_x'?"),
          testing::HasSubstr("controllers.pd.actuator.limits: unknown key of actuator"),
          testing::HasSubstr("controllers.2x.type: missing; must be one of"),
          testing::HasSubstr("controllers.2x.measures: must be a list of 1 to 64 signals"),
          testing::HasSubstr("controllers.2x.acts_on: must be a list of 1 to 64 inputs, found 0"),
          testing::HasSubstr("controllers.q.parameters.kpp: unknown parameter of pid"),
          testing::HasSubstr(
              "controllers.w.acts_on[0]: 'r.force_x' is already acted on by a controller"),
          testing::HasSubstr("controllers.late.delay: must be at most 10000 samples")));
}

TEST(ControllerReader, NoneIsNamedAsASystem) {
  const std::string law =
      ": {type: pid, rate: 20.0, measures: [s.x], acts_on: [s.force_x], parameters: {kp: 1.0}}";
  EXPECT_THAT(
      diagnosticsOf(withControllers("{S" + law + "}")),
      testing::ElementsAre(testing::HasSubstr("controllers.S: duplicate: a system or a station has "
                                              "this name, and parameters are published by name")));
  EXPECT_THAT(diagnosticsOf(withControllers("{drives" + law + "}")),
              testing::ElementsAre(testing::HasSubstr(
                  "controllers.drives: the name of a controller must not be this")));
}

TEST(ControllerReader, MembersOfAnEnsembleHaveNone) {
  EXPECT_THAT(
      diagnosticsOf(
          "{step: 0.001, systems: {r: {model: jeffcott_rotor, count: 10, spread: "
          "{mass: {standard_deviation: 0.1}}, parameters: {mass: 1.0, stiffness: 100.0, speed: "
          "5.0}}}, controllers: {pd: {type: pid, rate: 100.0, measures: [r.x], "
          "acts_on: [r.force_x], parameters: {kp: 1.0}}}}"),
      testing::ElementsAre(testing::HasSubstr("systems.r has a spread")));
}

std::string speedController(const std::string& parameters) {
  return "{step: 0.001, drives: {shaft: {speed: 5.0, motor: {torque: 0.0}}}, systems: {r: {model: "
         "jeffcott_rotor, drive: shaft, parameters: {mass: 1.0, stiffness: 100.0, damping: 0.4, "
         "eccentricity: 0.001, polar_inertia: 0.01}}}, controllers: {s: {type: speed, rate: 100.0, "
         "measures: [r.spin_rate], acts_on: [r.torque], parameters: {speed: 20.0, "
         "max_acceleration: 1.0, max_jerk: 1.0, inertia: 0.01, motor: [{speed: 0.0, torque: 1.0}]" +
         parameters + "}}}}";
}

TEST(ControllerReader, FindsTheCriticalSpeedsThatAShaftIsBroughtPast) {
  const auto bandsOf = [](const std::string& parameters) {
    return sceneOf(speedController(parameters)).controllers[0].critical_bands;
  };
  EXPECT_TRUE(bandsOf("").empty());
  const std::vector<SpeedBand> bands = bandsOf(", critical_speeds: true, margin: 0.2");
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_NEAR(bands[0].from, 8.0, 0.01);
  EXPECT_NEAR(bands[0].to, 12.0, 0.01);
  EXPECT_EQ(bandsOf(", critical_speeds: true").size(), 1u) << "as API 617 asks";
  EXPECT_THAT(diagnosticsOf(speedController(", critical_speeds: true, margin: 1.0")),
              testing::ElementsAre(testing::HasSubstr(
                  "controllers.s.parameters.margin: must be 0, or from 0.001 to 0.9")));
  EXPECT_THAT(diagnosticsOf(speedController(", margin: 0.1")),
              testing::ElementsAre(testing::HasSubstr("needs critical_speeds: true")));
  EXPECT_THAT(diagnosticsOf(speedController(", retry_acceleration: 0.5")),
              testing::ElementsAre(testing::HasSubstr(
                  "controllers.s.parameters.retry_acceleration: must be at least")));
}

std::vector<std::int64_t> lengthsOf(const std::string& rate_and_delay) {
  return partLengths(sceneOf(withControllers("{pd: {type: pid, " + rate_and_delay +
                                             ", measures: [s.x], acts_on: [s.force_x], parameters: "
                                             "{kp: 1.0}}}")));
}

TEST(ControlParts, AreFewWhereTheInstantsComeAgain) {
  using testing::ElementsAre;
  EXPECT_THAT(lengthsOf("rate: 1000.0"), ElementsAre());
  EXPECT_THAT(lengthsOf("rate: 20.0, delay: 0.03"), ElementsAre());
  EXPECT_THAT(lengthsOf("rate: 20000.0"), ElementsAre(50'000));
  EXPECT_THAT(lengthsOf("rate: 20000.0, delay: 8.0e-5"), ElementsAre(30'000, 20'000));
  EXPECT_THAT(lengthsOf("rate: 1250.0"), ElementsAre(800'000, 600'000, 400'000, 200'000));
}

TEST(ControlParts, AreSumsOfPowersOfTwoWhereTheyNeverDo) {
  const std::vector<std::int64_t> lengths = lengthsOf("rate: 1300.0, delay: 3.0e-4");
  EXPECT_EQ(lengths.back(), 1);
  for (std::int64_t power = 1; power < 1'000'000; power *= 2) {
    EXPECT_THAT(lengths, testing::Contains(power));
  }
}

ControlInstants instantsOf(const std::string& delay) {
  const Scene scene =
      sceneOf(withControllers("{pd: {type: pid, rate: 1000.0, delay: " + delay +
                              ", measures: [s.x], acts_on: [s.force_x], parameters: {kp: 1.0}}}"));
  return ControlInstants(scene.controllers[0], scene.time);
}

std::vector<std::int64_t> delaysOf(const std::string& delay, std::int64_t from = 0) {
  ControlInstants instants = instantsOf(delay);
  instants.start(from * 1'000'000);
  std::vector<std::int64_t> delays;
  for (; instants.output() < from + 10'000; instants.passOutput()) {
    if (instants.output() >= from) {
      delays.push_back(instants.outputTime() - instants.output() * 1'000'000);
    }
  }
  return delays;
}

TEST(ControlInstants, JitterIsEvenAboutTheMeanAndTheSameOnEveryRun) {
  const std::vector<std::int64_t> delays = delaysOf("{mean: 8.0e-4, jitter: 3.0e-4, seed: 5}");
  ASSERT_EQ(delays.size(), 10'000u);
  double sum = 0.0;
  double squares = 0.0;
  for (const std::int64_t delay : delays) {
    ASSERT_GE(delay, 500'000);
    ASSERT_LE(delay, 1'100'000);
    sum += static_cast<double>(delay);
    squares += std::pow(static_cast<double>(delay) - 8.0e5, 2);
  }
  // Of an even distribution: standard deviation jitter / sqrt(3), a hundredth of it that of the
  // mean.
  EXPECT_NEAR(sum / 1e4, 8.0e5, 4.0 * 3.0e5 / std::sqrt(3.0) / 100.0);
  EXPECT_NEAR(std::sqrt(squares / 1e4), 3.0e5 / std::sqrt(3.0), 3.0e3);
  EXPECT_EQ(delaysOf("{mean: 8.0e-4, jitter: 3.0e-4, seed: 5}"), delays);
  EXPECT_NE(delaysOf("{mean: 8.0e-4, jitter: 3.0e-4, seed: 6}"), delays);
  const std::vector<std::int64_t> later = delaysOf("{mean: 8.0e-4, jitter: 3.0e-4, seed: 5}", 5000);
  EXPECT_TRUE(std::equal(delays.begin() + 5000, delays.end(), later.begin()))
      << "of its sample, whenever it began";
}

TEST(ControlInstants, NoOutputOvertakesTheOneBefore) {
  ControlInstants instants = instantsOf("{mean: 4.0e-3, jitter: 4.0e-3}");
  std::int64_t before = instants.outputTime();
  for (int k = 0; k < 10'000; ++k) {
    instants.passOutput();
    ASSERT_GE(instants.outputTime(), before);
    before = instants.outputTime();
  }
  EXPECT_GT(before, 9'990'000'000) << "and none is left behind";
}

TEST(ControllerReader, JitterIsNoMoreThanTheMean) {
  EXPECT_THAT(diagnosticsOf(withControllers(
                  "{pd: {type: pid, rate: 100.0, delay: {mean: 0.01, jitter: 0.02, sed: 1}, "
                  "measures: [s.x], acts_on: [s.force_x], parameters: {kp: 1.0}}}")),
              testing::ElementsAre(
                  testing::HasSubstr("controllers.pd.delay.sed: unknown key"),
                  testing::HasSubstr(
                      "controllers.pd.delay.jitter: must be at most the mean delay, 0.01 s")));
}

TEST(PartOfAScene, KeepsTheControllersThatHaveToDoWithNothingElse) {
  const Scene scene =
      sceneOf(withControllers("{both: {type: pid, rate: 20.0, measures: [s.x], acts_on: "
                              "[r.force_x], parameters: {kp: 1.0}}, "
                              "one: {type: pid, rate: 20.0, measures: [r.x], acts_on: [r.force_y], "
                              "parameters: {kp: 1.0}}}"));
  const Scene part = partOf(scene, {1});
  ASSERT_EQ(part.controllers.size(), 1u);
  EXPECT_EQ(part.controllers[0].name, "one");
  EXPECT_EQ(part.controllers[0].measures[0].system, 0u);
  EXPECT_EQ(part.controllers[0].acts_on[0].system, 0u);
}

}  // namespace controller_reader_test
}  // namespace whirl_twin
