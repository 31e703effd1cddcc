// The complete list of active alerts, as it is published latched: most severe first, among equals
// the oldest first. An alert is known by its system and type and keeps its id from raised to
// cleared; the next one of the same kind gets a new id.
//
// As protection systems have it: an alert is acknowledged, and is not any more when it grows worse
// or its cause comes back; one that latches stays, marked as such, when its cause has gone, until
// the alarms are reset; while a system is inhibited none of its alerts is raised but those that
// report why others are not (INHIBITED, TRIP_MULTIPLIED), and active ones stay. First out is the
// alert that was raised when no other of its system was active.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "messages/alert.h"
#include "messages/loop_statistics.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

class AlertList {
 public:
  explicit AlertList(Latch latch = Latch::kNone) : latch_(latch) {}

  /// For alerts whose cause goes from now on; latched ones stay.
  void setLatch(Latch latch) { latch_ = latch; }

  /// Raises the alert, or updates an active one of the same system and type. Its id and
  /// raised_time are set here (raised_time: its time when it was raised), first_out and repeats,
  /// too. Nothing happens while the system is inhibited and the alert is not active.
  /// decision: the content of the text apart from its digits, e.g. which critical speed; the list
  /// counts as changed when it differs, not when only numbers do. But a countdown (time_to_entry)
  /// changes it every 0.2 s.
  void raise(state::Alert alert, const std::string& decision);

  /// Takes an alert off the list at time [s, simulated], or marks it latched; nothing happens when
  /// it is not active, or is latched already.
  /// reason: the sentence the cleared alert carries.
  void clear(const std::string& system, const std::string& type, double time,
             const std::string& reason);

  /// Acknowledges the alerts of a system and type, "" for any. Returns how many there were that
  /// had not been acknowledged. by: who, and since when; it is part of their texts from then on.
  std::size_t acknowledge(const std::string& system, const std::string& type,
                          const std::string& by = "");
  /// Clears latched alerts, at time [s, simulated]; acknowledges the others; repeats count from 0.
  /// Returns how many were cleared.
  std::size_t reset(double time, const std::string& by = "");
  /// Whether alerts of a system may not be raised.
  void setInhibited(const std::string& system, bool inhibited);

  /// The content of an earlier list: its alerts, the last id it gave, and how often each kind
  /// (system, type) was raised. An alert that was not latched is in doubt until it is raised
  /// again; it keeps its id and severity, and RestoredAlerts clears it when its cause has gone.
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
    std::string acknowledgement = {};                   ///< " (acknowledged by ...)"
  };
  std::vector<Entry>::iterator locate(const std::string& system, const std::string& type);
  void add(state::Alert alert, const std::string& decision);
  void update(Entry& entry, state::Alert alert, const std::string& decision);
  void record(const state::Alert& alert);
  void sort();

  Latch latch_;
  std::vector<Entry> entries_;
  std::vector<state::Alert> events_;
  std::set<std::string> inhibited_;
  Counts counts_;  ///< of raises
  bool changed_ = false;
  std::uint32_t last_id_ = 0;
};

/// A run of simulated time: when the simulation was started [ns, wall], and its resets since.
using TwinRun = std::pair<std::int64_t, std::uint64_t>;

/// What a monitor that restarts has to know: which alerts were there, and in which run of time.
struct AlarmMemory {
  std::vector<state::Alert> alerts;  ///< active or latched
  std::uint32_t last_id = 0;
  AlertList::Counts counts;    ///< of each kind, how often it was raised
  std::optional<TwinRun> run;  ///< none if the simulation never reported it
};

/// Alerts of a monitor that ran before, until it is known whether their causes persist: an alarm
/// that finds its cause raises its alert again, which keeps its id. Those that no alarm has raised
/// when their source has been received for long enough to raise all that there is to raise are
/// cleared; and all are where the simulation has been restarted or reset meanwhile, which it has to
/// report twice.
class RestoredAlerts {
 public:
  explicit RestoredAlerts(SharedSettings settings) : settings_(std::move(settings)) {}

  /// Restores the list.
  void restore(const AlarmMemory& memory, AlertList& alerts);
  /// A state of a source came, at time [s, simulated].
  void received(const std::string& source, double time, AlertList& alerts);
  /// The states of a source cannot be evaluated: the time that it is received restarts.
  void interrupted(const std::string& source) { received_since_.erase(source); }
  /// Statistics of the simulation.
  void received(const state::LoopStatistics& loop, AlertList& alerts);
  /// Time has restarted.
  void restart() { received_since_.clear(); }

 private:
  /// [s], simulated, without a break.
  double receivedFor(const std::string& source, double time);
  /// [s], simulated, after which a cause that persists would have raised its alert.
  double delayOf(const std::string& type) const;

  SharedSettings settings_;
  std::optional<TwinRun> run_;
  std::optional<TwinRun> other_run_;  ///< as reported once
  std::map<std::string, double> received_since_;
  bool any_ = false;
};

/// Systems whose alerts are inhibited for a time [s, wall]. An alert INHIBITED reports by whom,
/// since when and until when, and its end.
class Inhibitions {
 public:
  /// A duration of 0 ends it with the next update(). by: who commands it.
  void set(const std::string& system, double duration, double wall_time, const std::string& by,
           AlertList& alerts);
  /// Ends those whose time has passed, at time [s, simulated], and reports the others.
  void update(double wall_time, double time, AlertList& alerts);
  /// [s, wall]; 0: it is not inhibited.
  double remaining(const std::string& system, double wall_time) const;
  /// All of them, a sentence; "": none.
  std::string text() const;

 private:
  struct Inhibition {
    double until;       ///< [s, wall]
    std::string by;     ///< who commanded it
    std::string times;  ///< "since ... until ...", for people
  };
  std::map<std::string, Inhibition> all_;
};

}  // namespace whirl_twin
