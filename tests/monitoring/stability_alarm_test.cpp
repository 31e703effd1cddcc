// Alerts on the stability margin of one system.
#include "monitoring/stability_alarm.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "analysis/routh.h"
#include "messages/alert.h"

namespace whirl_twin {
namespace stability_alarm_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr Verdict kStable = Verdict::kAsymptoticallyStable;
constexpr Verdict kMarginal = Verdict::kMarginal;
constexpr Verdict kRepeatedImaginary = Verdict::kRepeatedImaginary;
constexpr Verdict kUnstable = Verdict::kUnstable;
constexpr Verdict kUncertain = Verdict::kUncertain;

state::StabilityMargin marginOf(double time, Verdict verdict, double log_decrement = 0.5,
                                double decay_rate = 1.0) {
  static const char* const kNames[] = {"asymptotically_stable", "marginal", "repeated_imaginary",
                                       "unstable", "uncertain"};
  state::StabilityMargin margin;
  margin.at.time = time;
  margin.verdict = static_cast<std::uint8_t>(verdict);
  margin.verdict_name = kNames[margin.verdict];
  margin.speed = 100.0;
  margin.log_decrement = log_decrement;
  margin.decay_rate = decay_rate;
  margin.right = verdict == kUnstable ? 2 : 0;
  return margin;
}

class StabilityAlarmTest : public testing::Test {
 protected:
  const state::Alert* unstable() const { return list_.find("rotor", alert_type::kUnstable); }
  const state::Alert* lowDamping() const { return list_.find("rotor", alert_type::kLowDamping); }

