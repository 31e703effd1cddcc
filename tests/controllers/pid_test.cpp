// The PID controller: overshoot and settling of a saturated motor with and without anti-windup, no
// kick by the first sample or the set-point, no state without a gain, the derivative filter,
// independent axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "made_controller.h"

namespace whirl_twin {
namespace pid_test {

struct Response {
  double overshoot;  ///< [-]
  double settling;   ///< [s], to 2 %
};

/// A step of 5 rad/s of a motor, J = 1 kg m^2, whose torque is within 1 N m, by kp = 2, ki = 1.
Response stepOfMotor(const std::string& anti_windup) {
  constexpr double kTarget = 5.0;
  constexpr double kPeriod = 1e-4;
  ControllerPlan plan = planOf(1.0 / kPeriod, 1);
  plan.limits = {1.0};
  Settings settings;
  settings.choices["anti_windup"] = anti_windup;
  const auto pid = made("pid", {{"kp", 2.0}, {"ki", 1.0}, {"setpoint", kTarget}}, settings, plan);
  double speed = 0.0;
  Response response{0.0, 0.0};
  for (int k = 0; k < 400000; ++k) {
    double u = 0.0;
    pid->update(sampleOf(&speed, k), &u);
    speed += kPeriod * std::clamp(u, -1.0, 1.0);
    response.overshoot = std::max(response.overshoot, speed / kTarget - 1.0);
    if (std::abs(speed - kTarget) > 0.02 * kTarget) {
      response.settling = (k + 1) * kPeriod;
    }
  }
  return response;
}

// Of the same loop in continuous time, worked out for this project: 66.13, 6.75 and 1.35 %; 13.22,
// 8.46 and 5.13 s.
TEST(Pid, OvershootsLessWithAntiWindup) {
  const Response none = stepOfMotor("none");
  EXPECT_NEAR(none.overshoot, 0.6613, 1e-4);
  EXPECT_NEAR(none.settling, 13.22, 0.01);
  const Response back = stepOfMotor("back_calculation");
  EXPECT_NEAR(back.overshoot, 0.0675, 1e-4);
  EXPECT_NEAR(back.settling, 8.46, 0.01);
  const Response clamping = stepOfMotor("clamping");
  EXPECT_NEAR(clamping.overshoot, 0.0135, 1e-4);
  EXPECT_NEAR(clamping.settling, 5.13, 0.01);
}

TEST(Pid, GivesTheBackwardDifferenceWithoutAFilter) {
  const auto pid = made("pid", {{"kp", 3.0}, {"kd", 0.5}}, {}, planOf(20.0, 1));
  double u = 0.0;
  const double y[] = {0.7, 0.9, 0.85};
  pid->update(sampleOf(&y[0]), &u);
  EXPECT_DOUBLE_EQ(u, -3.0 * 0.7) << "there is nothing before the first sample: no derivative";
  pid->update(sampleOf(&y[1]), &u);
  EXPECT_NEAR(u, -3.0 * 0.9 - 0.5 * 0.2 * 20.0, 1e-14);
  pid->update(sampleOf(&y[2]), &u);
  EXPECT_NEAR(u, -3.0 * 0.85 + 0.5 * 0.05 * 20.0, 1e-14);
}

TEST(Pid, HasNoDerivativeOfItsSetpoint) {
  const auto pid = made("pid", {{"kp", 3.0}, {"kd", 0.5}, {"setpoint", 9.0}}, {}, planOf(20.0, 1));
  double u = 0.0;
  const double y = 0.7;
  for (int k = 0; k < 3; ++k) {
    pid->update(sampleOf(&y), &u);
    EXPECT_DOUBLE_EQ(u, 3.0 * 8.3);
  }
}

// A ramp's derivative comes up as 1 - (tau / (tau + T))^k, that of a filter of a first order.
TEST(Pid, FiltersItsDerivative) {
  constexpr double kPeriod = 0.01;
  constexpr double kTime = 0.05;
  const auto pid =
      made("pid", {{"kd", 2.0}, {"derivative_time", kTime}}, {}, planOf(1.0 / kPeriod, 1));
  for (int k = 0; k < 40; ++k) {
    const double y = 3.0 * k * kPeriod;
    double u = 0.0;
    pid->update(sampleOf(&y), &u);
    EXPECT_NEAR(u, -2.0 * 3.0 * (1.0 - std::pow(kTime / (kTime + kPeriod), k)), 1e-12);
  }
}

TEST(Pid, HasNoStateWithoutAGain) {
  const auto states = [](const ParameterValues& values) {
    return made("pid", values, {}, planOf(20.0, 2))->linear(0.0)->states();
  };
  EXPECT_EQ(states({{"kp", 1.0}}), 0);
  EXPECT_EQ(states({{"kp", 1.0}, {"derivative_time", 0.1}}), 0);
  EXPECT_EQ(states({{"kd", 1.0}}), 2);
  EXPECT_EQ(states({{"ki", 1.0}}), 2);
  EXPECT_EQ(states({{"kp", 1.0}, {"ki", 1.0}, {"kd", 1.0}}), 4);
}

TEST(Pid, UnwindsAPureIntegralToItsLimit) {
  ControllerPlan plan = planOf(10.0, 1);
  plan.limits = {1.0};
  const auto pid = made("pid", {{"ki", 5.0}, {"setpoint", 1.0}}, {}, plan);
  double u = 0.0;
  const double away = 0.0;
  for (int k = 0; k < 1000; ++k) {
    pid->update(sampleOf(&away), &u);
  }
  // One step of the integral above, no more, and so below it a step after the error's sign changes.
  EXPECT_NEAR(u, 1.5, 1e-12);
  const double beyond = 2.0;
  pid->update(sampleOf(&beyond), &u);
  pid->update(sampleOf(&beyond), &u);
  EXPECT_LT(u, 1.0);
}

TEST(Pid, KeepsItsAxesApart) {
  const auto pid = made("pid", {{"kp", 1.0}, {"ki", 2.0}, {"kd", 0.1}}, {}, planOf(50.0, 2));
  const auto alone = made("pid", {{"kp", 1.0}, {"ki", 2.0}, {"kd", 0.1}}, {}, planOf(50.0, 1));
  for (int k = 0; k < 20; ++k) {
    const double y[] = {std::sin(k), std::cos(3 * k)};
    double both[2];
    double one = 0.0;
    pid->update(sampleOf(y), both);
    alone->update(sampleOf(&y[1]), &one);
    EXPECT_EQ(both[1], one);
  }
}

Settings gainsOverSpeed() {
  Settings settings;
  settings.tables["gains"] = {{{{"speed", 10.0}, {"kp", 1.0}, {"ki", 2.0}, {"kd", 0.0}}, {}},
                              {{{"speed", 20.0}, {"kp", 3.0}, {"ki", 0.0}, {"kd", 0.4}}, {}},
                              {{{"speed", 60.0}, {"kp", 3.0}, {"ki", 4.0}, {"kd", 0.0}}, {}}};
  return settings;
}

TEST(Pid, HasGainsOverTheShaftsSpeed) {
  const auto tabled = made("pid", {}, gainsOverSpeed(), planOf(20.0, 1));
  const auto same = [&](double speed, double kp, double ki, double kd) {
    const auto law = *tabled->linear(speed);
    // With a trifle of a gain for 0, for a gain that is 0 at any speed has no state.
    const auto plain =
        *made("pid", {{"kp", kp}, {"ki", ki + 1e-300}, {"kd", kd + 1e-300}}, {}, planOf(20.0, 1))
             ->linear(0.0);
    return law.a == plain.a && law.b.isApprox(plain.b, 1e-15) && law.d.isApprox(plain.d, 1e-15);
  };
  EXPECT_TRUE(same(0.0, 1.0, 2.0, 0.0));
  EXPECT_TRUE(same(10.0, 1.0, 2.0, 0.0));
  EXPECT_TRUE(same(15.0, 2.0, 1.0, 0.2));
  EXPECT_TRUE(same(-15.0, 2.0, 1.0, 0.2));
  EXPECT_TRUE(same(30.0, 3.0, 1.0, 0.3));
  EXPECT_TRUE(same(1e9, 3.0, 4.0, 0.0));
}

TEST(Pid, KeepsItsIntegralWhereItsGainsChange) {
  const auto tabled = made("pid", {}, gainsOverSpeed(), planOf(20.0, 1));
  const auto at = [&](double speed, double y) {
    double u = 0.0;
    tabled->update({&y, 0, 0, {}, speed}, &u);
    return u;
  };
  for (int k = 0; k < 100; ++k) {
    at(10.0, -0.5);
  }
  // 2 * 0.5 for 5 s, whatever the gains are at the next sample; without a speed the last one holds.
  EXPECT_NEAR(at(20.0, -0.5), 3.0 * 0.5 + 5.0, 1e-12);
  EXPECT_NEAR(at(std::nan(""), -0.5), 3.0 * 0.5 + 5.0, 1e-12);
}

TEST(Pid, RefusesAGainBesideATable) {
  EXPECT_EQ(inputError("pid", {{"kd", 1.0}}, gainsOverSpeed(), planOf(20.0, 1)).first, "kd");
}

TEST(Pid, RefusesUnequalCounts) {
  ControllerPlan plan = planOf(20.0, 2);
  plan.measured = 3;
  EXPECT_NE(inputError("pid", {{"kp", 1.0}}, {}, plan).second.find("3 measured, 2 acted on"),
            std::string::npos);
}

/// Output at sample 400 without a change of parameters, and after one.
std::pair<double, double> acrossChange(const ParameterValues& before, const ParameterValues& after,
                                       const std::function<double(int)>& measured) {
  const ControllerPlan plan = planOf(100.0, 1);
  const auto kept = made("pid", before, {}, plan);
  const auto left = made("pid", before, {}, plan);
  const auto changed = made("pid", after, {}, plan);
  double u = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double y = measured(k);
    kept->update(sampleOf(&y, k), &u);
    left->update(sampleOf(&y, k), &u);
  }
  changed->takeOver(*left);
  const double y = measured(400);
  double expected = 0.0;
  kept->update(sampleOf(&y, 400), &expected);
  changed->update(sampleOf(&y, 400), &u);
  return {expected, u};
}

// In the middle of a motion, with a repeated sample; for the derivative term, on a ramp.
TEST(Pid, HasNoBumpWhereItsGainsAreChanged) {
  const ParameterValues before{
      {"kp", 2.0}, {"ki", 5.0}, {"kd", 0.1}, {"derivative_time", 0.05}, {"setpoint", 0.3}};
  const auto with = [&](const ParameterValues& other) {
    ParameterValues after = before;
    for (const auto& [name, value] : other) {
      after[name] = value;
    }
    return after;
  };
  const auto waving = [](int k) { return std::sin(0.1 * std::min(k, 399)); };
  const auto ramp = [](int k) { return 0.02 * k; };
  for (const ParameterValues& other :
       {ParameterValues{{"kp", 9.0}}, {{"ki", 50.0}}, {{"kp", -1.0}, {"ki", 0.5}}}) {
    const auto [expected, found] = acrossChange(before, with(other), waving);
    EXPECT_NEAR(found, expected, 1e-12);
  }
  const auto [expected, found] = acrossChange(before, with({{"kd", 3.0}}), ramp);
  EXPECT_NEAR(found, expected, 1e-12);
}

// Without an integral nothing would wear a compensation off: the output is that of the new gain.
TEST(Pid, WithoutAnIntegralANewGainActsAtOnce) {
  const auto [expected, found] = acrossChange(
      {{"kp", 2.0}}, {{"kp", 6.0}}, [](int k) { return std::sin(0.1 * std::min(k, 399)); });
  EXPECT_NEAR(found, 3.0 * expected, 1e-13);
}

}  // namespace pid_test
}  // namespace whirl_twin
