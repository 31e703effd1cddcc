// Alerts on states that cannot be trusted.
#include "monitoring/state_alarm.h"

#include <gtest/gtest.h>

#include <limits>

#include "messages/alert_types.h"

namespace whirl_twin {
namespace {

TEST(StateAlarm, AnEnergyBalanceThatIsOffInEitherDirectionWarns) {
  for (const double residual : {2.0e-6, -2.0e-6}) {
    AlertList list;
    StateAlarm alarm("pendulum", AlarmSettings());
    alarm.updateEnergy(0.0, 0.99e-6, list);
    EXPECT_TRUE(list.active().empty());
    alarm.updateEnergy(0.5, residual, list);
    EXPECT_TRUE(list.active().empty()) << "one message alone, as after one step from rest";
    alarm.updateEnergy(0.6, 0.99e-6, list);
    alarm.updateEnergy(0.7, residual, list);
    EXPECT_TRUE(list.active().empty()) << "not two running";
    alarm.updateEnergy(1.0, residual, list);
    ASSERT_NE(list.find("pendulum", alert_type::kEnergyResidual), nullptr);
    EXPECT_EQ(list.active()[0].severity, state::Severity::kWarning);
    for (int step = 0; step < 10; ++step) {
      alarm.updateEnergy(2.0 + step, 0.99e-6, list);
    }
    EXPECT_EQ(list.active().size(), 1u) << "within the hysteresis";
    for (int step = 0; step < 10; ++step) {
      alarm.updateEnergy(20.0 + step, std::numeric_limits<double>::quiet_NaN(), list);
    }
    EXPECT_EQ(list.active().size(), 1u) << "no number, no verdict";
    alarm.updateEnergy(40.0, 1e-9, list);
    alarm.updateEnergy(41.0, 1e-9, list);
    EXPECT_TRUE(list.active().empty());
  }
}

TEST(StateAlarm, AnErrorBeyondWhatIsPromisedWarns) {
  AlertList list;
  StateAlarm alarm("rods", AlarmSettings());
  const double none = std::numeric_limits<double>::quiet_NaN();
  alarm.updateAccuracy(0.0, 0.9e-6, 1e-6, list);
  alarm.updateAccuracy(1.0, none, 1e-6, list);
  alarm.updateAccuracy(2.0, 1.0, none, list);  // an integrator that was named promises nothing
  EXPECT_TRUE(list.active().empty());
  alarm.updateAccuracy(3.0, 3e-6, 1e-6, list);
  const state::Alert* alert = list.find("rods", alert_type::kAccuracyLost);
  ASSERT_NE(alert, nullptr);
  EXPECT_EQ(alert->severity, state::Severity::kWarning);
  EXPECT_EQ(alert->text,
            "rods: error about 3e-06 over its horizon, more than its tolerance 1e-06: shorten the "
            "step");
  alarm.updateAccuracy(4.0, 1e-7, 1e-6, list);
  alarm.updateAccuracy(10.0, 1e-7, 1e-6, list);
  EXPECT_TRUE(list.active().empty());
}

TEST(StateAlarm, AStoppedSystemIsDangerAndNamesItsCause) {
  AlertList list;
  StateAlarm alarm("rotor", AlarmSettings());
  alarm.updateFinite(0.0, false, "", list);
  EXPECT_TRUE(list.active().empty());
  alarm.updateFinite(1.0, true, "step 4711, x = nan", list);
  const state::Alert* alert = list.find("rotor", alert_type::kNotFinite);
  ASSERT_NE(alert, nullptr);
  EXPECT_EQ(alert->severity, state::Severity::kDanger);
  EXPECT_EQ(alert->text, "rotor: stopped, a state is not finite: step 4711, x = nan");
  list.takeChanged();
  alarm.updateFinite(2.0, true, "step 4711, x = nan", list);
  EXPECT_FALSE(list.takeChanged());
  alarm.updateFinite(3.0, false, "", list);
  EXPECT_EQ(list.active().size(), 1u);
  alarm.updateFinite(4.0, false, "", list);
  EXPECT_TRUE(list.active().empty());
}

}  // namespace
}  // namespace whirl_twin
