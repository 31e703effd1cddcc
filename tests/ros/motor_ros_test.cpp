// The power balance of a motor, live.

#include <gtest/gtest.h>
#include <whirl_twin/MotorState.h>
#include <whirl_twin/SetSpeed.h>

#include <cmath>
#include <vector>

#include "waiting.h"

namespace whirl_twin {
namespace motor_test {

TEST(Motor, whatItGivesIsDissipatedOrKept) {
  ros::NodeHandle node("/twin");
  std::vector<MotorState> states;
  const boost::function<void(const MotorState::ConstPtr&)> on_motor =
      [&](const MotorState::ConstPtr& m) { states.push_back(*m); };
  const ros::Subscriber motor = node.subscribe<MotorState>("drives/engine/motor", 100000, on_motor);
  ASSERT_TRUE(waitUntil([&] { return states.size() > 2000; }));
  const MotorState& first = states.front();
  const MotorState& last = states.back();
  EXPECT_EQ(last.header.frame_id, "engine");
  EXPECT_EQ(last.system, "rotor");
  EXPECT_GT(last.speed, first.speed);
  EXPECT_NEAR(last.torque, 0.5 * (1.0 - last.speed / 100.0), 1.0e-9);
  EXPECT_NEAR(last.motor_power, last.torque * last.speed, 1.0e-9);
  EXPECT_NEAR(last.drag_power, 0.001 * last.speed * last.speed, 1.0e-9);
  // Within the energy residual, and the rounding of the motor's work summed over the records.
  EXPECT_NEAR(last.motor_work - first.motor_work,
              last.dissipated_work - first.dissipated_work + last.energy - first.energy,
              1.0e-6 * last.energy);
}

TEST(Motor, isNotSentToASpeed) {
  SetSpeed call;
  call.request.drive = "engine";
  call.request.speed = 50.0;
  call.request.max_acceleration = 1.0;
  ASSERT_TRUE(ros::service::waitForService("/simulation_node/set_speed", 40000));
  ASSERT_TRUE(ros::service::call("/simulation_node/set_speed", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(call.response.message.find("motor"), std::string::npos) << call.response.message;
}

}  // namespace motor_test
}  // namespace whirl_twin
