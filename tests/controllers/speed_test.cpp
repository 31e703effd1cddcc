// Speed control of a shaft by its motor: along the set-point, within the available torque, through
// a resonance that takes most of it; and a rotor of a scene on that motor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../scene/scenes.h"
#include "made_controller.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace speed_test {

Settings motor(double torque, bool avoids = false) {
  Settings settings;
  settings.tables["motor"] = {{{{"speed", 0.0}, {"torque", torque}}, {}}};
  if (avoids) {
    settings.tables["avoid"] = {{{{"from", 50.0}, {"to", 70.0}}, {}}};
  }
  return settings;
}
const ParameterValues kShaft{{"speed", 100.0},   {"max_acceleration", 20.0},
                             {"max_jerk", 50.0}, {"inertia", 0.02},
                             {"drag", 1e-3},     {"kp", 0.5},
                             {"ki", 2.0}};

/// J w' = u - d w - load, u held from sample to sample.
struct Shaft {
  double inertia, drag, load = 0.0, speed = 0.0;
  void go(double torque, double time) {
    const double end = (torque - load) / drag;
    speed = end + (speed - end) * std::exp(-drag / inertia * time);
  }
};

TEST(Speed, FollowsItsSetPointByWhatIsPlanned) {
  ParameterValues values = kShaft;
  values["kp"] = values["ki"] = 0.0;  // nothing but the plan
  const auto controller = made("speed", values, motor(1.0), planOf(1000.0, 1));
  Shaft shaft{0.02, 1e-3};
  double u = 0.0;
  for (int k = 0; k < 6000; ++k) {
    controller->update(sampleOf(&shaft.speed, k), &u);
    shaft.go(u, 1e-3);
  }
  // 100/20 + 20/50 s; the residual is the drag of half a sample.
  EXPECT_NEAR(shaft.speed, 100.0, 1e-2);
}

TEST(Speed, AsksForNoMoreThanTheMotorHasAndUnwinds) {
  const auto controller = made("speed", kShaft, motor(0.55), planOf(1000.0, 1));
  Shaft shaft{0.02, 1e-3};
  double u = 0.0;
  double highest = 0.0;
  int at_limit = 0;
  for (int k = 0; k < 20000; ++k) {
    shaft.load = k > 2000 && k < 6000 ? 0.4 : 0.0;  // of a resonance
    controller->update(sampleOf(&shaft.speed, k), &u);
    ASSERT_LE(std::abs(u), 0.55);
    at_limit += std::abs(u) == 0.55 ? 1 : 0;
    shaft.go(u, 1e-3);
    highest = std::max(highest, shaft.speed);
  }
  EXPECT_GT(at_limit, 1000);
  EXPECT_LT(highest, 110.0) << "the integral has not run away";
  EXPECT_NEAR(shaft.speed, 100.0, 1e-3);
}

// In the middle of a run-up: no torque but that of the largest jerk from sample to sample.
TEST(Speed, GoesOnToAnotherSpeedFromWhereItsSetPointIs) {
  ParameterValues values = kShaft;
  values["kp"] = values["ki"] = values["drag"] = 0.0;
  const ControllerPlan plan = planOf(1000.0, 1);
  auto controller = made("speed", values, motor(1.0), plan);
  Shaft shaft{0.02, 1e-9};
  double u = 0.0;
  double before = 0.0;
  for (int k = 0; k < 12000; ++k) {
    if (k == 2000) {
      values["speed"] = -30.0;
      auto next = made("speed", values, motor(1.0), plan);
      next->takeOver(*controller);
      controller = std::move(next);
    }
    controller->update(sampleOf(&shaft.speed, k), &u);
    ASSERT_LE(std::abs(u - before), 0.02 * 50.0 * 1e-3 * (1.0 + 1e-6)) << "sample " << k;
    before = u;
    shaft.go(u, 1e-3);
  }
  EXPECT_NEAR(shaft.speed, -30.0, 1e-3);
}

TEST(Speed, SaysWhatCannotBe) {
  const auto refused = [](const std::string& name, double value, bool avoids = false) {
    ParameterValues values = kShaft;
    values[name] = value;
    return inputError("speed", values, motor(0.55, avoids), planOf(1000.0, 1)).first;
  };
  EXPECT_EQ(refused("speed", 100.0), "");
  EXPECT_EQ(refused("speed", 600.0), "speed") << "its drag takes all torque at 550 rad/s";
  EXPECT_EQ(refused("speed", 60.0, true), "speed") << "in a band";
  EXPECT_EQ(refused("reserve", 1.0), "reserve");
  EXPECT_EQ(inputError("speed", kShaft, motor(0.55), planOf(1000.0, 2)).first, "speed");
  Settings falls = motor(1.0);
  falls.tables["motor"].push_back({{{"speed", 0.0}, {"torque", 0.5}}, {}});
  EXPECT_EQ(inputError("speed", kShaft, falls, planOf(1000.0, 1)).first, "motor[1].speed");
}

// The critical speed, 200 rad/s, takes 0.4 N m of one that sits there. The motor has 0.6, 15
// rad/s^2 take 0.3 of them.
TEST(Speed, TakesARotorThroughItsCriticalSpeed) {
  Twin twin(sceneOf(R"(
step: 0.001
drives: {shaft: {speed: 100.0, motor: {torque: 0.0}}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 5.0, stiffness: 2.0e5, damping: 40.0, eccentricity: 2.0e-4, polar_inertia: 0.02}
controllers:
  governor:
    type: speed
    rate: 1000.0
    measures: [rotor.spin_rate]
    acts_on: [rotor.torque]
    parameters:
      {speed: 300.0, max_acceleration: 15.0, max_jerk: 60.0, inertia: 0.02, kp: 0.5, ki: 1.0,
       motor: [{speed: 0.0, torque: 0.6}], avoid: [{from: 180.0, to: 220.0}]}
)"));
  std::vector<double> record(twin.layout().size);
  int inside = 0;
  for (int i = 0; i < 25000; ++i) {
    twin.step();
    twin.write(record.data());
    const double speed = RecordLayout::shaft(record.data(), 0).speed();
    inside += speed > 180.0 && speed < 220.0 ? 1 : 0;
  }
  EXPECT_NEAR(RecordLayout::shaft(record.data(), 0).speed(), 300.0, 0.1);
  EXPECT_NEAR(inside, 1000.0 * 40.0 / 15.0, 400.0) << "ms in the band";
}

}  // namespace speed_test
}  // namespace whirl_twin
