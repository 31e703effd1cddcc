// MODEL_INVALID: a warning while the equations of a system do not describe its machine: contact
// lost, a rod's end reached, slipping, tipping, a mass matrix near singular.
#pragma once

#include <memory>
#include <string>

#include "analysis/validity.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class ValidityAlarm {
 public:
  ValidityAlarm(std::string system, std::shared_ptr<const Dynamics> dynamics,
                const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// The parameters of the system have changed.
  void setDynamics(std::shared_ptr<const Dynamics> dynamics);
  /// The state at at.time [s, simulated].
  void update(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Moment<double>& at,
              AlertList& alerts);
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
  void hold() { alarm_.hold(); }

 private:
  std::string system_;
  std::shared_ptr<const Dynamics> dynamics_;
  bool has_conditions_;
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin
