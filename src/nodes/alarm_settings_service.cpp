#include "nodes/alarm_settings_service.h"

#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/node_reader.h"
#include "transport/ros_parameters.h"

namespace whirl_twin {

namespace {

/// Converts a parameter tree, as rosparam loads it from a file.
XmlRpc::XmlRpcValue toParameter(const YAML::Node& node) {
  XmlRpc::XmlRpcValue value;
  if (node.IsMap()) {
    for (const auto& entry : node) {
      value[entry.first.Scalar()] = toParameter(entry.second);
    }
  } else if (node.IsSequence()) {
    value.setSize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) {
      value[static_cast<int>(i)] = toParameter(node[i]);
    }
  } else if (const std::optional<double> number = parseNumber(node.Scalar())) {
    value = *number;
  } else {
    value = node.Scalar();
  }
  return value;
}

}  // namespace

LiveAlarmSettings alarmSettingsOf(const BuiltScene& scene, std::vector<std::string> others) {
  BuiltScene::RotorNames names = scene.rotorNames();
  XmlRpc::XmlRpcValue all;
  const std::string node = ros::this_node::getName();
  const bool any = ros::param::get(node, all) && all.getType() == XmlRpc::XmlRpcValue::TypeStruct;
  return LiveAlarmSettings(any ? toYaml(all) : YAML::Node(YAML::NodeType::Map), node,
                           std::move(names.rotors), std::move(others), std::move(names.stations));
}

AlarmSettingsService::AlarmSettingsService(TwinMonitor& monitor, LiveAlarmSettings& settings,
                                           ros::NodeHandle own,
                                           std::function<void(const std::string&)> was_changed)
    : monitor_(monitor),
      settings_(settings),
      own_(std::move(own)),
      was_changed_(std::move(was_changed)),
      server_(own_.advertiseService("set_alarm_settings", &AlarmSettingsService::set, this)) {}

bool AlarmSettingsService::set(SetAlarmSettings::Request& request,
                               SetAlarmSettings::Response& response) {
  response.success = true;
  if (!request.settings.empty()) {
    const YAML::Node before = YAML::Clone(settings_.tree());
    try {
      settings_.change(request.settings);
      monitor_.set(settings_.settings());
      tellParameters(before);
      was_changed_(request.settings);
      ROS_WARN("alarm settings changed: %s", settings_.text().c_str());
    } catch (const InputError& wrong) {
      response.success = false;
      response.message = wrong.what();
    }
  }
  response.in_force = settings_.text();
  return true;
}

std::string AlarmSettingsService::obey(const YAML::Node& all) {
  try {
    if (settings_.replace(all, own_.getNamespace())) {
      monitor_.set(settings_.settings());
      was_changed_(settings_.text());
      ROS_WARN("alarm settings changed by parameters: %s", settings_.text().c_str());
    }
  } catch (const InputError& wrong) {
    return wrong.what();
  }
  return "";
}

void AlarmSettingsService::tellParameters(const YAML::Node& before) {
  for (const auto& entry : before) {
    if (!settings_.tree()[entry.first.Scalar()].IsDefined()) {
      own_.deleteParam(entry.first.Scalar());
    }
  }
  for (const auto& entry : settings_.tree()) {
    own_.setParam(entry.first.Scalar(), toParameter(entry.second));
  }
}

}  // namespace whirl_twin
