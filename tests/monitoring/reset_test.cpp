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
  watched.run(0.5);
  expectUntouched();  // the one before may still be there
  for (int i = 0; i < 3 && watched.events.empty(); ++i) {
    watched.run(1.0);
    watched.announce();
    watched.run(0.001);
  }
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u);
}

/// A second twin, or a log that is played, on the channels of the one that is watched: it turns at
/// 10 rad/s, far from the band, and its simulated time is `ahead` [s] of the other's.
class Beside : public InDanger {
 protected:
  void runBoth(double seconds, double ahead) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) {
      if (i % 10 == 0) {
        watched.announce();
        other.at = watched.loop.at;
        other.at.time += ahead;
        watched.monitor.take(other, watched.wall);
      }
      for (int step = 0; step < 100; ++step) {
        watched.run(0.001);
        takeBoth(watched.observer.instant().time + ahead);
      }
      watched.monitor.tick(watched.wall, false);
    }
  }
  const state::Alert* duplicate() {
    return watched.monitor.alerts().find("twin", "DUPLICATE_TWIN");
  }
  static state::LoopStatistics statistics() {
    state::LoopStatistics loop;
    loop.started = 9'000'000'000;
    loop.sender = "/other/simulation_node on desk (process 7)";
    return loop;
  }
  const state::Alert* danger() { return watched.monitor.alerts().find("rotor", alert.type); }

  state::LoopStatistics other = statistics();
};

TEST_F(Beside, ASecondTwinClearsNothingAndIsNamed) {
  for (const double ahead : {-1.2, 4.0, 0.3, 100.0}) {
    runBoth(6.0, ahead);
    ASSERT_NE(danger(), nullptr) << ahead;
    EXPECT_EQ(danger()->id, alert.id) << ahead;
    EXPECT_EQ(danger()->severity, state::Severity::kDanger);
    ASSERT_NE(duplicate(), nullptr) << ahead;
    EXPECT_NE(duplicate()->text.find(other.sender), std::string::npos) << duplicate()->text;
    EXPECT_EQ(watched.monitor.alerts().active().size(), 2u);
  }
  EXPECT_GT(watched.monitor.ofOthers(), 20u);
  for (int i = 0; i < 7; ++i) {
    watched.run(1.0);
    watched.announce();
    watched.monitor.tick(watched.wall, false);
  }
  EXPECT_EQ(duplicate(), nullptr) << "it has gone";
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 0u);
}

// What the second one cannot hide: the first leaves the band and comes back.
TEST_F(Beside, TheTwinThatIsWatchedIsJudgedOn) {
  runBoth(4.0, -3.0);
  watched.twin.setSpeed(0, 10.0, 1000.0, 0.0);
  runBoth(2.5, -3.0);
  EXPECT_EQ(danger(), nullptr);
  watched.twin.setSpeed(0, 100.0, 1000.0, 0.0);
  runBoth(5.0, -3.0);
  ASSERT_NE(danger(), nullptr);
  EXPECT_EQ(danger()->severity, state::Severity::kDanger);
}

TEST_F(Beside, TwinsAtTheSameSimulatedTimeCannotBeToldApart) {
  runBoth(4.0, 0.3);
  EXPECT_NE(watched.monitor.notOk(watched.wall, false).front().find("two twins"),
            std::string::npos);
}

// A log of twin simulate has no run number: its stamps are from before the start. Played fast it
// passes the twin's own time.
TEST_F(Beside, ALogThatIsPlayedClearsNothingAndIsNamed) {
  watched.announcements = 10'000'000'000;  // stamps of the wall clock
  watched.loop.started = 9'000'000'000;
  const auto own = [&](double seconds) {
    for (int i = 0; i < std::lround(1000.0 * seconds); ++i) {
      watched.observer.setStamp(10'000'000'000);
      watched.run(0.001);
    }
    watched.announce();
    watched.monitor.tick(watched.wall, false);
  };
  for (int i = 0; i < 8; ++i) {  // that run is watched from now on, and in danger
    own(1.0);
  }
  watched.events.clear();
  const std::uint32_t id = only().id;
  watched.observer.setStamp(0);
  for (double played = watched.monitor.time() - 5.0; played < watched.monitor.time() + 5.0;
       played += 0.01) {
    watched.observer.setStamp(10'000'000'000);
    watched.run(0.001);
    state::WhirlState whirl = watched.observer.whirl(0);
    state::DriveState drive = watched.observer.drive(0);
    whirl.at.time = drive.at.time = played;
    whirl.at.stamp = drive.at.stamp = std::llround(1.0e9 * played) % 6'000'000'000;
    drive.speed = drive.target_speed = whirl.speed = 10.0;
    watched.monitor.take(drive, watched.wall);
    watched.monitor.take(whirl, watched.wall);
  }
  own(1.0);
  EXPECT_EQ(danger()->id, id);
  EXPECT_EQ(danger()->severity, state::Severity::kDanger);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 0u);
  ASSERT_NE(duplicate(), nullptr);
  EXPECT_NE(duplicate()->text.find("from a log being played"), std::string::npos);
  for (int i = 0; i < 7; ++i) {
    own(1.0);
  }
  EXPECT_EQ(duplicate(), nullptr);
}

// One datagram, or one message that was late, is no second twin.
TEST_F(Beside, OneMessageOfAnotherRunIsNone) {
  watched.monitor.take(other, watched.wall);
  for (int i = 0; i < 6; ++i) {
    watched.run(1.0);
    watched.announce();
    watched.monitor.tick(watched.wall, false);
  }
  EXPECT_EQ(duplicate(), nullptr);
  EXPECT_TRUE(watched.events.empty());
}

// Its parameters come before its statistics: they are put back, and later ones are left.
TEST_F(Beside, ParametersOfASecondTwinAreNotKept) {
  const auto toldBy = [&](double stiffness) {
    state::ParameterChange change = watched.observer.parameters(0);
    for (std::size_t i = 0; i < change.names.size(); ++i) {
      change.values[i] = change.names[i].rfind("stiffness", 0) == 0 ? stiffness : change.values[i];
    }
    EXPECT_TRUE(watched.monitor.take(change));
  };
  const auto lowestCriticalSpeed = [&] {
    watched.margins.clear();
    watched.run(0.5);
    return watched.margins.empty() ? 0.0 : watched.margins.back().critical_speeds.front().speed;
  };
  toldBy(1.0e4);
  const double own = lowestCriticalSpeed();
  toldBy(9.0e4);
  EXPECT_NEAR(lowestCriticalSpeed(), 3.0 * own, 2.0);
  other.at.time = 50.0;
  watched.monitor.take(other, watched.wall);
  EXPECT_NEAR(lowestCriticalSpeed(), own, 0.1);
  toldBy(9.0e4);
  EXPECT_NEAR(lowestCriticalSpeed(), own, 0.1);
}

TEST_F(InDanger, WhatIsUncertainRaisesAndClearsNothing) {
  watched.monitor.setUncertain("the scene of the twin");
  watched.twin.setSpeed(0, 10.0, 1000.0, 0.0);
  watched.run(3.0);
  watched.monitor.tick(watched.wall, false);
  expectUntouched();
  EXPECT_EQ(watched.monitor.notOk(watched.wall, false).front(), "the scene of the twin");
  watched.monitor.setUncertain("");
  watched.run(2.0);
  EXPECT_EQ(watched.count("IN_CRITICAL_BAND", false), 1u);
}

// LCM has no checksum: one message with a wrong epoch is no reset while states continue unchanged.
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
