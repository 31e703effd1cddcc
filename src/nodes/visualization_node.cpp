// visualization_node: publishes states of the twin as rviz markers and tf.
//
// Publishes markers (visualization_msgs/MarkerArray, frame `world`) and the tf frames world ->
// <system> -> <system>_disc or <system>_body, as drawn, of the twin in its namespace, and world ->
// twin_view, which the camera of config/rviz/demo.rviz follows. The models are those of the twin's
// scene, if there is one.
#include <fmt/format.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "display/layout.h"
#include "display/mechanism_display.h"
#include "display/rotor_display.h"
#include "display/scene_dynamics.h"
#include "display/shaft_display.h"
#include "display/twin_listener.h"
#include "display/twin_panel.h"
#include "display/vibration_limits.h"
#include "messages/input_error.h"
#include "nodes/node_parameters.h"
#include "plugins/plugins.h"
#include "transport/master_watch.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {
namespace {

struct DisplayParameters {
  double rate = 30.0, whirl_scale = 0.0, trail_turns = 3.0;
  std::string monitor = "monitor_node";
};

NodeParameters table(DisplayParameters& p) {
  NodeParameters all(
      "visualization_node",
      "Shows the states of a twin in rviz: markers and tf frames of its systems, margins and "
      "alarms.");
  all.number("rate", p.rate, {1.0e-3, 1000.0, "Hz"}, "frames per second")
      .number("whirl_scale", p.whirl_scale, {1.0e-9, 1.0e12, "", "chosen automatically"},
              "magnification of the whirl")
      .number("trail_turns", p.trail_turns, {1.0e-3, 1.0e6, "revolutions"},
              "length of the orbit's trail")
      .text("monitor", p.monitor, "", "the node whose limits are drawn");
  return all;
}

const ros::WallDuration kMeasuredFor(1.0);  // display time of a measurement

geometry_msgs::TransformStamped stampedTransform(const std::string& parent,
                                                 const std::string& child, const ros::Time& stamp,
                                                 const Eigen::Isometry3d& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = pose.translation().x();
  transform.transform.translation.y = pose.translation().y();
  transform.transform.translation.z = pose.translation().z();
  const Eigen::Quaterniond rotation(pose.linear());
  transform.transform.rotation.x = rotation.x();
  transform.transform.rotation.y = rotation.y();
  transform.transform.rotation.z = rotation.z();
  transform.transform.rotation.w = rotation.w();
  return transform;
}

class VisualizationNode {
 public:
  explicit VisualizationNode(const DisplayParameters& parameters)
      : whirl_scale_(parameters.whirl_scale),
        trail_turns_(parameters.trail_turns),
        rate_(parameters.rate),
        monitor_(ros::names::resolve(parameters.monitor)) {
    ros::NodeHandle node;
    publisher_ = node.advertise<visualization_msgs::MarkerArray>(twinNamespace() + "/markers", 2);
    listener_.onWhirl([this](const std::string& published, const WhirlState& state) {
      const std::string system = scene_.systemOf(published);
      if (ShaftDisplay* shaft = shaftOf(system)) {
        shaft->update(published, state);
        return;
      }
      rotors_.try_emplace(published, published, whirl_scale_, trail_turns_)
          .first->second.update(state);
    });
    listener_.onPendulum([this](const std::string& system, const PendulumState& state) {
      const DriveState* drive = listener_.drive(scene_.driveOf(system));
      mechanismOf(system).update(state, scene_.shaft(system, state.time, drive));
    });
    listener_.onMeasurement([this](const std::string& source, const Measurement& block) {
      takeMeasurement(source, block);
    });
    listener_.onController([this](const std::string& controller, const ControllerState& state) {
      controllers_[controller].take(state, scene_.actuatorLimit(controller));
    });
    listener_.onControllerMargins(
        [this](const std::string& controller, const ControllerMargins::ConstPtr& margins) {
          controllers_[controller].take(margins);
        });
    listener_.onLoop(
        [this](const LoopStatistics& loop) { loop_.take(loop, ros::WallTime::now().toSec()); });
    listener_.onParameters([this](const ParameterChange& change) { takeParameters(change); });
    discover();
    // Wall timers: the display is also updated while simulated time is constant.
    discover_timer_ =
        node.createWallTimer(ros::WallDuration(1.0), [this](const auto&) { discover(); });
    draw_timer_ =
        node.createWallTimer(ros::WallDuration(1.0 / rate_), [this](const auto&) { draw(); });
  }

 private:
  MechanismDisplay& mechanismOf(const std::string& system) {
    const auto found = mechanisms_.find(system);
    return found != mechanisms_.end()
               ? found->second
               : mechanisms_.try_emplace(system, system, scene_.dynamics(system)).first->second;
  }

