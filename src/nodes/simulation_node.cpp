// The simulation: a scene, stepped at a fixed rate in a real-time thread; states on ROS and LCM.
//
// Threads: the loop (FixedRateLoop) steps and writes records into a ring; the publisher drains the
// ring and owns all sockets; this thread serves the services and the diagnostics.

#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <mutex>
#include <thread>

#include "accuracy/step_choice.h"
#include "nodes/input_commands.h"
#include "nodes/loop_report.h"
#include "nodes/private_parameter.h"
#include "nodes/run_node.h"
#include "nodes/state_publisher.h"
#include "nodes/twin_services.h"
#include "plugins/plugin_models.h"
#include "realtime/fixed_rate_loop.h"
#include "scene/scene_reader.h"
#include "transport/channels.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "twin/live_twin.h"

namespace whirl_twin {

namespace {

constexpr double kSlowestRate = 1.0e-3;         // Hz, of publication
constexpr std::int64_t kShortestStep = 10'000;  // ns, that the fixed-rate loop takes
constexpr auto kClockPausePeriod = std::chrono::milliseconds(100);
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr double kServicePoll = 0.05;   // s
constexpr double kCommandPoll = 0.002;  // s, where there are ramps or commands by LCM

std::int64_t clockNow(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

/// The node's private parameters.
struct Settings {
  std::int64_t every;  ///< steps from one publication to the next
  std::string lcm_url;
  std::string lcm_prefix;
  bool clock;
  FixedRateLoop::Options loop;
};

Settings readSettings(const Scene& scene) {
  requireKnownParameters(
      {"publish_rate", "lcm_url", "lcm_prefix", "clock", "realtime", "priority", "overrun"});
  Settings s;
  const auto rate = privateParameter("publish_rate", "a number in Hz", 0.0);
  if (!(rate == 0.0 || (rate >= kSlowestRate && std::isfinite(rate)))) {
    throw Refusal(fmt::format("publish_rate: must be 0 (every step), or at least {} Hz, found {}",
                              kSlowestRate, rate));
  }
  s.every =
      rate == 0.0 ? 1 : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
  s.lcm_url = privateParameter<std::string>("lcm_url", "an LCM url, or nothing", kDefaultLcmUrl);
  s.lcm_prefix = lcmPrefixParameter();
  s.clock = privateParameter("clock", "true or false", false);
  if (s.clock && scene.time < 0) {
    throw Refusal("clock: needs a scene whose time is >= 0 s");
  }
  if (scene.step < kShortestStep) {
    throw Refusal(fmt::format("{}: step: must be >= {:g} s to run live, found {:g} s", scene.source,
                              static_cast<double>(kShortestStep) * 1.0e-9, scene.stepSeconds()));
  }
  s.loop.period = scene.step;
  s.loop.mode = parseRealtimeMode(
      privateParameter<std::string>("realtime", "enforce, warn or ignore", "warn"));
  s.loop.priority = privateParameter("priority", "a whole number", 50);
  s.loop.policy = parseOverrunPolicy(
      privateParameter<std::string>("overrun", "skip, catch_up or stop", "skip"));
  return s;
}

/// The publisher thread: everything that leaves the node at the rate of the steps.
class Publisher {
 public:
  Publisher(LiveTwin& live, const FixedRateLoop& loop, ros::NodeHandle node,
            const Settings& settings)
      : live_(live),
        loop_(loop),
        observer_(live.twin(), live.generations()),
        states_(live.twin(), live.ensembles(), node,
                LcmPublisher(settings.lcm_url, settings.lcm_prefix), settings.clock),
        clock_(settings.clock),
        every_(settings.every),
        epoch_(clockNow(CLOCK_REALTIME) - clockNow(CLOCK_MONOTONIC)),
        stopped_(live.twin().systems().size()) {
    if (!states_.lcm().warning().empty()) {
      ROS_WARN("%s", states_.lcm().warning().c_str());
    }
  }
  ~Publisher() { join(); }

  void start() {
    thread_ = std::thread([this] { run(); });
  }
  void join() {
    ending_.store(true);
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  /// The newest report, for the diagnostics.
  state::LoopStatistics report() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return report_;
  }

 private:
  void run() {
    std::vector<double> record(live_.twin().layout().size);
    auto next_report = std::chrono::steady_clock::now();
    auto next_clock = next_report;
    while (true) {
      const bool last_round = ending_.load();
      bool stopped_now = false;
      bool any = false;
      while (live_.pop(record.data())) {
        stopped_now = take(record.data()) || stopped_now;
        any = true;
      }
      if (any) {  // once for all records, which are not to wait for statistics
        states_.publishEnsembles(observer_);
      }
      const auto now = std::chrono::steady_clock::now();
      if (stopped_now || now >= next_report) {
        publishReport();
        next_report = now + kReportPeriod;
      }
      if (clock_ && live_.paused() && now >= next_clock) {
        states_.publishClock(observer_);
        next_clock = now + kClockPausePeriod;
      }
      if (last_round) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  /// One record; true if a system has just stopped.
  bool take(const double* record) {
    observer_.observe(record);
    const Scene& scene = live_.twin().scene();
    observer_.setStamp(clock_ ? scene.time + observer_.step() * scene.step
                              : epoch_ + RecordLayout::scheduled(record));
    states_.publish(observer_, observer_.step() % every_ == 0 && !observer_.tellsOnlyChange());
    bool stopped_now = false;
    for (std::size_t i = 0; i < stopped_.size(); ++i) {
      const bool stopped = observer_.status(i) != StepStatus::kOk;
      if (stopped && !stopped_[i]) {
        ROS_ERROR("%s", observer_.stopReason(i).c_str());
        stopped_now = true;
      }
      stopped_[i] = stopped;
    }
    return stopped_now;
  }

  void publishReport() {
    state::LoopStatistics report = loopStatistics(live_.twin(), observer_, loop_.status(),
                                                  loop_.timing(), live_.paused(), live_.dropped());
    report.at.stamp = static_cast<std::int64_t>(ros::Time::now().toNSec());
    states_.publish(report);
    const std::lock_guard<std::mutex> lock(mutex_);
    report_ = report;
  }

  LiveTwin& live_;
  const FixedRateLoop& loop_;
  Observer observer_;
  StatePublisher states_;
  bool clock_;
  std::int64_t every_;  // steps from one publication to the next
  std::int64_t epoch_;  // [ns], wall clock at zero of CLOCK_MONOTONIC
  std::vector<bool> stopped_;
  mutable std::mutex mutex_;  // report_, between this thread and the diagnostics
  state::LoopStatistics report_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

void run() {
  ros::NodeHandle node(twinNamespace());
  ros::NodeHandle private_node("~");
  usePluginModels();
  const ParameterTree given = parameterTree(node, "scene");
  const Scene scene = withStepsChosen(readScene(given.tree, given.source));
  const Settings settings = readSettings(scene);

  // Half a second of records, or some: what the publisher may be late by.
  const auto capacity =
      static_cast<std::size_t>(std::max<std::int64_t>(64, 500'000'000 / scene.step));
  LiveTwin live(scene, std::min<std::size_t>(capacity, 100'000));
  FixedRateLoop loop(settings.loop);
  Publisher publisher(live, loop, node, settings);
  TwinServices services(live, private_node,
                        [&] { return !stopRequested() && ros::ok() && loop.running(); });

  InputCommands commands(live, services, node, settings.lcm_url, settings.lcm_prefix);

  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("none");
  diagnostics.add("real-time loop", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    summarize(publisher.report(), status);
    if (commands.any()) {
      status.add("commands to inputs", commands.taken());
      status.add("refused commands to inputs", commands.refused());
    }
  });

  for (const SharedSystem& system : live.twin().systems()) {
    ROS_INFO("%s: %s with %s%s%s%s", system->spec.name.c_str(), system->model->name.c_str(),
             system->integrator.c_str(), system->integrator_reason.empty() ? "" : " (",
             system->integrator_reason.c_str(), system->integrator_reason.empty() ? "" : ")");
  }
  loop.start([&live](std::int64_t scheduled) { return live.cycle(scheduled); });
  const RealtimeStatus status = loop.status();
  for (const std::string& warning : status.warnings) {
    ROS_WARN("%s", warning.c_str());
  }
  ROS_INFO("stepping every %g s with %s, priority %d, memory %slocked", scene.stepSeconds(),
           status.policy.c_str(), status.priority, status.memory_locked ? "" : "not ");
  publisher.start();

  // Wall time: simulated time stands still in a pause and goes back in a reset.
  auto next_report = std::chrono::steady_clock::now();
  while (!stopRequested() && ros::ok() && loop.running()) {
    ros::getGlobalCallbackQueue()->callAvailable(
        ros::WallDuration(services.ramping() || commands.any() ? kCommandPoll : kServicePoll));
    services.continueRamps();
    commands.receive();
    if (std::chrono::steady_clock::now() >= next_report) {
      next_report = std::chrono::steady_clock::now() + kReportPeriod;
      diagnostics.force_update();
    }
  }
  const bool by_itself = !loop.running() && !stopRequested();
  loop.stop();
  publisher.join();
  ROS_INFO("stopped after %ld steps", static_cast<long>(live.twin().stepCount()));
  ros::shutdown();
  if (by_itself) {
    throw RunFailure("a step ended too late, and the parameter overrun says stop");
  }
}

}  // namespace

}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "simulation_node", whirl_twin::run);
}
