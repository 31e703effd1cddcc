#include "monitoring/data_lost_alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "algebra/constants.h"
#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kNever = -kInfinity;

}  // namespace

DataLostAlarm::DataLostAlarm(const std::vector<std::string>& systems, const AlarmSettings& settings)
    : timeout_(settings.data_timeout),
      everybody_(settings.delaysOf(alert_type::kDataLost)),
      last_arrival_(kNever),
      flowing_since_(kNever) {
  for (const std::string& system : systems) {
    watches_.push_back({system, kNever, ConditionAlarm(settings.delaysOf(alert_type::kDataLost))});
  }
}

void DataLostAlarm::set(const AlarmSettings& settings) {
  timeout_ = settings.data_timeout;
  const AlarmDelays delays = settings.delaysOf(alert_type::kDataLost);
  everybody_.setDelays(delays);
  for (Watch& watch : watches_) {
    watch.alarm.setDelays(delays);
  }
}

void DataLostAlarm::received(const std::string& source, double wall_time, double time,
                             AlertList& alerts) {
  if (wall_time - last_arrival_ > timeout_) {
    flowing_since_ = wall_time;
  }
  last_arrival_ = wall_time;
  for (Watch& watch : watches_) {
    if (watch.system == source) {
      watch.heard_at = wall_time;
    }
    judge(watch, wall_time, time, alerts);
  }
}

void DataLostAlarm::tick(double wall_time, double time, bool paused, AlertList& alerts) {
  if (last_arrival_ == kNever) {
    return;  // nothing has been promised yet
  }
  const double silence = wall_time - last_arrival_;
  const bool lost = silence > timeout_ && !paused;
  const AlarmCondition condition = lost ? AlarmCondition::kWarning : AlarmCondition::kClear;
  if (everybody_.update(wall_time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(alert_type::kEverybody, alert_type::kDataLost, time, "states are received again");
  } else if (everybody_.active() && lost) {
    state::Alert alert;
    alert.system = alert_type::kEverybody;
    alert.type = alert_type::kDataLost;
    alert.severity = everybody_.severity();
    alert.time = time;
    alert.text = "no states are received: nothing is monitored";
    alerts.raise(std::move(alert), "all data lost");
  }
}

void DataLostAlarm::judge(Watch& watch, double wall_time, double time, AlertList& alerts) const {
  // After a pause the silence counts from when the first source came back.
  const double silence = wall_time - std::max(watch.heard_at, flowing_since_);
  AlarmCondition condition = AlarmCondition::kHold;
  if (silence > timeout_) {
    condition = AlarmCondition::kWarning;
  } else if (watch.heard_at >= flowing_since_) {
    condition = AlarmCondition::kClear;
  }
  if (watch.alarm.update(wall_time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(watch.system, alert_type::kDataLost, time,
                 fmt::format("{}: states are received again", watch.system));
  } else if (watch.alarm.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = watch.system;
    alert.type = alert_type::kDataLost;
    alert.severity = watch.alarm.severity();
    alert.time = time;
    alert.text =
        fmt::format("{}: no state for {:.1f} s of wall time, while those of other systems arrive",
                    watch.system, silence);
    alerts.raise(std::move(alert), "data lost");
  }
}

}  // namespace whirl_twin
