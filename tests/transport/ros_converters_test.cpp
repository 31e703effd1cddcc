#include "transport/ros_converters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>
#include <vector>

#include "state_samples.h"

namespace whirl_twin {
namespace ros_converters_test {

TEST(RosConverters, BringEveryBitBack) {
  StateSamples samples(1);
  for (int i = 0; i < 300; ++i) {
    samples.each([](const auto& state) {
      if constexpr (!std::is_same_v<std::decay_t<decltype(state)>, state::Alert>) {
        EXPECT_EQ(bitsOf(fromRos(toRos(state))), bitsOf(state));
      }
    });
    const auto alert = samples.alert();
    const auto alerts = fromRos(toRos(std::vector<state::Alert>{alert}, alert.stamp));
    ASSERT_EQ(alerts.size(), 1u);
    EXPECT_EQ(bitsOf(alerts.front()), bitsOf(alert));
  }
}

TEST(RosConverters, TheHeaderCarriesStampAndName) {
  state::DriveState drive;
  drive.drive = "shaft";
  drive.at.stamp = 1234567890123456789;
  const auto message = toRos(drive);
  EXPECT_EQ(message.header.frame_id, "shaft");
  EXPECT_EQ(message.header.stamp.sec, 1234567890u);
  EXPECT_EQ(message.header.stamp.nsec, 123456789u);
}

TEST(RosConverters, AStampRosCannotCarryBecomesTheNearest) {
  EXPECT_EQ(toRosTime(-5), ros::Time(0, 0));
  EXPECT_EQ(toRosTime(std::numeric_limits<std::int64_t>::max()), ros::TIME_MAX);
}

TEST(RosConverters, JointStatesAreTheCoordinates) {
  StateSamples samples(2);
  const auto whirl = samples.whirl();
  const auto of_whirl = toJointState(whirl);
  EXPECT_EQ(of_whirl.header.stamp, toRos(whirl).header.stamp);
  EXPECT_EQ(of_whirl.header.frame_id, whirl.system);
  EXPECT_EQ(of_whirl.name, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(of_whirl.position.size(), 2u);
  ASSERT_EQ(of_whirl.velocity.size(), 2u);
  EXPECT_TRUE(of_whirl.effort.empty());
  state::PendulumState pendulum;
  pendulum.system = "arm";
  pendulum.name = {"theta1", "theta2"};
  pendulum.angle = {0.1, 0.2};
  pendulum.rate = {1.0, 2.0};
  const auto of_pendulum = toJointState(pendulum);
  EXPECT_EQ(of_pendulum.name, pendulum.name);
  EXPECT_EQ(of_pendulum.position, pendulum.angle);
  EXPECT_EQ(of_pendulum.velocity, pendulum.rate);
}

TEST(RosConverters, ConstantsAndStatesMeanTheSame) {
  state::Alert alert;
  alert.severity = state::Severity::kDanger;
  alert.raised = true;
  const auto message = toRos(std::vector<state::Alert>{alert}, 0).alerts.front();
  EXPECT_EQ(message.severity, Alert::DANGER);
  EXPECT_EQ(message.state, Alert::RAISED);
}

template <class Message>
void expectRejected(const Message& good,
                    const std::vector<std::function<void(Message&)>>& spoilers) {
  ASSERT_NO_THROW(fromRos(good));
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    Message message = good;
    spoilers[i](message);
    EXPECT_THROW(fromRos(message), RejectedMessage) << "spoiler " << i;
  }
}

TEST(RosConverters, RejectWhatCannotBeMeant) {
  StateSamples samples(3);
  expectRejected<WhirlState>(
      toRos(samples.whirl()),
      {[](auto& m) { m.header.frame_id = ""; }, [](auto& m) { m.header.frame_id = "a/b"; },
       [](auto& m) { m.step = -1; }, [](auto& m) { m.time = std::nan(""); },
       [](auto& m) { m.forward = 7; }});
  expectRejected<DriveState>(toRos(samples.drive()), {[](auto& m) { m.header.frame_id = "\xff"; }});
  expectRejected<PendulumState>(
      toRos(samples.pendulum()),
      {[](auto& m) { m.angle.push_back(0.0); }, [](auto& m) { m.name.emplace_back("one_more"); }});
  expectRejected<StabilityMargin>(
      toRos(samples.margin()),
      {[](auto& m) { m.verdict = 5; }, [](auto& m) { m.band_high.push_back(0.0); },
       [](auto& m) { m.left = 1000; }});
  expectRejected<MotorState>(toRos(samples.motor()), {[](auto& m) { m.header.frame_id = ""; },
                                                      [](auto& m) { m.system = "a/b"; }});
  expectRejected<EnsembleState>(
      toRos(samples.ensemble()),
      {[](auto& m) { m.header.frame_id = ""; }, [](auto& m) { m.count = 0; },
       [](auto& m) { m.running = m.count + 1; }, [](auto& m) { m.running = -1; },
       [](auto& m) { m.quantity[0] = "a b"; }, [](auto& m) { m.unit[0] = "mm"; },
       [](auto& m) { m.unit.pop_back(); }, [](auto& m) { m.mean.clear(); },
       [](auto& m) { m.peak_largest.push_back(0.0); }});
  expectRejected<ParameterChange>(
      toRos(samples.change()),
      {[](auto& m) { m.header.frame_id = ""; }, [](auto& m) { m.values.push_back(0.0); },
       [](auto& m) { m.previous.clear(); }, [](auto& m) { m.names[0] = "a b"; }});
  auto loop = samples.loop();
  loop.system.resize(1, "rotor");
  for (auto* texts : {&loop.integrator, &loop.stopped_why}) {
    texts->resize(1);
  }
  loop.error_estimate.resize(1);
  loop.tolerance.resize(1);
  loop.stopped.resize(1);
  expectRejected<LoopStatistics>(
      toRos(loop), {[](auto& m) { m.step = -1; }, [](auto& m) { m.stopped.clear(); },
                    [](auto& m) { m.system[0] = ""; }, [](auto& m) { m.stopped[0] = 6; }});
  expectRejected<AlertArray>(
      toRos(std::vector<state::Alert>{samples.alert()}, 0),
      {[](auto& m) { m.alerts[0].severity = 3; }, [](auto& m) { m.alerts[0].text = "\x80"; }});
}

}  // namespace ros_converters_test
}  // namespace whirl_twin
