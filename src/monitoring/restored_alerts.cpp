#include "monitoring/restored_alerts.h"

#include <fmt/format.h>

#include <algorithm>

#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kSlowest = 2.0;      // s, that an alarm takes to see its cause, without its delay
constexpr char kLoop[] = "the loop";  // no system has such a name

/// What the simulation itself says, and no state.
bool isToldByLoop(const std::string& type) {
  return type == alert_type::kNotFinite || type == alert_type::kStopped ||
         type == alert_type::kAccuracyLost || type == alert_type::kLcmLost;
}

}  // namespace

RestoredAlerts::RestoredAlerts(const AlarmSettings& settings) {
  set(settings);
}

void RestoredAlerts::set(const AlarmSettings& settings) {
  saturation_time_ = settings.saturation_time;
  patience_ = kSlowest + settings.clear_delay;
  for (const auto& [type, delays] : settings.delays) {
    patience_ = std::max(patience_, kSlowest + delays.set + delays.clear);
  }
}

void RestoredAlerts::begin(const AlarmMemory& memory, AlertList& alerts) {
  alerts.restore(memory.alerts, memory.last_id, memory.counts);
  run_ = memory.run;
  any_ = !memory.alerts.empty();
}

double RestoredAlerts::heardFor(const std::string& source, double time) {
  double& since = heard_since_.try_emplace(source, time).first->second;
  since = std::min(since, time);
  return time - since;
}

double RestoredAlerts::patienceOf(const std::string& type) const {
  return patience_ + (type == alert_type::kActuatorSaturated ? saturation_time_ : 0.0);
}

void RestoredAlerts::heard(const std::string& source, double time, AlertList& alerts) {
  if (!any_) {
    return;
  }
  const double heard_for = heardFor(source, time);
  for (const state::Alert& alert : alerts.inDoubt()) {
    const bool about_it = alert.system == source || alert.system == alert_type::kEverybody;
    if (about_it && !isToldByLoop(alert.type) && heard_for >= patienceOf(alert.type)) {
      alerts.clear(alert.system, alert.type, time,
                   fmt::format("{}: its cause was gone when the monitor restarted", alert.system));
    }
  }
  any_ = !alerts.inDoubt().empty();
}

void RestoredAlerts::heard(const state::LoopStatistics& loop, AlertList& alerts) {
  if (!any_) {
    return;
  }
  const TwinRun said{loop.started, loop.epoch};
  const bool tells = loop.started != 0 && run_.has_value();
  const bool another = tells && said != *run_ && other_run_ == said;
  if (tells && said != *run_) {
    other_run_ = said;
    if (!another) {
      return;
    }
  }
  const double heard_for = heardFor(kLoop, loop.at.time);
  for (const state::Alert& alert : alerts.inDoubt()) {
    if (another) {
      alerts.clear(alert.system, alert.type, loop.at.time,
                   fmt::format("{}: the simulation was restarted meanwhile", alert.system));
    } else if (isToldByLoop(alert.type) && heard_for >= patienceOf(alert.type)) {
      alerts.clear(alert.system, alert.type, loop.at.time,
                   fmt::format("{}: its cause was gone when the monitor restarted", alert.system));
    }
  }
  any_ = !alerts.inDoubt().empty();
}

}  // namespace whirl_twin
