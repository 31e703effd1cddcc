#include "monitoring/signal_settings_reader.h"

#include <fmt/format.h>

#include <complex>
#include <optional>
#include <utility>

namespace whirl_twin {

VibrationZones readZones(const YAML::Node& node, const std::string& key, Complaints& complaints) {
  const MapReader map(node, key, {"a", "b", "c"}, "zone", complaints);
  VibrationZones zones;
  if (!map.usable()) {
    return zones;
  }
  zones.a = map.number("a", Range::kPositive, "m", std::nullopt);
  zones.b = map.number("b", Range::kPositive, "m", std::nullopt);
  zones.c = map.number("c", Range::kPositive, "m", std::nullopt);
  const bool all = map.has("a") && map.has("b") && map.has("c");
  if (all && (zones.b <= zones.a || zones.c <= zones.b)) {
    complaints.add(
        key, fmt::format("the limits of the zones must increase, found {:g}, {:g}, {:g} m", zones.a,
                         zones.b, zones.c));
  }
  return zones;
}

RubLevels readRub(const YAML::Node& node, const std::string& key, Complaints& complaints) {
  const MapReader map(node, key, {"backward", "subharmonic"}, "key of rub levels", complaints);
  RubLevels levels;
  if (!map.usable()) {
    return levels;
  }
  if (!map.has("backward") && !map.has("subharmonic")) {
    complaints.add(key, "must have a level: backward or subharmonic [m]; found none");
  }
  for (const auto& [name, level] :
       {std::pair("backward", &levels.backward), std::pair("subharmonic", &levels.subharmonic)}) {
    if (map.has(name)) {
      *level = map.number(name, Range::kPositive, "m", std::nullopt);
    }
  }
  return levels;
}

SlowRoll readSlowRoll(const YAML::Node& node, const std::string& key, Complaints& complaints) {
  const MapReader map(node, key, {"below", "forward", "forward_lag", "backward", "backward_lag"},
                      "key of a slow roll", complaints);
  SlowRoll roll;
  if (!map.usable()) {
    return roll;
  }
  const bool given = map.has("forward") || map.has("backward");
  if (map.has("below") == given) {
    complaints.add(key, fmt::format("must be learned `below` a speed [rad/s], or be given as "
                                    "`forward` and `backward` [m], found {}",
                                    given ? "both" : "neither"));
    return roll;
  }
  if (map.has("below")) {
    roll.below = map.number("below", Range::kPositive, "rad/s", std::nullopt);
    return roll;
  }
  const auto vector = [&map](const char* amplitude, const char* lag) {
    const double size = map.number(amplitude, Range::kNotNegative, "m", 0.0);
    return std::polar(size, -map.number(lag, Range::kAny, "rad", 0.0));
  };
  roll.given.forward = vector("forward", "forward_lag");
  roll.given.backward = vector("backward", "backward_lag");
  return roll;
}

}  // namespace whirl_twin
