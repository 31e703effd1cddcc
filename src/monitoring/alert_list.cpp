#include "monitoring/alert_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "messages/alert.h"
#include "messages/wall_clock.h"

namespace whirl_twin {
namespace {

constexpr double kCountdownPeriod = 0.2;  // s
const std::string kAcknowledged = " (acknowledged by ";

/// That other alerts are inhibited or levels multiplied: no state of the machine.
bool isNotice(const state::Alert& alert) {
  return alert.type == alert_type::kInhibited || alert.type == alert_type::kTripMultiplied;
}

/// Of the wall clock, in so many seconds.
std::string clockText(double from_now) {
  return isoTime(wallClock() + std::llround(1.0e9 * from_now));
}

constexpr double kSlowest = 2.0;      // s, that an alarm takes to find its cause, without its delay
constexpr char kLoop[] = "the loop";  // no system has such a name

/// Reported by the simulation itself, and by no state.
bool isOfLoop(const std::string& type) {
  return type == alert_type::kNotFinite || type == alert_type::kStopped ||
         type == alert_type::kAccuracyLost || type == alert_type::kLcmLost;
}

}  // namespace

void AlertList::raise(state::Alert alert, const std::string& decision) {
  alert.raised = true;
  const auto entry = locate(alert.system, alert.type);
  if (entry != entries_.end()) {
    update(*entry, std::move(alert), decision);
  } else if (inhibited_.count(alert.system) == 0 || isNotice(alert)) {
    add(std::move(alert), decision);
  }
}

void AlertList::add(state::Alert alert, const std::string& decision) {
  alert.id = ++last_id_;
  alert.raised_time = alert.time;
  alert.repeats = counts_[{alert.system, alert.type}]++;
  alert.first_out = std::none_of(entries_.begin(), entries_.end(), [&](const Entry& other) {
    return other.alert.system == alert.system && !isNotice(other.alert);
  });
  record(alert);
  const double time = alert.time;
  entries_.push_back({std::move(alert), decision, time});
  sort();
}

void AlertList::update(Entry& entry, state::Alert alert, const std::string& decision) {
  const state::Alert& known = entry.alert;
  alert.id = known.id;
  alert.raised_time = known.raised_time;
  alert.first_out = known.first_out;
  alert.repeats = known.repeats;
  alert.acknowledged = known.acknowledged;
  alert.severity = std::max(alert.severity, entry.restored);
  entry.in_doubt = false;
  const bool back = known.latched;
  if (back) {
    alert.repeats = counts_[{alert.system, alert.type}]++;
  }
  const bool worse = alert.severity > known.severity;
  const bool same = alert.severity == known.severity && decision == entry.decision && !back;
  if (worse || back) {
    alert.acknowledged = false;
  }
  if (alert.acknowledged) {
    alert.text += entry.acknowledgement;
  } else {
    entry.acknowledgement.clear();
  }
  entry.alert = std::move(alert);
  if (same) {
    if (std::isfinite(entry.alert.time_to_entry) &&
        !(std::abs(entry.alert.time - entry.counted_at) < kCountdownPeriod)) {
      entry.counted_at = entry.alert.time;
      changed_ = true;
    }
    return;
  }
  entry.decision = decision;
  record(entry.alert);
  sort();
}

void AlertList::clear(const std::string& system, const std::string& type, double time,
                      const std::string& reason) {
  const auto entry = locate(system, type);
  if (entry == entries_.end() || entry->alert.latched) {
    return;
  }
  const bool latches =
      !isNotice(entry->alert) &&
      (latch_ == Latch::kAll ||
       (latch_ == Latch::kDanger && entry->alert.severity == state::Severity::kDanger));
  state::Alert& alert = entry->alert;
  alert.time = time;
  alert.text = reason + (latches ? entry->acknowledgement : "");
  alert.time_to_entry = state::Alert::kNone;
  alert.latched = latches;
  alert.raised = latches;
  entry->in_doubt = false;
  entry->restored = latches ? alert.severity : state::Severity::kInfo;
  record(alert);
  if (!latches) {
    entries_.erase(entry);
  }
}

std::size_t AlertList::acknowledge(const std::string& system, const std::string& type,
                                   const std::string& by) {
  std::size_t count = 0;
  for (Entry& entry : entries_) {
    state::Alert& alert = entry.alert;
    if (!alert.acknowledged && (system.empty() || system == alert.system) &&
        (type.empty() || type == alert.type)) {
      alert.acknowledged = true;
      entry.acknowledgement = by.empty() ? "" : kAcknowledged + by + ")";
      alert.text += entry.acknowledgement;
      record(alert);
      ++count;
    }
  }
  return count;
}

std::size_t AlertList::reset(double time, const std::string& by) {
  acknowledge("", "", by);
  counts_.clear();
  for (Entry& entry : entries_) {
    if (entry.alert.latched) {
      entry.alert.latched = entry.alert.raised = false;
      entry.alert.time = time;
      record(entry.alert);
    } else {
      entry.restored = state::Severity::kInfo;
      counts_[{entry.alert.system, entry.alert.type}] = 1;
    }
  }
  const auto off = std::remove_if(entries_.begin(), entries_.end(),
                                  [](const Entry& entry) { return !entry.alert.raised; });
  const auto count = static_cast<std::size_t>(entries_.end() - off);
  entries_.erase(off, entries_.end());
  return count;
}

void AlertList::setInhibited(const std::string& system, bool inhibited) {
  if (inhibited) {
    inhibited_.insert(system);
  } else {
    inhibited_.erase(system);
  }
}

void AlertList::restore(const std::vector<state::Alert>& alerts, std::uint32_t last_id,
                        Counts counts) {
  for (const state::Alert& alert : alerts) {
    const std::size_t seen =
        alert.acknowledged ? alert.text.rfind(kAcknowledged) : std::string::npos;
    entries_.push_back({alert, alert.text, alert.time, !alert.latched, alert.severity,
                        seen == std::string::npos ? "" : alert.text.substr(seen)});
  }
  last_id_ = std::max(last_id_, last_id);
  counts_ = std::move(counts);
  changed_ = true;
  sort();
}

std::vector<state::Alert> AlertList::inDoubt() const {
  std::vector<state::Alert> alerts;
  for (const Entry& entry : entries_) {
    if (entry.in_doubt) {
      alerts.push_back(entry.alert);
    }
  }
  return alerts;
}

const state::Alert* AlertList::find(const std::string& system, const std::string& type) const {
  for (const Entry& entry : entries_) {
    if (entry.alert.system == system && entry.alert.type == type) {
      return &entry.alert;
    }
  }
  return nullptr;
}

std::vector<state::Alert> AlertList::active() const {
  std::vector<state::Alert> alerts;
  alerts.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    alerts.push_back(entry.alert);
  }
  return alerts;
}

