#include "scene/controller_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algebra/constants.h"
#include "controllers/controller_registry.h"
#include "messages/names.h"
#include "scene/avoidance_reader.h"
#include "scene/control_parts.h"
#include "scene/controlled_plant.h"
#include "scene/parameter_reader.h"
#include "scene/sensor_spec.h"
#include "scene/signal_names.h"
#include "scene/system_setup.h"
#include "scene/weak_passage.h"

namespace whirl_twin {

namespace {

constexpr double kMostUnderWay = 1.0e4;  // outputs
constexpr std::size_t kMostSignals = 64;

/// Inputs of systems by name.
class InputNames {
 public:
  explicit InputNames(const Scene& scene) {
    for (std::size_t i = 0; i < scene.systems.size(); ++i) {
      if (!scene.systems[i].setup) {
        continue;
      }
      const std::vector<InputInfo> inputs = scene.systems[i].setup->made.dynamics->inputs();
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        names_.push_back(scene.systems[i].name + "." + inputs[k].name);
        places_.push_back({i, k});
      }
    }
  }

  std::optional<ActedInput> find(const std::string& name, const std::string& key,
                                 Complaints& complaints) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) {
      return places_[static_cast<std::size_t>(found - names_.begin())];
    }
    const std::string near = nearestName(name, names_);
    complaints.add(key,
                   fmt::format("must be an input of a system, found {}{}", whirl_twin::quoted(name),
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }

 private:
  std::vector<std::string> names_;
  std::vector<ActedInput> places_;
};

/// The entries of a list that must have some.
std::vector<YAML::Node> entries(const MapReader& map, const std::string& name,
                                const std::string& of, Complaints& complaints) {
  if (!map.usable()) {
    return {};
  }
  if (!map.has(name)) {
    complaints.add(map.key(name), fmt::format("missing; must be a list of {}", of));
    return {};
  }
  const YAML::Node node = map.at(name);
  if (!node.IsSequence() || node.size() == 0 || node.size() > kMostSignals) {
    complaints.add(map.key(name),
                   fmt::format("must be a list of 1 to {} {}, found {}", kMostSignals, of,
                               node.IsSequence() ? fmt::format("{}", node.size()) : shown(node)));
    return {};
  }
  return {node.begin(), node.end()};
}

void readMeasured(const MapReader& map, const SignalNames& signals, ControllerSpec& controller,
                  Complaints& complaints) {
  const std::vector<YAML::Node> given = entries(map, "measures", "signals", complaints);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string key = fmt::format("{}[{}]", map.key("measures"), i);
    std::string name;
    std::optional<double> direction;
    std::string name_key = key;
    if (given[i].IsMap()) {
      const MapReader entry(given[i], key, {"signal", "direction"}, "key of a signal", complaints);
      name = entry.text("signal", "");
      name_key = entry.key("signal");
      direction = entry.number("direction", Range::kAny, "rad", 0.0);
    } else if (given[i].IsScalar()) {
      name = given[i].Scalar();
    }
    std::optional<NamedSignal> found = signals.find(name, name_key, complaints);
    if (found && direction) {
      if (found->takes_direction) {
        found->signal.direction = *direction;
      } else {
        complaints.add(
            key + ".direction",
            fmt::format("needs a rotor or a station of one; the direction of {} is fixed",
                        whirl_twin::quoted(name)));
      }
    }
    if (found) {
      controller.measured.push_back(name);
      controller.measures.push_back(found->signal);
    }
  }
}

/// Makes the inputs that a controller acts on its own.
void readActedOn(const MapReader& map, Scene& scene, ControllerSpec& controller,
                 Complaints& complaints) {
  const InputNames inputs(scene);
  const std::vector<YAML::Node> given = entries(map, "acts_on", "inputs", complaints);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string key = fmt::format("{}[{}]", map.key("acts_on"), i);
    const std::string name = given[i].IsScalar() ? given[i].Scalar() : "";
    const std::optional<ActedInput> found = inputs.find(name, key, complaints);
    if (!found) {
      continue;
    }
    SystemSpec& system = scene.systems[found->system];
    const std::string input = system.setup->made.dynamics->inputs()[found->input].name;
    const auto signal = system.inputs.find(input);
    if (signal != system.inputs.end()) {
      complaints.add(key, fmt::format("{} is already {}", whirl_twin::quoted(name),
                                      signal->second.kind == InputSignal::Kind::kControlled
                                          ? "acted on by a controller"
                                          : "given by the system's inputs"));
      continue;
    }
    system.inputs.emplace(input, InputSignal::controlled());
    controller.acted_on.push_back(name);
    controller.acts_on.push_back(*found);
  }
}

