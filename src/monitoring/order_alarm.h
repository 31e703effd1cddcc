// Alarms on what the motion over some turns consists of (OrderState), each where its levels are
// set:
//
//   VIBRATION_ZONE         peak-to-peak vibration in zone C (a warning) or D (danger), of the zones
//                          that ISO 20816 has: new machines in A, unrestricted running in B,
//                          limited in C, damage in D. The levels are the machine's, and are
//                          multiplied while it starts up (start_up.h).
//   SUBSYNCHRONOUS_WHIRL   a forward line slower than the shaft is higher than its level: oil
//                          whirl, which keeps its ratio to the speed, or whip, which keeps its
//                          frequency (signal/line_character.h)
//   RUB                    what whirls backward is wider than its level, or a line of a half or a
//                          third of the speed is: friction at the stator drives a shaft backward,
//                          and a contact once in two or three turns is seen at those. Danger where
//                          the motion as a whole has turned backward.
#pragma once

#include <string>

#include "messages/order_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"
#include "monitoring/start_up.h"
#include "signal/line_character.h"

namespace whirl_twin {

class OrderAlarm {
 public:
  OrderAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// acceleration [rad/s^2] of the shaft.
  void update(const state::OrderState& orders, double acceleration, AlertList& alerts);
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
  void hold();

 private:
  void updateZone(const state::OrderState& orders, double acceleration, AlertList& alerts);
  void updateLine(const state::OrderState& orders, AlertList& alerts);
  void updateRub(const state::OrderState& orders, AlertList& alerts);

  std::string system_;
  double hysteresis_ = 0.0;
  VibrationZones zones_;  // infinite: none
  bool has_zones_ = false;
  double line_level_ = 0.0;  // [m]; infinite: none
  RubLevels rub_levels_;
  StartUp start_up_;
  ConditionAlarm zone_alarm_;
  ConditionAlarm line_alarm_;
  ConditionAlarm rub_alarm_;
  LineCharacter line_;
};

}  // namespace whirl_twin