bool AlertList::takeChanged() {
  return std::exchange(changed_, false);
}

std::vector<state::Alert> AlertList::takeEvents() {
  return std::exchange(events_, {});
}

std::vector<AlertList::Entry>::iterator AlertList::locate(const std::string& system,
                                                          const std::string& type) {
  return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.alert.system == system && entry.alert.type == type;
  });
}

void AlertList::record(const state::Alert& alert) {
  events_.push_back(alert);
  changed_ = true;
}

void AlertList::sort() {
  // The id gives the age: simulated time may have been set back since.
  std::sort(entries_.begin(), entries_.end(), [](const Entry& left, const Entry& right) {
    if (left.alert.severity != right.alert.severity) {
      return left.alert.severity > right.alert.severity;
    }
    return left.alert.id < right.alert.id;
  });
}

void RestoredAlerts::restore(const AlarmMemory& memory, AlertList& alerts) {
  alerts.restore(memory.alerts, memory.last_id, memory.counts);
  run_ = memory.run;
  any_ = !memory.alerts.empty();
}

double RestoredAlerts::receivedFor(const std::string& source, double time) {
  double& since = received_since_.try_emplace(source, time).first->second;
  since = std::min(since, time);
  return time - since;
}

double RestoredAlerts::delayOf(const std::string& type) const {
  double delay = settings_->clear_delay;
  for (const auto& [other, delays] : settings_->delays) {
    delay = std::max(delay, delays.set + delays.clear);
  }
  return kSlowest + delay +
         (type == alert_type::kActuatorSaturated ? settings_->saturation_time : 0.0);
}

