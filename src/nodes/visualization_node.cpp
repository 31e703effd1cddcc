// visualization_node: states of the twin to rviz markers and tf.
//
// Publishes /twin/markers (visualization_msgs/MarkerArray, frame `world`) and the tf frames
// world -> <system> -> <system>_disc or <system>_bob, as drawn. Private parameters:
//   ~rate         [Hz]     frames a second, > 0 (default 30)
//   ~whirl_scale  [-]      exaggeration of the whirl; 0 (default): a round number chosen to fit
//   ~trail_turns  [turns]  length of the orbit's trail, > 0 (default 3)
#include <fmt/format.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>

#include "nodes/pendulum_display.h"
#include "nodes/rotor_display.h"
#include "nodes/twin_listener.h"

namespace whirl_twin {
namespace {

/// Reads a private parameter that has to be a number above (or, if allowed, at) zero.
double positiveParameter(const char* name, const char* unit, double fallback, bool zero_allowed) {
  const ros::NodeHandle node("~");
  if (!node.hasParam(name)) {
    return fallback;
  }
  const std::string expected = fmt::format("{}: must be a number {} 0 {}", node.resolveName(name),
                                           zero_allowed ? ">=" : ">", unit);
  double value = 0.0;
  if (!node.getParam(name, value)) {
    throw std::invalid_argument(expected + ", found another type");
  }
  if (!std::isfinite(value) || value < 0.0 || (value == 0.0 && !zero_allowed)) {
    throw std::invalid_argument(fmt::format("{}, found {}", expected, value));
  }
  return value;
}

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
  VisualizationNode()
      : whirl_scale_(positiveParameter("whirl_scale", "(0: automatic)", 0.0, true)),
        trail_turns_(positiveParameter("trail_turns", "turns", 3.0, false)),
        rate_(positiveParameter("rate", "Hz", 30.0, false)) {
    ros::NodeHandle node;
    publisher_ = node.advertise<visualization_msgs::MarkerArray>(
        std::string(kTwinNamespace) + "/markers", 2);
    listener_.onWhirl([this](const std::string& system, const WhirlState& state) {
      rotors_.try_emplace(system, system, whirl_scale_, trail_turns_).first->second.update(state);
    });
    listener_.onPendulum([this](const std::string& system, const PendulumState& state) {
      auto& pendulum = pendulumOf(system);
      pendulum.update(state, listener_.drive(pendulum.geometry().drive));
    });
    discover();
    // Wall timers, so that the picture lives on while simulated time stands still.
    discover_timer_ =
        node.createWallTimer(ros::WallDuration(1.0), [this](const auto&) { discover(); });
    draw_timer_ =
        node.createWallTimer(ros::WallDuration(1.0 / rate_), [this](const auto&) { draw(); });
  }

 private:
  PendulumDisplay& pendulumOf(const std::string& system) {
    const auto found = pendulums_.find(system);
    if (found != pendulums_.end()) {
      return found->second;
    }
    auto& pendulum = pendulums_.try_emplace(system, system).first->second;
    pendulum.setGeometry(readGeometry(system));
    return pendulum;
  }

  static PendulumGeometry readGeometry(const std::string& system) {
    XmlRpc::XmlRpcValue description;
    ros::param::get(std::string(kTwinNamespace) + "/scene/systems/" + system, description);
    return pendulumGeometry(description);
  }

  void discover() {
    listener_.discover();
    const auto gone = [this](const auto& entry) {
      return listener_.systems().count(entry.first) == 0;
    };
    for (auto it = rotors_.begin(); it != rotors_.end();) {
      it = gone(*it) ? rotors_.erase(it) : std::next(it);
    }
    for (auto it = pendulums_.begin(); it != pendulums_.end();) {
      it = gone(*it) ? pendulums_.erase(it) : std::next(it);
    }
    for (auto& [name, pendulum] : pendulums_) {
      pendulum.setGeometry(readGeometry(name));
    }
  }

  void draw() {
    std::vector<std::pair<std::string, const SystemDisplay*>> displays;
    for (const auto& [name, rotor] : rotors_) {
      displays.emplace_back(name, &rotor);
    }
    for (const auto& [name, pendulum] : pendulums_) {
      displays.emplace_back(name, &pendulum);
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
    const ros::Time now = ros::Time::now();
    std::vector<geometry_msgs::TransformStamped> transforms;
    const auto places = sideBySide(displays.size());
    for (std::size_t i = 0; i < displays.size(); ++i) {
      const auto& [name, display] = displays[i];
      const Eigen::Isometry3d pose = display->placedAt(places[i]);
      MarkerCanvas canvas(markers, name, pose);
      display->draw({listener_.systems().at(name).margin, listener_.alertsOf(name)}, canvas);
      transforms.push_back(stampedTransform(MarkerCanvas::kWorldFrame, name, now, pose));
      transforms.push_back(
          stampedTransform(name, name + "_" + display->bodyName(), now, display->bodyPose()));
    }
    publisher_.publish(markers);
    // With simulated time standing still tf would warn of the same stamp again and again.
    if (now != transformed_) {
      broadcaster_.sendTransform(transforms);
      transformed_ = now;
    }
  }

  double whirl_scale_;  // -
  double trail_turns_;
  double rate_;  // Hz
  TwinListener listener_;
  std::map<std::string, RotorDisplay> rotors_;
  std::map<std::string, PendulumDisplay> pendulums_;
  std::vector<std::string> drawn_;  // systems in the order of the last frame
  ros::Publisher publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Time transformed_;
  ros::WallTimer discover_timer_;
  ros::WallTimer draw_timer_;
};

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  ros::init(argc, argv, "visualization_node");
  ros::NodeHandle node;  // keeps ROS up while the parameters are read
  try {
    whirl_twin::VisualizationNode visualization;
    ros::spin();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "visualization_node: %s\n", error.what());
    return 2;
  }
  return 0;
}
