// `twin watch`.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/loop_statistics.h"
#include "messages/names.h"
#include "monitoring/run_filter.h"
#include "monitoring/whirl_vibration.h"
#include "reports/live_lines.h"
#include "reports/output.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_receiver.h"

namespace whirl_twin {

namespace {

constexpr const char* kWatchDescription =
    "Watches a running twin in the terminal, by LCM: its loop, its systems, its alarms.";

constexpr const char* kWatchFooter =
    "A terminal is refreshed five times a second, until Ctrl-C; to a file or a pipe a table is\n"
    "written every second. All active alerts are known within five seconds. The vibration of a "
    "rotor\n"
    "is the 0-peak amplitude over the last revolution, without sag, as the alarms use it. Exit\n"
    "status: 0 messages of a twin were received, 1 none, 2 bad input.\n"
    "\n"
    "Examples:\n"
    "  twin watch\n"
    "  twin watch --lcm-prefix PLANT_\n"
    "  twin watch --duration 3 --json";

using Clock = std::chrono::steady_clock;

struct WatchRequest {
  std::string url = kDefaultLcmUrl;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<double> duration;  // s
  bool json = false;
};

double wallTime() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// The newest message of a kind, and its time of arrival.
template <class State>
struct Heard {
  std::optional<State> newest;
  Clock::time_point at{};

  void take(const State& state) {
    newest = state;
    at = Clock::now();
  }
  /// [s], of messages sent once a second; "" without a timeout.
  std::string silence(const char* who) const {
    constexpr double kPatience = 3.0;  // s
    return secondsSince(at) > kPatience
               ? fmt::format("no message from {} for {:.0f} s", who, secondsSince(at))
               : "";
  }
};

struct System {
  std::optional<state::WhirlState> whirl;
  WhirlVibration followed;  // of the whirl
  double vibration = kNaN;  // m, the measured vibration: the amplitude over a revolution
  std::optional<state::PendulumState> pendulum;
  std::optional<state::StabilityMargin> margin;
};

std::string systemLine(const System& system) {
  std::string out;
  const auto say = [&out](const std::string& part) { out += (out.empty() ? "" : ", ") + part; };
  if (system.whirl) {
    say(fmt::format("speed {:.2f} rad/s ({:.1f} rpm)", system.whirl->speed,
                    system.whirl->speed / kRpm));
    if (std::isfinite(system.vibration)) {
      say(fmt::format("vibration {:.1f} um 0-peak", 1.0e6 * system.vibration));
    }
  }
  if (system.pendulum) {
    for (std::size_t i = 0; i < system.pendulum->name.size(); ++i) {
      say(fmt::format("{} {:.4g}", system.pendulum->name[i], system.pendulum->angle[i]));
    }
  }
  if (system.margin) {
    say(system.margin->verdict_name);
    if (std::isfinite(system.margin->decay_rate)) {
      say(fmt::format("decay rate {:.3g} 1/s", system.margin->decay_rate));
    }
  }
  return out;
}

std::string alertLine(const state::Alert& alert) {
  constexpr const char* kSeverities[] = {"INFO", "WARNING", "DANGER"};
  const bool named = alert.text.find("(acknowledged") != std::string::npos;  // by whom
  return fmt::format("  {} since {:.3f} s: {}{}", kSeverities[static_cast<int>(alert.severity)],
                     alert.raised_time, alert.text,
                     alert.acknowledged && !named ? " (acknowledged)" : "");
}

class Watch {
 public:
  explicit Watch(const WatchRequest& request)
      : request_(request),
        receiver_(
            openLcm(request.url),
            kindsOf<state::LoopStatistics, state::WhirlState, state::PendulumState,
                    state::StabilityMargin, state::Alert, state::MonitorStatus>(),
            [this](const Message& message) {
              if (runs_.take(message, wallTime())) {
                std::visit([this](const auto& state) { take(state); }, message);
              }
            },
            request.lcm_prefix) {}

  void watch() {
    const double between = lines_.onTerminal() ? 0.2 : 1.0;  // s
    const auto begin = Clock::now();
    auto drawn = begin;
    while (!interrupted() && !(request_.duration && secondsSince(begin) >= *request_.duration)) {
      receiver_.receive(std::chrono::milliseconds(50));
      if (!request_.json && secondsSince(drawn) >= between) {
        drawn = Clock::now();
        lines_.show(lines());
      }
    }
    if (request_.json) {
      printJson(json());
    }
  }

  bool heard() const { return receiver_.received() > 0; }

 private:
  void take(const state::LoopStatistics& loop) { loop_.take(loop); }
  void take(const state::MonitorStatus& monitor) {
    monitor_.take(monitor);
    if (monitor.alerts == 0) {
      alerts_.clear();  // the message that cleared them may have been lost
    }
  }
  void take(const state::WhirlState& whirl) {
    System& system = systems_[whirl.system];
    system.whirl = whirl;
    system.vibration = system.followed.take(whirl);
    time_ = whirl.at.time;
  }
  void take(const state::PendulumState& pendulum) {
    systems_[pendulum.system].pendulum = pendulum;
    time_ = pendulum.at.time;
  }
  void take(const state::StabilityMargin& margin) { systems_[margin.system].margin = margin; }
  void take(const state::Alert& alert) {
    if (alert.raised) {
      alerts_[alert.id] = alert;
    } else {
      alerts_.erase(alert.id);
    }
  }
  template <class State>
  void take(const State&) {}  // not required

