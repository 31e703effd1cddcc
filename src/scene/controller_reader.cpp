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
#include "scene/resonance_passage_check.h"
#include "scene/sensor_spec.h"
#include "scene/signal_names.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

constexpr double kMaxUnderWay = 1.0e4;  // outputs delayed at a time
constexpr std::size_t kMaxSignals = 64;

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
                                 Diagnostics& diagnostics) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) {
      return places_[static_cast<std::size_t>(found - names_.begin())];
    }
    const std::string near = nearestName(name, names_);
    diagnostics.add(
        key, fmt::format("must be an input of a system, found {}{}", whirl_twin::inQuotes(name),
                         near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }

 private:
  std::vector<std::string> names_;
  std::vector<ActedInput> places_;
};

/// The entries of a list that must not be empty.
std::vector<YAML::Node> entries(const MapReader& map, const std::string& name,
                                const std::string& of, Diagnostics& diagnostics) {
  if (!map.usable()) {
    return {};
  }
  if (!map.has(name)) {
    diagnostics.add(map.key(name), fmt::format("missing; must be a list of {}", of));
    return {};
  }
  const YAML::Node node = map.at(name);
  if (!node.IsSequence() || node.size() == 0 || node.size() > kMaxSignals) {
    diagnostics.add(map.key(name),
                    fmt::format("must be a list of 1 to {} {}, found {}", kMaxSignals, of,
                                node.IsSequence() ? fmt::format("{}", node.size()) : shown(node)));
    return {};
  }
  return {node.begin(), node.end()};
}

void readMeasured(const MapReader& map, const SignalNames& signals, ControllerSpec& controller,
                  Diagnostics& diagnostics) {
  const std::vector<YAML::Node> given = entries(map, "measures", "signals", diagnostics);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string key = fmt::format("{}[{}]", map.key("measures"), i);
    std::string name;
    std::optional<double> direction;
    std::string name_key = key;
    if (given[i].IsMap()) {
      const MapReader entry(given[i], key, {"signal", "direction"}, "key of a signal", diagnostics);
      name = entry.text("signal", "");
      name_key = entry.key("signal");
      direction = entry.number("direction", Range::kAny, "rad", 0.0);
    } else if (given[i].IsScalar()) {
      name = given[i].Scalar();
    }
    std::optional<NamedSignal> found = signals.find(name, name_key, diagnostics);
    if (found && direction) {
      if (found->takes_direction) {
        found->signal.direction = *direction;
      } else {
        diagnostics.add(
            key + ".direction",
            fmt::format("needs a rotor or a station of one; the direction of {} is fixed",
                        whirl_twin::inQuotes(name)));
      }
    }
    if (found) {
      controller.measured.push_back(name);
      controller.measures.push_back(found->signal);
    }
  }
}

