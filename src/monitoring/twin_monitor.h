// The monitor of a whole scene: live states in, stability margins and alerts out. No ROS, no LCM.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/controller_state.h"
#include "messages/follow_state.h"
#include "messages/loop_statistics.h"
#include "messages/measurement.h"
#include "messages/monitor_status.h"
#include "messages/order_state.h"
#include "monitoring/alarm_memory.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/controller_alarms.h"
#include "monitoring/data_lost_alarm.h"
#include "monitoring/judging.h"
#include "monitoring/lcm_lost_alarm.h"
#include "monitoring/margin_search.h"
#include "monitoring/reset_watch.h"
#include "monitoring/restored_alerts.h"
#include "monitoring/source_clock.h"
#include "monitoring/system_watch.h"
#include "scene/built_scene.h"

namespace whirl_twin {

class TwinMonitor {
 public:
  /// With Judging::Mode::kBeside verdicts, and alerts on them, come with a later call.
  TwinMonitor(const BuiltScene& scene, const AlarmSettings& settings,
              Judging::Mode mode = Judging::Mode::kAtOnce);

  // States as they arrive, wall_time [s] from a clock that only goes forward. Those of systems and
  // drives the scene does not have, or has as another kind, are ignored, and so are those out of
  // step with their source (source_clock.h): they clear nothing and restart no delay.
  void take(const state::WhirlState& whirl, double wall_time);
  void take(const state::PendulumState& pendulum, double wall_time);
  void take(const state::DriveState& drive, double wall_time);
  void take(const state::OrderState& orders, double wall_time);
  void take(const state::FollowState& follow, double wall_time);
  /// Of a system that the scene's sensors measure (measured_signal.h): from its first message on
  /// the alarms on its motion act on it instead of on the twin's.
  void take(const state::ControllerState& controller, double wall_time);
  void take(const state::Measurement& measurement, double wall_time);
  /// The parameters of a system or a controller are others now, and what hangs on them is judged
  /// with them at once, where it was last. False for a set that it does not have, or cannot have.
  bool take(const state::ParameterChange& change);
  /// Wall time passes though nothing may arrive, to be called a few times a second; paused: the
  /// simulation says that it is held.
  void tick(double wall_time, bool paused);
  /// The simulation says how its systems fare: whether one has stopped, and why; how accurate it
  /// is. And whether it was reset: then all alerts clear and the alarms begin anew. False for
  /// statistics out of step, or of another simulation than the one watched, which are ignored.
  bool take(const state::LoopStatistics& loop, double wall_time);
  /// Why nothing that comes can be judged, from now on; "": it can. Meanwhile nothing is raised or
  /// cleared by it.
  void setUncertain(const std::string& why) { uncertain_ = why; }
  /// The simulation that is watched, and what other one sends in its name; "" with one alone.
  std::string watched() const { return resets_.sender(); }
  std::string duplicate(double wall_time) const { return resets_.duplicate(wall_time); }
  std::uint64_t ofOthers() const { return resets_.ofOthers(); }

  /// Margins judged since last asked: ten a second of simulated time for each system; at once where
  /// a rotor passes its threshold speed and where parameters change; and where its speed has
  /// changed by a hundredth, at once but for a break that goes with what a verdict costs
  /// (newsBreak).
  std::vector<state::StabilityMargin> takeMargins();
  /// Of the controllers' loops, with the verdicts, since last asked.
  std::vector<state::ControllerMargins> takeLoopMargins() {
    return std::exchange(loop_margins_, {});
  }
  /// Orders of what was measured, since last asked; of each system as SYSTEM_measured.
  std::vector<state::OrderState> takeOrders() { return std::exchange(orders_, {}); }
  bool measures(const std::string& system) const;
  /// What the last message, of a source, has completed of a measured system's motion, without its
  /// slow roll; empty where it cannot be judged at that time [s].
  std::vector<state::WhirlState> measuredMotion(const std::string& system,
                                                const std::string& source, double wall_time) const;
  /// What is taken off what a system measures.
  std::optional<OrderVector> slowRoll(const std::string& system) const;
  /// Something is being judged: it is worth asking soon.
  bool judging() { return judging_.pending(); }
  AlertList& alerts() { return alerts_; }
  /// Other settings from now on. Alarms go on with what they know: what has been latched stays,
  /// delays that run are measured anew, and an alert whose level was taken away clears after its
  /// delay.
  void set(const AlarmSettings& settings);
  const AlarmSettings& settings() const { return settings_; }
  /// It was here before: to be said before anything arrives.
  void remember(const AlarmMemory& memory);
  /// The run of simulated time; none before the simulation has told.
  std::optional<TwinRun> run() const { return resets_.present(); }
  /// Holds back what a system ("": every one) would raise for a duration [s, wall], max_inhibition
  /// at most; 0 ends it. What is there stays; an alert INHIBITED reports by whom, since when and
  /// until when, and its end. Returns the duration; none for a system that the scene does not have.
  std::optional<double> inhibit(const std::string& system, double duration, double wall_time,
                                const std::string& by);
  /// What is held back at present, a sentence; "": nothing.
  std::string heldBack() const;
  /// That it is there, at wall_time [s], to be told about once a second; without a stamp.
  state::MonitorStatus status(double wall_time, bool paused);
  std::vector<std::string> systemNames() const;
  /// Of each system, why what comes from it cannot be judged; "": it can.
  std::vector<std::string> notOk(double wall_time, bool paused) const;
  double time() const { return time_; }  ///< [s], simulated, of the newest state