  std::vector<std::string> lines() const {
    if (!heard()) {
      return {fmt::format("no message received on {}* at {}", request_.lcm_prefix, request_.url)};
    }
    std::vector<std::string> lines{fmt::format("{:.3f} s", time_)};
    if (const std::string others = runs_.duplicate(wallTime()); !others.empty()) {
      lines.push_back(fmt::format("{}: {} messages of other twins ignored",
                                  printable(others, others.size()), runs_.ofOthers()));
    }
    addLoop(lines);
    for (const auto& [name, system] : systems_) {
      lines.push_back(name + ": " + systemLine(system));
    }
    addMonitor(lines);
    return lines;
  }

  void addLoop(std::vector<std::string>& lines) const {
    if (!loop_.newest) {
      return;
    }
    const state::LoopStatistics& loop = *loop_.newest;
    const std::string silence = loop_.silence("the simulation");
    lines.push_back(fmt::format("loop: {}, step {:g} ms, {} {}, real-time factor {:.3g}",
                                !silence.empty() ? silence
                                : loop.paused    ? "paused"
                                                 : "running",
                                1.0e3 * loop.step_size, loop.policy, loop.priority,
                                loop.achieved_factor));
    lines.push_back(
        fmt::format("  wake-up latency p99 {:.0f} us, at most {:.0f} us; a step takes p99 {:.0f} "
                    "us, at most {:.0f} "
                    "us",
                    1.0e6 * loop.wakeup_latency_p99, 1.0e6 * loop.wakeup_latency_max,
                    1.0e6 * loop.execution_p99, 1.0e6 * loop.execution_max));
    lines.push_back(
        fmt::format("  {} overruns ({} by late wake-up), {} steps skipped, {} states not "
                    "published, {} not sent on "
                    "LCM, {} lost by subscribers",
                    loop.overruns, loop.late_wakeups, loop.skipped_steps, loop.dropped_snapshots,
                    loop.lcm_failed, loop.ros_lost));
    if (const std::string slowest = slowestPart(loop); !slowest.empty()) {
      lines.push_back("  slowest in a step: " + slowest);
    }
    if (!loop.waits_for.empty()) {
      lines.push_back("  in lockstep: waits for " + loop.waits_for);
    }
    for (std::size_t i = 0; i < loop.system.size(); ++i) {
      if (loop.stopped[i] != 0) {
        lines.push_back(fmt::format("  STOPPED: {}", loop.stopped_why[i]));
      }
    }
  }

  void addMonitor(std::vector<std::string>& lines) const {
    if (!monitor_.newest) {
      lines.push_back("monitor: no message received");
      return;
    }
    const state::MonitorStatus& monitor = *monitor_.newest;
    const std::string silence = monitor_.silence("the monitor");
    lines.push_back(
        silence.empty()
            ? fmt::format("monitor: {} active alerts, {} of them DANGER; {:.1f} % of a core",
                          monitor.alerts, monitor.dangers, 100.0 * monitor.load)
            : "monitor: " + silence + ", nothing is being monitored");
    for (std::size_t i = 0; i < monitor.system.size(); ++i) {
      if (monitor.inhibited[i] > 0.0) {
        lines.push_back(fmt::format("  alerts of {} are inhibited for another {:.0f} s",
                                    monitor.system[i], monitor.inhibited[i]));
      }
    }
    for (const auto& [id, alert] : alerts_) {
      lines.push_back(alertLine(alert));
    }
  }

  Json json() const {
    Json json = {{"time", time_},
                 {"loop", loop_.newest ? messageJson(*loop_.newest) : Json()},
                 {"others", runs_.duplicate(wallTime())},
                 {"left_out_of_others", runs_.ofOthers()},
                 {"monitor", monitor_.newest ? messageJson(*monitor_.newest) : Json()},
                 {"systems", Json::object()},
                 {"alerts", Json::array()}};
    for (const auto& [name, system] : systems_) {
      Json& one = json["systems"][name] = Json::object();
      const auto add = [&one](const char* kind, const auto& state) {
        if (state) {
          one[kind] = messageJson(*state);
        }
      };
      add("whirl", system.whirl);
      if (system.whirl) {
        one["vibration"] = system.vibration;  // null before a revolution
      }
      add("pendulum", system.pendulum);
      add("stability", system.margin);
    }
    for (const auto& [id, alert] : alerts_) {
      json["alerts"].push_back(messageJson(alert));
    }
    return json;
  }

  const WatchRequest& request_;
  LiveLines lines_;
  double time_ = 0.0;  ///< [s], simulated
  RunFilter runs_;
  Heard<state::LoopStatistics> loop_;
  Heard<state::MonitorStatus> monitor_;
  std::map<std::string, System> systems_;
  std::map<std::uint32_t, state::Alert> alerts_;
  LcmReceiver receiver_;  // last: it calls take()
};

int watch(const WatchRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  catchInterrupts();
  Watch watch(request);
  complain(fmt::format("twin watch: listening to {} for {}*\n", request.url, request.lcm_prefix));
  watch.watch();
  return watch.heard() ? kDone : kFailed;
}

}  // namespace

void addWatchCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("watch", kWatchDescription);
  const auto request = std::make_shared<WatchRequest>();
  command.quantity("--duration", request->duration, kListeningTime, "wall time", "until Ctrl-C")
      .type("S");
  command.option("--lcm-url", request->url, std::string("default: ") + kDefaultLcmUrl).type("URL");
  command
      .option("--lcm-prefix", request->lcm_prefix, "prefix of the twin's channels; default: TWIN_")
      .type("PREFIX");
  command.flag("--json", request->json, "print one JSON object at the end");
  command.footer(kWatchFooter);
  command.callback([request, &status] { status = watch(*request); });
}

}  // namespace whirl_twin
