// The complete list of active alerts, as it is published latched: most severe first, among equals
// the oldest first. An alert is known by its system and type and keeps its id from raised to
// cleared; the next one of the same kind gets a new id.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/alert.h"

namespace whirl_twin {

class AlertList {
 public:
  /// Raises the alert, or brings an active one of the same system and type up to date. Its id and
  /// raised_time are set here (raised_time: its time when it was raised).
  /// decision: what the text says apart from its digits, e.g. which critical speed; the list counts
  /// as changed when it differs, not when only numbers do. But a countdown (time_to_entry) changes
  /// it every 0.2 s, so that it never stands still.
  void raise(state::Alert alert, const std::string& decision);

  /// Takes an alert off the list at time [s, simulated]; nothing happens when it is not active.
  /// reason: the sentence the cleared alert carries.
  void clear(const std::string& system, const std::string& type, double time,
             const std::string& reason);

  /// The active alert of this kind; null when there is none.
  const state::Alert* find(const std::string& system, const std::string& type) const;

  /// Most severe first, then oldest first.
  std::vector<state::Alert> active() const;

  /// Whether an alert was raised, cleared or changed its severity or decision since last asked.
  bool takeChanged();

  /// What happened since last asked, in order: a copy of each alert as it was raised, changed its
  /// severity or decision (raised = true, same id), or cleared (raised = false).
  std::vector<state::Alert> takeEvents();

 private:
  struct Entry {
    state::Alert alert;
    std::string decision;
    double counted_at;  ///< [s], simulated: of the countdown that the list last changed for
  };
  std::vector<Entry>::iterator locate(const std::string& system, const std::string& type);
  void sort();

  std::vector<Entry> entries_;
  std::vector<state::Alert> events_;
  bool changed_ = false;
  std::uint32_t last_id_ = 0;
};

}  // namespace whirl_twin
