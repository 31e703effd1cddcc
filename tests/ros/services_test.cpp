// Pause, step, resume, reset and set_speed, on the live demo.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>
#include <whirl_twin/DriveState.h>
#include <whirl_twin/LoopStatistics.h>
#include <whirl_twin/SetRealTimeFactor.h>
#include <whirl_twin/SetSpeed.h>
#include <whirl_twin/StepN.h>
#include <whirl_twin/WhirlState.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

#include "waiting.h"

namespace whirl_twin {
namespace services_test {

class Services : public testing::Test {
 protected:
  void SetUp() override {
    const boost::function<void(const WhirlState::ConstPtr&)> on_whirl =
        [this](const WhirlState::ConstPtr& m) {
          whirl_ = *m;
          reached_ = m->step;
        };
    const boost::function<void(const DriveState::ConstPtr&)> on_drive =
        [this](const DriveState::ConstPtr& m) { shaft_ = *m; };
    whirl_subscriber_ = node_.subscribe<WhirlState>("/twin/rotor/whirl", 10000, on_whirl);
    drive_subscriber_ = node_.subscribe<DriveState>("/twin/drives/shaft", 10000, on_drive);
    const boost::function<void(const LoopStatistics::ConstPtr&)> on_loop =
        [this](const LoopStatistics::ConstPtr& m) { loop_ = *m; };
    loop_subscriber_ = node_.subscribe<LoopStatistics>("/twin/loop", 100, on_loop);
    for (const char* service : {"pause", "resume", "reset", "step", "set_speed"}) {
      ASSERT_TRUE(ros::service::waitForService(std::string("/simulation_node/") + service, 40000));
    }
    ASSERT_TRUE(trigger("resume").success);
    ASSERT_TRUE(waitUntil([this] { return whirl_ && shaft_ && loop_; }));
  }

  std_srvs::Trigger::Response trigger(const std::string& service) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("/simulation_node/" + service, call));
    return call.response;
  }
  StepN::Response step(std::uint32_t steps) {
    StepN call;
    call.request.steps = steps;
    EXPECT_TRUE(ros::service::call("/simulation_node/step", call));
    return call.response;
  }
  SetSpeed::Response setSpeed(const std::string& drive, double speed, double acceleration,
                              double jerk) {
    SetSpeed call;
    call.request.drive = drive;
    call.request.speed = speed;
    call.request.max_acceleration = acceleration;
    call.request.max_jerk = jerk;
    EXPECT_TRUE(ros::service::call("/simulation_node/set_speed", call));
    return call.response;
  }

  ros::NodeHandle node_;
  ros::Subscriber whirl_subscriber_;
  ros::Subscriber drive_subscriber_;
  ros::Subscriber loop_subscriber_;
  std::optional<WhirlState> whirl_;
  std::atomic<std::int64_t> reached_{0};  // its step, for other threads
  std::optional<DriveState> shaft_;
  std::optional<LoopStatistics> loop_;
};

TEST_F(Services, simulatedTimeGoesAsFastAsAsked) {
  const auto set = [](double factor) {
    SetRealTimeFactor call;
    call.request.factor = factor;
    EXPECT_TRUE(ros::service::call("/simulation_node/set_real_time_factor", call));
    return call.response;
  };
  for (const double wrong : {-1.0, 1e-3, 1e4, std::nan("")}) {
    const auto refused = set(wrong);
    EXPECT_FALSE(refused.success) << wrong;
    EXPECT_NE(refused.message.find("from 0.01 to 1000"), std::string::npos) << refused.message;
  }
  EXPECT_EQ(loop_->real_time_factor, 1.0);
  ASSERT_TRUE(set(0.1).success);
  EXPECT_TRUE(
      waitUntil([this] { return loop_->real_time_factor == 0.1 && loop_->achieved_factor < 0.2; }));
  ASSERT_TRUE(set(0.0).success);
  EXPECT_TRUE(waitUntil([this] {
    return loop_->real_time_factor == 0.0 && loop_->achieved_factor > 1.0;
  })) << loop_->achieved_factor;
  ASSERT_TRUE(set(1.0).success);
}