 private:
  void restart(double time, double wall_time);
  SystemWatch* find(const std::string& system);
  bool takeOfController(const state::ParameterChange& change);
  /// A set that a system cannot have: it is uncertain until it has another.
  void refuse(const state::ParameterChange& change, SystemWatch& watch);
  void take(state::StabilityMargin margin, SystemWatch& watch);
  /// A system asks this source, which may be a station of one.
  bool votes(const std::string& source) const;
  /// False for a state that is not to be believed.
  bool arrived(const std::string& source, const state::Instant& at, double wall_time);
  void liftInhibitions(double wall_time);
  void reportDuplicate(double wall_time);
  /// Why nothing can be judged; "": it can.
  std::string uncertainty(double wall_time) const;
  void putBackParameters();
  bool apply(const state::ParameterChange& change);
  void reportInhibitions();
  void reportStartUp(SystemWatch& watch, const state::DriveState& shaft);
  /// What came can be judged, or holds the alarms.
  bool isFit(SystemWatch& watch, bool fit, double time);
  void takeJudgements();
  void takeLoop(std::vector<state::ControllerMargins> judged);
  void judge(SystemWatch& watch, const state::Instant& at, const std::vector<double>& q,
             const std::vector<double>& v, double wall_time);
  /// Where it was last told to be.
  void askFor(SystemWatch& watch);
  /// Of all systems in the loop around one, as they came last; nothing where it is alone in it.
  SystemMotions motionsBeside(std::size_t place) const;
  bool loopHasCome(std::size_t place) const;
  void watchShaft(SystemWatch& watch, state::DriveState shaft);
  void watchMotion(SystemWatch& watch, const state::WhirlState& whirl);
  void takeMeasured(SystemWatch& watch, double wall_time);

  AlarmSettings settings_;
  /// Around each system, with the parameters of its controllers as they are; null: none.
  std::vector<std::shared_ptr<const ClosedLoop>> loops_;
  Judging judging_;
  MarginSearch margin_search_;
  std::uint64_t run_ = 0;  ///< of simulated time: resets so far
  std::vector<SystemWatch> watches_;
  DataLostAlarm data_lost_alarm_;
  LcmLostAlarm lcm_lost_alarm_;
  ControllerAlarms controller_alarms_;
  AlertList alerts_;
  RestoredAlerts restored_;
  struct Inhibition {
    double until;       ///< [s, wall]
    std::string by;     ///< who commanded it
    std::string times;  ///< "since ... until ...", for people
  };
  std::map<std::string, Inhibition> inhibitions_;  ///< of systems
  std::vector<state::StabilityMargin> margins_;
  std::vector<state::ControllerMargins> loop_margins_;
  std::vector<state::OrderState> orders_;
  std::map<std::string, SourceClock> clocks_;  ///< of each source
  SourceClock loop_clock_;
  double pace_ = 1.0;       ///< [-], of simulated time, where it goes faster than the clock
  double loop_time_ = 0.0;  ///< [s], simulated, of the newest statistics
  ResetWatch resets_;
  std::string uncertain_;
  /// What parameters were before the changes of the last seconds: those of a twin that turns out
  /// to be another are put back.
  struct Replaced {
    state::ParameterChange before;
    double wall_time;  ///< [s]
  };
  std::vector<Replaced> replaced_;
  std::map<std::string, state::ParameterChange> parameters_;  ///< as last told, of each subject
  double wall_time_ = 0.0;                                    ///< [s], newest that was told
  double time_ = 0.0;
  std::int64_t step_ = 0;     ///< of the newest state
  double status_at_ = 0.0;    ///< [s], wall time of the last status
  double status_busy_ = 0.0;  ///< [s], judging until then
};

}  // namespace whirl_twin
