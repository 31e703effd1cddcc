#include "estimation/follow_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

constexpr double kMaxFalseAlarms = 3600.0;  // 1/h
constexpr double kMaxPatience = 10.0;       // s
// In any unit; the squares must not underflow.
constexpr double kSmallest = 1.0e-30;
constexpr double kLargest = 1.0e9;

/// A standard deviation; 0 if none is given.
double deviationOf(const MapReader& map, const std::string& name, const std::string& unit) {
  return map.numberBetween(name, kSmallest, kLargest, unit, 0.0);
}

EstimatorNumber followedNumber(const MapReader& map, const std::string& name,
                               const std::string& unit, Diagnostics& diagnostics) {
  EstimatorNumber number;
  if (!map.at(name).IsMap()) {
    number.deviation = deviationOf(map, name, unit);
    return number;
  }
  const MapReader entry(map.at(name), map.key(name), {"deviation", "walk"},
                        "key of an estimated parameter", diagnostics);
  if (entry.usable()) {
    number.deviation = entry.numberBetween("deviation", kSmallest, kLargest, unit, std::nullopt);
    number.walk = entry.numberBetween("walk", 0.0, kLargest, unit + "/sqrt(s)", 0.0);
  }
  return number;
}

/// Measured channels of a system, displacements only or all: "source/channel".
std::vector<std::string> channelsOf(const Scene& scene, const std::string& system,
                                    bool displacements) {
  std::vector<std::string> all;
  for (const SensorSpec& sensor : scene.sensors) {
    for (const SensorChannelSpec& channel : sensor.channels) {
      if (scene.systems[channel.signal.system].name == system &&
          (!displacements || channel.signal.kind == SignalSpec::Kind::kDisplacement)) {
        all.push_back(sensor.name + "/" + channel.name);
      }
    }
  }
  return all;
}

/// Reads SOURCE/CHANNEL: number, or SOURCE: {CHANNEL: number}, as on a parameter server, where a
/// slash separates names.
void readOffsets(const YAML::Node& given, const std::string& key,
                 const std::vector<std::string>& channels, SystemFollowing& of,
                 Diagnostics& diagnostics) {
  constexpr const char* kUnit = "the channel's unit";
  constexpr const char* kKey = "channel of the scene's sensors, SOURCE/CHANNEL, of the system";
  std::vector<std::string> known = channels;
  std::map<std::string, std::vector<std::string>> sources;
  for (const std::string& path : channels) {
    const std::size_t slash = path.find('/');
    sources[path.substr(0, slash)].push_back(path.substr(slash + 1));
  }
  for (const auto& [source, own] : sources) {
    if (given.IsMap() && given[source].IsDefined() && given[source].IsMap()) {
      known.push_back(source);
    }
  }
  const MapReader offsets(given, key, known, kKey, diagnostics);
  for (const std::string& name : offsets.usable() ? offsets.names() : std::vector<std::string>{}) {
    if (!offsets.at(name).IsMap()) {
      of.offset[name] = deviationOf(offsets, name, kUnit);
      continue;
    }
    const MapReader source(offsets.at(name), offsets.key(name), sources[name], kKey, diagnostics);
    for (const std::string& channel :
         source.usable() ? source.names() : std::vector<std::string>{}) {
      of.offset[name + "/" + channel] = deviationOf(source, channel, kUnit);
    }
  }
}

/// INPUT: SOURCE/CHANNEL, or a map with the channel and its conversion.
InputFollowing readInput(const MapReader& inputs, const InputInfo& info, const Scene& scene,
                         Diagnostics& diagnostics) {
  InputFollowing of;
  of.unit = info.unit;
  std::string path, key = inputs.key(info.name);
  if (inputs.at(info.name).IsMap()) {
    const MapReader map(inputs.at(info.name), key,
                        {"channel", "scale", "offset", "deviation", "hold"},
                        "key of a measured input", diagnostics);
    if (!map.usable()) {
      return of;
    }
    path = map.text("channel", "");
    key = map.key("channel");
    of.scale = map.number("scale", Range::kAny, "-", 1.0);
    of.offset = map.number("offset", Range::kAny, info.unit, 0.0);
    of.deviation = map.number("deviation", Range::kNotNegative, info.unit, 0.0);
    of.hold = map.choice("hold", {"false", "true"}, "true or false", "false") == "true";
  } else {
    path = inputs.text(info.name, "");
  }
  const std::size_t slash = std::min(path.find('/'), path.size());
  of.source = path.substr(0, slash);
  of.channel = path.substr(std::min(slash + 1, path.size()));
  if (!isLegalName(of.source) || !isLegalName(of.channel)) {
    diagnostics.add(key,
                    fmt::format("must be the channel that measures it, SOURCE/CHANNEL, found {}",
                                whirl_twin::inQuotes(path)));
  }
  for (const SensorSpec& sensor : scene.sensors) {
    const bool taken = std::any_of(sensor.channels.begin(), sensor.channels.end(),
                                   [&](const auto& c) { return c.name == of.channel; });
    if (sensor.name == of.source && (taken || sensor.keyphasor)) {
      diagnostics.add(key, fmt::format("{} measures another quantity in the scene",
                                       whirl_twin::inQuotes(path)));
    }
  }
  return of;
}

