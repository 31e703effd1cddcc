// The complete list of active alerts, as it is published latched: most severe first, among equals
// the oldest first. An alert is known by its system and type and keeps its id from raised to
// cleared; the next one of the same kind gets a new id.
//
// As protection systems have it: an alert is acknowledged by who has seen it, and is not any more
// when it grows worse or its cause comes back; one that latches stays, marked as such, when its
// cause has gone, until the alarms are reset; while a system is inhibited none of its alerts is
// raised but those that report what silences (INHIBITED, TRIP_MULTIPLIED), and those that are there
// stay. First out is the alert that was raised when no other of its system was there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "messages/alert.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

class AlertList {
 public:
  explicit AlertList(Latch latch = Latch::kNone) : latch_(latch) {}

  /// For alerts whose cause goes from now on; what is latched stays.
  void setLatch(Latch latch) { latch_ = latch; }

  /// Raises the alert, or brings an active one of the same system and type up to date. Its id and
  /// raised_time are set here (raised_time: its time when it was raised), first_out and repeats,
  /// too. Nothing happens while the system is inhibited and the alert is not there.
  /// decision: what the text says apart from its digits, e.g. which critical speed; the list counts
  /// as changed when it differs, not when only numbers do. But a countdown (time_to_entry) changes
  /// it every 0.2 s, so that it never stands still.
  void raise(state::Alert alert, const std::string& decision);

  /// Takes an alert off the list at time [s, simulated], or marks it latched; nothing happens when
  /// it is not active, or is latched already.
  /// reason: the sentence the cleared alert carries.
  void clear(const std::string& system, const std::string& type, double time,
             const std::string& reason);

  /// Somebody has seen the alerts of a system and type, "" for any. Returns how many there were
  /// that nobody had acknowledged. by: who, and since when; it is part of their texts from then on.
  std::size_t acknowledge(const std::string& system, const std::string& type,
                          const std::string& by = "");
  /// Takes off the list what is latched, at time [s, simulated]; acknowledges the others; repeats
  /// count from 0. Returns how many were taken off.
  std::size_t reset(double time, const std::string& by = "");
  /// Whether alerts of a system may not be raised.
  void setInhibited(const std::string& system, bool inhibited);

  /// What an earlier list knew: the alerts that were there, the last id it gave, and how often each
  /// kind (system, type) was raised. An alert that was not latched is in doubt until it is raised
  /// again; it keeps its id and severity, and who would know that its cause has gone clears it.
  using Counts = std::map<std::pair<std::string, std::string>, std::uint32_t>;
  void restore(const std::vector<state::Alert>& alerts, std::uint32_t last_id, Counts counts);
  /// Alerts in doubt.
  std::vector<state::Alert> inDoubt() const;

  /// The active alert of this kind, which may be latched; null when there is none.
  const state::Alert* find(const std::string& system, const std::string& type) const;

  /// Most severe first, then oldest first.
  std::vector<state::Alert> active() const;

  /// Whether an alert was raised, cleared or acknowledged, latched, or changed its severity or
  /// decision since last asked.
  bool takeChanged();

  /// What happened since last asked, in order: a copy of each alert as it was raised, latched,
  /// acknowledged, changed its severity or decision (raised = true, same id), or cleared
  /// (raised = false).
  std::vector<state::Alert> takeEvents();

 private:
  struct Entry {
    state::Alert alert;
    std::string decision;
    double counted_at;      ///< [s], simulated: of the countdown that the list last changed for
    bool in_doubt = false;  ///< restored, and not raised since
    state::Severity restored = state::Severity::kInfo;  ///< severity it had then
    std::string seen = {};                              ///< " (acknowledged by ...)"
  };
  std::vector<Entry>::iterator locate(const std::string& system, const std::string& type);
  void add(state::Alert alert, const std::string& decision);
  void bringUpToDate(Entry& entry, state::Alert alert, const std::string& decision);
  void tell(const state::Alert& alert);
  void sort();

  Latch latch_;
  std::vector<Entry> entries_;
  std::vector<state::Alert> events_;
  std::set<std::string> inhibited_;
  Counts counts_;  ///< of raises
  bool changed_ = false;
  std::uint32_t last_id_ = 0;
};

}  // namespace whirl_twin
