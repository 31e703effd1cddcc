#include "reports/monitored_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/wall_clock.h"
#include "monitoring/twin_monitor.h"
#include "monitoring/whirl_vibration.h"

namespace whirl_twin {

namespace {

constexpr double kMaxWindow = 20.0;  // s, of what turns with the shaft
constexpr double kTick = 0.1;        // s, as the node ticks at least
constexpr double kSample = 0.1;      // s, simulated, of what is drawn
constexpr double kSilence = 600.0;   // s: a longer one is a clock that was set, or two recordings
constexpr int kBelievedAstray = 10;  // events

/// The last turns of a whirl.
class LastTurns {
 public:
  void take(const state::WhirlState& whirl) {
    const double turns = kDrawnTurns * kTwoPi;
    if (!kept_.empty() && !(whirl.at.time > kept_.back().at.time)) {
      kept_.clear();
    }
    kept_.push_back(whirl);
    while (kept_.size() > kMaxDrawn || whirl.shaft_angle - kept_.front().shaft_angle > turns) {
      kept_.pop_front();
    }
  }

  /// Less its mean; empty where the shaft has not turned once, or samples are too far apart.
  std::vector<state::WhirlState> orbit() const {
    if (kept_.empty() || !(kept_.back().shaft_angle - kept_.front().shaft_angle >= kTwoPi) ||
        kept_.size() < kMinDrawn) {
      return {};
    }
    std::vector<state::WhirlState> orbit(kept_.begin(), kept_.end());
    double x = 0.0, y = 0.0;
    for (const state::WhirlState& whirl : orbit) {
      x += whirl.x / static_cast<double>(orbit.size());
      y += whirl.y / static_cast<double>(orbit.size());
    }
    for (state::WhirlState& whirl : orbit) {
      whirl.x -= x;
      whirl.y -= y;
    }
    return orbit;
  }

 private:
  static constexpr double kDrawnTurns = 5.0;
  static constexpr std::size_t kMaxDrawn = 4096, kMinDrawn = 32;
  std::deque<state::WhirlState> kept_;
};

class Replay {
 public:
  Replay(const BuiltScene& scene, const AlarmSettings& settings, std::optional<double> spectrum_at,
         MonitoredLog& run)
      : monitor_(scene, settings), spectrum_at_(spectrum_at), run_(run) {
    for (const SharedSystem& system : scene.systems) {
      SystemCourse course;
      course.name = system->spec.name;
      course.rotor = system->dynamics->isRotor();
      if (const auto levels = settings.amplitude.find(course.name);
          levels != settings.amplitude.end()) {
        course.levels = levels->second;
      }
      run_.systems.push_back(course);
      drives_.push_back(system->spec.drive.value_or(""));
    }
    peaks_.assign(run_.systems.size(), 0.0);
    cascades_.resize(run_.systems.size());
    vibrations_.resize(run_.systems.size());
    turns_.resize(run_.systems.size());
  }

  /// Of the stamp of an event [us].
  void passTo(std::int64_t stamp) {
    const double at = 1.0e-6 * static_cast<double>(stamp);
    const double silence = started_ ? at - newest_stamp_ : 0.0;
    if (silence < 0.0 || silence > kSilence) {
      // One that stands alone is of another time, as repeated parameters of a simulated log are.
      astray_ = at > stray_stamp_ && at - stray_stamp_ <= kSilence ? astray_ + 1 : 1;
      stray_stamp_ = at;
      if (astray_ < kBelievedAstray) {
        return;
      }
    }
    astray_ = 0;
    started_ = true;
    newest_stamp_ = at;
    if (silence < 0.0 || silence > kSilence) {
      return;  // the clock was set, or another recording begins: time continues from here
    }
    const double until = wall_ + silence;
    while (until - ticked_ >= kTick) {
      ticked_ += kTick;
      monitor_.tick(ticked_, paused_);
      keepNotOk();
      keep();
    }
    wall_ = until;
  }

  void take(const Message& message) {
    std::visit([this](const auto& state) { takeOf(state); }, message);
  }

  void finish() {
    run_.duration = wall_;
    keep();
    for (std::size_t i = 0; i < run_.systems.size(); ++i) {
      SystemCourse& course = run_.systems[i];
      course.spectra = cascades_[i].spectra();
      if (!spectrum_at_) {
        course.spectrum = cascades_[i].latest();
        course.orbit = turns_[i].orbit();
      }
      course.slow_roll = monitor_.slowRoll(course.name);
      course.resonances = passedResonances(course.orders, course.critical_speeds);
    }
  }

 private:
  template <class State>
  void takeOf(const State& state) {
    if constexpr (std::is_same_v<State, state::ParameterChange>) {
      monitor_.take(state) ? ++run_.watched : ++run_.rejected;
    } else if constexpr (std::is_same_v<State, state::LoopStatistics>) {
      if (monitor_.take(state, wall_)) {
        paused_ = state.paused;
      }
      ++run_.watched;
    } else if constexpr (IsWatchedState<State>::value) {
      monitor_.take(state, wall_);
      ++run_.watched;
      span(state.at.time);
      draw(state);
    }
    keep();
  }

