#include "nodes/pendulum_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace whirl_twin {
namespace {

// A length or speed of the scene; the default where there is none or it makes no sense. The nodes
// that compute with it have refused a wrong one already.
double number(XmlRpc::XmlRpcValue& members, const std::string& key, double fallback) {
  if (members.getType() != XmlRpc::XmlRpcValue::TypeStruct || !members.hasMember(key)) {
    return fallback;
  }
  XmlRpc::XmlRpcValue& value = members[key];
  double result = fallback;
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) {
    result = static_cast<double>(value);
  } else if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) {
    result = static_cast<int>(value);
  } else if (value.getType() == XmlRpc::XmlRpcValue::TypeString) {
    const auto text = static_cast<std::string>(value);
    char* end = nullptr;
    const double parsed = std::strtod(text.c_str(), &end);
    result = end != text.c_str() && *end == '\0' ? parsed : fallback;
  }
  return std::isfinite(result) ? result : fallback;
}

std::string word(XmlRpc::XmlRpcValue& members, const std::string& key) {
  const bool found =
      members.hasMember(key) && members[key].getType() == XmlRpc::XmlRpcValue::TypeString;
  return found ? static_cast<std::string>(members[key]) : std::string();
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

PendulumGeometry pendulumGeometry(XmlRpc::XmlRpcValue system) {
  PendulumGeometry geometry;
  if (system.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return geometry;
  }
  geometry.model = word(system, "model");
  geometry.drive = word(system, "drive");
  if (system.hasMember("parameters")) {
    XmlRpc::XmlRpcValue& parameters = system["parameters"];
    const double length = number(parameters, "length", geometry.length1);
    geometry.length1 = number(parameters, "length1", length);
    geometry.length2 = number(parameters, "length2", geometry.length2);
    geometry.speed = number(parameters, "speed", geometry.speed);
  }
  return geometry;
}

double planeAngle(const PendulumState& state, const PendulumGeometry& geometry,
                  const DriveState* drive) {
  if (state.name.size() == 2 && state.name[1] == "phi" && state.angle.size() == 2) {
    return state.angle[1];
  }
  if (drive != nullptr) {
    // The drive's message may be a step older or newer than the pendulum's.
    return drive->shaft_angle + drive->speed * (state.time - drive->time);
  }
  return geometry.drive.empty() ? geometry.speed * state.time : 0.0;
}

std::vector<Eigen::Vector3d> pendulumJoints(const PendulumState& state,
                                            const PendulumGeometry& geometry, double plane_angle) {
  const auto& name = state.name;
  const auto& angle = state.angle;
  std::vector<double> rods;  // absolute angles from hanging down
  if (name.size() != angle.size() || name.empty()) {
    return {};
  }
  if (isOneOf(geometry.model, {"", "spinning_pendulum", "rotating_pendulum"}) &&
      name[0] == "theta" && (name.size() == 1 || (name.size() == 2 && name[1] == "phi"))) {
    rods = {angle[0]};
  } else if (isOneOf(geometry.model, {"", "double_pendulum"}) && name.size() == 2 &&
             name[0] == "theta1" && isOneOf(name[1], {"theta2", "theta3"})) {
    rods = {angle[0], name[1] == "theta2" ? angle[1] : angle[0] + angle[1]};
  }
  std::vector<Eigen::Vector3d> joints;
  if (!rods.empty()) {
    joints.emplace_back(Eigen::Vector3d::Zero());
  }
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const double length = i == 0 ? geometry.length1 : geometry.length2;
    const double out = length * std::sin(rods[i]);
    joints.emplace_back(joints.back() + Eigen::Vector3d(out * std::cos(plane_angle),
                                                        out * std::sin(plane_angle),
                                                        -length * std::cos(rods[i])));
  }
  return joints;
}

}  // namespace whirl_twin
