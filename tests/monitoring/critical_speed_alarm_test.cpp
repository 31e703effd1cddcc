// What a protection engineer expects of the critical-speed alerts of one rotor.
#include "monitoring/resonance_alarms.h"
#include "watched_rotor.h"

namespace whirl_twin {
namespace critical_speed_alarm_test {

// One passage, whatever its direction: from 0 time the band is entered at entry [s], left by the
// hysteresis at leave [s].
void expectOnePassage(const WatchedRotor& rotor, double entry, double leave) {
  const AlarmSettings settings;
  EXPECT_EQ(rotor.count(kApproach, true), 1);
  EXPECT_EQ(rotor.count(kApproach, false), 1);
  EXPECT_EQ(rotor.count(kInBand, true), 1);
  EXPECT_EQ(rotor.count(kInBand, false), 1);

  const state::Alert approach = rotor.event(kApproach, true);
  EXPECT_EQ(approach.severity, state::Severity::kWarning);
  EXPECT_EQ(approach.critical_speed, 100.0);
  EXPECT_NEAR(approach.time_to_entry, entry - approach.time, 0.01 * approach.time_to_entry);
  EXPECT_NEAR(approach.time_to_entry, settings.approach_time, 0.01 * settings.approach_time);

  // The instants are resolved to the step; one more for rounding of the ramp.
  EXPECT_NEAR(rotor.event(kInBand, true).time, entry, 2 * kStep);
  EXPECT_NEAR(rotor.event(kApproach, false).time, entry, 2 * kStep);
  EXPECT_NEAR(rotor.event(kInBand, false).time, leave + settings.clear_delay, 2 * kStep);
  EXPECT_EQ(rotor.event(kInBand, true).severity, state::Severity::kWarning);
  EXPECT_TRUE(rotor.list.active().empty());
}

TEST(CriticalSpeedAlarm, ARunUpIsWarnedOfBeforeThenInTheBandThenCleared) {
  WatchedRotor rotor;
  rotor.move(200.0, 20.0);
  expectOnePassage(rotor, 80.0 / 20.0, 120.0 * 1.02 / 20.0);
}

TEST(CriticalSpeedAlarm, ARunDownIsTheSameFromTheOtherSide) {
  WatchedRotor rotor;
  rotor.move(200.0, 20.0);
  rotor.events.clear();
  const double start = 200.0 / 20.0;
  rotor.move(0.0, 20.0);
  expectOnePassage(rotor, start + (200.0 - 120.0) / 20.0, start + (200.0 - 80.0 * 0.98) / 20.0);
}

TEST(CriticalSpeedAlarm, NegativeRotationMeetsTheSameBand) {
  WatchedRotor rotor;
  rotor.move(-200.0, 20.0);
  expectOnePassage(rotor, 80.0 / 20.0, 120.0 * 1.02 / 20.0);
  EXPECT_LT(rotor.event(kApproach, true).speed, 0.0);
}

TEST(CriticalSpeedAlarm, AReversalThroughStandstillMeetsTheBandOfEachSense) {
  WatchedRotor rotor;
  rotor.move(200.0, 20.0);
  rotor.events.clear();
  rotor.move(-200.0, 20.0);
  EXPECT_EQ(rotor.count(kApproach, true), 2);
  EXPECT_EQ(rotor.count(kInBand, true), 2);
  EXPECT_EQ(rotor.count(kInBand, false), 2);
}

TEST(CriticalSpeedAlarm, TheApproachSaysWhenWhereAndWhatToDo) {
  WatchedRotor rotor;
  rotor.move(200.0, 20.0);
  EXPECT_EQ(rotor.event(kApproach, true).text,
            "rotor: critical speed 100.0 rad/s (955 rpm), band entered in 2.0 s at 20 rad/s^2: "
            "do not dwell between 80.0 rad/s (764 rpm) and 120.0 rad/s (1146 rpm)");
}

TEST(CriticalSpeedAlarm, AMoveThatStopsBeforeTheBandDoesNotWarn) {
  WatchedRotor rotor;
  rotor.move(79.5, 20.0, 5.0);
  EXPECT_TRUE(rotor.events.empty());
}

TEST(CriticalSpeedAlarm, CreepingTowardTheEdgeWarnsHoweverSlowly) {
  WatchedRotor rotor;
  rotor.move(75.0, 20.0);
  ASSERT_TRUE(rotor.events.empty());
  rotor.move(80.1, 0.1);
  // The edge of the hysteresis, 78.4 rad/s, is more than approach_time from the band at this rate.
  EXPECT_NEAR(rotor.event(kApproach, true).speed, 80.0 * 0.98, 0.01);
  EXPECT_EQ(rotor.count(kInBand, true), 1);
}

TEST(CriticalSpeedAlarm, AMoveCalledOffClearsTheApproachAfterTheDelay) {
  WatchedRotor rotor;
  for (int step = 0; step < 100; ++step) {
    rotor.see(60.0, 20.0, 200.0);
  }
  EXPECT_EQ(rotor.count(kApproach, true), 1);
  for (int step = 0; step < 900; ++step) {
    rotor.see(60.0, 0.0, 60.0);
  }
  EXPECT_EQ(rotor.count(kApproach, false), 0) << "clear_delay is 1 s";
  for (int step = 0; step < 200; ++step) {
    rotor.see(60.0, 0.0, 60.0);
  }
  EXPECT_EQ(rotor.count(kApproach, false), 1);
  EXPECT_EQ(rotor.count(kInBand, true), 0);
}

TEST(CriticalSpeedAlarm, AnUnknownTargetIsTakenToLieBeyondTheBand) {
  WatchedRotor rotor;
  rotor.see(60.0, 20.0, kNaN);
  EXPECT_EQ(rotor.count(kApproach, true), 1);
  WatchedRotor slowing;
  slowing.see(60.0, -20.0, kNaN);
  EXPECT_TRUE(slowing.events.empty());
}

TEST(CriticalSpeedAlarm, DwellingBecomesDangerAtTheLimit) {
  WatchedRotor rotor;
  rotor.move(100.0, 20.0, 10.0);
  const double entry = 80.0 / 20.0;
  ASSERT_EQ(rotor.count(kInBand, true), 2) << "raised, then more severe";
  const state::Alert warning = rotor.event(kInBand, true, 0);
  const state::Alert danger = rotor.event(kInBand, true, 1);
  EXPECT_EQ(warning.severity, state::Severity::kWarning);
  EXPECT_EQ(danger.severity, state::Severity::kDanger);
  EXPECT_EQ(danger.id, warning.id);
  EXPECT_NEAR(danger.time, entry + AlarmSettings().dwell_limit, 2 * kStep);
  EXPECT_EQ(rotor.count(kInBand, false), 0) << "it stays as long as the rotor does";
}

TEST(CriticalSpeedAlarm, WaveringAboutTheEdgeIsDwellingToo) {
  WatchedRotor rotor;
  for (int step = 0; step < 5000; ++step) {
    rotor.see(80.0 + std::sin(0.01 * step), 0.0, 81.0);
  }
  ASSERT_EQ(rotor.list.active().size(), 1u);
  EXPECT_EQ(rotor.list.active()[0].severity, state::Severity::kDanger);
}

TEST(CriticalSpeedAlarm, AnEmptyBandNeverAlarms) {
  // Critically damped (AF < 2.5): both ends at the critical speed.
  WatchedRotor rotor({criticalAt(100.0, 100.0, 100.0), criticalAt(kNaN, kNaN, kNaN)});
  rotor.move(100.0, 20.0, 5.0);
  rotor.move(200.0, 20.0);
  EXPECT_TRUE(rotor.events.empty());
}

TEST(CriticalSpeedAlarm, TwoCriticalSpeedsArePassedOneAfterTheOther) {
  WatchedRotor rotor({criticalAt(100.0, 80.0, 120.0), criticalAt(300.0, 250.0, 350.0)});
  rotor.move(450.0, 20.0);
  for (const bool raised : {true, false}) {
    EXPECT_EQ(rotor.count(kApproach, raised), 2);
    EXPECT_EQ(rotor.event(kApproach, raised, 0).critical_speed, 100.0);
    EXPECT_EQ(rotor.event(kApproach, raised, 1).critical_speed, 300.0);
    EXPECT_EQ(rotor.event(kInBand, raised, 0).critical_speed, 100.0);
    EXPECT_EQ(rotor.event(kInBand, raised, rotor.count(kInBand, raised) - 1).critical_speed, 300.0);
  }
  EXPECT_NE(rotor.event(kApproach, true, 0).id, rotor.event(kApproach, true, 1).id);
  EXPECT_EQ(rotor.count(kInBand, false), 2);
  EXPECT_NEAR(rotor.event(kApproach, true, 1).time, 250.0 / 20.0 - 2.0, 2 * kStep);
}

TEST(CriticalSpeedAlarm, TheNextCriticalSpeedIsWarnedOfWhileStillInTheBandOfTheFirst) {
  WatchedRotor rotor({criticalAt(100.0, 80.0, 120.0), criticalAt(150.0, 130.0, 180.0)});
  rotor.move(250.0, 20.0);
  EXPECT_EQ(rotor.count(kApproach, true), 2);
  EXPECT_NEAR(rotor.event(kApproach, true, 1).time, 130.0 / 20.0 - 2.0, 2 * kStep);
  EXPECT_EQ(rotor.count(kInBand, false), 1) << "one stay: the bands lie closer than clear_delay";
}

}  // namespace critical_speed_alarm_test
}  // namespace whirl_twin
