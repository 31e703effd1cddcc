#include "display/scene_dynamics.h"

#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "messages/message_check.h"
#include "messages/units.h"
#include "scene/scene_reader.h"
#include "scene/signal_names.h"
#include "transport/ros_converters.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {

std::optional<MeasuredPlace> MeasuredPlace::of(const BuiltScene& scene, const std::string& system) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const BuiltSystem& built = *scene.systems[i];
    if (built.spec.name != system || built.dynamics->isRotor()) {
      continue;
    }
    for (const SensorSpec& sensor : scene.scene.sensors) {
      MeasuredPlace place;
      place.source_ = sensor.name;
      for (const CoordinateInfo& coordinate : built.dynamics->coordinates()) {
        place.channel_.emplace_back();
        place.unit_.push_back(coordinate.unit);
      }
      for (const SensorChannelSpec& channel : sensor.channels) {
        if (channel.signal.system == i && channel.signal.kind == SignalSpec::Kind::kCoordinate) {
          place.channel_[channel.signal.coordinate] = channel.name;
        }
      }
      if (std::none_of(place.channel_.begin(), place.channel_.end(),
                       [](const std::string& name) { return name.empty(); })) {
        return place;
      }
    }
  }
  return std::nullopt;
}

std::vector<double> MeasuredPlace::newest(const Measurement& block) const {
  std::vector<std::size_t> column;
  std::vector<double> scale;
  for (std::size_t i = 0; i < channel_.size(); ++i) {
    const auto found = std::find(block.channel.begin(), block.channel.end(), channel_[i]);
    const auto c = static_cast<std::size_t>(found - block.channel.begin());
    if (c >= std::min(block.channel.size(), block.unit.size())) {
      return {};
    }
    column.push_back(c);
    scale.push_back(unitScale(block.unit[c], unit_[i]));
    if (scale.back() == 0.0) {
      return {};
    }
  }
  const std::size_t width = block.channel.size();
  const std::size_t values = std::min(block.value.size(), block.valid.size());
  for (std::size_t end = values - values % width; end > 0; end -= width) {
    std::vector<double> place;
    for (std::size_t i = 0; i < column.size(); ++i) {
      const std::size_t at = end - width + column[i];
      if (block.valid[at] && std::isfinite(block.value[at])) {
        place.push_back(scale[i] * block.value[at]);
      }
    }
    if (place.size() == column.size()) {
      return place;
    }
  }
  return {};
}

bool SceneDynamics::refresh() {
  const ros::NodeHandle node(twinNamespace());
  XmlRpc::XmlRpcValue tree;
  const std::string found = node.getParam("scene", tree) ? tree.toXml() : "";
  if (found == tree_) {
    return false;
  }
  tree_ = found;
  systems_.clear();
  measured_.clear();
  actuator_limits_.clear();
  if (tree_.empty()) {
    return true;
  }
  try {
    const ParameterTree scene = parameterTree(node, "scene");
    const BuiltScene built = build(readScene(scene.tree, scene.source));
    for (const SharedSystem& system : built.systems) {
      systems_[system->spec.name] = system;
      if (const auto place = MeasuredPlace::of(built, system->spec.name)) {
        measured_.emplace(system->spec.name, *place);
      }
    }
    for (const ControllerSpec& controller : built.scene.controllers) {
      if (controller.actuator.limit > 0.0) {
        actuator_limits_[controller.name] = controller.actuator.limit;
      }
    }
  } catch (const InputError& error) {
    ROS_WARN("systems are shown without their models, because the scene is invalid:\n%s",
             error.what());
  }
  return true;
}

bool SceneDynamics::take(const ParameterChange& change) {
  try {
    const state::ParameterChange set = fromRos(change);
    const auto found = systems_.find(set.system);
    SharedSystem changed = found == systems_.end() ? nullptr : found->second->with(set);
    if (changed == nullptr) {
      return false;
    }
    found->second = std::move(changed);
    return true;
  } catch (const RejectedMessage&) {
    return false;
  }
}

std::shared_ptr<const Dynamics> SceneDynamics::dynamics(const std::string& system) const {
  const auto found = systems_.find(system);
  return found == systems_.end() ? nullptr : found->second->dynamics;
}

std::string SceneDynamics::systemOf(const std::string& published) const {
  if (systems_.count(published) > 0) {
    return published;
  }
  for (const auto& [name, system] : systems_) {
    const std::vector<std::string> stations = publishedStations(name, *system->dynamics);
    if (std::find(stations.begin(), stations.end(), published) != stations.end()) {
      return name;
    }
  }
  return published;
}

std::string SceneDynamics::driveOf(const std::string& system) const {
  const auto found = systems_.find(system);
  return found == systems_.end() ? "" : found->second->spec.drive.value_or("");
}

double SceneDynamics::actuatorLimit(const std::string& controller) const {
  const auto found = actuator_limits_.find(controller);
  return found == actuator_limits_.end() ? std::numeric_limits<double>::infinity() : found->second;
}

std::optional<MeasuredPlace> SceneDynamics::measuredPlace(const std::string& system) const {
  const auto found = measured_.find(system);
  return found == measured_.end() ? std::nullopt : std::optional<MeasuredPlace>(found->second);
}

EvaluationPoint<double> SceneDynamics::shaft(const std::string& system, double time,
                                             const DriveState* drive) const {
  if (drive != nullptr) {
    // The drive's message may be a step older or newer than the system's.
    return {time, drive->shaft_angle + drive->speed * (time - drive->time), drive->speed,
            drive->acceleration};
  }
  const auto found = systems_.find(system);
  const double speed = found == systems_.end() ? 0.0 : found->second->spec.speed.value_or(0.0);
  return {time, speed * time, speed, 0.0};
}

}  // namespace whirl_twin
