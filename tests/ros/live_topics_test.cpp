// The demo, live: every topic carries every step, and the topics agree with each other.

#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <whirl_twin/DriveState.h>
#include <whirl_twin/LoopStatistics.h>
#include <whirl_twin/PendulumState.h>
#include <whirl_twin/WhirlState.h>

#include <cmath>
#include <map>
#include <set>

#include "waiting.h"

namespace whirl_twin {
namespace live_topics_test {

constexpr std::uint32_t kQueue = 20000;
constexpr std::size_t kEnough = 2000;  // steps

class LiveTopics : public testing::Test {
 protected:
  template <class Message>
  void listen(const std::string& topic, std::map<std::int64_t, Message>& steps) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> keep =
        [&steps](const boost::shared_ptr<const Message>& m) { steps[m->step] = *m; };
    subscribers_.push_back(node_.subscribe<Message>(topic, kQueue, keep));
  }

  template <class Message>
  static void expectNoGap(const std::map<std::int64_t, Message>& steps) {
    ASSERT_FALSE(steps.empty());
    const std::int64_t span = steps.rbegin()->first - steps.begin()->first + 1;
    EXPECT_EQ(static_cast<std::int64_t>(steps.size()), span);
    for (const auto& [step, message] : steps) {
      // Simulated time is a count of steps: the same double as the quotient of two integers.
      EXPECT_EQ(message.time, static_cast<double>(step) / 1000.0);
    }
  }

  ros::NodeHandle node_{"/twin"};
  std::vector<ros::Subscriber> subscribers_;
};

TEST_F(LiveTopics, carryEveryStepAndAgree) {
  std::map<std::int64_t, WhirlState> whirl;
  std::map<std::int64_t, PendulumState> pendulum;
  std::map<std::int64_t, DriveState> shaft;
  std::map<ros::Time, sensor_msgs::JointState> joints;
  listen("rotor/whirl", whirl);
  listen("pendulum/pendulum", pendulum);
  listen("drives/shaft", shaft);
  const boost::function<void(const sensor_msgs::JointState::ConstPtr&)> keep =
      [&joints](const sensor_msgs::JointState::ConstPtr& m) { joints[m->header.stamp] = *m; };
  subscribers_.push_back(
      node_.subscribe<sensor_msgs::JointState>("rotor/joint_states", kQueue, keep));
  ASSERT_TRUE(waitUntil([&] {
    return whirl.size() >= kEnough && pendulum.size() >= kEnough && shaft.size() >= kEnough &&
           joints.size() >= kEnough;
  }));
  subscribers_.clear();

  expectNoGap(whirl);
  expectNoGap(pendulum);
  expectNoGap(shaft);

  std::size_t compared = 0;
  for (const auto& [step, w] : whirl) {
    EXPECT_EQ(w.header.frame_id, "rotor");
    EXPECT_NEAR(w.radius, std::hypot(w.x, w.y), 1.0e-18);
    EXPECT_LT(std::fabs(w.energy_residual), 1.0e-6);
    const auto s = shaft.find(step);
    if (s != shaft.end()) {
      EXPECT_EQ(w.speed, s->second.speed);
      EXPECT_EQ(w.shaft_angle, s->second.shaft_angle);
      EXPECT_EQ(w.header.stamp, s->second.header.stamp);
      ++compared;
    }
    const auto j = joints.find(w.header.stamp);
    if (j != joints.end()) {
      EXPECT_EQ(j->second.position, (std::vector<double>{w.x, w.y}));
      EXPECT_EQ(j->second.velocity, (std::vector<double>{w.x_rate, w.y_rate}));
    }
  }
  EXPECT_GE(compared, kEnough / 2);
  for (const auto& entry : pendulum) {
    EXPECT_EQ(entry.second.name, std::vector<std::string>{"theta"});
    EXPECT_LT(std::fabs(entry.second.energy_residual), 1.0e-6);
  }
}

TEST_F(LiveTopics, loopStatisticsSayWhatWasObtained) {
  LoopStatistics loop;
  bool heard = false;
  const boost::function<void(const LoopStatistics::ConstPtr&)> keep =
      [&](const LoopStatistics::ConstPtr& m) {
        loop = *m;
        heard = m->step > 0;
      };
  subscribers_.push_back(node_.subscribe<LoopStatistics>("loop", 10, keep));
  ASSERT_TRUE(waitUntil([&] { return heard; }));
  EXPECT_EQ(loop.policy, "SCHED_OTHER");  // the test requests no priority
  EXPECT_EQ(loop.step_size, 0.001);
  ASSERT_EQ(loop.system.size(), 2u);
  EXPECT_EQ(std::set<std::string>(loop.system.begin(), loop.system.end()),
            (std::set<std::string>{"pendulum", "rotor"}));
  EXPECT_EQ(loop.stopped, (std::vector<std::uint8_t>{0, 0}));
  EXPECT_EQ(loop.tolerance, (std::vector<double>{1.0e-6, 1.0e-6}));
  ASSERT_EQ(loop.error_estimate.size(), 2u);
  for (const double error : loop.error_estimate) {
    EXPECT_GE(error, 0.0);     // the first of the estimates may be yet to come
    EXPECT_LT(error, 1.0e-6);  // the error bound of auto, and no alert
  }
}

}  // namespace live_topics_test
}  // namespace whirl_twin
