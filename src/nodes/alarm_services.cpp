#include "nodes/alarm_services.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr double kLongest = 3600.0;  // s: an inhibition that is forgotten ends

std::string nameOf(const std::string& system) {
  return system.empty() ? "every system" : printable(system);
}

}  // namespace

AlarmServices::AlarmServices(TwinMonitor& monitor, ros::NodeHandle node,
                             std::function<double()> wall_time, std::function<void()> was_reset)
    : monitor_(monitor),
      wall_time_(std::move(wall_time)),
      was_reset_(std::move(was_reset)),
      servers_{node.advertiseService("acknowledge", &AlarmServices::acknowledge, this),
               node.advertiseService("reset_alarms", &AlarmServices::reset, this),
               node.advertiseService("inhibit", &AlarmServices::inhibit, this)} {}

bool AlarmServices::acknowledge(Acknowledge::Request& request, Acknowledge::Response& response) {
  AlertList& alerts = monitor_.alerts();
  bool any = false;
  for (const state::Alert& alert : alerts.active()) {
    any = any || ((request.system.empty() || request.system == alert.system) &&
                  (request.type.empty() || request.type == alert.type));
  }
  const std::size_t count = alerts.acknowledge(request.system, request.type);
  const bool nothing_asked = request.system.empty() && request.type.empty();
  response.success = any || nothing_asked;
  response.message = response.success ? fmt::format("{} acknowledged", count)
                                      : fmt::format("no alert {} of {}", printable(request.type),
                                                    nameOf(request.system));
  return true;
}

bool AlarmServices::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  AlertList& alerts = monitor_.alerts();
  const std::size_t cleared = alerts.reset(monitor_.time());
  was_reset_();
  response.success = true;
  response.message =
      fmt::format("{} cleared, {} have their cause still", cleared, alerts.active().size());
  return true;
}

bool AlarmServices::inhibit(Inhibit::Request& request, Inhibit::Response& response) {
  response.success = false;
  if (!(request.duration >= 0.0 && request.duration <= kLongest)) {
    response.message =
        fmt::format("duration: must be from 0 to {:g} s, found {:g}", kLongest, request.duration);
    return true;
  }
  if (!monitor_.inhibit(request.system, request.duration, wall_time_())) {
    response.message = fmt::format("system: must be a system of the scene, found {}{}",
                                   whirl_twin::quoted(request.system),
                                   hint(request.system, monitor_.systemNames()));
    return true;
  }
  response.success = true;
  response.message = request.duration > 0.0
                         ? fmt::format("alerts of {} are held back for {:g} s",
                                       nameOf(request.system), request.duration)
                         : fmt::format("alerts of {} are raised", nameOf(request.system));
  if (request.duration > 0.0) {
    ROS_WARN("%s", response.message.c_str());
  }
  return true;
}

}  // namespace whirl_twin