  void span(double time) {
    run_.begin = spanned_ ? std::min(run_.begin, time) : time;
    run_.end = spanned_ ? std::max(run_.end, time) : time;
    spanned_ = true;
  }

  SystemCourse* courseOf(const std::string& name) {
    const auto found =
        std::find_if(run_.systems.begin(), run_.systems.end(),
                     [&](const SystemCourse& course) { return course.name == name; });
    return found == run_.systems.end() ? nullptr : &*found;
  }

  void draw(const state::WhirlState& whirl) {
    if (SystemCourse* course = courseOf(whirl.system)) {
      course->modelled = true;
      drawMotion(*course, whirl);
    }
  }
  void drawMotion(SystemCourse& course, const state::WhirlState& whirl) {
    const auto place = static_cast<std::size_t>(&course - run_.systems.data());
    const double time = whirl.at.time;
    if (spectrum_at_ && time > *spectrum_at_ && !course.spectrum) {
      course.spectrum = cascades_[place].latest();
      course.orbit = turns_[place].orbit();
    }
    turns_[place].take(whirl);
    cascades_[place].take({whirl.at.step, time, 0, 0.0, whirl.speed, whirl.x, whirl.y});
    double& peak = peaks_[place];
    peak = std::fmax(peak, vibrations_[place].take(whirl));
    if (sample(course, time, whirl.speed)) {
      course.vibration.push_back(peak);
      peak = 0.0;
    }
  }
  void draw(const state::PendulumState& pendulum) {
    if (SystemCourse* course = courseOf(pendulum.system)) {
      sample(*course, pendulum.at.time, speedOf(*course));
    }
  }
  /// What is measured is drawn where no twin runs beside it; beside one, its orders are.
  void draw(const state::Measurement& measurement) {
    for (SystemCourse& course : run_.systems) {
      if (!course.modelled) {
        for (const state::WhirlState& whirl :
             monitor_.measuredMotion(course.name, measurement.source, wall_)) {
          drawMotion(course, whirl);
        }
      }
    }
  }
  void draw(const state::OrderState& state) {
    if (!monitor_.measures(state.system)) {
      drawOrders(state, courseOf(state.system));
    }
  }
  void drawOrders(const state::OrderState& state, SystemCourse* course) {
    if (course == nullptr) {
      return;
    }
    OrderCourse& orders = course->orders;
    const double time = state.at.time - state.delay;
    if (!state.line_frequency.empty()) {
      orders.line_time.push_back(time);
      orders.line_frequency.push_back(state.line_frequency.front());
    }
    const auto first = std::find(state.order.begin(), state.order.end(), 1.0);
    if (!state.valid || first == state.order.end()) {
      return;
    }
    if (!orders.time.empty() && time <= orders.time.back() &&
        time > orders.time.back() - kMaxWindow) {
      return;  // from a longer window than the one before: it says nothing new
    }
    const auto place = static_cast<std::size_t>(first - state.order.begin());
    const double before = orders.lag.empty() ? 0.0 : orders.lag.back();
    orders.time.push_back(time);
    orders.speed.push_back(state.speed);
    orders.amplitude.push_back(state.forward_amplitude[place]);
    orders.deviation.push_back(state.deviation[place]);
    orders.lag.push_back(before + std::remainder(state.forward_lag[place] - before, kTwoPi));
  }
  void draw(const state::FollowState&) {}      // its alerts tell it
  void draw(const state::ControllerState&) {}  // likewise
  void draw(const state::DriveState& drive) { speeds_[drive.drive] = drive.speed; }

  double speedOf(const SystemCourse& course) const {
    const auto found =
        speeds_.find(drives_[static_cast<std::size_t>(&course - run_.systems.data())]);
    return found == speeds_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
  }

  /// Is this state one of those that are drawn?
  static bool sample(SystemCourse& course, double time, double speed) {
    ++course.states;
    if (!course.time.empty() && time >= course.time.back() &&
        time < course.time.back() + kSample * (1.0 - 1.0e-9)) {
      return false;
    }
    course.time.push_back(time);
    course.speed.push_back(speed);
    return true;
  }

  void keep() {
    for (const state::StabilityMargin& margin : monitor_.takeMargins()) {
      keepMargin(margin);
    }
    for (const state::Alert& event : monitor_.alerts().takeEvents()) {
      keepEvent(event);
    }
    for (const state::OrderState& measured : monitor_.takeOrders()) {
      drawOrders(measured, courseOf(measured.system.substr(0, measured.system.rfind("_measured"))));
    }
    if (const std::optional<TwinRun> run = monitor_.run()) {
      run_.resets = std::max(run_.resets, run->second);
    }
  }

