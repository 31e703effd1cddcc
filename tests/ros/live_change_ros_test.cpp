// Parameters changed on the live twin: the state continues, the topic publishes them, the monitor
// uses them.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/AlertArray.h>
#include <whirl_twin/ParameterChange.h>
#include <whirl_twin/PendulumState.h>
#include <whirl_twin/SetParameter.h>
#include <whirl_twin/StabilityMargin.h>
#include <whirl_twin/StepN.h>
#include <whirl_twin/WhirlState.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "waiting.h"

namespace whirl_twin {
namespace live_change_test {

class LiveChange : public testing::Test {
 protected:
  void SetUp() override {
    const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
        [this](const WhirlState::ConstPtr& m) {
          repeated_ = repeated_ || whirls_.count(m->step) > 0;
          whirls_[m->step] = *m;
        };
    const boost::function<void(const ParameterChange::ConstPtr&)> on_change =
        [this](const ParameterChange::ConstPtr& m) { changes_[m->header.frame_id] = *m; };
    const boost::function<void(const AlertArray::ConstPtr&)> on_alerts =
        [this](const AlertArray::ConstPtr& m) { alerts_ = *m; };
    const boost::function<void(const StabilityMargin::ConstPtr&)> on_margin =
        [this](const StabilityMargin::ConstPtr& m) { margin_ = *m; };
    ASSERT_TRUE(ros::service::waitForService("/simulation_node/set_parameter", 40000));
    ASSERT_TRUE(trigger("reset").success);
    ASSERT_TRUE(trigger("resume").success);
    subscribers_ = {node_.subscribe<WhirlState>("rotor/whirl", 100000, on_whirl),
                    node_.subscribe<ParameterChange>("rotor/parameters", 100, on_change),
                    node_.subscribe<ParameterChange>("swing/parameters", 100, on_change),
                    node_.subscribe<ParameterChange>("pd/parameters", 100, on_change),
                    node_.subscribe<AlertArray>("alerts", 100, on_alerts),
                    node_.subscribe<StabilityMargin>("rotor/stability", 100, on_margin)};
    ASSERT_TRUE(waitUntil([this] { return !whirls_.empty() && changes_.size() == 3; }));
  }

  std_srvs::Trigger::Response trigger(const std::string& service) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("/simulation_node/" + service, call));
    return call.response;
  }
  SetParameter::Response set(const std::string& system, const std::string& parameter, double value,
                             double ramp = 0.0) {
    SetParameter call;
    call.request.system = system;
    call.request.parameter = parameter;
    call.request.value = value;
    call.request.ramp = ramp;
    EXPECT_TRUE(ros::service::call("/simulation_node/set_parameter", call));
    return call.response;
  }
  double value(const std::string& system, const std::string& parameter) {
    const ParameterChange& set = changes_[system];
    const auto found = std::find(set.names.begin(), set.names.end(), parameter);
    return found == set.names.end() ? std::nan("") : set.values[found - set.names.begin()];
  }
  bool alerted(const std::string& type) const {
    return std::any_of(alerts_.alerts.begin(), alerts_.alerts.end(),
                       [&](const Alert& alert) { return alert.type == type; });
  }

  ros::NodeHandle node_{"/twin"};
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::int64_t, WhirlState> whirls_;  // by step
  std::map<std::string, ParameterChange> changes_;
  AlertArray alerts_;
  std::optional<StabilityMargin> margin_;
  bool repeated_ = false;  // a step came twice
};

