// Set-points that a motor can follow: time-optimal within limits that depend on the speed, and
// through bands at the motor's full torque.
#include "control/speed_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "../realtime/allocation_guard.h"

namespace whirl_twin {
namespace speed_planner_test {

ShaftLimits steady(double acceleration) {
  return {Motor::constant(1.0), 0.01, 0.0, acceleration};
}
/// 0.9 N m at rest, nothing at 400 rad/s, with some drag.
ShaftLimits falling() {
  return {Motor::falling(0.9, 400.0, 2.0e-4), 0.02, 0.1, 30.0};
}

// With limits independent of the speed it is the known plan: (v0, a0 -> v1; A, J).
TEST(SpeedPlanner, IsTheFastestChangeOfConstantLimits) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double limit = std::pow(10.0, 1.0 + 0.9 * unit(random));
    const double jerk = std::pow(10.0, 2.0 + unit(random));
    const double speed = 300.0 * unit(random);
    const double acceleration = i % 3 == 0 ? 0.0 : 1.5 * limit * unit(random);
    const double target = 300.0 * unit(random);
    const SpeedPlanner planner(steady(limit), jerk, {});
    SpeedPlan plan = planner.staying(0.0);
    ASSERT_TRUE(planner.plan(speed, acceleration, target, plan));
    const double fastest =
        planSpeedChange(speed, acceleration, {target, limit, jerk, 0.0}).duration;
    ASSERT_NEAR(plan.duration, fastest, 1e-6 * (1.0 + fastest))
        << speed << ", " << acceleration << " to " << target << ", A " << limit << " J " << jerk;
  }
}

TEST(SpeedPlanner, AsksOfAMotorWhatItHas) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const ShaftLimits limits = falling();
  const double jerk = 100.0;
  const SpeedPlanner planner(limits, jerk, {});
  EXPECT_GT(planner.highest(), 300.0);
  EXPECT_LT(planner.highest(), 400.0) << "there the motor has nothing left";
  SpeedPlan plan = planner.staying(0.0);
  for (int i = 0; i < 500; ++i) {
    const double speed = 0.9 * planner.highest() * unit(random);
    const double target = 0.9 * planner.highest() * unit(random);
    ASSERT_TRUE(planner.plan(speed, 0.0, target, plan));
    PlanCursor cursor;
    SpeedSegment before{0.0, speed, 0.0, 0.0};
    const double h = plan.duration / 2000;
    for (int k = 0; k <= 2001; ++k) {
      const SpeedSegment there = cursor.at(plan, h * k);
      const bool rises = there.acceleration * there.speed > 0.0;
      const double most = rises ? limits.rise(there.speed) : limits.fall(there.speed);
      ASSERT_LE(std::abs(there.acceleration), most * (1.0 + 1e-9)) << there.speed;
      ASSERT_LE(std::abs(there.acceleration - before.acceleration), jerk * h * (1.0 + 1e-6));
      ASSERT_NEAR(there.speed, before.speed, 30.0 * h * (1.0 + 1e-6));
      before = there;
    }
    ASSERT_EQ(before.speed, target);
  }
}

// At 0 rad/s the motor allows 0.81 N m / 0.02 kg m^2, limited to 30; near 300 rad/s 7 remain. The
// minimum over the whole speed range would also be feasible, and far slower.
TEST(SpeedPlanner, UsesWhatTheMotorHasWhereItHasIt) {
  const ShaftLimits limits = falling();
  const SpeedPlanner planner(limits, 100.0, {});
  SpeedPlan up = planner.staying(0.0);
  SpeedPlan down = planner.staying(0.0);
  ASSERT_TRUE(planner.plan(0.0, 0.0, 300.0, up));
  ASSERT_TRUE(planner.plan(300.0, 0.0, 0.0, down));
  EXPECT_LT(up.duration,
            0.6 * planSpeedChange(0.0, 0.0, {300.0, limits.rise(300.0), 100.0, 0.0}).duration);
  EXPECT_LT(down.duration, up.duration) << "drag brakes";
  // No change within these limits is faster than the integral of dw / a(w) without a jerk limit.
  double least = 0.0;
  for (int i = 0; i < 3000; ++i) {
    least += 0.1 / limits.rise(0.1 * (i + 0.5));
  }
  EXPECT_GT(up.duration, least);
  EXPECT_LT(up.duration, 1.1 * least);
}

TEST(SpeedPlanner, CrossesABandAtAllThatItHas) {
  const ShaftLimits limits = falling();
  const double jerk = 100.0;
  const SpeedPlanner planner(limits, jerk, ExclusionBands({{190, 215}}));
  EXPECT_EQ(planner.allowed(210.0, std::numeric_limits<double>::quiet_NaN()), 215.0);
  SpeedPlan plan = planner.staying(0.0);
  ASSERT_TRUE(planner.plan(190.0, 0.0, 215.0, plan));  // back first, and beyond
  PlanCursor cursor;
  int inside = 0;
  for (int k = 0; k <= 20000; ++k) {
    const SpeedSegment there = cursor.at(plan, plan.duration * k / 20000);
    if (there.speed > 190.0 + 1e-9 && there.speed < 215.0 - 1e-9) {
      // A(w) is one of 24 steps up to 390 rad/s, each the minimum over its 16.2 rad/s.
      ASSERT_GE(there.acceleration, limits.rise(there.speed + 16.3)) << there.speed;
      ++inside;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(plan.target, 215.0);
  EXPECT_FALSE(planner.plan(0.0, 0.0, 500.0, plan)) << "faster than it can turn";
  EXPECT_EQ(plan.target, 215.0);
}

TEST(SpeedPlanner, AllocatesNothing) {
  const SpeedPlanner planner(falling(), 100.0, ExclusionBands({{50, 60}, {190, 215}}));
  SpeedPlan plan = planner.staying(0.0);
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(planner.plan(3.0 * i, 10.0, 300.0 - 3.0 * i, plan));
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace speed_planner_test
}  // namespace whirl_twin