TEST_F(Services, pausedItStandsStillAndStepsAsAsked) {
  ASSERT_TRUE(trigger("pause").success);
  const StepN::Response first = step(1);
  ASSERT_TRUE(first.success) << first.message;
  const StepN::Response more = step(25);
  ASSERT_TRUE(more.success) << more.message;
  EXPECT_EQ(more.step, first.step + 25);
  EXPECT_EQ(more.time, static_cast<double>(more.step) / 1000.0);
  EXPECT_TRUE(waitUntil([&] { return whirl_->step == more.step; }));
  EXPECT_EQ(step(0).step, more.step);
}

TEST_F(Services, aPauseEndsStepsThatAreUnderWay) {
  ASSERT_TRUE(trigger("pause").success);
  const std::int64_t stood = step(1).step;
  std::atomic<bool> answered{false};
  std_srvs::Trigger::Response pause;
  std::thread another([&] {  // a second client, beside the one that waits for its steps
    while (reached_.load() < stood + 10) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_FALSE(answered.load());
    pause = trigger("pause");
  });
  std::thread listening([&] {
    while (!answered.load()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
  });
  const StepN::Response response = step(4000000000u);
  answered.store(true);
  another.join();
  listening.join();
  EXPECT_TRUE(pause.success);
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message, "interrupted by a pause at step " + std::to_string(response.step));
  EXPECT_EQ(step(1).step, response.step + 1) << "it stands where the pause put it";
}

TEST_F(Services, steppingWithoutAPauseIsRefused) {
  const StepN::Response response = step(3);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("pause"), std::string::npos);
}

TEST_F(Services, resumedItGoesOnFromWhereItStood) {
  ASSERT_TRUE(trigger("pause").success);
  const std::int64_t stood = step(1).step;
  ASSERT_TRUE(trigger("resume").success);
  EXPECT_TRUE(waitUntil([&] { return whirl_->step > stood + 100; }));
}

TEST_F(Services, resetBringsBackTheStart) {
  ASSERT_TRUE(waitUntil([&] { return whirl_->step > 300; }));
  ASSERT_TRUE(trigger("pause").success);
  const LoopStatistics before = *loop_;
  ASSERT_TRUE(trigger("reset").success);
  EXPECT_TRUE(waitUntil([&] { return whirl_->step == 0; }));
  EXPECT_EQ(whirl_->radius, 0.0);
  EXPECT_FALSE(whirl_->phase_valid);
  EXPECT_TRUE(std::isnan(whirl_->phase));
  EXPECT_TRUE(waitUntil([&] { return loop_->epoch > before.epoch; })) << "it is announced";
  EXPECT_EQ(loop_->epoch, before.epoch + 1);
  EXPECT_EQ(loop_->started, before.started);
  EXPECT_EQ(loop_->step, 0);
  EXPECT_TRUE(waitUntil([&] { return shaft_->step == 0; }));
  EXPECT_EQ(shaft_->shaft_angle, 0.0);
}

TEST_F(Services, aDriveGoesToTheSpeedItIsGiven) {
  const SetSpeed::Response response = setSpeed("shaft", 30.0, 100.0, 1000.0);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_GT(response.duration, 0.0);
  EXPECT_TRUE(waitUntil([&] { return shaft_->speed == 30.0 && shaft_->acceleration == 0.0; }));
}

TEST_F(Services, badSpeedsAreRefusedWithAReason) {
  const SetSpeed::Response no_drive = setSpeed("shft", 30.0, 10.0, 10.0);
  EXPECT_FALSE(no_drive.success);
  EXPECT_NE(no_drive.message.find("did you mean 'shaft'"), std::string::npos) << no_drive.message;
  const SetSpeed::Response no_limit = setSpeed("shaft", 30.0, 0.0, 10.0);
  EXPECT_FALSE(no_limit.success);
  EXPECT_NE(no_limit.message.find("rad/s^2"), std::string::npos) << no_limit.message;
  EXPECT_FALSE(setSpeed("shaft", std::nan(""), 1.0, 1.0).success);
}

}  // namespace services_test
}  // namespace whirl_twin