  /// Null for an unknown rotor, or one without stations along a shaft.
  ShaftDisplay* shaftOf(const std::string& system) {
    const auto found = shafts_.find(system);
    if (found != shafts_.end()) {
      return &found->second;
    }
    if (rotors_.count(system) > 0) {
      return nullptr;
    }
    const auto dynamics = scene_.dynamics(system);
    if (!ShaftDisplay::shows(dynamics.get())) {
      return nullptr;
    }
    return &shafts_.try_emplace(system, system, dynamics, whirl_scale_, trail_turns_).first->second;
  }

  void takeParameters(const ParameterChange& change) {
    const std::string system = change.header.frame_id;
    parameters_[system] = change;
    if (!scene_.take(change)) {
      return;
    }
    if (const auto mechanism = mechanisms_.find(system); mechanism != mechanisms_.end()) {
      mechanism->second.setDynamics(scene_.dynamics(system));
    }
    if (const auto shaft = shafts_.find(system); shaft != shafts_.end()) {
      shaft->second.setDynamics(scene_.dynamics(system));
    }
  }

  void takeMeasurement(const std::string& source, const Measurement& block) {
    for (auto& [name, mechanism] : mechanisms_) {
      const auto place = scene_.measuredPlace(name);
      if (place && place->source() == source) {
        mechanism.measure(place->newest(block));
        measured_at_[name] = ros::WallTime::now();
      }
    }
  }

  void discover() {
    listener_.discover();
    const auto gone = [this](const auto& entry) {
      return listener_.systems().count(entry.first) == 0;
    };
    for (auto it = rotors_.begin(); it != rotors_.end();) {
      it = gone(*it) ? rotors_.erase(it) : std::next(it);
    }
    for (auto it = shafts_.begin(); it != shafts_.end();) {
      it = gone(*it) ? shafts_.erase(it) : std::next(it);
    }
    if (scene_.refresh()) {
      mechanisms_.clear();
      rotors_.clear();
      shafts_.clear();
      controllers_.clear();
      for (const auto& [system, change] : parameters_) {  // latched messages that arrived before
        scene_.take(change);
      }
    }
    for (auto it = mechanisms_.begin(); it != mechanisms_.end();) {
      it = gone(*it) ? mechanisms_.erase(it) : std::next(it);
    }
    std::vector<std::string> rotors;
    for (const auto& entry : rotors_) {
      rotors.push_back(entry.first);
    }
    for (const auto& entry : shafts_) {
      const std::vector<std::string> published = entry.second.published();
      rotors.insert(rotors.end(), published.begin(), published.end());
    }
    settings_ = settingsOfMonitor(monitor_, rotors);
  }

  void draw() {
    for (auto& [name, mechanism] : mechanisms_) {
      if (ros::WallTime::now() - measured_at_[name] > kMeasuredFor) {
        mechanism.measuredGone();
      }
    }
    std::vector<std::pair<std::string, const SystemDisplay*>> displays;
    for (const auto& [name, rotor] : rotors_) {
      displays.emplace_back(name, &rotor);
    }
    for (const auto& [name, shaft] : shafts_) {
      displays.emplace_back(name, &shaft);
    }
    for (const auto& [name, mechanism] : mechanisms_) {
      displays.emplace_back(name, &mechanism);
    }
    visualization_msgs::MarkerArray markers;
    std::vector<std::string> names;
    for (const auto& display : displays) {
      names.push_back(display.first);
    }
    if (names != drawn_) {
      markers.markers.push_back(deleteAllMarkers());
      drawn_ = names;
    }
    const ros::Time now = ros::Time().fromNSec(static_cast<std::uint64_t>(stampNow()));
    std::vector<geometry_msgs::TransformStamped> transforms;
    const Layout layout = layoutOf(displays.size());
    for (std::size_t i = 0; i < displays.size(); ++i) {
      const auto& [name, display] = displays[i];
      const Eigen::Isometry3d pose = display->placedAt(layout.places[i]);
      MarkerCanvas canvas(markers, name, pose);
      SystemStatus status = statusOf(name);
      status.compact = layout.compact;
      if (const auto shaft = shafts_.find(name); shaft != shafts_.end()) {
        addPlaces(shaft->second, status);
      }
      display->draw(status, canvas);
      transforms.push_back(stampedTransform(MarkerCanvas::kWorldFrame, name, now, pose));
      transforms.push_back(
          stampedTransform(name, name + "_" + display->bodyName(), now, display->bodyPose()));
    }
    const auto& alerts = listener_.alerts();
    drawTwin(alerts ? alerts->alerts : std::vector<Alert>(), loop_, listener_.monitor(),
             listener_.monitorSilence(), ros::WallTime::now().toSec(), layout, markers);
    Eigen::Isometry3d view = Eigen::Isometry3d::Identity();
    view.translation() = layout.view;
    transforms.push_back(
        stampedTransform(MarkerCanvas::kWorldFrame, ViewedFrom::kFrame, now, view));
    publisher_.publish(markers);
    // tf warns of repeated stamps, which occur while simulated time is constant.
    if (now != transformed_) {
      broadcaster_.sendTransform(transforms);
      transformed_ = now;
    }
  }