void readSurroundings(const MapReader& map, Scene& scene, ControllerSpec& controller,
                      Complaints& complaints) {
  const auto part = [&](const char* name, const std::vector<std::string>& keys) {
    return MapReader(map.has(name) ? map.at(name) : YAML::Node(YAML::NodeType::Map), map.key(name),
                     keys, fmt::format("key of {}", name), complaints);
  };
  const MapReader sensor = part("sensor", {"resolution", "noise", "bandwidth", "range", "seed"});
  const std::string unit = "in the unit of the measured signal";
  controller.sensor.resolution = sensor.number("resolution", Range::kNotNegative, unit, 0.0);
  controller.sensor.noise = sensor.number("noise", Range::kNotNegative, unit, 0.0);
  controller.sensor.range = sensor.number("range", Range::kNotNegative, unit, 0.0);
  controller.sensor.bandwidth = sensor.number("bandwidth", Range::kNotNegative, "Hz", 0.0);
  controller.seed = static_cast<std::uint32_t>(sensor.integer("seed", 0, 2147483647, 1));
  const MapReader actuator = part("actuator", {"limit", "slew", "resolution", "bandwidth"});
  const std::string acted = "in the unit of the input";
  controller.actuator.limit = actuator.number("limit", Range::kNotNegative, acted, 0.0);
  controller.actuator.slew = actuator.number("slew", Range::kNotNegative, acted + ", 1/s", 0.0);
  controller.actuator.resolution = actuator.number("resolution", Range::kNotNegative, acted, 0.0);
  controller.actuator.bandwidth = actuator.number("bandwidth", Range::kNotNegative, "Hz", 0.0);
  for (const ActedInput& on : controller.acts_on) {
    SystemSpec& system = scene.systems[on.system];
    system.inputs.at(system.setup->made.dynamics->inputs()[on.input].name).pole =
        kTwoPi * controller.actuator.bandwidth;
  }
}

/// A number, or {mean, jitter, seed}.
void readDelay(const MapReader& map, ControllerSpec& controller, Complaints& complaints) {
  const bool parts = map.has("delay") && map.at("delay").IsMap();
  double delay = 0.0;
  double jitter = 0.0;
  if (parts) {
    const MapReader given(map.at("delay"), map.key("delay"), {"mean", "jitter", "seed"},
                          "key of delay", complaints);
    delay = given.numberBetween("mean", 0.0, kMaxSignalDelay, "s", std::nullopt);
    jitter = given.numberBetween("jitter", 0.0, kMaxSignalDelay, "s", 0.0);
    controller.jitter_seed = static_cast<std::uint32_t>(given.integer("seed", 0, 2147483647, 1));
    if (jitter > delay) {
      complaints.add(
          given.key("jitter"),
          fmt::format("must be at most the mean delay, {:g} s, found {:g}", delay, jitter));
    }
  } else {
    delay = map.numberBetween("delay", 0.0, kMaxSignalDelay, "s", 0.0);
  }
  controller.delay = std::llround(delay * 1.0e9);
  controller.jitter = std::llround(jitter * 1.0e9);
  if ((delay + jitter) * controller.rate > kMostUnderWay) {
    complaints.add(map.key("delay"),
                   fmt::format("must be at most {:g} samples, found {:g}", kMostUnderWay,
                               (delay + jitter) * controller.rate));
  }
}

/// A law that cannot be made of its parameters.
void checkLaw(const MapReader& map, const ControllerInfo& info, const Scene& scene,
              const ControllerSpec& controller, Complaints& complaints) {
  try {
    info.make(controller.parameters, controller.settings, planOf(scene, controller));
  } catch (const SetupError& error) {
    complaints.add(map.key("parameters." + error.parameter()), error.what());
  } catch (const Refusal& error) {
    complaints.add(map.key("type"), error.what());
  }
}

/// What a controller that brings a shaft to a speed is to know of what it turns.
void findBands(const MapReader& map, const Scene& scene, ControllerSpec& controller,
               Complaints& complaints) {
  const double margin = controller.parameters.at("margin");
  const std::string key = map.key("parameters.margin");
  if (margin != 0.0 && (margin < kLeastBandMargin || margin > kMostBandMargin)) {
    complaints.add(key, fmt::format("must be 0, or from {} to {} of a critical speed, found {}",
                                    kLeastBandMargin, kMostBandMargin, margin));
  }
  if (controller.settings.choices.at("critical_speeds") == "true") {
    controller.critical_bands =
        criticalBands(scene, scene.driveOf(scene.systems[controller.measures.front().system]),
                      margin > 0.0 ? std::optional<double>(margin) : std::nullopt,
                      map.key("parameters.critical_speeds"), complaints);
  } else if (margin != 0.0) {
    complaints.add(key, "needs critical_speeds: true");
  }
}

