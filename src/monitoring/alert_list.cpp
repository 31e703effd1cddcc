#include "monitoring/alert_list.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kCountdownPeriod = 0.2;  // s
const std::string kSeen = " (acknowledged by ";

/// That other alerts are held back or levels raised: no state of the machine.
bool isNotice(const state::Alert& alert) {
  return alert.type == alert_type::kInhibited || alert.type == alert_type::kTripMultiplied;
}

}  // namespace

void AlertList::raise(state::Alert alert, const std::string& decision) {
  alert.raised = true;
  const auto entry = locate(alert.system, alert.type);
  if (entry != entries_.end()) {
    bringUpToDate(*entry, std::move(alert), decision);
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
  tell(alert);
  const double time = alert.time;
  entries_.push_back({std::move(alert), decision, time});
  sort();
}

void AlertList::bringUpToDate(Entry& entry, state::Alert alert, const std::string& decision) {
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
    alert.text += entry.seen;
  } else {
    entry.seen.clear();
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
  tell(entry.alert);
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
  alert.text = reason + (latches ? entry->seen : "");
  alert.time_to_entry = state::Alert::kNone;
  alert.latched = latches;
  alert.raised = latches;
  entry->in_doubt = false;
  entry->restored = latches ? alert.severity : state::Severity::kInfo;
  tell(alert);
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
      entry.seen = by.empty() ? "" : kSeen + by + ")";
      alert.text += entry.seen;
      tell(alert);
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
      tell(entry.alert);
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
    const std::size_t seen = alert.acknowledged ? alert.text.rfind(kSeen) : std::string::npos;
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

void AlertList::tell(const state::Alert& alert) {
  events_.push_back(alert);
  changed_ = true;
}

void AlertList::sort() {
  // The id tells the age: simulated time may have been set back since.
  std::sort(entries_.begin(), entries_.end(), [](const Entry& left, const Entry& right) {
    if (left.alert.severity != right.alert.severity) {
      return left.alert.severity > right.alert.severity;
    }
    return left.alert.id < right.alert.id;
  });
}

}  // namespace whirl_twin
