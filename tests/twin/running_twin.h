// A live twin and its parameter changes, run in the thread of the caller.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "twin/live_parameters.h"
#include "twin/observer.h"

namespace whirl_twin {

inline constexpr double kDamped = 10.0;  // N s/m

/// A rotor at its own constant speed, and a pendulum on a shaft.
inline const char* const kTwoSystems = R"(
step: 0.001
drives: {shaft: {speed: 5.0}}
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1, stiffness: 1.0e4, damping: 10, eccentricity: 1.0e-4, speed: 80}
  governor:
    model: spinning_pendulum
    drive: shaft
    parameters: {mass: 0.5, length: 0.2, damping: 0.01}
    initial: {theta: 0.4}
)";

/// A live twin whose loop runs one cycle per wait.
class Running {
 public:
  explicit Running(const Scene& scene)
      : live(scene, 100000),
        parameters(live,
                   [this] {
                     while (live.carriedOut() < live.sent()) {
                       cycle();
                     }
                     return true;
                   }),
        observer(live.twin(), live.generations()),
        record(live.twin().layout().size) {}

  void cycle(int times = 1) {
    for (int i = 0; i < times; ++i) {
      live.cycle(0);
    }
  }
  /// Observes all there is, and returns the largest energy residual of a system on the way.
  double observe(std::size_t system = 0) {
    double largest = 0.0;
    while (live.pop(record.data())) {
      observer.observe(record.data());
      largest = std::max(largest, std::fabs(observer.energyResidual(system)));
    }
    return largest;
  }
  ParameterAnswer set(const std::string& system, const std::string& name, double value,
                      double ramp = 0.0) {
    return parameters.set({system, {name}, {value}, ramp});
  }
  std::vector<double> state(std::size_t system) const {
    const std::size_t n = live.twin().systems()[system]->spec.q.size();
    const double* q = observer.coordinates(system);
    return std::vector<double>(q, q + 2 * n);
  }
  double value(std::size_t system, const std::string& name) const {
    const state::ParameterChange& set = observer.parameters(system);
    for (std::size_t i = 0; i < set.names.size(); ++i) {
      if (set.names[i] == name) {
        return set.values[i];
      }
    }
    return std::nan("");
  }
  void command(TwinCommand::Kind kind) {
    TwinCommand c;
    c.kind = kind;
    ASSERT_TRUE(live.send(c));
    cycle();
  }

  LiveTwin live;
  LiveParameters parameters;
  Observer observer;
  std::vector<double> record;
};

}  // namespace whirl_twin