/// What is said of a controller in another process, in place of parameters.
void readExternal(const MapReader& map, const ControllerInfo& info, const Scene& scene,
                  ControllerSpec& controller, Complaints& complaints) {
  controller.parameters["timeout"] = map.numberBetween("timeout", 1.0e-6, 1.0e3, "s", std::nullopt);
  for (const SettingInfo& setting : info.settings) {
    controller.settings.choices[setting.name] =
        map.choice(setting.name, setting.choices, "one of its values", setting.choices.front());
  }
  if (map.has("parameters")) {
    complaints.add(map.key("parameters"),
                   "must not be given: the controller's own process has them");
  }
  const std::int64_t shortest = controller.delay - controller.jitter;
  if (controller.settings.choices["mode"] == "lockstep" && shortest < scene.step) {
    complaints.add(map.key("delay"),
                   fmt::format("must be at least a step, {:g} s, in lockstep: simulated time waits "
                               "for answers between steps, found {:g} s",
                               scene.stepSeconds(), static_cast<double>(shortest) / 1e9));
  }
}

/// What cannot have controllers.
void checkSystems(const MapReader& map, const Scene& scene, const ControllerSpec& controller,
                  Complaints& complaints) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const auto is_it = [&](const ActedInput& input) { return input.system == i; };
    if (!scene.systems[i].ensemble.spread.empty() &&
        std::any_of(controller.acts_on.begin(), controller.acts_on.end(), is_it)) {
      complaints.add(
          map.key("acts_on"),
          fmt::format("systems.{} has a spread: the samples of an ensemble cannot have controllers",
                      scene.systems[i].name));
    }
  }
}

ControllerSpec readController(const YAML::Node& node, const std::string& key,
                              const std::string& name, const SignalNames& signals, Scene& scene,
                              Complaints& complaints) {
  ControllerSpec controller;
  controller.name = name;
  const MapReader map(node, key,
                      {"type", "rate", "measures", "acts_on", "delay", "sensor", "actuator",
                       "parameters", "mode", "timeout", "on_timeout"},
                      "key of a controller", complaints);
  if (!map.usable()) {
    return controller;
  }
  const std::size_t before = complaints.all().size();
  const ControllerInfo* info = nullptr;
  if (map.has("type")) {
    controller.type = map.choice("type", controllerNames(), "the name of a controller type", "");
    info = findController(controller.type);
  } else {
    complaints.add(map.key("type"),
                   fmt::format("missing; must be one of {}", fmt::join(controllerNames(), ", ")));
  }
  controller.rate = map.numberBetween("rate", 1.0e-3, kMaxSampleRate, "Hz", std::nullopt);
  readDelay(map, controller, complaints);
  readMeasured(map, signals, controller, complaints);
  readActedOn(map, scene, controller, complaints);
  readSurroundings(map, scene, controller, complaints);
  const bool external = info != nullptr && info->name == "external";
  for (const char* const own : {"mode", "timeout", "on_timeout"}) {
    if (!external && map.has(own)) {
      complaints.add(map.key(own), "needs type: external, a controller in another process");
    }
  }
  if (external) {
    readExternal(map, *info, scene, controller, complaints);
    checkSystems(map, scene, controller, complaints);
  } else if (info != nullptr) {
    readParameterValues(map, info->name, info->parameters, info->settings, {},
                        controller.parameters, controller.following, controller.settings,
                        complaints);
    checkSystems(map, scene, controller, complaints);
    const bool speed = info->name == "speed";
    if (speed && complaints.all().size() == before) {
      findBands(map, scene, controller, complaints);
    }
    if (complaints.all().size() == before) {
      checkLaw(map, *info, scene, controller, complaints);
    }
    if (speed && complaints.all().size() == before) {
      controller.weak_passages = weakPassages(scene, controller);
    }
  }
  return controller;
}

}  // namespace

ControllerPlan planOf(const Scene& scene, const ControllerSpec& controller) {
  ControllerPlan plan;
  plan.rate = controller.rate;
  plan.measured = controller.measures.size();
  plan.outputs = controller.acts_on.size();
  plan.limits.assign(plan.outputs, controller.actuator.limit > 0.0
                                       ? controller.actuator.limit
                                       : std::numeric_limits<double>::infinity());
  HeldMotions rests;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (involves(controller, i)) {
      rests[i] = restNear(motionAtStart(scene, i));
    }
  }
  const LinearPlant plant = linearPlant(controller.measures, controller.acts_on, rests);
  if (plant.a.allFinite() && plant.b.allFinite()) {
    plan.plant = plant;
  }
  plan.critical_bands = controller.critical_bands;
  for (const WeakPassage& passage : controller.weak_passages) {
    if (!passage.tried && !plan.impassable) {
      plan.impassable = passage.band;
    }
  }
  return plan;
}

void readControllers(const YAML::Node& node, const std::string& key, Scene& scene,
                     Complaints& complaints) {
  const MapReader map(node, key, {}, "", complaints);
  const SignalNames signals(scene);
  for (const std::string& name : map.names()) {
    scene.controllers.push_back(
        readController(map.at(name), map.key(name), name, signals, scene, complaints));
  }
}

}  // namespace whirl_twin
