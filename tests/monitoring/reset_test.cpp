// What clears the alerts: their cause gone, or a reset that the twin has announced, and nothing
// else that may come over a network.
#include <gtest/gtest.h>

#include "watched_twin.h"

namespace whirl_twin {
namespace reset_test {

// It dwells in the band of its critical speed, 100 rad/s, and is in danger from 3 s on.
constexpr const char* kDwelling = R"(
name: dwelling
step: 0.001
drives: {shaft: {speed: 100.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-5}
)";

/// In danger since a moment ago.
class InDanger : public testing::Test {
 protected:
  InDanger() : watched(sceneOf(kDwelling)) {
    watched.run(1.5);
    watched.announce();
    watched.run(1.6);
    alert = only();
    watched.events.clear();
  }
  state::Alert only() {
    const auto active = watched.monitor.alerts().active();
    EXPECT_EQ(active.size(), 1u);
    return active.empty() ? state::Alert{} : active.front();
  }
  void takeBoth(double time) {
    state::WhirlState whirl = watched.observer.whirl(0);
    state::DriveState drive = watched.observer.drive(0);
    whirl.at.time = drive.at.time = time;
    drive.speed = drive.target_speed = whirl.speed = 10.0;  // far from the band
    watched.monitor.take(drive, watched.wall);
    watched.monitor.take(whirl, watched.wall);
  }
  void expectUntouched() {
    EXPECT_TRUE(watched.events.empty());
    EXPECT_EQ(only().id, alert.id);
    EXPECT_EQ(only().severity, state::Severity::kDanger);
  }

  WatchedTwin watched;
  state::Alert alert;
};

TEST_F(InDanger, AStateThatIsLateClearsNothing) {
  ASSERT_EQ(alert.severity, state::Severity::kDanger);
  takeBoth(0.5);
  watched.run(2.0);
  expectUntouched();
}

TEST_F(InDanger, AStateThatComesTwiceClearsNothing) {
  for (int i = 0; i < 3000; ++i) {
    watched.run(0.001);
    takeBoth(watched.monitor.time());
    takeBoth(watched.monitor.time() - 0.001);
  }
  expectUntouched();
}

TEST_F(InDanger, AStateFromTheFutureClearsNothing) {
  takeBoth(1.0e6);
  watched.run(2.0);
  expectUntouched();
  EXPECT_LT(watched.monitor.time(), 10.0);
}

TEST_F(InDanger, LostStatesAreNotTheFuture) {
  for (int i = 0; i < 900; ++i) {
    watched.twin.step();
  }
  const auto before = watched.monitor.time();
  watched.feed();
  EXPECT_NEAR(watched.monitor.time(), before + 0.900, 1.0e-9);
}

TEST_F(InDanger, AnAnnouncedResetClearsEverythingAndBeginsAnew) {
  watched.twin.reset();
  ++watched.loop.epoch;
  watched.loop.at.time = 0.0;
  watched.twin.write(watched.record.data());
  watched.observer.observe(watched.record.data());
  watched.announce();
  EXPECT_FALSE(watched.monitor.alerts().active().empty()) << "its states may be a moment behind";
  watched.feed();
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u);
  watched.run(2.5);
  EXPECT_NE(only().id, alert.id);
  EXPECT_EQ(only().severity, state::Severity::kWarning) << "the dwell counts from the reset";
}

TEST_F(InDanger, TheStatesMayComeBeforeTheAnnouncement) {
  watched.twin.reset();
  watched.run(0.05);
  expectUntouched();
  ++watched.loop.epoch;
  watched.announce();
  watched.run(0.05);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u);
  EXPECT_NE(only().id, alert.id);
}

TEST_F(InDanger, ASimulationThatWasStartedAgainIsAnnouncedToo) {
  watched.run(0.1);
  watched.twin.reset();
  watched.loop.started += 5'000'000'000;
  watched.run(0.001);
  watched.announce();
  watched.run(0.001);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u);
}

// LCM has no checksum: one message with a wrong epoch is no reset while states go on as they were.
TEST_F(InDanger, AnAnnouncementThatNothingConfirmsClearsNothing) {
  watched.loop.epoch = 77;
  watched.announce();
  watched.loop.epoch = 0;
  watched.run(1.0);
  watched.announce();
  takeBoth(0.5);
  watched.run(1.0);
  expectUntouched();
}

TEST_F(InDanger, AnAnnouncementOfAnEarlierEpochIsOld) {
  watched.loop.epoch = 3;
  watched.announce();
  watched.run(0.1);
  watched.announce();  // twice: they are the statistics now
  watched.run(3.5);
  const state::Alert now = only();
  watched.events.clear();
  watched.loop.epoch = 2;
  watched.announce();
  takeBoth(0.5);
  watched.announce();
  watched.run(0.5);
  EXPECT_TRUE(watched.events.empty());
  EXPECT_EQ(only().id, now.id);
}

// A log without epochs, played in a loop: the states are followed, and nothing is forgotten.
TEST_F(InDanger, ALogPlayedASecondTimeIsFollowedAndTheAlertsSurvive) {
  watched.twin.reset();
  watched.margins.clear();
  watched.run(1.0);
  EXPECT_NEAR(watched.monitor.time(), 1.0, 1.0e-9);
  EXPECT_GE(watched.margins.size(), 4u) << "judged from 0.5 s on";
  expectUntouched();
  watched.twin.setSpeed(0, 10.0, 1000.0, 0.0);
  watched.run(1.5);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u) << "left for more than a second";
}

TEST_F(InDanger, StatisticsOutOfStepDoNotSetAStoppedSystemGoing) {
  watched.loop.system = {"rotor"};
  watched.loop.error_estimate = watched.loop.tolerance = {std::nan("")};
  watched.loop.stopped = {1};
  watched.loop.stopped_why = {"rotor: not finite"};
  watched.announce();
  ASSERT_EQ(watched.monitor.alerts().active().size(), 2u);
  state::LoopStatistics old = watched.loop;
  old.stopped = {0};
  old.at.time = 1.0;
  EXPECT_FALSE(watched.monitor.take(old, watched.wall));
  old.at.time = 1.0e5;
  EXPECT_FALSE(watched.monitor.take(old, watched.wall));
  EXPECT_EQ(watched.monitor.alerts().active().size(), 2u);
}

// After a stall one topic's backlog may come whole before another's.
TEST_F(InDanger, ATopicSecondsAheadOfAnotherIsNoReset) {
  state::WhirlState whirl = watched.observer.whirl(0);
  state::DriveState drive = watched.observer.drive(0);
  for (int i = 0; i < 30; ++i) {
    whirl.at.time += 0.1;
    watched.monitor.take(whirl, watched.wall);
  }
  drive.at.time += 0.001;
  watched.monitor.take(drive, watched.wall);
  expectUntouched();
}

}  // namespace reset_test
}  // namespace whirl_twin
