#include "scene/closed_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "messages/input_error.h"
#include "scene/changed_controller.h"
#include "scene/control_parts.h"

namespace whirl_twin {

namespace {

std::vector<std::size_t> systemsOf(const Scene& scene, const ControllerSpec& controller) {
  std::vector<std::size_t> systems;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (involves(controller, i)) {
      systems.push_back(i);
    }
  }
  return systems;
}

/// Removes the states that affect neither the dynamics nor a measurement: a cyclic angle of a shaft
/// drifts, and is not part of the closed loop.
LoopPlant withoutCyclic(const LinearPlant& plant) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < plant.a.cols(); ++i) {
    if (!plant.a.col(i).isZero(0.0) || !plant.c.col(i).isZero(0.0)) {
      kept.push_back(i);
    }
  }
  return {plant.a(kept, kept), plant.b(kept, Eigen::all), plant.c(Eigen::all, kept)};
}

/// Throws RunFailure if the equilibrium requires more than the actuator's limit.
void checkLimit(const ControllerSpec& controller, const Eigen::VectorXd& outputs,
                const HeldMotions& held) {
  const double limit = controller.actuator.limit;
  for (std::size_t i = 0; limit > 0.0 && i < controller.acts_on.size(); ++i) {
    const double output = outputs[static_cast<Eigen::Index>(i)];
    if (std::fabs(output) > limit) {
      const ActedInput& acted = controller.acts_on[i];
      const std::string unit = held.at(acted.system).dynamics->inputs()[acted.input].unit;
      throw RunFailure(
          fmt::format("holding the setpoint needs {0} = {1:.4g} {2}: the actuator of {3} is "
                      "limited to {4:g} {2}",
                      controller.acted_on[i], output, unit, controller.name, limit));
    }
  }
}

}  // namespace

ClosedLoop::ClosedLoop(const Scene& scene, std::vector<std::size_t> controllers)
    : scene_(scene), controllers_(std::move(controllers)) {
  for (const std::size_t i : controllers_) {
    laws_.push_back(lawOf(scene, scene.controllers[i]));
  }
}

std::vector<std::size_t> ClosedLoop::systems() const {
  std::set<std::size_t> systems;
  for (const std::size_t i : controllers_) {
    for (const std::size_t system : systemsOf(scene_, scene_.controllers[i])) {
      systems.insert(system);
    }
  }
  return {systems.begin(), systems.end()};
}

bool ClosedLoop::has(const std::string& controller) const {
  return std::any_of(controllers_.begin(), controllers_.end(),
                     [&](std::size_t i) { return scene_.controllers[i].name == controller; });
}

state::ParameterChange ClosedLoop::parametersOf(const std::string& controller) const {
  const auto found =
      std::find_if(scene_.controllers.begin(), scene_.controllers.end(),
                   [&](const ControllerSpec& spec) { return spec.name == controller; });
  return whirl_twin::parametersOf(*found);
}

std::optional<ClosedLoop> ClosedLoop::with(const state::ParameterChange& set) const {
  ClosedLoop next = *this;
  for (std::size_t k = 0; k < controllers_.size(); ++k) {
    ControllerSpec& spec = next.scene_.controllers[controllers_[k]];
    if (spec.name != set.system || !hasParameters(spec) ||
        set.names != whirl_twin::parametersOf(spec).names ||
        set.values.size() != set.names.size()) {
      continue;
    }
    try {
      ChangedController changed = withParameters(scene_, spec, set.names, set.values, "parameters");
      spec = std::move(changed.spec);
      next.laws_[k] = std::move(changed.law);
      return next;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<ClosedLoop::Parts> ClosedLoop::parts(const SystemMotions& present,
                                                   double shaft_speed) const {
  std::vector<SignalSpec> measures;
  std::vector<ActedInput> acts_on;
  std::vector<HoldingLaw> holding;
  const double acceleration = present(leadingSystem()).acceleration;
  Parts parts;
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const ControllerSpec& spec = scene_.controllers[controllers_[i]];
    const bool holds = laws_[i]->holds(shaft_speed, acceleration);
    const std::optional<DiscreteStateSpace> law =
        (holds ? laws_[i]->law() : *laws_[i]).linear(shaft_speed);
    if (!law) {
      return std::nullopt;
    }
    parts.holding.push_back(holds);
    LoopController controller;
    controller.name = spec.name;
    controller.rate = spec.rate;
    controller.delay = static_cast<double>(spec.delay) / 1e9;
    controller.law = *law;
    controller.sensor_bandwidth = spec.sensor.bandwidth;
    controller.actuator_bandwidth = spec.actuator.bandwidth;
    for (const SignalSpec& signal : spec.measures) {
      controller.measures.push_back(static_cast<Eigen::Index>(measures.size()));
      measures.push_back(signal);
    }
    for (const ActedInput& acted : spec.acts_on) {
      controller.acts_on.push_back(static_cast<Eigen::Index>(acts_on.size()));
      acts_on.push_back(acted);
    }
    parts.controllers.push_back(std::move(controller));
    holding.push_back({&spec, *law, laws_[i]->setpoint()});
  }
  if (std::optional<Held> held = closedLoopEquilibria(holding, present)) {
    for (std::size_t i = 0; i < holding.size(); ++i) {
      checkLimit(*holding[i].controller, held->outputs[i], held->motions);
    }
    parts.about = std::move(held->motions);
    parts.outputs = std::move(held->outputs);
  } else {
    for (const std::size_t i : systems()) {
      parts.about[i] = restNear(present(i));
    }
  }
  parts.plant = withoutCyclic(linearPlant(measures, acts_on, parts.about));
  return parts;
}

std::vector<ClosedLoop> closedLoops(const Scene& scene) {
  std::vector<std::vector<std::size_t>> groups;  // of controllers
  std::vector<std::set<std::size_t>> systems;    // of each group
  for (std::size_t i = 0; i < scene.controllers.size(); ++i) {
    std::vector<std::size_t> group{i};
    const std::vector<std::size_t> own = systemsOf(scene, scene.controllers[i]);
    std::set<std::size_t> all(own.begin(), own.end());
    for (std::size_t k = groups.size(); k-- > 0;) {
      const bool shared = std::any_of(own.begin(), own.end(),
                                      [&](std::size_t s) { return systems[k].count(s) > 0; });
      if (shared) {
        group.insert(group.end(), groups[k].begin(), groups[k].end());
        all.insert(systems[k].begin(), systems[k].end());
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(k));
        systems.erase(systems.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
    systems.push_back(std::move(all));
  }
  std::vector<ClosedLoop> loops;
  for (std::vector<std::size_t>& group : groups) {
    loops.emplace_back(scene, std::move(group));
  }
  return loops;
}

}  // namespace whirl_twin
