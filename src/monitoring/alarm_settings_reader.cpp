#include "monitoring/alarm_settings_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "messages/alert.h"
#include "messages/names.h"
#include "monitoring/signal_settings_reader.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"

namespace whirl_twin {
namespace {

constexpr double kMaxDelay = 3600.0;  // s, of a delay

/// A number, or a list of as many as there are points; each > 0 unless zero is fine.
std::vector<double> readList(const MapReader& map, const std::string& name, const char* unit,
                             bool zero, Complaints& complaints) {
  std::vector<double> values;
  if (!map.has(name)) {
    return values;
  }
  const YAML::Node node = map.at(name);
  const auto add = [&](const YAML::Node& item, const std::string& key) {
    const std::optional<double> value =
        item.IsScalar() ? parseQuantity(item.Scalar(), unit) : std::optional<double>();
    if (!value || *value < 0.0 || (!zero && *value == 0.0)) {
      complaints.add(key, fmt::format("must be {} {}, found {}{}", zero ? ">= 0" : "> 0", unit,
                                      shown(item), objectionToUnit(item, unit)));
    }
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  };
  if (!node.IsSequence()) {
    add(node, map.key(name));
    return values;
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    add(node[i], fmt::format("{}[{}]", map.key(name), i));
  }
  if (values.empty()) {
    complaints.add(map.key(name), "must be a number or a list of numbers, found an empty list");
  }
  return values;
}

AmplitudeLevels readLevels(const YAML::Node& node, const std::string& key, Complaints& complaints) {
  const MapReader map(node, key, {"speed", "alert", "danger", "range"}, "key of amplitude levels",
                      complaints);
  AmplitudeLevels levels;
  if (!map.usable()) {
    return levels;
  }
  levels.speed = readList(map, "speed", "rad/s", true, complaints);
  levels.alert = readList(map, "alert", "m", false, complaints);
  levels.danger = readList(map, "danger", "m", false, complaints);
  if (levels.alert.empty() && levels.danger.empty() && !map.has("range")) {
    complaints.add(key, "must have a level: alert, danger or range [m]; found none");
  }
  if (map.has("range")) {
    levels.range = map.number("range", Range::kPositive, "m", std::nullopt);
  }
  for (std::size_t i = 1; i < levels.speed.size(); ++i) {
    if (levels.speed[i] <= levels.speed[i - 1]) {
      complaints.add(fmt::format("{}[{}]", map.key("speed"), i),
                     fmt::format("must be greater than the one before, {:g} rad/s, found {:g}",
                                 levels.speed[i - 1], levels.speed[i]));
    }
  }
  const std::size_t points = levels.speed.empty() ? 1 : levels.speed.size();
  for (const auto& [name, list] :
       {std::pair("alert", &levels.alert), std::pair("danger", &levels.danger)}) {
    if (!list->empty() && list->size() != points) {
      complaints.add(map.key(name), fmt::format("must be {} [m], one for each speed, found {}",
                                                points, list->size()));
    }
  }
  for (std::size_t i = 0; i < levels.alert.size() && i < levels.danger.size(); ++i) {
    if (levels.danger[i] <= levels.alert[i]) {
      complaints.add(map.key("danger"), fmt::format("must be above alert, {:g} m, found {:g}",
                                                    levels.alert[i], levels.danger[i]));
    }
  }
  for (const std::vector<double>* list : {&levels.alert, &levels.danger}) {
    for (const double level : *list) {
      if (levels.range <= level) {
        complaints.add(map.key("range"), fmt::format("must be above the levels, {:g} m, found {:g}",
                                                     level, levels.range));
        return levels;
      }
    }
  }
  return levels;
}

Voting readVoting(const YAML::Node& node, const std::string& key,
                  const std::vector<std::string>& sources, Complaints& complaints) {
  const MapReader map(node, key, {"of", "agree", "alert", "danger", "range"}, "key of voting",
                      complaints);
  Voting voting;
  if (!map.usable()) {
    return voting;
  }
  const YAML::Node of = map.at("of");
  if (!map.has("of") || !of.IsSequence() || of.size() < 2) {
    complaints.add(map.key("of"), fmt::format("must be a list of two sources or more, found {}",
                                              map.has("of") ? shown(of) : "nothing"));
    return voting;
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::string name = of[i].IsScalar() ? of[i].Scalar() : shown(of[i]);
    const std::string at = fmt::format("{}[{}]", map.key("of"), i);
    if (std::find(sources.begin(), sources.end(), name) == sources.end()) {
      complaints.add(at, fmt::format("must be a rotor of the scene or one of its stations, found "
                                     "{}{}",
                                     quoted(name), hint(name, sources)));
    } else if (std::find(voting.of.begin(), voting.of.end(), name) != voting.of.end()) {
      complaints.add(at, fmt::format("duplicate: {} is already in the list", name));
    }
    voting.of.push_back(name);
  }
  const auto all = static_cast<int>(voting.of.size());
  if (!map.has("agree")) {
    complaints.add(map.key("agree"), fmt::format("missing; must be from 1 to {}", all));
  }
  voting.agree = map.integer("agree", 1, all, all);
  if (!map.has("alert") && !map.has("danger")) {
    complaints.add(key, "must have a level: alert or danger [m]; found none");
  }
  for (const auto& [name, level] :
       {std::pair("alert", &voting.alert), std::pair("danger", &voting.danger),
        std::pair("range", &voting.range)}) {
    if (map.has(name)) {
      *level = map.number(name, Range::kPositive, "m", std::nullopt);
    }
  }
  if (map.has("alert") && map.has("danger") && voting.danger <= voting.alert) {
    complaints.add(map.key("danger"), fmt::format("must be above alert, {:g} m, found {:g}",
                                                  voting.alert, voting.danger));
  }
  const double highest = map.has("danger") ? voting.danger : voting.alert;
  if (map.has("range") && voting.range <= highest) {
    complaints.add(map.key("range"), fmt::format("must be above the levels, {:g} m, found {:g}",
                                                 highest, voting.range));
  }
  return voting;
}

}  // namespace

AlarmSettings readAlarmSettings(const YAML::Node& tree, const std::string& source,
                                const std::vector<std::string>& rotors,
                                const std::vector<std::string>& besides,
                                const std::vector<std::string>& stations) {
  AlarmSettings s;
  const std::vector<std::pair<const char*, double*>> numbers{
      {"approach_time", &s.approach_time},
      {"clear_delay", &s.clear_delay},
      {"hysteresis", &s.hysteresis},
      {"dwell_limit", &s.dwell_limit},
      {"decay_rate_alarm", &s.decay_rate_alarm},
      {"log_decrement_warning", &s.log_decrement_warning},
      {"sensitivity_warning", &s.sensitivity_warning},
      {"saturation_time", &s.saturation_time},
      {"members_beyond", &s.members_beyond},
      {"lowest_decay_rate", &s.lowest_decay_rate},
      {"energy_residual", &s.energy_residual},
      {"data_timeout", &s.data_timeout},
      {"decay_audit", &s.decay_audit},
      {"sensor_delay", &s.sensor_delay},
      {"clock_offset", &s.clock_offset},
      {"clock_drift", &s.clock_drift},
      {"trip_multiply", &s.trip_multiply},
      {"start_up_acceleration", &s.start_up_acceleration},
      {"max_inhibition", &s.max_inhibition}};
  std::vector<std::string> known{"latch", "delays",         "amplitude", "voting",
                                 "zones", "subsynchronous", "rub",       "slow_roll"};
  for (const auto& number : numbers) {
    known.emplace_back(number.first);
  }
  known.insert(known.end(), besides.begin(), besides.end());

  Complaints complaints(source);
  const MapReader map(tree, "", known, "parameter", complaints);
  for (const auto& [name, value] : numbers) {
    *value = map.number(name, Range::kAny, "", *value);
  }
  for (const std::string& error : settingErrors(s)) {
    const auto colon = error.find(": ");
    complaints.add(error.substr(0, colon), error.substr(colon + 2));
  }

  const std::string latch =
      map.choice("latch", {"none", "danger", "all"}, "none, danger or all", "none");
  s.latch = latch == "all" ? Latch::kAll : latch == "danger" ? Latch::kDanger : Latch::kNone;

  if (map.has("delays")) {
    const std::vector<std::string> types(std::begin(alert_type::kAll), std::end(alert_type::kAll));
    const MapReader delays(map.at("delays"), "delays", types, "type of alert", complaints);
    for (const std::string& type : delays.names()) {
      const MapReader of(delays.at(type), delays.key(type), {"set", "clear"}, "key of delays",
                         complaints);
      AlarmDelays& delay = s.delays[type];
      delay.set = of.numberBetween("set", 0.0, kMaxDelay, "s", 0.0);
      delay.clear = of.numberBetween("clear", 0.0, kMaxDelay, "s", s.clear_delay);
    }
  }
  const auto each_rotor = [&](const char* name, const auto& read) {
    if (!map.has(name)) {
      return;
    }
    const MapReader of(map.at(name), name, rotors, "rotor of the scene", complaints);
    for (const std::string& rotor : of.names()) {
      if (rotors.empty()) {
        complaints.add(of.key(rotor), "needs a scene with a rotor, found none");
        continue;
      }
      read(rotor, of);
    }
  };
  each_rotor("amplitude", [&](const std::string& rotor, const MapReader& of) {
    s.amplitude[rotor] = readLevels(of.at(rotor), of.key(rotor), complaints);
  });
  std::vector<std::string> sources = rotors;
  sources.insert(sources.end(), stations.begin(), stations.end());
  each_rotor("voting", [&](const std::string& rotor, const MapReader& of) {
    s.voting[rotor] = readVoting(of.at(rotor), of.key(rotor), sources, complaints);
  });
  each_rotor("zones", [&](const std::string& rotor, const MapReader& of) {
    s.zones[rotor] = readZones(of.at(rotor), of.key(rotor), complaints);
  });
  each_rotor("subsynchronous", [&](const std::string& rotor, const MapReader& of) {
    s.subsynchronous[rotor] = of.number(rotor, Range::kPositive, "m", std::nullopt);
  });
  each_rotor("rub", [&](const std::string& rotor, const MapReader& of) {
    s.rub[rotor] = readRub(of.at(rotor), of.key(rotor), complaints);
  });
  each_rotor("slow_roll", [&](const std::string& rotor, const MapReader& of) {
    s.slow_roll[rotor] = readSlowRoll(of.at(rotor), of.key(rotor), complaints);
  });
  if (!complaints.all().empty()) {
    throw SceneError(complaints.all());
  }
  return s;
}

}  // namespace whirl_twin
