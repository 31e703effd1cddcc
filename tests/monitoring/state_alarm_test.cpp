// Alerts on states that cannot be trusted.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "messages/alert.h"
#include "monitoring/data_alarms.h"
#include "scene/built_scene.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace state_alarm_test {

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
  EXPECT_EQ(
      alert->text,
      "rods: error about 3e-06 over the horizon, above the tolerance 1e-06: shorten the step");
  alarm.updateAccuracy(4.0, 1e-7, 1e-6, list);
  alarm.updateAccuracy(10.0, 1e-7, 1e-6, list);
  EXPECT_TRUE(list.active().empty());
}

/// What the simulation says of a rotor that stopped for a cause, in the words of its observer.
std::string stopTextFor(StepStatus status) {
  const BuiltScene scene = build(sceneOf(
      "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 1, stiffness: "
      "1e4, speed: 1}}}}"));
  std::vector<double> record(layoutOf(scene).size);
  const SystemPlace place = layoutOf(scene).system(record.data(), 0);
  place.setStatus(status);
  return stopText(*scene.systems[0], place, describe(status), 41, 0.041);
}

struct Cause {
  StepStatus status;
  const char* type;
  const char* words;
};

class Stopped : public testing::TestWithParam<Cause> {};

TEST_P(Stopped, IsDangerAndTellsItsCauseInOneSentence) {
  const auto& [status, type, words] = GetParam();
  const std::string why = stopTextFor(status);
  AlertList list;
  StateAlarm alarm("rotor", AlarmSettings());
  alarm.updateStopped(0.0, StepStatus::kOk, "", list);
  EXPECT_TRUE(list.active().empty());
  alarm.updateStopped(1.0, status, why, list);
  ASSERT_EQ(list.active().size(), 1u);
  const state::Alert* alert = list.find("rotor", type);
  ASSERT_NE(alert, nullptr);
  EXPECT_EQ(alert->severity, state::Severity::kDanger);
  EXPECT_EQ(alert->text,
            std::string("rotor: stopped in step 41 (t = 0.041 s), ") + words +
                "; last valid state: x = 0 m, x_rate = 0 m/s, y = 0 m, y_rate = 0 m/s");
  list.takeChanged();
  alarm.updateStopped(2.0, status, why, list);
  EXPECT_FALSE(list.takeChanged());
  alarm.updateStopped(3.0, StepStatus::kOk, "", list);
  EXPECT_EQ(list.active().size(), 1u);
  alarm.updateStopped(4.0, StepStatus::kOk, "", list);
  EXPECT_TRUE(list.active().empty());
}

TEST(StoppedSystem, IsToldWhereItsCauseDoesNotArrive) {
  AlertList list;
  StateAlarm alarm("rotor", AlarmSettings());
  alarm.updateStopped(0.0, StepStatus::kOk, "", list);
  alarm.updateStopped(1.0, StepStatus::kNotFinite, "", list);
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_EQ(list.active().front().text, "rotor: stopped, cause not reported");
}

INSTANTIATE_TEST_SUITE_P(
    Causes, Stopped,
    testing::Values(Cause{StepStatus::kNotFinite, "NOT_FINITE", "state not finite"},
                    Cause{StepStatus::kNotConverged, "STOPPED", "implicit step did not converge"},
                    Cause{StepStatus::kOutOfRange, "STOPPED",
                          "the speed of its shaft is outside the prepared range"}),
    [](const auto& test) { return std::to_string(static_cast<int>(test.param.status)); });

TEST(StateAlarm, AStopForAnotherCauseTakesThePlaceOfTheOneBefore) {
  AlertList list;
  StateAlarm alarm("rotor", AlarmSettings());
  alarm.updateStopped(1.0, StepStatus::kNotFinite, "rotor: the first", list);
  alarm.updateStopped(1.1, StepStatus::kOk, "", list);  // reset, and stopped again at once
  alarm.updateStopped(1.2, StepStatus::kNotConverged, "rotor: the second", list);
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_EQ(list.active()[0].type, alert_type::kStopped);
  EXPECT_EQ(list.active()[0].text, "rotor: the second");
}

}  // namespace state_alarm_test
}  // namespace whirl_twin
