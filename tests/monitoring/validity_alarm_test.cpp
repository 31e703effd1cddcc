// A warning while the equations of a system do not describe its machine.
#include <gtest/gtest.h>

#include "../analysis/models_under_test.h"
#include "messages/alert.h"
#include "monitoring/data_alarms.h"

namespace whirl_twin {
namespace validity_alarm_test {

Eigen::VectorXd vector(std::initializer_list<double> x) {
  return Eigen::Map<const Eigen::VectorXd>(x.begin(), static_cast<Eigen::Index>(x.size()));
}

TEST(ValidityAlarm, WarnsWhileASliderIsOffItsRodAndClearsAfterTheDelay) {
  AlarmSettings settings;
  settings.clear_delay = 1.0;
  AlertList list;
  ValidityAlarm alarm("rod",
                      dynamicsOf("rod_slider", {{"slider_mass", 1.0},
                                                {"rod_mass", 0.5},
                                                {"rod_length", 1.2},
                                                {"stiffness", 60.0},
                                                {"free_length", 0.5}}),
                      settings);
  const Eigen::VectorXd rest = vector({0.0, 0.0});
  const auto at = [&](double time, double r) {
    alarm.update(vector({r, 0.1}), rest, {time, 0.0, 0.0, 0.0}, list);
    return list.find("rod", alert_type::kModelInvalid) != nullptr;
  };
  EXPECT_FALSE(at(0.0, 1.1));
  ASSERT_TRUE(at(0.1, 1.25));
  const state::Alert alert = list.active().front();
  EXPECT_EQ(alert.severity, state::Severity::kWarning);
  EXPECT_EQ(alert.raised_time, 0.1);
  EXPECT_NE(alert.text.find("rod_end"), std::string::npos) << alert.text;
  EXPECT_TRUE(at(0.2, 1.0));
  EXPECT_TRUE(at(1.1, 1.0)) << "not before the delay";
  EXPECT_FALSE(at(1.3, 1.0));
}

TEST(ValidityAlarm, IsSilentForASystemThatHoldsEverywhere) {
  AlertList list;
  ValidityAlarm alarm(
      "pendulum",
      dynamicsOf("double_pendulum",
                 {{"mass1", 1.0}, {"mass2", 1.0}, {"length1", 1.0}, {"length2", 1.0}}),
      AlarmSettings());
  alarm.update(vector({100.0, -3.0}), vector({1e3, 1e3}), {}, list);
  EXPECT_TRUE(list.active().empty());
}

}  // namespace validity_alarm_test
}  // namespace whirl_twin
