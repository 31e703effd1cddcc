// One alarm as a state machine: raised at once, cleared late, never flickering.
#include "monitoring/condition_alarm.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace whirl_twin {
namespace condition_alarm_test {

using Change = ConditionAlarm::Change;

TEST(ConditionAlarm, RaisesAtOnceAndClearsOnlyAfterTheDelay) {
  ConditionAlarm alarm(1.0);
  EXPECT_EQ(alarm.update(0.0, AlarmCondition::kClear), Change::kNone);
  EXPECT_EQ(alarm.update(0.5, AlarmCondition::kWarning), Change::kRaised);
  EXPECT_TRUE(alarm.active());
  EXPECT_EQ(alarm.update(1.0, AlarmCondition::kClear), Change::kNone);
  EXPECT_EQ(alarm.update(1.75, AlarmCondition::kClear), Change::kNone);
  EXPECT_EQ(alarm.update(2.0, AlarmCondition::kClear), Change::kCleared);
  EXPECT_FALSE(alarm.active());
}

TEST(ConditionAlarm, ABreakInTheClearConditionStartsTheDelayAnew) {
  for (const AlarmCondition interruption : {AlarmCondition::kWarning, AlarmCondition::kHold}) {
    ConditionAlarm alarm(1.0);
    alarm.update(0.0, AlarmCondition::kWarning);
    alarm.update(1.0, AlarmCondition::kClear);
    EXPECT_EQ(alarm.update(1.75, interruption), Change::kNone);
    EXPECT_EQ(alarm.update(2.0, AlarmCondition::kClear), Change::kNone);
    EXPECT_EQ(alarm.update(2.75, AlarmCondition::kClear), Change::kNone);
    EXPECT_EQ(alarm.update(3.0, AlarmCondition::kClear), Change::kCleared);
  }
}

TEST(ConditionAlarm, HoldNeitherRaisesNorClears) {
  ConditionAlarm alarm(0.0);
  EXPECT_EQ(alarm.update(0.0, AlarmCondition::kHold), Change::kNone);
  EXPECT_FALSE(alarm.active());
  alarm.update(1.0, AlarmCondition::kWarning);
  EXPECT_EQ(alarm.update(100.0, AlarmCondition::kHold), Change::kNone);
  EXPECT_TRUE(alarm.active());
}

TEST(ConditionAlarm, SeverityOnlyGoesUpUntilItClears) {
  ConditionAlarm alarm(0.0);
  EXPECT_EQ(alarm.update(0.0, AlarmCondition::kWarning), Change::kRaised);
  EXPECT_EQ(alarm.update(1.0, AlarmCondition::kDanger), Change::kUpgraded);
  EXPECT_EQ(alarm.update(2.0, AlarmCondition::kWarning), Change::kNone);
  EXPECT_EQ(alarm.severity(), state::Severity::kDanger);
  EXPECT_EQ(alarm.update(3.0, AlarmCondition::kClear), Change::kCleared);
  EXPECT_EQ(alarm.update(4.0, AlarmCondition::kWarning), Change::kRaised);
  EXPECT_EQ(alarm.severity(), state::Severity::kWarning);
}

TEST(ConditionAlarm, ARaiseDelayRidesOverShortExcursions) {
  ConditionAlarm alarm(0.0, 0.5);
  EXPECT_EQ(alarm.update(0.0, AlarmCondition::kWarning), Change::kNone);
  EXPECT_EQ(alarm.update(0.25, AlarmCondition::kWarning), Change::kNone);
  EXPECT_EQ(alarm.update(0.375, AlarmCondition::kClear), Change::kNone);
  EXPECT_EQ(alarm.update(0.5, AlarmCondition::kWarning), Change::kNone);
  EXPECT_EQ(alarm.update(0.75, AlarmCondition::kWarning), Change::kNone);
  EXPECT_EQ(alarm.update(1.0, AlarmCondition::kWarning), Change::kRaised);
}

TEST(ConditionAlarm, NoiseAcrossTheRaiseLimitRaisesOnce) {
  ConditionAlarm alarm(1.0);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coin(0, 1);
  int raised = 0;
  int cleared = 0;
  for (int step = 0; step < 20000; ++step) {
    // At 1 kHz a fair coin never shows the same side for a second.
    const auto condition = coin(random) == 0 ? AlarmCondition::kClear : AlarmCondition::kWarning;
    const Change change = alarm.update(0.001 * step, condition);
    raised += change == Change::kRaised;
    cleared += change == Change::kCleared;
  }
  EXPECT_EQ(raised, 1);
  EXPECT_EQ(cleared, 0);
}

TEST(ConditionAlarm, AClockSetBackStartsTheDelayAnewInsteadOfWaitingForThePast) {
  ConditionAlarm alarm(1.0);
  alarm.update(100.0, AlarmCondition::kWarning);
  alarm.update(101.0, AlarmCondition::kClear);
  EXPECT_EQ(alarm.update(0.0, AlarmCondition::kClear), Change::kNone);
  EXPECT_EQ(alarm.update(1.0, AlarmCondition::kClear), Change::kCleared);
}

TEST(ConditionAlarm, ATimeThatIsNotFiniteChangesNothing) {
  ConditionAlarm alarm(0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(alarm.update(nan, AlarmCondition::kDanger), Change::kNone);
  EXPECT_FALSE(alarm.active());
  alarm.update(0.0, AlarmCondition::kDanger);
  EXPECT_EQ(alarm.update(nan, AlarmCondition::kClear), Change::kNone);
  EXPECT_TRUE(alarm.active());
}

}  // namespace condition_alarm_test
}  // namespace whirl_twin
