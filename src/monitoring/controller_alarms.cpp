#include "monitoring/controller_alarms.h"

namespace whirl_twin {

ControllerAlarms::ControllerAlarms(const Scene& scene, const AlarmSettings& settings) {
  for (const ControllerSpec& controller : scene.controllers) {
    const std::string& name = controller.name;
    all_.emplace(name, Alarms{ControllerAlarm(name, settings), LoopAlarm(name, settings),
                              SaturationAlarm(name, settings), PassageAlarm(controller, settings)});
  }
}

void ControllerAlarms::set(const AlarmSettings& settings) {
  for (auto& [name, alarms] : all_) {
    alarms.lost.set(settings);
    alarms.loop.set(settings);
    alarms.saturation.set(settings);
    alarms.passage.set(settings);
  }
}

void ControllerAlarms::restart(const AlarmSettings& settings) {
  for (auto& [name, alarms] : all_) {
    alarms.lost = ControllerAlarm(name, settings);
    alarms.loop = LoopAlarm(name, settings);
    alarms.saturation = SaturationAlarm(name, settings);
    alarms.passage.restart(settings);
  }
}

void ControllerAlarms::update(const state::ControllerState& controller, AlertList& alerts) {
  Alarms& alarms = all_.at(controller.controller);
  alarms.lost.update(controller.at.time, controller.lost, alerts);
  alarms.saturation.update(controller, alerts);
  alarms.passage.update(controller, alerts);
}

void ControllerAlarms::update(state::ControllerMargins& margins, AlertList& alerts) {
  Alarms& alarms = all_.at(margins.controller);
  margins.saturated = alarms.saturation.saturated();
  margins.missed = alarms.saturation.missed();
  alarms.loop.update(margins, alerts);
}

}  // namespace whirl_twin