  /// The result of the monitor for a system, or that the monitor has timed out.
  SystemStatus statusOf(const std::string& name) {
    const SystemReadout& readout = listener_.systems().at(name);
    SystemStatus status;
    status.orders = readout.orders;
    status.vibration = readout.vibration;
    status.follow = readout.follow;
    if (readout.follow) {
      loop_.setFollowing();
    }
    if (readout.whirl) {
      status.limits = vibrationLimits(settings_, name, readout.whirl->speed);
    }
    const std::string silence = listener_.monitorSilence();
    const bool held = listener_.monitor() && listener_.monitor()->paused;
    // A station has the margin of its rotor.
    const auto judged = listener_.systems().find(scene_.systemOf(name));
    const SystemReadout& of = judged == listener_.systems().end() ? readout : judged->second;
    status.live =
        liveMargin(of.margin, ros::WallTime::now().toSec() - of.margin_heard, held, silence);
    // As in the monitor, which requires no damping of systems other than rotors.
    status.live.least_decrement = readout.whirl ? settings_.log_decrement_warning : 0.0;
    status.live.least_decay_rate = readout.whirl ? settings_.decay_rate_alarm : 0.0;
    status.alerts = listener_.alertsOf(name);
    for (const auto& [controller, live] : controllers_) {
      const std::vector<Command> commands = live.commandsOn(name);
      status.commands.insert(status.commands.end(), commands.begin(), commands.end());
      if (commands.empty()) {
        continue;
      }
      if (const std::string loop = live.loopText(); silence.empty() && !loop.empty()) {
        status.loops.push_back(controller + ": " + loop);
      }
      for (const Alert& alert : listener_.alertsOf(controller)) {
        status.alerts.push_back(alert);
      }
    }
    mostSevereFirst(status.alerts);
    if (!silence.empty()) {
      Alert silent;
      silent.severity = Alert::WARNING;
      silent.type = "MONITOR_SILENT";
      silent.system = name;
      silent.text = silence;
      status.alerts = {silent};
    }
    return status;
  }

  /// Limits and alerts of the further stations of a shaft.
  void addPlaces(const ShaftDisplay& shaft, SystemStatus& status) {
    const std::vector<std::string> names = shaft.published();
    for (std::size_t i = 1; i < names.size(); ++i) {
      const auto readout = listener_.systems().find(names[i]);
      if (readout != listener_.systems().end() && readout->second.whirl) {
        status.further_limits[names[i]] =
            vibrationLimits(settings_, names[i], readout->second.whirl->speed);
      }
      if (listener_.monitorSilence().empty()) {
        const std::vector<Alert> alerts = listener_.alertsOf(names[i]);
        status.alerts.insert(status.alerts.end(), alerts.begin(), alerts.end());
      }
    }
    mostSevereFirst(status.alerts);
  }

  static void mostSevereFirst(std::vector<Alert>& alerts) {
    std::stable_sort(alerts.begin(), alerts.end(),
                     [](const Alert& a, const Alert& b) { return a.severity > b.severity; });
  }

  double whirl_scale_;  // -
  double trail_turns_;
  double rate_;  // Hz
  std::string monitor_;
  AlarmSettings settings_;  // of the monitor
  LoopHealth loop_;
  TwinListener listener_;
  std::map<std::string, RotorDisplay> rotors_;
  std::map<std::string, ShaftDisplay> shafts_;
  SceneDynamics scene_;
  std::map<std::string, ParameterChange> parameters_;  // the latest of each system
  std::map<std::string, MechanismDisplay> mechanisms_;
  std::map<std::string, LiveController> controllers_;
  std::map<std::string, ros::WallTime> measured_at_;  // last measurement of each
  std::vector<std::string> drawn_;                    // systems in the order of the last frame
  ros::Publisher publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Time transformed_;
  ros::WallTimer discover_timer_;
  ros::WallTimer draw_timer_;
};

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  whirl_twin::DisplayParameters parameters;
  const whirl_twin::NodeParameters table = whirl_twin::table(parameters);
  if (whirl_twin::printsHelp(argc, argv, table.help())) {
    return 0;
  }
  ros::init(argc, argv, "visualization_node");
  ros::NodeHandle node;  // keeps ROS up while the parameters are read
  try {
    whirl_twin::usePlugins();
    table.read();
    const whirl_twin::VisualizationNode visualization(parameters);
    const whirl_twin::MasterWatch master;
    ros::spin();
  } catch (const whirl_twin::InputError& error) {
    std::fprintf(stderr, "visualization_node: %s\n", error.what());
    return 2;
  }
  return 0;
}
