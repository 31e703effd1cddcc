// Monitor node: subscribes to live states by ROS or by LCM, publishes stability margins and the
// list of alerts.

#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "monitoring/alarm_settings_reader.h"
#include "monitoring/twin_monitor.h"
#include "monitoring/watched_scene.h"
#include "nodes/alarm_services.h"
#include "nodes/alarm_settings_service.h"
#include "nodes/alert_events.h"
#include "nodes/changed_parameters.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/node_parameters.h"
#include "nodes/refusal_report.h"
#include "nodes/run_node.h"
#include "plugins/plugins.h"
#include "scene/scene_reader.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_publisher.h"
#include "transport/lcm_receiver.h"
#include "transport/master_watch.h"
#include "transport/ros_parameters.h"
#include "transport/ros_topics.h"
#include "transport/twin_namespace.h"
#include "twin/step_messages.h"

namespace whirl_twin {

namespace {

struct MonitorParameters {
  std::string source = "ros";
  std::string lcm_url, lcm_prefix, history;
  double await_scene = 0.0;  ///< [s]
};

NodeParameters table(MonitorParameters& p) {
  NodeParameters all("monitor_node",
                     "The monitor: receives live states by ROS or by LCM; publishes stability "
                     "margins and the list\n"
                     "of alerts. It needs the scene on the parameter server.");
  all.choice("source", p.source, {"ros", "lcm"}, "source of all messages it monitors")
      .lcm(p.lcm_url, p.lcm_prefix)
      .text("history", p.history, "none",
            "a file: every change of the alarms is saved in it and restored at start")
      .number("await_scene", p.await_scene, {0.0, 86400.0, "s"},
              "longest wait for the scene, which a played log brings")
      .others(
          "The limits of its alarms are those of config/monitor.yaml, where each is explained:\n"
          "  <rosparam command=\"load\" file=\"$(find whirl_twin)/config/monitor.yaml\"/>\n");
  return all;
}

constexpr std::uint32_t kQueue = 5000;        // some seconds at 1 kHz
constexpr std::uint32_t kPublishQueue = 100;  // ten seconds of margins
constexpr std::chrono::microseconds kGather{1000};
constexpr double kReportPeriod = 1.0;  // s, wall time
/// [s], wall time to wait for the scene of a twin, which is published every 2 s; logs of earlier
/// versions have none.
constexpr double kScenePatience = 3.0;

double wallTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The player of a log may load its scene a moment after the monitor starts.
const ros::NodeHandle& awaitScene(const ros::NodeHandle& node, double longest) {
  const double end = wallTime() + longest;
  while (!node.hasParam("scene") && wallTime() < end && !stopRequested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return node;
}

class MonitorNode {
 public:
  MonitorNode(ros::NodeHandle node, const MonitorParameters& parameters,
              std::vector<std::string> names)
      : node_(node),
        names_(std::move(names)),
        given_(parameterTree(awaitScene(node, parameters.await_scene), "scene")),
        scene_(build(readScene(given_.tree, given_.source))),
        watched_scene_(sceneLines(given_.tree), given_.source),
        settings_(alarmSettingsOf(scene_, names_)),
        monitor_(scene_, settings_.settings(), EvaluationQueue::Mode::kConcurrent),
        url_(parameters.lcm_url),
        lcm_(url_, parameters.lcm_prefix),
        rivals_(lcm_.prefix()),
        topics_(node, kPublishQueue),
        history_(monitor_, events_, parameters.history),
        services_(monitor_, ros::NodeHandle("~"), node, wallTime, [this] { history_.keepReset(); }),
        settings_service_(monitor_, settings_, ros::NodeHandle("~"),
                          [this](const std::string& text) { history_.keepSettings(text); }) {
    if (!lcm_.warning().empty()) {
      ROS_WARN("%s", lcm_.warning().c_str());
    } else if (lcm_.on()) {
      services_.listen(url_, lcm_.prefix());
    }
    for (const SharedSystem& system : scene_.systems) {
      topics_.advertise<state::StabilityMargin>(system->spec.name);
    }
    for (const ControllerSpec& controller : scene_.scene.controllers) {
      topics_.advertise<state::ControllerMargins>(controller.name);
    }
    for (std::size_t i = 0; i < scene_.systems.size(); ++i) {
      if (measuredOrbitOf(scene_, i)) {
        topics_.advertise<state::OrderState>(scene_.systems[i]->spec.name + "_measured");
      }
    }
    topics_.advertise<state::MonitorStatus>();
    publishAlerts();

    if (parameters.source == "ros") {
      subscribe();
    } else if (url_.empty()) {
      throw InputError("lcm_url: must be an LCM URL with source lcm, found nothing");
    } else {
      receive(url_);
    }
    diagnostics_.setHardwareID("none");
    diagnostics_.add("monitor", this, &MonitorNode::summarize);
    reportMaster(master_, diagnostics_);
    parameters_.report(diagnostics_);
    if (receiver_) {
      rivals_.report(diagnostics_);
    }
    refused_payloads_.emplace(diagnostics_, std::vector<const RefusedPayloads*>{
                                                services_.refusedPayloads(),
                                                receiver_ ? &receiver_->refused() : nullptr});
  }

  void spinOnce() {
    // Waits for states only briefly while an evaluation is running.
    const bool soon = monitor_.evaluating();
    if (receiver_) {
      receiver_->receive(std::chrono::microseconds(soon ? 200 : 10'000));
      ros::getGlobalCallbackQueue()->callAvailable();
    } else {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(soon ? 2.0e-4 : 1.0e-2));
    }
    if (!soon) {  // gathers messages to handle them in one turn
      std::this_thread::sleep_for(kGather);
    }
    services_.receive();
    askForScene();
    monitor_.tick(wallTime(), paused_);
    publish();
    // Wall time: simulated time is constant during a pause and jumps back in a reset.
    if (wallTime() >= next_report_) {
      next_report_ = wallTime() + kReportPeriod;
      diagnostics_.force_update();
      beat();
      events_.tellAgain(monitor_.alerts().active(), wallTime());
    }
  }

  /// Must be called before ros::shutdown().
  void stop() { master_.stop(); }

 private:
  /// Passes one message to the monitor; an invalid message is counted and discarded.
  template <class Message>
  void feed(const Message& message) {
    try {
      takeMessage(fromRos(message));
    } catch (const RejectedMessage& error) {
      ++rejected_;
      ROS_WARN_THROTTLE(5.0, "rejected: %s", error.what());
    }
  }

  template <class State>
  void subscribeTo(const std::string& subject = "") {
    using Type = RosType<State>;
    const boost::function<void(const boost::shared_ptr<const Type>&)> callback =
        [this](const boost::shared_ptr<const Type>& message) { feed(*message); };
    subscribers_.push_back(node_.subscribe<Type>(topicName(State::kKind, subject), kQueue, callback,
                                                 ros::VoidConstPtr(),
                                                 ros::TransportHints().tcpNoDelay()));
  }

  void subscribe() {
    StepMessages(scene_).announce([this](auto kind, const std::string& subject) {
      using State = typename decltype(kind)::State;
      if constexpr (isWatched<State>()) {
        subscribeTo<State>(subject);
      }
    });
    for (const SharedSystem& system : scene_.systems) {
      subscribeTo<state::FollowState>(system->spec.name);  // published by a state estimator only
    }
    for (const SensorSpec& sensor : scene_.scene.sensors) {
      subscribeTo<state::Measurement>(sensor.name);
    }
    subscribeTo<state::LoopStatistics>();
    subscribeTo<state::SceneText>();
  }

  void receive(const std::string& url) {
    Kinds kinds{&state::SceneText::kKind};
    eachKind([&kinds](auto kind) {
      using State = typename decltype(kind)::State;
      if (isWatched<State>()) {
        kinds.push_back(&State::kKind);
      }
    });
    const auto take = [this](const Message& message) {
      if (const auto* loop = std::get_if<state::LoopStatistics>(&message)) {
        rivals_.take(*loop);
      }
      std::visit([this](const auto& state) { takeMessage(state); }, message);
    };
    receiver_ = std::make_unique<LcmReceiver>(openLcm(url), kinds, take, lcm_.prefix());
  }

  template <class State>
  void takeState(const State& state) {
    if constexpr (IsWatchedState<State>::value) {
      newest_arrival_ = wallTime();
      monitor_.take(state, newest_arrival_);
    }
  }
  void takeState(const state::ParameterChange& change) {
    if (!monitor_.take(change)) {
      ++rejected_;
      ROS_WARN("rejected: parameters of '%s' do not match the scene", change.system.c_str());
    }
  }
  void takeState(const state::LoopStatistics& loop) {
    if (monitor_.take(loop, wallTime())) {
      paused_ = loop.paused;
    }
    if (monitor_.run() && simulation_ != monitor_.run()->first) {
      if (simulation_) {
        ROS_WARN("another run is monitored from now on, of %s", monitor_.watched().c_str());
      }
      simulation_ = monitor_.run()->first;
      watched_scene_.follow(simulation_);
    }
  }
  void takeState(const state::SceneText& scene) {
    const std::string before = watched_scene_.mismatch();
    watched_scene_.take(scene, simulation_);
    if (watched_scene_.mismatch() != before) {
      ROS_WARN("%s", before.empty() ? watched_scene_.mismatch().c_str()
                                    : "twin and monitor have the same scene");
    }
  }
  /// Must be called before any state is evaluated.
  void askForScene() {
    const double heard_for = wallTime() - first_arrival_;
    const bool waits = !watched_scene_.received() && heard_for >= 0.0 && heard_for < kScenePatience;
    monitor_.setUncertain(waits ? "the scene of the twin was not received yet"
                                : watched_scene_.mismatch());
  }
  template <class State>
  void takeMessage(const State& state) {
    first_arrival_ = std::min(first_arrival_, wallTime());
    askForScene();
    takeState(state);
  }

  void publish() {
    for (const state::StabilityMargin& margin : monitor_.takeMargins()) {
      lcm_.publish(margin);
      topics_.publish(margin);
    }
    for (const state::ControllerMargins& margins : monitor_.takeLoopMargins()) {
      lcm_.publish(margins);
      topics_.publish(margins);
    }
    for (const state::OrderState& orders : monitor_.takeOrders()) {
      lcm_.publish(orders);
      topics_.publish(orders);
    }
    history_.keep();
    if (monitor_.alerts().takeChanged()) {
      publishAlerts();
    }
  }

  /// Publishes the heartbeat. Wall time: also during a pause.
  void beat() {
    state::MonitorStatus status = monitor_.status(wallTime(), paused_);
    status.at.stamp = stampNow();
    topics_.publish(status);
    lcm_.publish(status);
  }

  void publishAlerts() { topics_.publishAlerts(monitor_.alerts().active(), stampNow()); }

  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const std::vector<state::Alert> active = monitor_.alerts().active();
    status.summary(DiagnosticStatus::OK, "no alerts");
    if (!active.empty()) {
      status.summary(active.front().severity == state::Severity::kDanger ? DiagnosticStatus::ERROR
                                                                         : DiagnosticStatus::WARN,
                     active.front().text);
    }
    if (!watched_scene_.mismatch().empty()) {
      status.mergeSummary(DiagnosticStatus::ERROR, watched_scene_.mismatch());
    }
    if (const std::string held = monitor_.heldBack(); !held.empty()) {
      status.mergeSummary(DiagnosticStatus::WARN, held);
    }
    const auto acknowledged = std::count_if(
        active.begin(), active.end(), [](const state::Alert& alert) { return alert.acknowledged; });
    if (!paused_ && wallTime() - newest_arrival_ > monitor_.settings().data_timeout) {
      status.mergeSummary(DiagnosticStatus::WARN, "no states are received: nothing is monitored");
    }
    const std::vector<std::string> not_ok = monitor_.notOk(wallTime(), paused_);
    const std::vector<std::string> systems = monitor_.systemNames();
    for (std::size_t i = 0; i < systems.size(); ++i) {
      if (!not_ok[i].empty()) {
        status.mergeSummary(DiagnosticStatus::WARN, systems[i] + ": " + not_ok[i]);
        status.add(systems[i] + " data quality", not_ok[i]);
      }
    }
    if (const std::string problem = history_.problem(); !problem.empty()) {
      status.mergeSummary(DiagnosticStatus::WARN, problem);
    }
    status.add("active alerts", active.size());
    status.add("acknowledged alerts", acknowledged);
    status.add("simulated time [s]", monitor_.time());
    status.add("watches", monitor_.watched());
    status.add("statistics of other twins", monitor_.ofOthers());
    status.add("alarm commands", services_.taken());
    status.add("refused alarm commands", services_.refused());
    status.add("rejected messages", rejected_ + (receiver_ ? receiver_->rejected() : 0));
  }

  ros::NodeHandle node_;
  std::vector<std::string> names_;  // of the private parameters that are no settings of alarms
  ParameterTree given_;
  BuiltScene scene_;
  WatchedScene watched_scene_;
  LiveAlarmSettings settings_;
  TwinMonitor monitor_;
  std::string url_;
  LcmPublisher lcm_;
  AlertEvents events_{lcm_};
  DuplicatePublishers rivals_;
  RosTopics topics_;
  KeptHistory history_;
  AlarmServices services_;
  AlarmSettingsService settings_service_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  MasterWatch master_;
  ChangedParameters parameters_{
      master_, names_, [this](const YAML::Node& all) { return settings_service_.obey(all); }};
  diagnostic_updater::Updater diagnostics_;
  std::optional<RefusalReport> refused_payloads_;
  std::uint64_t rejected_ = 0;
  bool paused_ = false;                                             // as reported by the simulation
  std::optional<std::int64_t> simulation_;                          // start of the monitored run
  double newest_arrival_ = 0.0;                                     // [s], wall time
  double first_arrival_ = std::numeric_limits<double>::infinity();  // [s], wall time
  double next_report_ = 0.0;                                        // [s], wall time
};

void run() {
  usePlugins();
  MonitorParameters parameters;
  const NodeParameters all = table(parameters);
  all.read();
  MonitorNode monitor(ros::NodeHandle(twinNamespace()), parameters, all.names());
  while (!stopRequested() && ros::ok()) {
    monitor.spinOnce();
  }
  monitor.stop();
  ros::shutdown();
}

}  // namespace

}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "monitor_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
