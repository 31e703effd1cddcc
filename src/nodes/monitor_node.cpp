// The monitor: live states in, by ROS or by LCM; stability margins and the list of alerts out.

#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <whirl_twin/AlertArray.h>
#include <whirl_twin/LoopStatistics.h>

#include <chrono>
#include <map>
#include <memory>

#include "messages/message_check.h"
#include "monitoring/twin_monitor.h"
#include "nodes/private_parameter.h"
#include "nodes/run_node.h"
#include "plugins/plugin_models.h"
#include "scene/scene_reader.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_publisher.h"
#include "transport/lcm_receiver.h"
#include "transport/ros_converters.h"
#include "transport/ros_parameters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kQueue = 5000;  // some seconds at 1 kHz
constexpr double kReportPeriod = 1.0;   // s, wall time

double wallTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

AlarmSettings alarmSettings() {
  AlarmSettings s;
  const auto read = [](const char* name, double& value) {
    value = privateParameter(name, "a number", value);
  };
  read("approach_time", s.approach_time);
  read("clear_delay", s.clear_delay);
  read("hysteresis", s.hysteresis);
  read("dwell_limit", s.dwell_limit);
  read("decay_rate_alarm", s.decay_rate_alarm);
  read("log_decrement_warning", s.log_decrement_warning);
  read("energy_residual", s.energy_residual);
  read("data_timeout", s.data_timeout);
  const std::vector<std::string> errors = settingErrors(s);
  if (!errors.empty()) {
    throw std::invalid_argument(fmt::format("{}", fmt::join(errors, "\n")));
  }
  return s;
}

BuiltScene sceneOf(const ParameterTree& given) {
  return build(readScene(given.tree, given.source));
}

class MonitorNode {
 public:
  explicit MonitorNode(ros::NodeHandle node)
      : node_(node),
        scene_(sceneOf(parameterTree(node, "scene"))),
        settings_(alarmSettings()),
        monitor_(scene_, settings_),
        url_(privateParameter<std::string>("lcm_url", "an LCM url, or nothing", kDefaultLcmUrl)),
        lcm_(url_),
        alerts_(node.advertise<AlertArray>("alerts", 10, true)) {
    if (!lcm_.warning().empty()) {
      ROS_WARN("%s", lcm_.warning().c_str());
    }
    for (const SharedSystem& system : scene_.systems) {
      const std::string& name = system->spec.name;
      margins_[name] = node.advertise<StabilityMargin>(name + "/stability", 100);
    }
    publishAlerts();

    const auto source = privateParameter<std::string>("source", "ros or lcm", "ros");
    if (source == "ros") {
      subscribe();
    } else if (source == "lcm") {
      if (url_.empty()) {
        throw std::invalid_argument("lcm_url: source is lcm, expected an LCM url, found nothing");
      }
      receive(url_);
    } else {
      throw std::invalid_argument("source: must be ros or lcm, found '" + source + "'");
    }
    subscribers_.push_back(node_.subscribe("loop", 10, &MonitorNode::onLoop, this));
    diagnostics_.setHardwareID("none");
    diagnostics_.add("monitor", this, &MonitorNode::summarize);
  }

