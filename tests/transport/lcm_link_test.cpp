// Publisher and receiver joined by memq://, LCM's link within a process: no network is touched.
#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "event_log_sample.h"
#include "state_samples.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_publisher.h"
#include "transport/lcm_receiver.h"
#include "transport/lcm_recorder.h"

namespace whirl_twin {
namespace {

constexpr std::chrono::milliseconds kNow{0};
const std::vector<ChannelKind> kAllKinds{ChannelKind::kWhirl,     ChannelKind::kPendulum,
                                         ChannelKind::kStability, ChannelKind::kEnsemble,
                                         ChannelKind::kDrive,     ChannelKind::kAlerts};

class LcmLink : public testing::Test {
 protected:
  LcmReceiver receiverOf(const std::vector<ChannelKind>& kinds) {
    return {lcm_, kinds, [this](const TwinState& state) { arrived_.push_back(state); }};
  }

  std::shared_ptr<lcm::LCM> lcm_ = openLcm("memq://");
  LcmPublisher publisher_{lcm_};
  std::vector<TwinState> arrived_;
};

TEST_F(LcmLink, CarriesEveryKindInOrder) {
  auto receiver = receiverOf(kAllKinds);
  StateSamples samples(1);
  const auto whirl = samples.whirl();
  const auto pendulum = samples.pendulum();
  const auto drive = samples.drive();
  const auto margin = samples.margin();
  const auto ensemble = samples.ensemble();
  const auto alert = samples.alert();
  publisher_.publish(whirl);
  publisher_.publish(pendulum);
  publisher_.publish(drive);
  publisher_.publish(margin);
  publisher_.publish(ensemble);
  publisher_.publish(alert);
  EXPECT_EQ(receiver.receive(kNow), 6);
  ASSERT_EQ(arrived_.size(), 6u);
  EXPECT_EQ(bitsOf(std::get<state::WhirlState>(arrived_[0])), bitsOf(whirl));
  EXPECT_EQ(bitsOf(std::get<state::PendulumState>(arrived_[1])), bitsOf(pendulum));
  EXPECT_EQ(bitsOf(std::get<state::DriveState>(arrived_[2])), bitsOf(drive));
  EXPECT_EQ(bitsOf(std::get<state::StabilityMargin>(arrived_[3])), bitsOf(margin));
  EXPECT_EQ(bitsOf(std::get<state::EnsembleState>(arrived_[4])), bitsOf(ensemble));
  EXPECT_EQ(bitsOf(std::get<state::Alert>(arrived_[5])), bitsOf(alert));
  EXPECT_EQ(publisher_.sent(), 6u);
  EXPECT_EQ(publisher_.failed(), 0u);
  EXPECT_EQ(receiver.received(), 6u);
  EXPECT_EQ(receiver.lost() + receiver.rejected(), 0u);
}

TEST_F(LcmLink, KeepsAllOfALongQueue) {
  // liblcm keeps 30 messages of a subscription unless told otherwise.
  auto receiver = receiverOf({ChannelKind::kWhirl});
  state::WhirlState whirl;
  whirl.system = "rotor";
  for (int step = 0; step < 5000; ++step) {
    whirl.at = {step, step * 1e-3, 0};
    publisher_.publish(whirl);
  }
  int handled = 0;
  while (handled < 5000) {
    const int more = receiver.receive(kNow);
    ASSERT_GT(more, 0);
    handled += more;
  }
  ASSERT_EQ(arrived_.size(), 5000u);
  for (int step = 0; step < 5000; ++step) {
    EXPECT_EQ(std::get<state::WhirlState>(arrived_[step]).at.step, step);
  }
  EXPECT_EQ(receiver.lost(), 0u);
}

TEST_F(LcmLink, TakesOnlyTheWantedKinds) {
  auto receiver = receiverOf({ChannelKind::kDrive, ChannelKind::kPendulum});
  StateSamples samples(2);
  publisher_.publish(samples.whirl());
  publisher_.publish(samples.drive());
  publisher_.publish(samples.alert());
  receiver.receive(kNow);
  ASSERT_EQ(arrived_.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<state::DriveState>(arrived_[0]));
}

TEST_F(LcmLink, CountsWhatWasLostAndWhatIsRejected) {
  auto receiver = receiverOf({ChannelKind::kWhirl});
  state::WhirlState whirl;
  whirl.system = "rotor";
  for (const int step : {0, 1, 2, 6, 7}) {
    whirl.at = {step, step * 1e-3, 0};
    publisher_.publish(whirl);
  }
  const char garbage[] = "no state";
  lcm_->publish("TWIN_ROTOR_WHIRL", garbage, sizeof(garbage));
  lcm_->publish("TWIN_ROTOR_WHIRL", garbage, 0);
  receiver.receive(kNow);
  EXPECT_EQ(receiver.received(), 5u);
  EXPECT_EQ(receiver.lost(), 3u);
  EXPECT_EQ(receiver.rejected(), 2u);
  EXPECT_EQ(arrived_.size(), 5u);
  EXPECT_EQ(receiver.lastRejection().find("TWIN_ROTOR_WHIRL: "), 0u) << receiver.lastRejection();
}

TEST_F(LcmLink, RecordsEveryEventOfTheWantedChannels) {
  const TemporaryLog log;
  {
    LcmRecorder recorder(lcm_, "TWIN_.*", log.path());
    for (int step = 0; step < 2000; ++step) {
      publisher_.publish(whirlAt(step));
      publisher_.publish(driveAt(step));
    }
    const char other[] = "not the twin's";
    lcm_->publish("CAMERA", other, sizeof(other));
    recorder.record(kNow, 10000);
    EXPECT_EQ(recorder.recorded(), 4000u);
    // What has been recorded is in the file even if nobody ends the recorder properly.
    EXPECT_EQ(readEventLog(log.path()).events, 4000u);
  }
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact() && summary.continuous());
  EXPECT_EQ(summary.channels.size(), 2u);
}

TEST_F(LcmLink, ARecorderNoticesAFullDisk) {
  LcmRecorder recorder(lcm_, "TWIN_.*", "/dev/full");
  publisher_.publish(whirlAt(0));
  EXPECT_THROW(recorder.record(kNow), std::runtime_error);
}

TEST_F(LcmLink, ARecorderSaysWhichFileCannotBeWritten) {
  EXPECT_THROW(LcmRecorder(lcm_, "TWIN_.*", "/tmp/whirl_twin_no_such_directory/run.lcmlog"),
               std::runtime_error);
}

TEST(LcmPublisher, IsOffWithoutAUrl) {
  LcmPublisher publisher("");
  EXPECT_FALSE(publisher.on());
  EXPECT_EQ(publisher.warning(), "");
  publisher.publish(state::DriveState{});
  EXPECT_EQ(publisher.sent() + publisher.failed(), 0u);
}

TEST(LcmPublisher, StaysOffAndSaysWhyIfLcmDoesNotOpen) {
  LcmPublisher publisher("no_such_link://");
  EXPECT_FALSE(publisher.on());
  EXPECT_NE(publisher.warning().find("'no_such_link://'"), std::string::npos);
  EXPECT_NE(publisher.warning().find("nothing is sent on LCM"), std::string::npos);
  publisher.publish(state::WhirlState{});
  EXPECT_EQ(publisher.sent() + publisher.failed(), 0u);
}

}  // namespace
}  // namespace whirl_twin
