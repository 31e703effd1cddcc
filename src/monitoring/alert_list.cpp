#include "monitoring/alert_list.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kCountdownPeriod = 0.2;  // s

}  // namespace

void AlertList::raise(state::Alert alert, const std::string& decision) {
  alert.raised = true;
  const auto entry = locate(alert.system, alert.type);
  if (entry == entries_.end()) {
    alert.id = ++last_id_;
    alert.raised_time = alert.time;
    events_.push_back(alert);
    const double time = alert.time;
    entries_.push_back({std::move(alert), decision, time});
  } else {
    alert.id = entry->alert.id;
    alert.raised_time = entry->alert.raised_time;
    const bool same = alert.severity == entry->alert.severity && decision == entry->decision;
    entry->alert = std::move(alert);
    if (same) {
      Entry& now = *entry;
      if (std::isfinite(now.alert.time_to_entry) &&
          !(std::abs(now.alert.time - now.counted_at) < kCountdownPeriod)) {
        now.counted_at = now.alert.time;
        changed_ = true;
      }
      return;
    }
    entry->decision = decision;
    events_.push_back(entry->alert);
  }
  changed_ = true;
  sort();
}

void AlertList::clear(const std::string& system, const std::string& type, double time,
                      const std::string& reason) {
  const auto entry = locate(system, type);
  if (entry == entries_.end()) {
    return;
  }
  state::Alert cleared = std::move(entry->alert);
  entries_.erase(entry);
  cleared.raised = false;
  cleared.time = time;
  cleared.text = reason;
  events_.push_back(std::move(cleared));
  changed_ = true;
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