  AlertList list_;
  StabilityAlarm alarm_{"rotor", AlarmSettings()};
};

TEST_F(StabilityAlarmTest, AnUnstableVerdictIsDangerAtOnceAndClearsAfterTheDelay) {
  alarm_.update(marginOf(0.0, kStable), list_);
  EXPECT_TRUE(list_.active().empty());
  alarm_.update(marginOf(0.1, kUnstable, -0.05, -2.5), list_);
  ASSERT_NE(unstable(), nullptr);
  EXPECT_EQ(unstable()->severity, state::Severity::kDanger);
  EXPECT_EQ(unstable()->decay_rate, -2.5);
  EXPECT_EQ(unstable()->text,
            "rotor at 100.0 rad/s (955 rpm): unstable, 2 roots in the right half-plane, growth "
            "rate 2.5 1/s: "
            "add external damping, or remove the destabilizing force");
  state::StabilityMargin periodic = marginOf(0.15, kUnstable, -0.05, -2.5);
  periodic.judged_about = state::StabilityMargin::About::kPeriodicMotion;
  periodic.right = 1;
  alarm_.update(periodic, list_);
  EXPECT_EQ(
      unstable()->text,
      "rotor at 100.0 rad/s (955 rpm) (its periodic motion): unstable, 1 Floquet multiplier "
      "outside the "
      "unit circle, growth rate 2.5 1/s: add external damping, or remove the destabilizing force");
  alarm_.update(marginOf(0.2, kStable), list_);
  alarm_.update(marginOf(1.0, kStable), list_);
  EXPECT_NE(unstable(), nullptr);
  alarm_.update(marginOf(1.3, kStable), list_);
  EXPECT_EQ(unstable(), nullptr);
}

TEST_F(StabilityAlarmTest, RouthAndEigenvaluesThatDisagreeAreAWarning) {
  const auto disagreement = [&] { return list_.find("rotor", alert_type::kRouthDisagrees); };
  alarm_.update(marginOf(0.0, kUncertain), list_);
  EXPECT_EQ(disagreement(), nullptr) << "uncertain is no disagreement";
  state::StabilityMargin margin = marginOf(0.1, kStable);
  margin.right_by_eigenvalues = 2;
  margin.routh_disagrees = true;
  alarm_.update(margin, list_);
  ASSERT_NE(disagreement(), nullptr);
  EXPECT_EQ(disagreement()->severity, state::Severity::kWarning);
  EXPECT_EQ(
      disagreement()->text,
      "rotor at 100.0 rad/s (955 rpm): Routh's test counts 0 roots in the right half-plane, the "
      "eigenvalues 2: the verdict is unreliable");
  EXPECT_EQ(unstable(), nullptr);
  alarm_.update(marginOf(0.2, kStable), list_);
  alarm_.update(marginOf(0.8, kUncertain, kNaN, kNaN), list_);  // beyond a double: nothing is known
  alarm_.update(marginOf(1.3, kStable), list_);
  EXPECT_NE(disagreement(), nullptr) << "the clear delay begins anew";
  alarm_.update(marginOf(2.4, kStable), list_);
  EXPECT_EQ(disagreement(), nullptr);
}

TEST_F(StabilityAlarmTest, AnUncertainVerdictNeverClears) {
  alarm_.update(marginOf(0.0, kUncertain), list_);
  EXPECT_TRUE(list_.active().empty()) << "nor does it raise";
  alarm_.update(marginOf(1.0, kUnstable), list_);
  list_.takeChanged();
  for (int step = 0; step < 100; ++step) {
    alarm_.update(marginOf(2.0 + step, kUncertain), list_);
    ASSERT_NE(unstable(), nullptr);
    EXPECT_EQ(unstable()->severity, state::Severity::kDanger);
    EXPECT_EQ(list_.takeChanged(), step == 0) << "told once";
  }
  // Nor does it let a clear delay run on that it interrupts.
  alarm_.update(marginOf(200.0, kStable), list_);
  alarm_.update(marginOf(200.5, kUncertain), list_);
  alarm_.update(marginOf(201.1, kStable), list_);
  EXPECT_NE(unstable(), nullptr);
}

TEST_F(StabilityAlarmTest, RepeatedImaginaryRootsWarnAndUpgradeWhenTheyMoveToTheRight) {
  alarm_.update(marginOf(0.0, kRepeatedImaginary, 0.0, 0.0), list_);
  ASSERT_NE(unstable(), nullptr);
  EXPECT_EQ(unstable()->severity, state::Severity::kWarning);
  const std::uint32_t id = unstable()->id;
  alarm_.update(marginOf(0.1, kUnstable), list_);
  EXPECT_EQ(unstable()->severity, state::Severity::kDanger);
  EXPECT_EQ(unstable()->id, id);
  alarm_.update(marginOf(0.2, kRepeatedImaginary, 0.0, 0.0), list_);
  EXPECT_EQ(unstable()->severity, state::Severity::kDanger) << "until cleared";
}

TEST_F(StabilityAlarmTest, SaysWhatToDoAboutIt) {
  state::StabilityMargin growing = marginOf(0.0, kUnstable, -0.05, -2.5);
  growing.threshold_below = 80.0;
  alarm_.update(growing, list_);
  ASSERT_NE(unstable(), nullptr);
  EXPECT_NE(unstable()->text.find(": run below 80.0 rad/s (764 rpm)"), std::string::npos);

  AlertList both;
  growing.threshold_above = 130.0;
  StabilityAlarm between("rotor", AlarmSettings());
  between.update(growing, both);
  ASSERT_NE(both.find("rotor", alert_type::kUnstable), nullptr);
  EXPECT_NE(both.find("rotor", alert_type::kUnstable)
                ->text.find(": run below 80.0 rad/s (764 rpm) or above 130.0 rad/s (1241 rpm)"),
            std::string::npos);

  AlertList slow;
  StabilityAlarm decaying("rotor", AlarmSettings());
  state::StabilityMargin margin = marginOf(0.0, kStable, 0.05);
  margin.threshold_above = 110.0;
  decaying.update(margin, slow);
  ASSERT_NE(slow.find("rotor", alert_type::kLowDamping), nullptr);
  EXPECT_NE(slow.find("rotor", alert_type::kLowDamping)
                ->text.find(": keep away from 110.0 rad/s (1050 rpm), or add external damping"),
            std::string::npos);

  AlertList near;
  StabilityAlarm without_threshold("rotor", AlarmSettings());
  margin = marginOf(0.0, kStable, 0.05);
  margin.nearest_parameter = "damping";
  margin.nearest_change = -0.25;
  without_threshold.update(margin, near);
  ASSERT_NE(near.find("rotor", alert_type::kLowDamping), nullptr);
  EXPECT_NE(
      near.find("rotor", alert_type::kLowDamping)->text.find("; unstable if damping falls by 25 %"),
      std::string::npos);

  AlertList falling;
  StabilityAlarm without_shaft("pendulum", AlarmSettings());
  growing = marginOf(0.0, kUnstable, -0.05, -2.5);
  growing.speed = std::numeric_limits<double>::quiet_NaN();
  without_shaft.update(growing, falling);
  ASSERT_NE(falling.find("pendulum", alert_type::kUnstable), nullptr);
  EXPECT_NE(falling.find("pendulum", alert_type::kUnstable)->text.find(": add damping, or"),
            std::string::npos);
}

TEST_F(StabilityAlarmTest, AMarginalSystemIsNotUnstable) {
  alarm_.update(marginOf(0.0, kMarginal, 0.0, 0.0), list_);
  EXPECT_EQ(unstable(), nullptr);
  EXPECT_NE(lowDamping(), nullptr) << "but it has no damping";
}

TEST_F(StabilityAlarmTest, LowDampingWarnsBelowTheLimitAndClearsBeyondTheHysteresis) {
  alarm_.update(marginOf(0.0, kStable, 0.101), list_);
  EXPECT_EQ(lowDamping(), nullptr);
  alarm_.update(marginOf(1.0, kStable, 0.099), list_);
  ASSERT_NE(lowDamping(), nullptr);
  EXPECT_EQ(lowDamping()->severity, state::Severity::kWarning);
  EXPECT_EQ(lowDamping()->text,
            "rotor at 100.0 rad/s (955 rpm): log decrement 0.099, below 0.1: "
            "add external damping");
  for (int step = 0; step < 20; ++step) {
    alarm_.update(marginOf(2.0 + step, kStable, 0.101), list_);
  }
  EXPECT_NE(lowDamping(), nullptr) << "0.101 is within the hysteresis of 2 percent";
  alarm_.update(marginOf(30.0, kStable, 0.103), list_);
  alarm_.update(marginOf(31.0, kStable, 0.103), list_);
  EXPECT_EQ(lowDamping(), nullptr);
}

TEST_F(StabilityAlarmTest, AnUnstableSystemIsNotAlsoReportedAsLightlyDamped) {
  alarm_.update(marginOf(0.0, kUnstable, -0.1, -1.0), list_);
  EXPECT_EQ(list_.active().size(), 1u);
  EXPECT_EQ(lowDamping(), nullptr);
}

TEST_F(StabilityAlarmTest, AnOverdampedSystemIsWellDamped) {
  alarm_.update(marginOf(0.0, kStable, 0.05), list_);
  alarm_.update(marginOf(1.0, kStable, kNaN), list_);
  alarm_.update(marginOf(2.0, kStable, kNaN), list_);
  EXPECT_EQ(lowDamping(), nullptr);
}

TEST_F(StabilityAlarmTest, APendulumWithoutAShaftHasNoRotorCriterion) {
  state::StabilityMargin margin = marginOf(0.0, kMarginal, 0.0, 0.0);
  margin.speed = kNaN;
  alarm_.update(margin, list_);
  EXPECT_TRUE(list_.active().empty());
  margin.verdict = static_cast<std::uint8_t>(kUnstable);
  alarm_.update(margin, list_);
  EXPECT_NE(unstable(), nullptr) << "but it can be unstable";
}

TEST_F(StabilityAlarmTest, MarginsThatAreNotNumbersNeitherRaiseNorClear) {
  alarm_.update(marginOf(0.0, kMarginal, kNaN, kNaN), list_);
  EXPECT_TRUE(list_.active().empty());
  alarm_.update(marginOf(1.0, kStable, 0.05), list_);
  alarm_.update(marginOf(2.0, kStable, 0.5, kNaN), list_);
  alarm_.update(marginOf(9.0, kStable, 0.5, kNaN), list_);
  EXPECT_NE(lowDamping(), nullptr);
}

TEST(StabilityAlarm, ADecayRateLimitIsWatchedWhenSetAndOffAtZero) {
  AlarmSettings settings;
  settings.log_decrement_warning = 0.0;
  AlertList list;
  StabilityAlarm off("rotor", settings);
  off.update(marginOf(0.0, kMarginal, -1e-17, -1e-17), list);
  EXPECT_TRUE(list.active().empty());

  settings.decay_rate_alarm = 0.5;
  StabilityAlarm on("rotor", settings);
  on.update(marginOf(0.0, kStable, 0.01, 0.6), list);
  EXPECT_TRUE(list.active().empty());
  on.update(marginOf(0.1, kStable, 0.01, 0.4), list);
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_EQ(list.active()[0].text,
            "rotor at 100.0 rad/s (955 rpm): decay rate 0.4 1/s, below 0.5 1/s: "
            "add external damping");
  on.update(marginOf(1.0, kStable, 0.01, 0.6), list);
  on.update(marginOf(2.0, kStable, 0.01, 0.6), list);
  EXPECT_TRUE(list.active().empty());
}

TEST_F(StabilityAlarmTest, LowDampingIsThatOfTheRotorAndNotOfItsShapes) {
  state::StabilityMargin margin = marginOf(0.0, kStable, 0.01, 0.5);
  margin.unreduced_decay_rate = 3.0;
  margin.unreduced_log_decrement = 0.4;
  for (; margin.at.time < 5.0; margin.at.time += 0.5) {
    alarm_.update(margin, list_);
  }
  EXPECT_EQ(lowDamping(), nullptr);
  margin.log_decrement = 0.4;
  margin.unreduced_log_decrement = 0.01;
  for (; margin.at.time < 10.0; margin.at.time += 0.5) {
    alarm_.update(margin, list_);
  }
  ASSERT_NE(lowDamping(), nullptr);
  EXPECT_NE(lowDamping()->text.find("log decrement 0.01"), std::string::npos);
}

TEST_F(StabilityAlarmTest, ARotorAndItsShapesThatDisagreeAreAWarning) {
  state::StabilityMargin margin = marginOf(0.0, kUncertain, 0.1, 0.5);
  margin.unreduced_decay_rate = -0.2;
  margin.unreduced_log_decrement = -0.04;
  margin.reduction_disagrees = true;
  alarm_.update(margin, list_);
  ASSERT_NE(unstable(), nullptr);
  EXPECT_EQ(unstable()->severity, state::Severity::kWarning);
  EXPECT_EQ(
      unstable()->text,
      "rotor at 100.0 rad/s (955 rpm): stability uncertain, the models disagree: decay rate "
      "-0.2 1/s of the full-order model, 0.5 1/s of the reduced-order model: retain more modes");
  alarm_.update(marginOf(1.0, kUnstable, -0.05, -2.5), list_);
  EXPECT_EQ(unstable()->severity, state::Severity::kDanger);
}

}  // namespace stability_alarm_test
}  // namespace whirl_twin