/// Marks the inputs that a controller acts on as controlled by it.
void readActedOn(const MapReader& map, Scene& scene, ControllerSpec& controller,
                 Diagnostics& diagnostics) {
  const InputNames inputs(scene);
  const std::vector<YAML::Node> given = entries(map, "acts_on", "inputs", diagnostics);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string key = fmt::format("{}[{}]", map.key("acts_on"), i);
    const std::string name = given[i].IsScalar() ? given[i].Scalar() : "";
    const std::optional<ActedInput> found = inputs.find(name, key, diagnostics);
    if (!found) {
      continue;
    }
    SystemSpec& system = scene.systems[found->system];
    const std::string input = system.setup->made.dynamics->inputs()[found->input].name;
    const auto signal = system.inputs.find(input);
    if (signal != system.inputs.end()) {
      diagnostics.add(key, fmt::format("{} is already {}", whirl_twin::inQuotes(name),
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
                      Diagnostics& diagnostics) {
  const auto part = [&](const char* name, const std::vector<std::string>& keys) {
    return MapReader(map.has(name) ? map.at(name) : YAML::Node(YAML::NodeType::Map), map.key(name),
                     keys, fmt::format("key of {}", name), diagnostics);
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
void readDelay(const MapReader& map, ControllerSpec& controller, Diagnostics& diagnostics) {
  const bool parts = map.has("delay") && map.at("delay").IsMap();
  double delay = 0.0;
  double jitter = 0.0;
  if (parts) {
    const MapReader given(map.at("delay"), map.key("delay"), {"mean", "jitter", "seed"},
                          "key of delay", diagnostics);
    delay = given.numberBetween("mean", 0.0, kMaxSignalDelay, "s", std::nullopt);
    jitter = given.numberBetween("jitter", 0.0, kMaxSignalDelay, "s", 0.0);
    controller.jitter_seed = static_cast<std::uint32_t>(given.integer("seed", 0, 2147483647, 1));
    if (jitter > delay) {
      diagnostics.add(
          given.key("jitter"),
          fmt::format("must be at most the mean delay, {:g} s, found {:g}", delay, jitter));
    }
  } else {
    delay = map.numberBetween("delay", 0.0, kMaxSignalDelay, "s", 0.0);
  }
  controller.delay = std::llround(delay * 1.0e9);
  controller.jitter = std::llround(jitter * 1.0e9);
  if ((delay + jitter) * controller.rate > kMaxUnderWay) {
    diagnostics.add(map.key("delay"),
                    fmt::format("must be at most {:g} samples, found {:g}", kMaxUnderWay,
                                (delay + jitter) * controller.rate));
  }
}

/// Reports a control law that cannot be made from its parameters.
void checkLaw(const MapReader& map, const ControllerInfo& info, const Scene& scene,
              const ControllerSpec& controller, Diagnostics& diagnostics) {
  try {
    info.make(controller.parameters, controller.settings, planOf(scene, controller));
  } catch (const SetupError& error) {
    diagnostics.add(map.key("parameters." + error.parameter()), error.what());
  } catch (const InputError& error) {
    diagnostics.add(map.key("type"), error.what());
  }
}

/// Finds the barred speed ranges about critical speeds for a speed controller.
void findBands(const MapReader& map, const Scene& scene, ControllerSpec& controller,
               Diagnostics& diagnostics) {
  const double margin = controller.parameters.at("margin");
  const std::string key = map.key("parameters.margin");
  if (margin != 0.0 && (margin < kMinBandMargin || margin > kMaxBandMargin)) {
    diagnostics.add(key, fmt::format("must be 0, or from {} to {} of a critical speed, found {}",
                                     kMinBandMargin, kMaxBandMargin, margin));
  }
  if (controller.settings.choices.at("critical_speeds") == "true") {
    controller.critical_bands =
        criticalBands(scene, scene.driveOf(scene.systems[controller.measures.front().system]),
                      margin > 0.0 ? std::optional<double>(margin) : std::nullopt,
                      map.key("parameters.critical_speeds"), diagnostics);
  } else if (margin != 0.0) {
    diagnostics.add(key, "needs critical_speeds: true");
  }
}

/// The keys of a controller in another process, in place of parameters.
void readExternal(const MapReader& map, const ControllerInfo& info, const Scene& scene,
                  ControllerSpec& controller, Diagnostics& diagnostics) {
  controller.parameters["timeout"] = map.numberBetween("timeout", 1.0e-6, 1.0e3, "s", std::nullopt);
  for (const SettingInfo& setting : info.settings) {
    controller.settings.choices[setting.name] =
        map.choice(setting.name, setting.choices, "one of its values", setting.choices.front());
  }
  if (map.has("parameters")) {
    diagnostics.add(map.key("parameters"),
                    "must not be given: the controller's own process has them");
  }
  const std::int64_t shortest = controller.delay - controller.jitter;
  if (controller.settings.choices["mode"] == "lockstep" && shortest < scene.step) {
    diagnostics.add(
        map.key("delay"),
        fmt::format("must be at least a step, {:g} s, in lockstep: simulated time waits "
                    "for answers between steps, found {:g} s",
                    scene.stepSeconds(), static_cast<double>(shortest) / 1e9));
  }
}

/// Reports systems that cannot have controllers.
void checkSystems(const MapReader& map, const Scene& scene, const ControllerSpec& controller,
                  Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const auto is_it = [&](const ActedInput& input) { return input.system == i; };
    if (!scene.systems[i].ensemble.spread.empty() &&
        std::any_of(controller.acts_on.begin(), controller.acts_on.end(), is_it)) {
      diagnostics.add(
          map.key("acts_on"),
          fmt::format("systems.{} has a spread: the samples of an ensemble cannot have controllers",
                      scene.systems[i].name));
    }
  }
}

ControllerSpec readController(const YAML::Node& node, const std::string& key,
                              const std::string& name, const SignalNames& signals, Scene& scene,
                              Diagnostics& diagnostics) {
  ControllerSpec controller;
  controller.name = name;
  const MapReader map(node, key,
                      {"type", "rate", "measures", "acts_on", "delay", "sensor", "actuator",
                       "parameters", "mode", "timeout", "on_timeout"},
                      "key of a controller", diagnostics);
  if (!map.usable()) {
    return controller;
  }
  const std::size_t before = diagnostics.all().size();
  const ControllerInfo* info = nullptr;
  if (map.has("type")) {
    controller.type = map.choice("type", controllerNames(), "the name of a controller type", "");
    info = findController(controller.type);
  } else {
    diagnostics.add(map.key("type"),
                    fmt::format("missing; must be one of {}", fmt::join(controllerNames(), ", ")));
  }
  controller.rate = map.numberBetween("rate", 1.0e-3, kMaxSampleRate, "Hz", std::nullopt);
  readDelay(map, controller, diagnostics);
  readMeasured(map, signals, controller, diagnostics);
  readActedOn(map, scene, controller, diagnostics);
  readSurroundings(map, scene, controller, diagnostics);
  const bool external = info != nullptr && info->name == "external";
  for (const char* const own : {"mode", "timeout", "on_timeout"}) {
    if (!external && map.has(own)) {
      diagnostics.add(map.key(own), "needs type: external, a controller in another process");
    }
  }
  if (external) {
    readExternal(map, *info, scene, controller, diagnostics);
    checkSystems(map, scene, controller, diagnostics);
  } else if (info != nullptr) {
    readParameterValues(map, info->name, info->parameters, info->settings, {},
                        controller.parameters, controller.following, controller.settings,
                        diagnostics);
    checkSystems(map, scene, controller, diagnostics);
    const bool speed = info->name == "speed";
    if (speed && diagnostics.all().size() == before) {
      findBands(map, scene, controller, diagnostics);
    }
    if (diagnostics.all().size() == before) {
      checkLaw(map, *info, scene, controller, diagnostics);
    }
    if (speed && diagnostics.all().size() == before) {
      controller.weak_passages = resonancePassageChecks(scene, controller);
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
  for (const ResonancePassageCheck& passage : controller.weak_passages) {
    if (!passage.tried && !plan.impassable) {
      plan.impassable = passage.band;
    }
  }
  return plan;
}

void readControllers(const YAML::Node& node, const std::string& key, Scene& scene,
                     Diagnostics& diagnostics) {
  const MapReader map(node, key, {}, "", diagnostics);
  const SignalNames signals(scene);
  for (const std::string& name : map.names()) {
    scene.controllers.push_back(
        readController(map.at(name), map.key(name), name, signals, scene, diagnostics));
  }
}

}  // namespace whirl_twin
