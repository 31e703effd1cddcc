// The monitor of a whole scene: live states in, stability margins and alerts out. No ROS, no LCM.
//
// A message passes the gate (StateGate: run, order, duplicates) and the check of its quality; then
// the alarms of its system (SystemAlarms) or of the scene act on it, and its stability is evaluated
// where that is due.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "messages/message.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/controller_alarms.h"
#include "monitoring/evaluation_queue.h"
#include "monitoring/run_filter.h"
#include "monitoring/system_monitor.h"
#include "scene/built_scene.h"

namespace whirl_twin {

class TwinMonitor {
 public:
  /// With EvaluationQueue::Mode::kConcurrent verdicts, and alerts on them, come with a later call.
  TwinMonitor(const BuiltScene& scene, const AlarmSettings& settings,
              EvaluationQueue::Mode mode = EvaluationQueue::Mode::kAtOnce);

  // States as they arrive, wall_time [s] from a clock that only goes forward. Those of systems and
  // drives the scene does not have, or has as a different kind, are ignored, and so are those that
  // the gate rejects: they clear nothing and restart no delay.
  void take(const state::WhirlState& whirl, double wall_time);
  void take(const state::PendulumState& pendulum, double wall_time);
  void take(const state::DriveState& drive, double wall_time);
  void take(const state::OrderState& orders, double wall_time);
  void take(const state::FollowState& follow, double wall_time);
  void take(const state::ControllerState& controller, double wall_time);
  /// Of a system that the scene's sensors measure (measured_signal.h): from its first message on
  /// the alarms on its motion act on it instead of on the twin's.
  void take(const state::Measurement& measurement, double wall_time);
  /// The parameters of a system or a controller have changed, and its stability is evaluated with
  /// them at once, where it was last. False for a set that it does not have, or that is invalid.
  bool take(const state::ParameterChange& change);
  /// The simulation reports its systems: whether one has stopped, and why; how accurate it is. And
  /// whether it was reset: then all alerts clear and the alarms restart. False for statistics out
  /// of order, or of a different simulation than the monitored one, which are ignored.
  bool take(const state::LoopStatistics& loop, double wall_time);
  /// Wall time passes though nothing may arrive, to be called a few times a second; paused: the
  /// simulation reports a pause.
  void tick(double wall_time, bool paused);
  /// Why nothing that comes can be evaluated, from now on; "": it can. Meanwhile nothing is raised
  /// or cleared by it.
  void setUncertain(const std::string& why) { gate_.setUncertain(why); }
  /// The simulation that is monitored, and its duplicate publisher; "" with one alone.
  std::string watched() const { return gate_.run().sender(); }
  std::string duplicate(double wall_time) const { return gate_.run().duplicate(wall_time); }
  std::uint64_t ofOthers() const { return gate_.run().ofOthers(); }

  /// Margins since last asked: ten a second of simulated time for each system; at once where a
  /// rotor passes its threshold speed and where parameters change; and where its speed has changed
  /// by a hundredth, at once but for a break that goes with the cost of a verdict (newsBreak).
  std::vector<state::StabilityMargin> takeMargins();
  /// Of the controllers' loops, with the verdicts, since last asked.
  std::vector<state::ControllerMargins> takeLoopMargins() {
    return std::exchange(loop_margins_, {});
  }
  /// Orders of what was measured, since last asked; of each system as SYSTEM_measured.
  std::vector<state::OrderState> takeOrders() { return std::exchange(orders_, {}); }
  bool measures(const std::string& system) const;
  /// The part of a measured system's motion that the last message, of a source, has completed,
  /// without its slow roll; empty where it cannot be evaluated at that time [s].
  std::vector<state::WhirlState> measuredMotion(const std::string& system,
                                                const std::string& source, double wall_time) const;
  /// Slow roll that is compensated in the measurements of a system.
  std::optional<OrderVector> slowRoll(const std::string& system) const;
  /// An evaluation is pending: it is worth asking soon.
  bool evaluating() { return queue_.pending(); }
  AlertList& alerts() { return alerts_; }
  /// New settings. Alarms continue with what they know: latched alerts stay, delays that run are
  /// measured by the new ones, and an alert whose level was removed clears after its delay.
  void set(const AlarmSettings& settings);
  const AlarmSettings& settings() const { return *settings_; }
  /// The alarms of a monitor that ran before; to be called before anything arrives.
  void remember(const AlarmMemory& memory);
  /// The run of simulated time; none before the simulation has reported it.
  std::optional<TwinRun> run() const { return gate_.run().present(); }
  /// Inhibits the alerts that a system ("": every one) would raise for a duration [s, wall],
  /// max_inhibition at most; 0 ends it. Active alerts stay. Returns the duration; none for a system
  /// that the scene does not have.
  std::optional<double> inhibit(const std::string& system, double duration, double wall_time,
                                const std::string& by);
  /// Present inhibitions, a sentence; "": none.
  std::string heldBack() const { return inhibitions_.text(); }
  /// The heartbeat at wall_time [s], to be called about once a second; without a stamp.
  state::MonitorStatus status(double wall_time, bool paused);
  std::vector<std::string> systemNames() const;
  /// Of each system, why its data are bad or uncertain; "": they are good.
  std::vector<std::string> notOk(double wall_time, bool paused) const;
  double time() const { return gate_.time(); }  ///< [s], simulated, of the newest state