  /// A reason continues while it is of the same kind: the duration of a timeout changes.
  void keepNotOk() {
    const std::vector<std::string> why = monitor_.notOk(ticked_, paused_);
    for (std::size_t i = 0; i < why.size(); ++i) {
      SystemCourse& course = run_.systems[i];
      if (course.states == 0) {
        continue;  // it has not begun
      }
      NotOkCourse* const last = course.not_ok.empty() || std::isfinite(course.not_ok.back().end)
                                    ? nullptr
                                    : &course.not_ok.back();
      if (last != nullptr && kindOf(last->why) == kindOf(why[i])) {
        last->why = why[i];
        continue;
      }
      if (last != nullptr) {
        last->end = monitor_.time();
      }
      if (!why[i].empty()) {
        course.not_ok.push_back(
            {why[i], monitor_.time(), std::numeric_limits<double>::quiet_NaN()});
      }
    }
  }
  static std::string kindOf(const std::string& why) { return why.substr(0, why.find(':')); }

  void keepMargin(const state::StabilityMargin& margin) {
    SystemCourse* course = courseOf(margin.system);
    if (course == nullptr) {
      return;
    }
    course->margin_time.push_back(margin.at.time);
    course->decay_rate.push_back(margin.decay_rate);
    course->critical_speeds = margin.critical_speeds;
    if (!(margin.decay_rate >= course->least_decay_rate)) {
      course->least_decay_rate = margin.decay_rate;
      course->least_at = margin.at.time;
      course->least_at_speed = margin.speed;
      course->least_verdict = margin.verdict_name;
    }
  }

  std::string wallTimeText() const {
    const std::int64_t stamp = std::llround(1.0e9 * newest_stamp_);
    return isOfWallClock(stamp) ? isoTime(stamp) : "";
  }

  void keepEvent(const state::Alert& event) {
    const auto same = std::find_if(run_.alerts.rbegin(), run_.alerts.rend(),
                                   [&](const AlertCourse& a) { return a.worst.id == event.id; });
    if (same == run_.alerts.rend()) {
      run_.alerts.push_back({event, event.raised_time, std::numeric_limits<double>::quiet_NaN(), "",
                             wallTimeText(), ""});
    } else if (!event.raised) {
      same->cleared = event.time;
      same->cleared_at = wallTimeText();
      same->why_cleared = event.text;
    } else {
      if (std::isnan(same->latched) || !event.latched) {
        same->latched = event.latched ? event.time : std::numeric_limits<double>::quiet_NaN();
      }
      same->worst = event.severity > same->worst.severity ? event : same->worst;
    }
  }

  TwinMonitor monitor_;
  std::optional<double> spectrum_at_;  ///< [s], simulated
  MonitoredLog& run_;
  std::vector<std::string> drives_;  ///< of each system
  std::map<std::string, double> speeds_;
  std::vector<double> peaks_;  ///< [m], of each system since its last sample
  std::vector<SpectrumCascade> cascades_;
  std::vector<WhirlVibration> vibrations_;
  std::vector<LastTurns> turns_;
  bool started_ = false, spanned_ = false, paused_ = false;
  double newest_stamp_ = 0.0;  ///< [s]
  double stray_stamp_ = 0.0;   ///< [s], of the last event that was out of order
  int astray_ = 0;             ///< events out of order, in a row and in order among themselves
  double wall_ = 0.0;          ///< [s], from the first event on
  double ticked_ = 0.0;        ///< [s]
};

}  // namespace

MonitoredLog monitorLog(const BuiltScene& scene, const AlarmSettings& settings,
                        const Recording& recording, std::optional<double> spectrum_at,
                        const LogProgress& advanced) {
  MonitoredLog run;
  run.scene = scene.scene.name;
  run.log = recording.path;
  Replay replay(scene, settings, spectrum_at, run);
  const LoggedMessages read = readRecording(
      recording, estimatorSources(scene.scene, {}), allKinds(),
      [&](const Message& message, std::int64_t stamp) {
        replay.passTo(stamp);
        replay.take(message);
      },
      advanced, LogOrder::kOfFile);
  run.damaged = read.damaged;
  run.first_damage = read.first_damage;
  run.rejected += read.rejected;
  run.remarks = read.remarks;
  replay.finish();
  if (std::all_of(run.systems.begin(), run.systems.end(),
                  [](const SystemCourse& course) { return course.states == 0; })) {
    throw InputError(
        fmt::format("{}: must have states of the systems of '{}' on channels that begin with {} "
                    "(--lcm-prefix), {}",
                    run.log, scene.scene.name, recording.prefix, foundElsewhere(read)));
  }
  if (spectrum_at && !(*spectrum_at >= run.begin && *spectrum_at <= run.end)) {
    throw InputError(
        fmt::format("--spectrum-at: expected a time within the log, {:g} to {:g} s, "
                    "found {:g} s",
                    run.begin, run.end, *spectrum_at));
  }
  return run;
}

}  // namespace whirl_twin
