#include "reports/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "accuracy/step_choice.h"
#include "accuracy/trajectory.h"
#include "algebra/constants.h"
#include "analysis/rotor_statics.h"
#include "analysis/sommerfeld_speeds.h"
#include "reports/report_values.h"
#include "reports/rotor_systems.h"
#include "reports/step_cost.h"
#include "scene/held_rotor.h"
#include "scene/part_of_scene.h"
#include "scene/signal_names.h"
#include "transport/channels.h"
#include "twin/step_messages.h"

namespace whirl_twin {

namespace {

constexpr double kDearSteps = 10.0;     // s, to prepare: of such the cost of a step is not measured
constexpr double kWholeBudget = 0.02;   // s, to measure the scene
constexpr double kSystemBudget = 0.01;  // s, to measure one system,
constexpr double kSystemsBudget = 0.5;  // and all of them one by one

std::optional<ShaftSize> shaftSize(const BuiltSystem& system) {
  std::optional<FlexibleShaft> shaft = shaftOf(system);
  if (!shaft) {
    return std::nullopt;
  }
  ShaftSize size{shaft->positions().back(), 0.0, rotorBody(*shaft).mass};
  shaft->discs.clear();
  size.mass = rotorBody(*shaft).mass;
  return size;
}

/// That the shaft turns at speeds that the rotor's tables, films or motor do not cover.
void warnOfTables(const BuiltScene& scene, const BuiltSystem& system, SystemCheck& check) {
  const auto [low, high] = scene.driveOf(system).speedRange();
  const DataSpeeds tables = tableSpeeds(system);
  // Films carry no shaft at the start of its run-up.
  const auto leaves = [&, from = low](double to) {
    return !tables.covers(to) || !(tables.covers(from) || std::isinf(tables.to));
  };
  if (!system.spec.setup->around.motor) {
    if (leaves(high)) {
      check.warnings.push_back(fmt::format("the shaft turns at {:.6g} to {:.6g} rad/s, in part {}",
                                           low, high, beyondText(tables)));
    }
    return;
  }
  const Motor& motor = *system.spec.setup->around.motor;
  const double reached = highestSpeed(motor);
  if (leaves(reached)) {
    check.warnings.push_back(
        fmt::format("the motor can turn the shaft from {:.6g} to {:.6g} rad/s, in part {}", low,
                    reached, beyondText(tables)));
  }
  const bool has_end = !motor.extended && motor.count > 1;
  if (has_end && reached > motor.points[motor.count - 1].speed) {
    check.warnings.push_back(
        fmt::format("the motor can turn the shaft up to {:.6g} rad/s, beyond its torque table, "
                    "which ends at {:.6g} rad/s: extrapolated with the last torque",
                    reached, motor.points[motor.count - 1].speed));
  }
}

SystemCheck checkSystem(const BuiltScene& scene, const BuiltSystem& system) {
  SystemCheck check;
  const std::string& name = system.spec.name;
  check.name = name;
  check.model = system.model;
  check.coordinates = system.dynamics->coordinates();
  check.note = system.setup().note;
  check.shaft = shaftSize(system);
  warnOfTables(scene, system, check);
  check.integrator = system.integrator;
  check.reason = system.integrator_reason.empty() ? "named in the scene" : system.integrator_reason;
  check.substeps = system.spec.substeps;
  check.tolerance = system.spec.tolerance;
  check.horizon = system.spec.horizon;
  check.drive = system.spec.drive;
  check.speed = system.spec.speed;
  if (system.spec.rest) {
    check.starts_at_rest = true;
    check.sag = largestSag(*system.dynamics, Eigen::Map<const Eigen::VectorXd>(
                                                 system.spec.q.data(),
                                                 static_cast<Eigen::Index>(system.spec.q.size())));
  }
  for (const InputInfo& input : system.dynamics->inputs()) {
    const auto given = system.spec.inputs.find(input.name);
    if (given != system.spec.inputs.end()) {
      check.inputs.push_back({input, given->second});
    }
  }
  return check;
}

/// Lists what a live twin of the scene, and its monitor, publish of each system and drive.
void listMessages(const BuiltScene& scene, SceneCheck& check) {
  const auto add = [](const MessageKind& kind, const std::string& subject, Published& published) {
    published.topics.push_back(
        {"/twin/" + topicName(kind, subject), std::string("whirl_twin/") + kind.type});
    published.channels.push_back(channelName(kind, subject));
  };
  std::map<std::string, Published> heard;
  StepMessages(scene).announce([&](auto kind, const std::string& subject) {
    const MessageKind& row = decltype(kind)::State::kKind;
    const std::string topic = topicName(row, "");
    Published& published = topic.rfind("drives/", 0) == 0        ? check.drives[subject]
                           : topic.rfind("controllers/", 0) == 0 ? check.controllers[subject]
                                                                 : heard[subject];
    add(row, subject, published);
    if (row.has(MessageKind::kJointStates)) {
      published.topics.push_back({"/twin/" + subject + "/joint_states", "sensor_msgs/JointState"});
      const auto is_it = [&](const SystemCheck& system) { return system.name == subject; };
      if (std::any_of(check.systems.begin(), check.systems.end(), is_it)) {  // else a station of it
        add(state::StabilityMargin::kKind, subject, published);
      }
    }
  });
  for (std::size_t i = 0; i < check.systems.size(); ++i) {
    SystemCheck& system = check.systems[i];
    for (const std::string& station : publishedStations(system.name, *scene.systems[i]->dynamics)) {
      const Published& there = heard[station];
      Published& all = system.published;
      all.topics.insert(all.topics.end(), there.topics.begin(), there.topics.end());
      all.channels.insert(all.channels.end(), there.channels.begin(), there.channels.end());
    }
  }
}

}  // namespace

AskedCost costOfCheck(const Scene& scene, const std::vector<std::size_t>& systems) {
  const BuiltScene built = build(scene);
  AskedCost cost;
  for (const std::size_t i : systems) {
    const AskedCost steps = costOfSteps(built, i);
    if (steps.seconds <= kDearSteps) {
      cost += steps;
      const AskedCost members = costOfMembers(built, i);
      const double times = systems.size() > 1 ? 2.0 : 1.0;  // alone, and with the others
      cost += {members.seconds * times, members.memory, members.cause};
    }
  }
  return cost;
}

SceneCheck checkScene(const Scene& scene, const std::vector<std::size_t>& systems) {
  SceneCheck check;
  check.scene = partOf(scene, systems);
  const std::vector<StepChoice> choices = chooseSteps(check.scene, true);
  check.scene = withSteps(check.scene, choices);
  const BuiltScene built = build(check.scene);
  bool dear = false;
  const double budget =
      std::min(kSystemBudget, kSystemsBudget / static_cast<double>(built.systems.size()));
  for (std::size_t i = 0; i < built.systems.size(); ++i) {
    check.systems.push_back(checkSystem(built, *built.systems[i]));
    SystemCheck& system = check.systems.back();
    system.accuracy = choices[i].promise;
    const AskedCost steps = costOfSteps(built, i);
    if (steps.seconds > kDearSteps) {
      system.preparation = steps.seconds;
      system.step_cost = kNaN;
      system.memory = static_cast<std::size_t>(steps.memory);
      dear = true;
      continue;
    }
    const RunningCost cost = runningCost(sceneOfOne(check.scene, i), budget);
    system.step_cost = cost.step;
    system.memory = cost.memory;
    system.ensemble = cost.ensembles.front();
  }
  if (check.systems.size() == 1) {
    check.step_cost = check.systems[0].step_cost;
    check.memory = check.systems[0].memory;
  } else if (dear) {
    check.step_cost = kNaN;
    for (const SystemCheck& system : check.systems) {
      check.memory += system.memory;
    }
  } else {
    const RunningCost cost = runningCost(check.scene, kWholeBudget);
    check.step_cost = cost.step;
    check.memory = cost.memory;
  }
  listMessages(built, check);
  check.record = layoutOf(built).size * sizeof(double);
  return check;
}

}  // namespace whirl_twin
