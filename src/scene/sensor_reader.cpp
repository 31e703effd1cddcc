#include "scene/sensor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "messages/names.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

constexpr double kHighestRate = 1.0e7;   // Hz
constexpr double kLongestBlock = 10.0;   // s
constexpr double kMostSamples = 1.0e5;   // values in a message
constexpr double kLongestDelay = 1.0e3;  // s
constexpr double kLargestMark = 1.0e6;   // rad
constexpr double kLargestJitter = 1.0;   // s
constexpr double kHalfPi = 1.57079632679489661923;

/// Everything of a system that can be measured, by name.
struct Signals {
  std::vector<std::string> names;
  std::vector<SignalSpec> signals;
  std::vector<bool> takes_direction;

  void add(const std::string& name, const SignalSpec& signal, bool free_direction = false) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
      signals.push_back(signal);
      takes_direction.push_back(free_direction);
    }
  }
};

void addDisplacements(const std::string& prefix, SignalSpec at, Signals& all) {
  at.kind = SignalSpec::Kind::kDisplacement;
  at.unit = "m";
  all.add(prefix, at, true);
  all.add(prefix + ".x", at);
  at.direction = kHalfPi;
  all.add(prefix + ".y", at);
}

Signals signalsOf(const Scene& scene) {
  Signals all;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (!scene.systems[i].setup) {
      continue;  // it was refused
    }
    const Dynamics& dynamics = *scene.systems[i].setup->made.dynamics;
    const std::string& system = scene.systems[i].name;
    SignalSpec signal;
    signal.system = i;
    const std::vector<Station> stations = dynamics.stations();
    for (std::size_t k = 0; k < stations.size(); ++k) {
      signal.station = k;
      if (k == 0) {
        addDisplacements(system, signal, all);
      }
      addDisplacements(system + "." + stations[k].name, signal, all);
    }
    const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      signal.coordinate = k;
      signal.kind = SignalSpec::Kind::kCoordinate;
      signal.unit = coordinates[k].unit;
      all.add(system + "." + coordinates[k].name, signal);
      signal.kind = SignalSpec::Kind::kRate;
      signal.unit += "/s";
      all.add(system + "." + coordinates[k].name + "_rate", signal);
    }
  }
  return all;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

std::uint32_t readSeed(const MapReader& map) {
  return static_cast<std::uint32_t>(map.integer("seed", 0, 2147483647, 1));
}

