#include "web/offered_services.h"

#include <fmt/format.h>

#include "web/scene_description.h"

namespace whirl_twin {

const std::vector<ServiceInfo>& offeredServices() {
  static const std::vector<ServiceInfo> kAll = {
      {"pause", "stops simulated time", {}},
      {"resume", "continues", {}},
      {"reset", "to the scene's start and parameters", {}},
      {"step", "a number of steps while paused", {{"steps", "integer"}}},
      {"set_speed",
       "moves a drive to a speed [rad/s]",
       {{"drive", "string"},
        {"speed", "number"},
        {"max_acceleration", "number"},
        {"max_jerk", "number"}}},
      {"set_input",
       "holds an input at a value for a duration [s, simulated]",
       {{"system", "string"}, {"input", "string"}, {"value", "number"}, {"duration", "number"}}},
      {"set_real_time_factor", "simulated seconds per second; 0: fastest", {{"factor", "number"}}},
      {"acknowledge",
       "alerts of a system and type; \"\": any",
       {{"system", "string"}, {"type", "string"}}},
      {"reset_alarms", "clears latched alerts", {}},
      {"inhibit",
       "alerts of a system for a duration [s]",
       {{"system", "string"}, {"duration", "number"}}}};
  return kAll;
}

std::string readParameters(const std::vector<ParameterValue>& values, ParameterRequest& request) {
  for (const auto& [name, value] : values) {
    const ParameterPlace place = parameterPlace(name);
    if (!request.names.empty() && place.subject != request.system) {
      return fmt::format("parameters: must be of one system or controller, found {} and {}",
                         request.system, place.subject);
    }
    request.system = place.subject;
    request.names.push_back(place.path);
    request.values.push_back(value);
  }
  return "";
}

bool isOfMonitor(const std::string& service) {
  return service == "acknowledge" || service == "reset_alarms" || service == "inhibit";
}

}  // namespace whirl_twin
