// Two twins under one master, /twin and /plant/machine, whose rotors have the same name: neither
// receives the other's messages, on ROS or on LCM.

#include <gtest/gtest.h>
#include <whirl_twin/StabilityMargin.h>
#include <whirl_twin/WhirlState.h>

#include <chrono>
#include <set>
#include <string>
#include <vector>

#include "transport/lcm_connection.h"
#include "transport/lcm_receiver.h"
#include "waiting.h"

namespace whirl_twin {
namespace two_twins_test {

constexpr char kRotor[] = "rotor";      // /twin has a system without a shaft beside it
constexpr double kTwinSpeed = 150.0;    // rad/s, of tests/ros/scenes/supercritical.yaml
constexpr double kMachineSpeed = 30.0;  // rad/s, of tests/ros/scenes/ensemble.yaml
constexpr std::size_t kEnough = 2000;   // states of each

/// Messages received of one rotor.
struct Heard {
  std::size_t states = 0;
  std::set<double> speeds;         // rad/s, of the states
  std::set<double> margin_speeds;  // rad/s, of the monitor's evaluations
};

class TwoTwins : public testing::Test {
 protected:
  void listen(const std::string& twin, Heard& heard) {
    const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
        [&heard](const WhirlState::ConstPtr& m) {
          ++heard.states;
          heard.speeds.insert(m->speed);
        };
    const boost::function<void(const StabilityMargin::ConstPtr&)> on_margin =
        [&heard](const StabilityMargin::ConstPtr& m) { heard.margin_speeds.insert(m->speed); };
    subscribers_.push_back(node_.subscribe<WhirlState>(twin + "/rotor/whirl", 10000, on_whirl));
    subscribers_.push_back(
        node_.subscribe<StabilityMargin>(twin + "/rotor/stability", 1000, on_margin));
  }

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
};

TEST_F(TwoTwins, areHeardApartOnRos) {
  Heard twin, machine;
  listen("/twin", twin);
  listen("/plant/machine", machine);
  ASSERT_TRUE(waitUntil([&] {
    return twin.states > kEnough && machine.states > kEnough && !twin.margin_speeds.empty() &&
           !machine.margin_speeds.empty();
  }));
  EXPECT_EQ(twin.speeds, std::set<double>{kTwinSpeed});
  EXPECT_EQ(twin.margin_speeds, std::set<double>{kTwinSpeed});
  EXPECT_EQ(machine.speeds, std::set<double>{kMachineSpeed});
  EXPECT_EQ(machine.margin_speeds, std::set<double>{kMachineSpeed});
}

TEST_F(TwoTwins, areHeardApartOnLcm) {
  const auto listener = [](Heard& heard) {
    return [&heard](const Message& message) {
      if (const auto* whirl = std::get_if<state::WhirlState>(&message)) {
        ++heard.states;
        heard.speeds.insert(whirl->speed);
      } else if (const auto* margin = std::get_if<state::StabilityMargin>(&message);
                 margin != nullptr && margin->system == kRotor) {
        heard.margin_speeds.insert(margin->speed);
      }
    };
  };
  Heard twin, machine;
  LcmReceiver of_twin(openLcm(kDefaultLcmUrl), allKinds(), listener(twin));
  LcmReceiver of_machine(openLcm(kDefaultLcmUrl), allKinds(), listener(machine), "PLANT_MACHINE_");
  ASSERT_TRUE(waitUntil([&] {
    of_twin.receive(std::chrono::milliseconds(1));
    of_machine.receive(std::chrono::milliseconds(1));
    return twin.states > kEnough && machine.states > kEnough && !twin.margin_speeds.empty() &&
           !machine.margin_speeds.empty();
  }));
  EXPECT_EQ(twin.speeds, std::set<double>{kTwinSpeed});
  EXPECT_EQ(twin.margin_speeds, std::set<double>{kTwinSpeed});
  EXPECT_EQ(machine.speeds, std::set<double>{kMachineSpeed});
  EXPECT_EQ(machine.margin_speeds, std::set<double>{kMachineSpeed});
  EXPECT_EQ(of_twin.rejected() + of_machine.rejected(), 0u);
  EXPECT_EQ(of_twin.channels().count("TWIN_LOOP"), 1u);
  EXPECT_EQ(of_machine.channels().count("PLANT_MACHINE_ROTOR_ENSEMBLE"), 1u);
}

}  // namespace two_twins_test
}  // namespace whirl_twin