void RestoredAlerts::received(const std::string& source, double time, AlertList& alerts) {
  if (!any_) {
    return;
  }
  const double received_for = receivedFor(source, time);
  for (const state::Alert& alert : alerts.inDoubt()) {
    const bool about_it = alert.system == source || alert.system == alert_type::kEverybody;
    if (about_it && !isOfLoop(alert.type) && received_for >= delayOf(alert.type)) {
      alerts.clear(alert.system, alert.type, time,
                   fmt::format("{}: its cause was gone when the monitor restarted", alert.system));
    }
  }
  any_ = !alerts.inDoubt().empty();
}

void RestoredAlerts::received(const state::LoopStatistics& loop, AlertList& alerts) {
  if (!any_) {
    return;
  }
  const TwinRun reported{loop.started, loop.epoch};
  const bool reports = loop.started != 0 && run_.has_value();
  const bool another = reports && reported != *run_ && other_run_ == reported;
  if (reports && reported != *run_) {
    other_run_ = reported;
    if (!another) {
      return;
    }
  }
  const double received_for = receivedFor(kLoop, loop.at.time);
  for (const state::Alert& alert : alerts.inDoubt()) {
    if (another) {
      alerts.clear(alert.system, alert.type, loop.at.time,
                   fmt::format("{}: the simulation was restarted meanwhile", alert.system));
    } else if (isOfLoop(alert.type) && received_for >= delayOf(alert.type)) {
      alerts.clear(alert.system, alert.type, loop.at.time,
                   fmt::format("{}: its cause was gone when the monitor restarted", alert.system));
    }
  }
  any_ = !alerts.inDoubt().empty();
}

void Inhibitions::set(const std::string& system, double duration, double wall_time,
                      const std::string& by, AlertList& alerts) {
  const auto known = all_.find(system);
  if (duration > 0.0) {
    all_[system] = {wall_time + duration, by,
                    fmt::format("since {} until {}", clockText(0.0), clockText(duration))};
    alerts.setInhibited(system, true);
  } else if (known != all_.end()) {
    known->second.until = wall_time;
    known->second.times += fmt::format(", ended by {} at {}", by, clockText(0.0));
  }
}

void Inhibitions::update(double wall_time, double time, AlertList& alerts) {
  for (auto one = all_.begin(); one != all_.end();) {
    const auto& [system, inhibition] = *one;
    if (wall_time >= inhibition.until) {
      alerts.setInhibited(system, false);
      alerts.clear(system, alert_type::kInhibited, time,
                   fmt::format("alerts of {} are active again: inhibited by {} {}", system,
                               inhibition.by, inhibition.times));
      one = all_.erase(one);
      continue;
    }
    state::Alert alert;
    alert.type = alert_type::kInhibited;
    alert.system = system;
    alert.severity = state::Severity::kWarning;
    alert.time = time;
    alert.text =
        fmt::format("alerts of {} are inhibited by {} {}", system, inhibition.by, inhibition.times);
    const state::Alert* const known = alerts.find(system, alert.type);
    if (known == nullptr || known->text != alert.text) {
      alerts.raise(alert, alert.text);
    }
    ++one;
  }
}

double Inhibitions::remaining(const std::string& system, double wall_time) const {
  const auto found = all_.find(system);
  return found == all_.end() ? 0.0 : found->second.until - wall_time;
}

std::string Inhibitions::text() const {
  std::vector<std::string> systems;
  for (const auto& [system, inhibition] : all_) {
    systems.push_back(system);
  }
  return systems.empty()
             ? ""
             : fmt::format("alerts of {} are inhibited by {} {}", fmt::join(systems, ", "),
                           all_.begin()->second.by, all_.begin()->second.times);
}

}  // namespace whirl_twin