  void spinOnce() {
    if (receiver_) {
      receiver_->receive(std::chrono::milliseconds(10));
      ros::getGlobalCallbackQueue()->callAvailable();
    } else {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
    monitor_.tick(wallTime(), paused_);
    publish();
    // Wall time: simulated time stands still in a pause and goes back in a reset.
    if (wallTime() >= next_report_) {
      next_report_ = wallTime() + kReportPeriod;
      diagnostics_.force_update();
    }
  }

 private:
  /// Feeds one message to the monitor; a message that cannot be meant is counted and left.
  template <class Message>
  void feed(const Message& message) {
    try {
      takeState(fromRos(message));
    } catch (const RejectedMessage& error) {
      ++rejected_;
      ROS_WARN_THROTTLE(5.0, "rejected: %s", error.what());
    }
  }

  template <class Message>
  void subscribeTo(const std::string& topic) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this](const boost::shared_ptr<const Message>& message) { feed(*message); };
    subscribers_.push_back(node_.subscribe<Message>(topic, kQueue, callback, ros::VoidConstPtr(),
                                                    ros::TransportHints().tcpNoDelay()));
  }

  void subscribe() {
    for (const SharedSystem& system : scene_.systems) {
      if (system->dynamics->isRotor()) {
        subscribeTo<WhirlState>(system->spec.name + "/whirl");
      } else {
        subscribeTo<PendulumState>(system->spec.name + "/pendulum");
      }
    }
    for (const SharedSystem& system : scene_.systems) {
      subscribeTo<ParameterChange>(system->spec.name + "/parameters");
    }
    for (const DriveSpec& drive : scene_.scene.drives) {
      subscribeTo<DriveState>("drives/" + drive.name);
    }
  }

  void receive(const std::string& url) {
    receiver_ = std::make_unique<LcmReceiver>(
        openLcm(url),
        std::vector<ChannelKind>{ChannelKind::kWhirl, ChannelKind::kPendulum, ChannelKind::kDrive,
                                 ChannelKind::kParameter},
        [this](const TwinState& state) {
          std::visit([this](const auto& s) { takeState(s); }, state);
        });
  }
  template <class State>
  void takeState(const State& s) {
    newest_arrival_ = wallTime();
    monitor_.take(s, newest_arrival_);
  }
  void takeState(const state::ParameterChange& change) {
    if (!monitor_.take(change)) {
      ++rejected_;
      ROS_WARN("rejected: parameters of '%s' that are not those of the scene",
               change.system.c_str());
    }
  }
  void takeState(const state::MotorState&) {}
  void takeState(const state::EnsembleState&) {}
  void takeState(const state::StabilityMargin&) {}
  void takeState(const state::Alert&) {}

  void onLoop(const LoopStatistics& loop) {
    paused_ = loop.paused;
    for (std::size_t i = 0;
         i < loop.system.size() && i < loop.stopped.size() && i < loop.stopped_why.size(); ++i) {
      monitor_.takeStopped(loop.system[i], loop.time, static_cast<StepStatus>(loop.stopped[i]),
                           loop.stopped_why[i]);
    }
    for (std::size_t i = 0;
         i < loop.system.size() && i < loop.error_estimate.size() && i < loop.tolerance.size();
         ++i) {
      monitor_.takeAccuracy(loop.system[i], loop.time, loop.error_estimate[i], loop.tolerance[i]);
    }
  }

  void publish() {
    for (const state::StabilityMargin& margin : monitor_.takeMargins()) {
      lcm_.publish(margin);
      margins_.at(margin.system).publish(toRos(margin));
    }
    for (const state::Alert& event : monitor_.alerts().takeEvents()) {
      lcm_.publish(event);
      if (event.raised) {
        ROS_WARN("%s", event.text.c_str());
      } else {
        ROS_INFO("%s: %s cleared: %s", event.system.c_str(), event.type.c_str(),
                 event.text.c_str());
      }
    }
    if (monitor_.alerts().takeChanged()) {
      publishAlerts();
    }
  }

  void publishAlerts() {
    alerts_.publish(
        toRos(monitor_.alerts().active(), static_cast<std::int64_t>(ros::Time::now().toNSec())));
  }

  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const std::vector<state::Alert> active = monitor_.alerts().active();
    status.summary(DiagnosticStatus::OK, "no alerts");
    if (!active.empty()) {
      status.summary(active.front().severity == state::Severity::kDanger ? DiagnosticStatus::ERROR
                                                                         : DiagnosticStatus::WARN,
                     active.front().text);
    }
    if (!paused_ && wallTime() - newest_arrival_ > settings_.data_timeout) {
      status.mergeSummary(DiagnosticStatus::WARN, "no states arrive: nothing is being watched");
    }
    status.add("active alerts", active.size());
    status.add("simulated time [s]", monitor_.time());
    status.add("rejected messages", rejected_ + (receiver_ ? receiver_->rejected() : 0));
  }

  ros::NodeHandle node_;
  BuiltScene scene_;
  AlarmSettings settings_;
  TwinMonitor monitor_;
  std::string url_;
  LcmPublisher lcm_;
  ros::Publisher alerts_;
  std::map<std::string, ros::Publisher> margins_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  diagnostic_updater::Updater diagnostics_;
  std::uint64_t rejected_ = 0;
  bool paused_ = false;          // the simulation says so
  double newest_arrival_ = 0.0;  // [s], wall time
  double next_report_ = 0.0;     // [s], wall time
};

void run() {
  usePluginModels();
  MonitorNode monitor(ros::NodeHandle("/twin"));
  while (!stopRequested() && ros::ok()) {
    monitor.spinOnce();
  }
  ros::shutdown();
}

}  // namespace

}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "monitor_node", whirl_twin::run);
}
