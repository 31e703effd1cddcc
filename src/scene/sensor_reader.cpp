#include "scene/sensor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "messages/names.h"
#include "scene/sensor_spec.h"
#include "scene/signal_names.h"

namespace whirl_twin {

namespace {

constexpr double kMaxBlock = 10.0;     // s
constexpr double kMaxSamples = 1.0e5;  // values in a message
constexpr double kMaxMark = 1.0e6;     // rad
constexpr double kMaxJitter = 1.0;     // s

std::uint32_t readSeed(const MapReader& map) {
  return static_cast<std::uint32_t>(map.integer("seed", 0, 2147483647, 1));
}

SensorChannelSpec readChannel(const YAML::Node& node, const std::string& key,
                              const std::string& name, const SignalNames& signals,
                              Diagnostics& diagnostics) {
  SensorChannelSpec channel;
  channel.name = name;
  const MapReader map(node, key,
                      {"measures", "direction", "noise", "resolution", "range", "bandwidth",
                       "delay", "run_out", "run_out_angle"},
                      "key of a sensor", diagnostics);
  if (!map.usable()) {
    return channel;
  }
  const std::string measured = map.text("measures", "");
  const std::optional<NamedSignal> found =
      map.has("measures") ? signals.find(measured, map.key("measures"), diagnostics) : std::nullopt;
  if (!map.has("measures")) {
    diagnostics.add(map.key("measures"), "missing; must be a signal such as rotor.x");
  }
  if (found) {
    channel.signal = found->signal;
    if (map.has("direction")) {
      channel.signal.direction = map.number("direction", Range::kAny, "rad", 0.0);
      if (!found->takes_direction) {
        diagnostics.add(
            map.key("direction"),
            fmt::format("needs a rotor or a station of one; the direction of {} is fixed",
                        whirl_twin::inQuotes(measured)));
      }
    }
  }
  const std::string unit = channel.signal.unit.empty() ? "-" : channel.signal.unit;
  channel.sensor.noise = map.number("noise", Range::kNotNegative, unit, 0.0);
  channel.sensor.resolution = map.number("resolution", Range::kNotNegative, unit, 0.0);
  channel.sensor.range = map.number("range", Range::kNotNegative, unit, 0.0);
  channel.sensor.bandwidth = map.number("bandwidth", Range::kNotNegative, "Hz", 0.0);
  channel.sensor.delay = map.numberBetween("delay", 0.0, kMaxSignalDelay, "s", 0.0);
  channel.run_out.amplitude = map.number("run_out", Range::kNotNegative, "m", 0.0);
  channel.run_out.angle = map.number("run_out_angle", Range::kAny, "rad", 0.0);
  if (channel.run_out.amplitude > 0.0 && channel.signal.kind != SignalSpec::Kind::kDisplacement &&
      found) {
    diagnostics.add(map.key("run_out"), "needs a displacement probe on a rotor");
  }
  return channel;
}

void readKeyphasor(const MapReader& map, const Scene& scene, SensorSpec& sensor,
                   Diagnostics& diagnostics) {
  std::vector<std::string> drives;
  for (const DriveSpec& drive : scene.drives) {
    drives.push_back(drive.name);
  }
  const std::string name = map.choice("keyphasor", drives, "a drive of the scene", "");
  const auto found = std::find(drives.begin(), drives.end(), name);
  sensor.drive = static_cast<std::size_t>(found - drives.begin());
  KeyphasorSettings settings;
  settings.mark = map.numberBetween("mark", -kMaxMark, kMaxMark, "rad", 0.0);
  settings.jitter = map.numberBetween("jitter", 0.0, kMaxJitter, "s", 0.0);
  settings.resolution = map.numberBetween("resolution", 0.0, 1.0, "s", 0.0);
  sensor.keyphasor = settings;
  for (const char* key : {"rate", "channels"}) {
    if (map.has(key)) {
      diagnostics.add(map.key(key),
                      "must not be given with a keyphasor, which sends one pulse per revolution");
    }
  }
}

SensorSpec readSource(const YAML::Node& node, const std::string& key, const std::string& name,
                      const Scene& scene, const SignalNames& signals, Diagnostics& diagnostics) {
  SensorSpec sensor;
  sensor.name = name;
  const MapReader map(
      node, key, {"rate", "seed", "block", "channels", "keyphasor", "mark", "jitter", "resolution"},
      "key of sensors", diagnostics);
  if (!map.usable()) {
    return sensor;
  }
  sensor.seed = readSeed(map);
  sensor.block = map.numberBetween("block", 1.0e-6, kMaxBlock, "s", sensor.block);
  if (map.has("keyphasor")) {
    readKeyphasor(map, scene, sensor, diagnostics);
    return sensor;
  }
  for (const char* alone : {"mark", "jitter", "resolution"}) {
    if (map.has(alone)) {
      diagnostics.add(map.key(alone), "needs a keyphasor");
    }
  }
  sensor.rate = map.numberBetween("rate", 1.0e-3, kMaxSampleRate, "Hz", std::nullopt);
  if (!map.has("channels")) {
    diagnostics.add(map.key("channels"), "missing; sensors need at least one channel");
    return sensor;
  }
  const MapReader channels(map.at("channels"), map.key("channels"), {}, "", diagnostics);
  for (const std::string& channel : channels.names()) {
    if (!isLegalName(channel)) {
      diagnostics.add(
          channels.key(channel),
          fmt::format("the name of a channel must have at most {} letters, digits and _, a letter "
                      "first",
                      kMaxNameLength));
    }
    sensor.channels.push_back(
        readChannel(channels.at(channel), channels.key(channel), channel, signals, diagnostics));
  }
  if (channels.usable() && sensor.channels.empty()) {
    diagnostics.add(map.key("channels"), "sensors need at least one channel, found none");
  }
  const double samples = sensor.rate * sensor.block * static_cast<double>(sensor.channels.size());
  if (samples > kMaxSamples) {
    diagnostics.add(
        map.key("block"),
        fmt::format("must give at most {:g} values per message, found {:g}", kMaxSamples, samples));
  }
  return sensor;
}

}  // namespace

std::vector<SensorSpec> readSensors(const YAML::Node& node, const std::string& key,
                                    const Scene& scene, Diagnostics& diagnostics) {
  std::vector<SensorSpec> sensors;
  const MapReader map(node, key, {}, "", diagnostics);
  const SignalNames signals(scene);
  std::set<std::string> channels;  // names of LCM channels
  for (const std::string& name : map.names()) {
    if (!isLegalName(name)) {
      diagnostics.add(
          map.key(name),
          fmt::format("the name of sensors must have at most {} letters, digits and _, a letter "
                      "first",
                      kMaxNameLength));
    } else if (!channels.insert(capitals(name)).second) {
      diagnostics.add(
          map.key(name),
          "duplicate: other sensors have this name (upper and lower case are the same)");
    }
    sensors.push_back(readSource(map.at(name), map.key(name), name, scene, signals, diagnostics));
  }
  return sensors;
}

}  // namespace whirl_twin
