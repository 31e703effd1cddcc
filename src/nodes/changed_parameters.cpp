#include "nodes/changed_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/ros.h>

#include <algorithm>
#include <set>
#include <utility>

#include "messages/names.h"
#include "transport/ros_parameters.h"

namespace whirl_twin {
namespace {

/// "" for no value.
std::string textOf(const YAML::Node& node) {
  if (!node.IsDefined()) {
    return "";
  }
  YAML::Emitter out;
  out << YAML::Flow << node;
  return out.c_str();
}

YAML::Node presentParameters() {
  XmlRpc::XmlRpcValue all;
  const bool any = ros::param::get(ros::this_node::getName(), all) &&
                   all.getType() == XmlRpc::XmlRpcValue::TypeStruct;
  return any ? toYaml(all) : YAML::Node(YAML::NodeType::Map);
}

}  // namespace

ChangedParameters::ChangedParameters(const MasterWatch& master)
    : ChangedParameters(master, {}, nullptr) {}

ChangedParameters::ChangedParameters(const MasterWatch& master, std::vector<std::string> at_start,
                                     Obey obey)
    : master_(master),
      at_start_(std::move(at_start)),
      obey_(std::move(obey)),
      started_with_(presentParameters()) {
  YAML::Node live(YAML::NodeType::Map);
  for (const auto& entry : started_with_) {
    if (!readAtStart(entry.first.Scalar())) {
      live[entry.first.Scalar()] = entry.second;
    }
  }
  live_ = textOf(live);
}

bool ChangedParameters::readAtStart(const std::string& name) const {
  return !obey_ || std::find(at_start_.begin(), at_start_.end(), name) != at_start_.end();
}

std::string ChangedParameters::look() {
  XmlRpc::XmlRpcValue known = master_.ownParameters();
  if (known.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return reported_;
  }
  const YAML::Node now = toYaml(known);
  std::set<std::string> names;
  for (const YAML::Node& tree : {started_with_, now}) {
    for (const auto& entry : tree) {
      names.insert(entry.first.Scalar());
    }
  }
  std::vector<std::string> too_late;
  YAML::Node live(YAML::NodeType::Map);
  for (const std::string& name : names) {
    const YAML::Node value = now[name];
    if (!readAtStart(name)) {
      if (value.IsDefined()) {
        live[name] = value;
      }
    } else if (textOf(value) != textOf(std::as_const(started_with_)[name])) {
      too_late.push_back(printable(name));
    }
  }
  if (const std::string text = textOf(live); text != live_) {
    live_ = text;
    refusal_ = obey_(live);
  }
  std::string trouble = refusal_;
  if (!too_late.empty()) {
    trouble += fmt::format("{}{}: changed, but read only when the node starts",
                           trouble.empty() ? "" : "; ", fmt::join(too_late, ", "));
  }
  return trouble;
}

void ChangedParameters::report(diagnostic_updater::Updater& diagnostics) {
  diagnostics.add("private parameters", [this](diagnostic_updater::DiagnosticStatusWrapper& s) {
    const std::string trouble = look();
    if (trouble != reported_ && !trouble.empty()) {
      ROS_WARN("private parameters: %s", trouble.c_str());
    }
    reported_ = trouble;
    s.summary(trouble.empty() ? diagnostic_msgs::DiagnosticStatus::OK
                              : diagnostic_msgs::DiagnosticStatus::WARN,
              trouble.empty() ? "all in force" : trouble);
  });
}

}  // namespace whirl_twin