TEST_F(LiveChange, theStateGoesOnAndTheTopicTells) {
  EXPECT_EQ(value("rotor", "damping"), 12.0);
  EXPECT_TRUE(changes_["rotor"].changed.empty());
  EXPECT_EQ(value("swing", "force[0].amplitude"), 1.0);
  // Until the initial transient has decayed, with 3 1/s.
  ASSERT_TRUE(waitUntil([&] { return whirls_.rbegin()->first > 3000; }));
  const SetParameter::Response response = set("rotor", "eccentricity", 5.0e-4);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.previous, 1.0e-4);
  ASSERT_TRUE(waitUntil([&] {
    return value("rotor", "eccentricity") == 5.0e-4 && whirls_.count(response.step + 300) > 0;
  }));
  EXPECT_EQ(changes_["rotor"].step, response.step);
  EXPECT_EQ(changes_["rotor"].changed, std::vector<std::string>{"eccentricity"});
  EXPECT_EQ(changes_["rotor"].previous, std::vector<double>{1.0e-4});
  EXPECT_FALSE(repeated_);
  // x (k+1) = x + h (v + v_next) / 2 but for h^3 / 12 of the third derivative: e w^2 w h^3 / 12.
  const double h = 0.001;
  const double bound = 2.0 * 5.0e-4 * std::pow(150.0, 3) * std::pow(h, 3) / 12.0;
  for (std::int64_t k = response.step - 100; k < response.step + 100; ++k) {
    if (whirls_.count(k) > 0 && whirls_.count(k + 1) > 0) {
      const WhirlState& now = whirls_[k];
      const WhirlState& next = whirls_[k + 1];
      EXPECT_NEAR(next.x - now.x, 0.5 * h * (now.x_rate + next.x_rate), bound) << k;
      EXPECT_LT(std::fabs(now.energy_residual), 1.0e-9) << k;
    }
  }
  // Five times the unbalance, five times the whirl, when the transient has decayed.
  ASSERT_TRUE(waitUntil([&] {
    return std::fabs(whirls_.rbegin()->second.radius / whirls_[response.step].radius - 5.0) < 0.05;
  }));
}

TEST_F(LiveChange, theMonitorFollowsInternalDampingIntoInstabilityAndOut) {
  ASSERT_TRUE(waitUntil([&] { return margin_.has_value() && margin_->time > 0.2; }));
  EXPECT_EQ(margin_->verdict, StabilityMargin::ASYMPTOTICALLY_STABLE);
  EXPECT_FALSE(margin_->instability_speed_valid);
  const SetParameter::Response ramp = set("rotor", "internal_damping", 16.0, 1.0);
  ASSERT_TRUE(ramp.success) << ramp.message;
  ASSERT_TRUE(waitUntil([&] { return alerted("UNSTABLE"); }));
  ASSERT_TRUE(waitUntil([&] {
    return value("rotor", "internal_damping") == 16.0 &&
           std::fabs(margin_->instability_speed - 60.0 * (1.0 + 12.0 / 16.0)) < 1.0e-6;
  }));
  ASSERT_TRUE(set("rotor", "internal_damping", 0.0).success);
  ASSERT_TRUE(waitUntil([&] { return !alerted("UNSTABLE"); }));
}

// Less than the magnet's negative stiffness, and more again.
TEST_F(LiveChange, theMonitorFollowsTheGainOfAController) {
  EXPECT_EQ(value("pd", "kp"), 2.0);
  const SetParameter::Response weaker = set("pd", "kp", 0.9);
  ASSERT_TRUE(weaker.success) << weaker.message;
  EXPECT_EQ(weaker.previous, 2.0);
  ASSERT_TRUE(waitUntil([&] { return value("pd", "kp") == 0.9 && alerted("UNSTABLE"); }));
  ASSERT_TRUE(set("pd", "kp", 2.0, 0.5).success);
  ASSERT_TRUE(waitUntil([&] { return value("pd", "kp") == 2.0 && !alerted("UNSTABLE"); }));
  EXPECT_NE(set("pd", "kpp", 2.0).message.find("did you mean 'kp'"), std::string::npos);
}

TEST_F(LiveChange, aResetBringsBackTheScenesParameters) {
  ASSERT_TRUE(set("swing", "force[0].amplitude", 3.0).success);
  ASSERT_TRUE(waitUntil([&] { return value("swing", "force[0].amplitude") == 3.0; }));
  const std_srvs::Trigger::Response reset = trigger("reset");
  EXPECT_NE(reset.message.find("parameters"), std::string::npos) << reset.message;
  ASSERT_TRUE(waitUntil([&] { return value("swing", "force[0].amplitude") == 1.0; }));
}

TEST_F(LiveChange, whatASceneWouldRefuseIsRefusedInItsWords) {
  const SetParameter::Response unknown = set("rotor", "internl_damping", 1.0);
  EXPECT_FALSE(unknown.success);
  EXPECT_NE(unknown.message.find("did you mean 'internal_damping'"), std::string::npos)
      << unknown.message;
  const SetParameter::Response negative = set("rotor", "mass", -1.0);
  EXPECT_FALSE(negative.success);
  EXPECT_NE(negative.message.find("mass: must be > 0 kg, found -1"), std::string::npos)
      << negative.message;
  EXPECT_FALSE(set("rotr", "mass", 1.0).success);
  EXPECT_FALSE(set("rotor", "mass", 1.0, -1.0).success);
}

}  // namespace live_change_test
}  // namespace whirl_twin