SensorChannelSpec readChannel(const YAML::Node& node, const std::string& key,
                              const std::string& name, const Signals& signals,
                              Complaints& complaints) {
  SensorChannelSpec channel;
  channel.name = name;
  const MapReader map(node, key,
                      {"measures", "direction", "noise", "resolution", "range", "bandwidth",
                       "delay", "run_out", "run_out_angle"},
                      "key of a sensor", complaints);
  if (!map.usable()) {
    return channel;
  }
  const std::string measured = map.text("measures", "");
  const auto found = std::find(signals.names.begin(), signals.names.end(), measured);
  if (!map.has("measures")) {
    complaints.add(map.key("measures"), "missing; must be a signal such as rotor.x");
  } else if (found == signals.names.end()) {
    const std::string near = nearestName(measured, signals.names);
    complaints.add(map.key("measures"),
                   fmt::format("must be a coordinate, a rate or a station of a system, found {}{}",
                               quoted(measured),
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  } else {
    const auto place = static_cast<std::size_t>(found - signals.names.begin());
    channel.signal = signals.signals[place];
    if (map.has("direction")) {
      channel.signal.direction = map.number("direction", Range::kAny, "rad", 0.0);
      if (!signals.takes_direction[place]) {
        complaints.add(
            map.key("direction"),
            fmt::format("is for a rotor or a station of it, but {} has its own", quoted(measured)));
      }
    }
  }
  const std::string unit = channel.signal.unit.empty() ? "-" : channel.signal.unit;
  channel.sensor.noise = map.number("noise", Range::kNotNegative, unit, 0.0);
  channel.sensor.resolution = map.number("resolution", Range::kNotNegative, unit, 0.0);
  channel.sensor.range = map.number("range", Range::kNotNegative, unit, 0.0);
  channel.sensor.bandwidth = map.number("bandwidth", Range::kNotNegative, "Hz", 0.0);
  channel.sensor.delay = map.numberBetween("delay", 0.0, kLongestDelay, "s", 0.0);
  channel.run_out.amplitude = map.number("run_out", Range::kNotNegative, "m", 0.0);
  channel.run_out.angle = map.number("run_out_angle", Range::kAny, "rad", 0.0);
  if (channel.run_out.amplitude > 0.0 && channel.signal.kind != SignalSpec::Kind::kDisplacement &&
      found != signals.names.end()) {
    complaints.add(map.key("run_out"), "is of a rotor's surface under a probe of displacement");
  }
  return channel;
}

void readKeyphasor(const MapReader& map, const Scene& scene, SensorSpec& sensor,
                   Complaints& complaints) {
  std::vector<std::string> drives;
  for (const DriveSpec& drive : scene.drives) {
    drives.push_back(drive.name);
  }
  const std::string name = map.choice("keyphasor", drives, "a drive of the scene", "");
  const auto found = std::find(drives.begin(), drives.end(), name);
  sensor.drive = static_cast<std::size_t>(found - drives.begin());
  KeyphasorSettings settings;
  settings.mark = map.numberBetween("mark", -kLargestMark, kLargestMark, "rad", 0.0);
  settings.jitter = map.numberBetween("jitter", 0.0, kLargestJitter, "s", 0.0);
  settings.resolution = map.numberBetween("resolution", 0.0, 1.0, "s", 0.0);
  sensor.keyphasor = settings;
  for (const char* key : {"rate", "channels"}) {
    if (map.has(key)) {
      complaints.add(map.key(key), "a keyphasor's pulses come when they come: it has none");
    }
  }
}

SensorSpec readSource(const YAML::Node& node, const std::string& key, const std::string& name,
                      const Scene& scene, const Signals& signals, Complaints& complaints) {
  SensorSpec sensor;
  sensor.name = name;
  const MapReader map(
      node, key, {"rate", "seed", "block", "channels", "keyphasor", "mark", "jitter", "resolution"},
      "key of sensors", complaints);
  if (!map.usable()) {
    return sensor;
  }
  sensor.seed = readSeed(map);
  sensor.block = map.numberBetween("block", 1.0e-6, kLongestBlock, "s", sensor.block);
  if (map.has("keyphasor")) {
    readKeyphasor(map, scene, sensor, complaints);
    return sensor;
  }
  for (const char* alone : {"mark", "jitter", "resolution"}) {
    if (map.has(alone)) {
      complaints.add(map.key(alone), "is for a keyphasor");
    }
  }
  sensor.rate = map.numberBetween("rate", 1.0e-3, kHighestRate, "Hz", std::nullopt);
  if (!map.has("channels")) {
    complaints.add(map.key("channels"), "missing; sensors have at least one channel");
    return sensor;
  }
  const MapReader channels(map.at("channels"), map.key("channels"), {}, "", complaints);
  for (const std::string& channel : channels.names()) {
    if (!isLegalName(channel)) {
      complaints.add(channels.key(channel),
                     fmt::format("a channel is named by up to {} letters, digits and _, a letter "
                                 "first",
                                 kMaxNameLength));
    }
    sensor.channels.push_back(
        readChannel(channels.at(channel), channels.key(channel), channel, signals, complaints));
  }
  if (channels.usable() && sensor.channels.empty()) {
    complaints.add(map.key("channels"), "sensors have at least one channel, found none");
  }
  const double samples = sensor.rate * sensor.block * static_cast<double>(sensor.channels.size());
  if (samples > kMostSamples) {
    complaints.add(
        map.key("block"),
        fmt::format("must give at most {:g} values a message, found {:g}", kMostSamples, samples));
  }
  return sensor;
}

}  // namespace

std::vector<SensorSpec> readSensors(const YAML::Node& node, const std::string& key,
                                    const Scene& scene, Complaints& complaints) {
  std::vector<SensorSpec> sensors;
  const MapReader map(node, key, {}, "", complaints);
  const Signals signals = signalsOf(scene);
  std::set<std::string> channels;  // of LCM
  for (const std::string& name : map.names()) {
    if (!isLegalName(name)) {
      complaints.add(map.key(name),
                     fmt::format("sensors are named by up to {} letters, digits and _, a letter "
                                 "first",
                                 kMaxNameLength));
    } else if (!channels.insert(upper(name)).second) {
      complaints.add(map.key(name), "other sensors have this name but for upper and lower case");
    }
    sensors.push_back(readSource(map.at(name), map.key(name), name, scene, signals, complaints));
  }
  return sensors;
}

}  // namespace whirl_twin
