// An input set live: the force displaces the rotor, which returns when the duration has elapsed.

#include <gtest/gtest.h>
#include <whirl_twin/InputCommand.h>
#include <whirl_twin/SetInput.h>
#include <whirl_twin/WhirlState.h>

#include <cmath>
#include <limits>
#include <string>

#include "messages/commands.h"
#include "transport/channels.h"
#include "transport/lcm_publisher.h"
#include "waiting.h"

namespace whirl_twin {
namespace set_input_test {

SetInput::Response setInput(const std::string& system, const std::string& input, double value,
                            double duration) {
  SetInput call;
  call.request.system = system;
  call.request.input = input;
  call.request.value = value;
  call.request.duration = duration;
  EXPECT_TRUE(ros::service::waitForService("/simulation_node/set_input", 40000));
  EXPECT_TRUE(ros::service::call("/simulation_node/set_input", call));
  return call.response;
}

TEST(SetInput, pushesTheRotorUntilItsTimeIsOut) {
  ros::NodeHandle node("/twin");
  double x = 1.0;
  const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
      [&](const WhirlState::ConstPtr& m) { x = m->x; };
  const ros::Subscriber whirl = node.subscribe<WhirlState>("rotor/whirl", 100, on_whirl);
  ASSERT_TRUE(waitUntil([&] { return x == 0.0; }));
  const SetInput::Response response = setInput("rotor", "force_x", 4.0, 3.0);
  EXPECT_TRUE(response.success) << response.message;
  // Critically damped: F / k, within a thousandth after a second.
  EXPECT_TRUE(waitUntil([&] { return std::abs(x - 0.02) < 2.0e-5; }));
  EXPECT_TRUE(waitUntil([&] { return std::abs(x) < 2.0e-5; }));
}

TEST(SetInput, takesCommandsByTopicAndByLcm) {
  ros::NodeHandle node("/twin");
  double x = 1.0;
  const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
      [&](const WhirlState::ConstPtr& m) { x = m->x; };
  const ros::Subscriber whirl = node.subscribe<WhirlState>("rotor/whirl", 100, on_whirl);
  ros::Publisher topic = node.advertise<InputCommand>("rotor/inputs", 10);
  ASSERT_TRUE(waitUntil([&] { return topic.getNumSubscribers() > 0; }));
  InputCommand command;
  command.input = {"force_x"};
  command.value = {std::numeric_limits<double>::infinity()};  // rejected: nothing moves
  command.duration = 2.0;
  topic.publish(command);
  command.value = {6.0};
  topic.publish(command);
  EXPECT_TRUE(waitUntil([&] { return std::abs(x - 0.03) < 3.0e-5; }));
  EXPECT_TRUE(waitUntil([&] { return std::abs(x) < 2.0e-5; })) << "the time is out";

  LcmPublisher lcm(kDefaultLcmUrl);
  ASSERT_TRUE(lcm.on()) << lcm.warning();
  state::InputCommand by_lcm;
  by_lcm.system = "rotor";
  by_lcm.input = {"force_x"};
  by_lcm.value = {-6.0};
  by_lcm.duration = 2.0;
  lcm.publish(by_lcm);
  EXPECT_TRUE(waitUntil([&] { return std::abs(x + 0.03) < 3.0e-5; }));
  EXPECT_TRUE(waitUntil([&] { return std::abs(x) < 2.0e-5; }));
}

TEST(SetInput, refusesWhatThereIsNot) {
  EXPECT_EQ(setInput("rotr", "force_x", 1.0, 1.0).message,
            "system: must be a system of the scene, found 'rotr'; did you mean 'rotor'?");
  EXPECT_EQ(setInput("rotor", "force_y", 1.0, 1.0).message,
            "input: must be an input given as a number in the scene, found 'force_y'; did you mean "
            "'force_x'?");
  EXPECT_FALSE(setInput("rotor", "force_x", std::numeric_limits<double>::quiet_NaN(), 1.0).success);
  EXPECT_FALSE(setInput("rotor", "force_x", 1.0, 0.0).success);
}

}  // namespace set_input_test
}  // namespace whirl_twin