 private:
  /// Alarms that are not of one system.
  struct SceneAlarms {
    DataLostAlarm data_lost;
    LcmLostAlarm lcm_lost;
    std::map<std::string, ControllerAlarms> controllers;
  };
  /// The parameters that were in force before the changes of the last seconds: those of a twin that
  /// turns out to be a duplicate are undone.
  struct Replaced {
    state::ParameterChange before;
    double wall_time;  ///< [s]
  };

  SceneAlarms makeAlarms() const;
  SystemMonitor* find(const std::string& name);
  const SystemMonitor* find(const std::string& name) const;
  /// Some system votes with the whirl of this source, which may be a station of one.
  bool votes(const std::string& source) const;

  /// False for a state that the gate rejects, or that cannot be evaluated.
  bool accept(const std::string& source, const state::Instant& at, double wall_time);
  void restartIfReset();
  /// Whether a state of good or bad quality can be evaluated; else it holds the alarms.
  bool useIf(bool good, SystemMonitor& system, double time);
  void evaluateShaft(SystemMonitor& system, state::DriveState shaft);
  void evaluateMotion(SystemMonitor& system, const state::WhirlState& whirl);
  void evaluateMeasured(SystemMonitor& system, double wall_time);
  void reportDuplicate(double wall_time);
  std::string problemOf(const SystemMonitor& system, double wall_time, bool paused) const;

  bool apply(const state::ParameterChange& change);
  bool applyToController(const state::ParameterChange& change);
  /// A set that a system cannot have: it is uncertain until it has a valid one.
  void refuse(const state::ParameterChange& change, SystemMonitor& system);
  void undoParameters();

  /// Requests a verdict where one is due.
  void evaluateStability(SystemMonitor& system, const state::Instant& at,
                         const std::vector<double>& q, const std::vector<double>& v,
                         double wall_time);
  /// Where it was last.
  void request(SystemMonitor& system);
  std::size_t placeOf(const SystemMonitor& system) const {
    return static_cast<std::size_t>(&system - systems_.data());
  }
  /// Of all systems in the loop around one, as they came last; nothing where it is alone in it.
  SystemMotions motionsBeside(std::size_t place) const;
  bool loopIsComplete(std::size_t place) const;
  void takeResults();
  void takeMargin(state::StabilityMargin margin, SystemMonitor& system);

  SharedSettings settings_;
  /// Around each system, with the parameters of its controllers as they are; null: none.
  std::vector<std::shared_ptr<const ClosedLoop>> loops_;
  std::vector<ControllerSpec> controllers_;
  EvaluationQueue queue_;
  StabilityBoundarySearch boundary_search_;
  std::vector<SystemMonitor> systems_;
  SceneAlarms alarms_;
  StateGate gate_;
  std::uint64_t run_ = 0;  ///< of simulated time: resets so far
  AlertList alerts_;
  RestoredAlerts restored_;
  Inhibitions inhibitions_;
  std::vector<state::StabilityMargin> margins_;
  std::vector<state::ControllerMargins> loop_margins_;
  std::vector<state::OrderState> orders_;
  std::vector<Replaced> replaced_;
  std::map<std::string, state::ParameterChange> parameters_;  ///< as last reported, of each subject
  double status_at_ = 0.0;                                    ///< [s], wall time of the last status
  double status_busy_ = 0.0;                                  ///< [s], evaluating until then
};

/// Whether the monitor takes messages of a kind as states, with the time they arrived at.
template <class State, class = void>
struct IsWatchedState : std::false_type {};
template <class State>
struct IsWatchedState<State, std::void_t<decltype(std::declval<TwinMonitor&>().take(
                                 std::declval<const State&>(), double{}))>>
    : std::bool_constant<!std::is_same_v<State, state::LoopStatistics>> {};

/// Whether the monitor uses messages of a kind at all.
template <class State>
constexpr bool isWatched() {
  return IsWatchedState<State>::value || std::is_same_v<State, state::ParameterChange> ||
         std::is_same_v<State, state::LoopStatistics>;
}

}  // namespace whirl_twin
