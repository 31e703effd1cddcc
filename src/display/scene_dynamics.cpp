#include "display/scene_dynamics.h"

#include <ros/ros.h>

#include <exception>

#include "display/twin_listener.h"
#include "scene/parameter_paths.h"
#include "scene/scene_reader.h"
#include "transport/ros_parameters.h"

namespace whirl_twin {

bool SceneDynamics::refresh() {
  const ros::NodeHandle node(kTwinNamespace);
  XmlRpc::XmlRpcValue tree;
  const std::string found = node.getParam("scene", tree) ? tree.toXml() : "";
  if (found == tree_) {
    return false;
  }
  tree_ = found;
  systems_.clear();
  twin_.reset();
  if (tree_.empty()) {
    return true;
  }
  try {
    const ParameterTree scene = parameterTree(node, "scene");
    twin_ = std::make_unique<Twin>(readScene(scene.tree, scene.source));
    for (const Twin::Member& member : twin_->members()) {
      systems_[member.spec.name] = {member.spec, member.dynamics};
    }
  } catch (const Refusal& error) {
    ROS_WARN("systems are shown without their models, for the scene is not right:\n%s",
             error.what());
  }
  return true;
}

bool SceneDynamics::take(const ParameterChange& change) {
  const auto found = systems_.find(change.header.frame_id);
  if (found == systems_.end()) {
    return false;
  }
  state::ParameterChange set;
  set.system = change.header.frame_id;
  set.names = change.names;
  set.values = change.values;
  for (std::size_t i = 0; i < twin_->members().size(); ++i) {
    const Twin::Member& member = twin_->members()[i];
    SystemSpec spec = member.spec;
    if (spec.name == set.system && takeParameters(set, *member.model, spec)) {
      try {
        found->second = {spec, twin_->changed(i, spec).dynamics};
        return true;
      } catch (const std::exception&) {
        return false;  // values that the model refuses
      }
    }
  }
  return false;
}

std::shared_ptr<const Dynamics> SceneDynamics::dynamics(const std::string& system) const {
  const auto found = systems_.find(system);
  return found == systems_.end() ? nullptr : found->second.dynamics;
}

std::string SceneDynamics::driveOf(const std::string& system) const {
  const auto found = systems_.find(system);
  return found == systems_.end() ? "" : found->second.spec.drive.value_or("");
}

Moment<double> SceneDynamics::shaft(const std::string& system, double time,
                                    const DriveState* drive) const {
  if (drive != nullptr) {
    // The drive's message may be a step older or newer than the system's.
    return {time, drive->shaft_angle + drive->speed * (time - drive->time), drive->speed,
            drive->acceleration};
  }
  const auto found = systems_.find(system);
  const double speed = found == systems_.end() ? 0.0 : found->second.spec.speed.value_or(0.0);
  return {time, speed * time, speed, 0.0};
}

}  // namespace whirl_twin
