// A twin that runs as fast as it can under its monitor, and all that the monitor said.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "monitoring/twin_monitor.h"
#include "twin/observer.h"

namespace whirl_twin {

/// A circular whirl about the bearings, in step with the shaft: radius [m], speed [rad/s].
inline state::WhirlState circularWhirl(const std::string& system, double time, double radius,
                                       double speed) {
  state::WhirlState whirl;
  whirl.system = system;
  whirl.at.time = time;
  whirl.radius = radius;
  whirl.speed = speed;
  whirl.shaft_angle = speed * time;
  whirl.x = radius * std::cos(whirl.shaft_angle);
  whirl.y = radius * std::sin(whirl.shaft_angle);
  return whirl;
}

/// A controller of this name, as far as its alarms know it.
inline ControllerSpec controllerNamed(const std::string& name) {
  ControllerSpec spec;
  spec.name = name;
  return spec;
}

/// Runs the scene for `duration` [s] and feeds every step to the monitor.
struct WatchedTwin {
  explicit WatchedTwin(const Scene& scene, const AlarmSettings& settings = {})
      : twin(scene), observer(twin), monitor(build(scene), settings), record(twin.layout().size) {
    loop.started = 1'000'000'000;
  }

  void run(double duration) {
    const auto steps =
        static_cast<std::int64_t>(std::llround(duration / twin.scene().stepSeconds()));
    for (std::int64_t i = 0; i < steps; ++i) {
      twin.step();
      feed();
    }
  }
  void feed() {
    twin.write(record.data());
    observer.observe(record.data());
    wall += twin.scene().stepSeconds();
    for (std::size_t d = 0; d < twin.scene().drives.size(); ++d) {
      monitor.take(observer.drive(d), wall);
    }
    for (std::size_t s = 0; s < observer.systemCount(); ++s) {
      if (observer.isRotor(s)) {
        monitor.take(observer.whirl(s), wall);
      } else {
        monitor.take(observer.pendulum(s), wall);
      }
    }
    for (std::size_t c = 0; c < twin.scene().controllers.size(); ++c) {
      monitor.take(observer.controller(c), wall);
    }
    for (auto& margin : monitor.takeLoopMargins()) {
      loop_margins.push_back(margin);
    }
    for (auto& margin : monitor.takeMargins()) {
      margins.push_back(margin);
    }
    for (auto& event : monitor.alerts().takeEvents()) {
      events.push_back(event);
    }
  }
  /// As the simulation says it once a second, and when it was reset.
  void announce() {
    loop.at = observer.instant();
    loop.at.stamp = ++announcements;
    monitor.take(loop, wall);
  }
  std::size_t count(const std::string& type, bool raised) const {
    std::size_t n = 0;
    for (const auto& e : events) {
      n += e.type == type && e.raised == raised ? 1 : 0;
    }
    return n;
  }

  Twin twin;
  Observer observer;
  TwinMonitor monitor;
  std::vector<double> record;
  double wall = 0.0;  ///< [s]
  state::LoopStatistics loop;
  std::int64_t announcements = 0;
  std::vector<state::StabilityMargin> margins;
  std::vector<state::ControllerMargins> loop_margins;
  std::vector<state::Alert> events;
};

}  // namespace whirl_twin