void readInputs(const MapReader& map, const BuiltSystem& system, const Scene& scene,
                SystemFollowing& of, Diagnostics& diagnostics) {
  const std::vector<InputInfo> all = system.dynamics->inputs();
  std::vector<std::string> names;
  for (const InputInfo& info : all) {
    names.push_back(info.name);
  }
  if (names.empty()) {
    diagnostics.add(map.key("inputs"), "the system has no inputs");
    return;
  }
  const MapReader inputs(map.at("inputs"), map.key("inputs"), names, "input of the system",
                         diagnostics);
  for (std::size_t i = 0; i < all.size() && inputs.usable(); ++i) {
    if (inputs.has(names[i])) {
      of.inputs.push_back(readInput(inputs, all[i], scene, diagnostics));
      of.inputs.back().input = i;
    }
  }
}

/// A channel must not be used for two inputs.
void refuseDoubleInputs(const FollowSettings& settings, Diagnostics& diagnostics) {
  std::map<std::string, std::string> used;  // system of the input, by channel
  for (const auto& [system, of] : settings.systems) {
    for (const InputFollowing& input : of.inputs) {
      const std::string path = input.source + "/" + input.channel;
      if (!used.emplace(path, system).second) {
        diagnostics.add(
            "systems." + system + ".inputs",
            fmt::format("{} measures another input already", whirl_twin::inQuotes(path)));
      }
    }
  }
}

SystemFollowing readSystem(const MapReader& map, const BuiltSystem& system, const Scene& scene,
                           Diagnostics& diagnostics) {
  SystemFollowing of;
  const bool rotor = system.dynamics->isRotor();
  const std::string coordinate = system.dynamics->coordinates().front().unit;
  of.disturbance =
      map.numberBetween("disturbance", 0.0, kLargest, coordinate + "/s^2/sqrt(Hz)", 0.0);
  if (map.has("parameters")) {
    const MapReader parameters(map.at("parameters"), map.key("parameters"),
                               system.parameters().names, "parameter of the system", diagnostics);
    for (const std::string& path :
         parameters.usable() ? parameters.names() : std::vector<std::string>{}) {
      const std::optional<double> value = system.parameter(path);
      if (!value) {
        continue;  // reported above
      }
      if (*value == 0.0) {
        diagnostics.add(parameters.key(path),
                        "must start from a nonzero value in the scene, found 0");
      }
      of.parameters.push_back(
          {path, followedNumber(parameters, path, "of its value", diagnostics)});
    }
  }
  for (const char* key : {"unbalance", "run_out"}) {
    if (map.has(key) && !rotor) {
      diagnostics.add(map.key(key), "needs a rotor");
    }
  }
  if (map.has("unbalance")) {
    of.unbalance = followedNumber(map, "unbalance", "kg m", diagnostics);
  }
  of.run_out = map.numberBetween("run_out", 0.0, kLargest, "m", 0.0);
  if (map.has("inputs")) {
    readInputs(map, system, scene, of, diagnostics);
  }
  if (map.has("offsets")) {
    readOffsets(map.at("offsets"), map.key("offsets"), channelsOf(scene, system.spec.name, false),
                of, diagnostics);
  }
  if (of.run_out > 0.0 && channelsOf(scene, system.spec.name, true).empty()) {
    diagnostics.add(map.key("run_out"), "needs displacement probes among the scene's sensors");
  }
  return of;
}

}  // namespace

FollowSettings readFollowSettings(const YAML::Node& tree, const std::string& source,
                                  const BuiltScene& scene) {
  Diagnostics diagnostics(source);
  FollowSettings settings;
  const MapReader map(tree, "", {"systems", "false_alarms", "patience"},
                      "key of estimator settings", diagnostics);
  if (map.usable()) {
    settings.false_alarms =
        map.numberBetween("false_alarms", 1.0e-9, kMaxFalseAlarms, "per hour", 0.02);
    if (map.has("patience")) {
      settings.patience = map.numberBetween("patience", 0.0, kMaxPatience, "s", 0.0);
    }
    if (map.has("systems")) {
      std::vector<std::string> names;
      for (const SharedSystem& system : scene.systems) {
        names.push_back(system->spec.name);
      }
      const MapReader systems(map.at("systems"), map.key("systems"), names, "system of the scene",
                              diagnostics);
      for (const SharedSystem& system : scene.systems) {
        if (!systems.usable() || !systems.has(system->spec.name)) {
          continue;
        }
        const MapReader one(
            systems.at(system->spec.name), systems.key(system->spec.name),
            {"disturbance", "parameters", "inputs", "unbalance", "offsets", "run_out"},
            "key of an estimated system", diagnostics);
        if (one.usable()) {
          settings.systems[system->spec.name] = readSystem(one, *system, scene.scene, diagnostics);
        }
      }
      refuseDoubleInputs(settings, diagnostics);
    }
  }
  if (!diagnostics.all().empty()) {
    throw InputError(errorList(diagnostics.all(), "\ntwin: "));
  }
  return settings;
}

}  // namespace whirl_twin
