#include "monitoring/alarm_settings_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "algebra/constants.h"
#include "messages/alert.h"
#include "messages/names.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"
#include "scene/yaml_file.h"

namespace whirl_twin {
namespace {

constexpr double kMaxDelay = 3600.0;  // s, of a delay
constexpr char kChange[] = "settings";
constexpr std::size_t kMaxChangeSize = 65536;  // bytes of a change
constexpr int kDeepest = 8;                    // maps and lists in each other: settings have three
constexpr int kMaxChangedValues = 10000;       // values

/// A number, or a list of as many as there are points; each > 0 unless zero is fine.
std::vector<double> readList(const MapReader& map, const std::string& name, const char* unit,
                             bool zero, Diagnostics& diagnostics) {
  std::vector<double> values;
  if (!map.has(name)) {
    return values;
  }
  const YAML::Node node = map.at(name);
  const auto add = [&](const YAML::Node& item, const std::string& key) {
    const std::optional<double> value =
        item.IsScalar() ? parseQuantity(item.Scalar(), unit) : std::optional<double>();
    if (!value || *value < 0.0 || (!zero && *value == 0.0)) {
      diagnostics.add(key, fmt::format("must be {} {}, found {}{}", zero ? ">= 0" : "> 0", unit,
                                       shown(item), unitDiagnostic(item, unit)));
    }
    values.push_back(value.value_or(kNaN));
  };
  if (!node.IsSequence()) {
    add(node, map.key(name));
  }
  for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) {
    add(node[i], fmt::format("{}[{}]", map.key(name), i));
  }
  if (values.empty()) {
    diagnostics.add(map.key(name), "must be a number or a list of numbers, found an empty list");
  }
  return values;
}

/// Levels [m] that may be left out.
void readOptional(const MapReader& map,
                  std::initializer_list<std::pair<const char*, double*>> all) {
  for (const auto& [name, level] : all) {
    if (map.has(name)) {
      *level = map.number(name, Range::kPositive, "m", std::nullopt);
    }
  }
}

AmplitudeLevels readLevels(const YAML::Node& node, const std::string& key,
                           Diagnostics& diagnostics) {
  const MapReader map(node, key, {"speed", "alert", "danger", "range"}, "key of amplitude levels",
                      diagnostics);
  AmplitudeLevels levels;
  if (!map.usable()) {
    return levels;
  }
  levels.speed = readList(map, "speed", "rad/s", true, diagnostics);
  levels.alert = readList(map, "alert", "m", false, diagnostics);
  levels.danger = readList(map, "danger", "m", false, diagnostics);
  if (levels.alert.empty() && levels.danger.empty() && !map.has("range")) {
    diagnostics.add(key, "must have a level: alert, danger or range [m]; found none");
  }
  readOptional(map, {{"range", &levels.range}});
  for (std::size_t i = 1; i < levels.speed.size(); ++i) {
    if (levels.speed[i] <= levels.speed[i - 1]) {
      diagnostics.add(fmt::format("{}[{}]", map.key("speed"), i),
                      fmt::format("must be greater than the one before, {:g} rad/s, found {:g}",
                                  levels.speed[i - 1], levels.speed[i]));
    }
  }
  const std::size_t points = levels.speed.empty() ? 1 : levels.speed.size();
  for (const auto& [name, list] :
       {std::pair("alert", &levels.alert), std::pair("danger", &levels.danger)}) {
    if (!list->empty() && list->size() != points) {
      diagnostics.add(map.key(name), fmt::format("must be {} [m], one for each speed, found {}",
                                                 points, list->size()));
    }
  }
  for (std::size_t i = 0; i < levels.alert.size() && i < levels.danger.size(); ++i) {
    if (levels.danger[i] <= levels.alert[i]) {
      diagnostics.add(map.key("danger"), fmt::format("must be above alert, {:g} m, found {:g}",
                                                     levels.alert[i], levels.danger[i]));
    }
  }
  std::vector<double> all = levels.alert;
  all.insert(all.end(), levels.danger.begin(), levels.danger.end());
  const auto beyond =
      std::find_if(all.begin(), all.end(), [&](double level) { return levels.range <= level; });
  if (beyond != all.end()) {
    diagnostics.add(map.key("range"), fmt::format("must be above the levels, {:g} m, found {:g}",
                                                  *beyond, levels.range));
  }
  return levels;
}

Voting readVoting(const std::vector<std::string>& sources, const YAML::Node& node,
                  const std::string& key, Diagnostics& diagnostics) {
  const MapReader map(node, key, {"of", "agree", "alert", "danger", "range"}, "key of voting",
                      diagnostics);
  Voting voting;
  if (!map.usable()) {
    return voting;
  }
  const YAML::Node of = map.at("of");
  if (!map.has("of") || !of.IsSequence() || of.size() < 2) {
    diagnostics.add(map.key("of"), fmt::format("must be a list of two sources or more, found {}",
                                               map.has("of") ? shown(of) : "nothing"));
    return voting;
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::string name = of[i].IsScalar() ? of[i].Scalar() : shown(of[i]);
    const std::string at = fmt::format("{}[{}]", map.key("of"), i);
    if (std::find(sources.begin(), sources.end(), name) == sources.end()) {
      diagnostics.add(at, fmt::format("must be a rotor of the scene or one of its stations, found "
                                      "{}{}",
                                      inQuotes(name), hint(name, sources)));
    } else if (std::find(voting.of.begin(), voting.of.end(), name) != voting.of.end()) {
      diagnostics.add(at, fmt::format("duplicate: {} is already in the list", name));
    }
    voting.of.push_back(name);
  }
  const auto all = static_cast<int>(voting.of.size());
  if (!map.has("agree")) {
    diagnostics.add(map.key("agree"), fmt::format("missing; must be from 1 to {}", all));
  }
  voting.agree = map.integer("agree", 1, all, all);
  if (!map.has("alert") && !map.has("danger")) {
    diagnostics.add(key, "must have a level: alert or danger [m]; found none");
  }
  readOptional(map,
               {{"alert", &voting.alert}, {"danger", &voting.danger}, {"range", &voting.range}});
  if (map.has("alert") && map.has("danger") && voting.danger <= voting.alert) {
    diagnostics.add(map.key("danger"), fmt::format("must be above alert, {:g} m, found {:g}",
                                                   voting.alert, voting.danger));
  }
  const double highest = map.has("danger") ? voting.danger : voting.alert;
  if (map.has("range") && voting.range <= highest) {
    diagnostics.add(map.key("range"), fmt::format("must be above the levels, {:g} m, found {:g}",
                                                  highest, voting.range));
  }
  return voting;
}

VibrationZones readZones(const YAML::Node& node, const std::string& key, Diagnostics& diagnostics) {
  const MapReader map(node, key, {"a", "b", "c"}, "zone", diagnostics);
  VibrationZones zones;
  if (!map.usable()) {
    return zones;
  }
  for (const auto& [name, limit] : {std::pair("a", &zones.a), {"b", &zones.b}, {"c", &zones.c}}) {
    *limit = map.number(name, Range::kPositive, "m", std::nullopt);
  }
  const bool all = map.has("a") && map.has("b") && map.has("c");
  if (all && (zones.b <= zones.a || zones.c <= zones.b)) {
    diagnostics.add(
        key, fmt::format("the limits of the zones must increase, found {:g}, {:g}, {:g} m", zones.a,
                         zones.b, zones.c));
  }
  return zones;
}

RubLevels readRub(const YAML::Node& node, const std::string& key, Diagnostics& diagnostics) {
  const MapReader map(node, key, {"backward", "subharmonic"}, "key of rub levels", diagnostics);
  RubLevels levels;
  if (!map.usable()) {
    return levels;
  }
  if (!map.has("backward") && !map.has("subharmonic")) {
    diagnostics.add(key, "must have a level: backward or subharmonic [m]; found none");
  }
  readOptional(map, {{"backward", &levels.backward}, {"subharmonic", &levels.subharmonic}});
  return levels;
}

SlowRoll readSlowRoll(const YAML::Node& node, const std::string& key, Diagnostics& diagnostics) {
  const MapReader map(node, key, {"below", "forward", "forward_lag", "backward", "backward_lag"},
                      "key of a slow roll", diagnostics);
  SlowRoll roll;
  if (!map.usable()) {
    return roll;
  }
  const bool given = map.has("forward") || map.has("backward");
  if (map.has("below") == given) {
    diagnostics.add(key, fmt::format("must be learned `below` a speed [rad/s], or be given as "
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

/// Whether a tree is finite: in YAML a list may contain itself.
bool isTree(const YAML::Node& node, int depth, int& left) {
  if (depth > kDeepest || --left < 0) {
    return false;
  }
  if (node.IsSequence()) {
    return std::all_of(node.begin(), node.end(),
                       [&](const YAML::Node& item) { return isTree(item, depth + 1, left); });
  }
  return !node.IsMap() || std::all_of(node.begin(), node.end(), [&](const auto& entry) {
    return isTree(entry.first, depth + 1, left) && isTree(entry.second, depth + 1, left);
  });
}

/// Whether two trees are equal, in whatever order and spelling of numbers.
bool same(const YAML::Node& a, const YAML::Node& b) {
  if (!a.IsDefined() || !b.IsDefined() || a.Type() != b.Type() || a.size() != b.size()) {
    return false;
  }
  if (a.IsScalar()) {
    const std::optional<double> x = parseNumber(a.Scalar());
    return a.Scalar() == b.Scalar() || (x && x == parseNumber(b.Scalar()));
  }
  if (a.IsSequence()) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return same(x, y); });
  }
  return !a.IsMap() || std::all_of(a.begin(), a.end(), [&b](const auto& entry) {
    return same(entry.second, b[entry.first.Scalar()]);
  });
}

/// Applies a change to the present settings.
void applyChange(const MapReader& change, YAML::Node present, bool outermost,
                 Diagnostics& diagnostics) {
  for (const std::string& name : change.names()) {
    const YAML::Node value = change.at(name);
    const YAML::Node before = std::as_const(present)[name];
    const bool has_entries =
        std::find(std::begin(kSettingMaps), std::end(kSettingMaps), name) != std::end(kSettingMaps);
    if (value.IsNull()) {
      if (!before.IsDefined()) {
        diagnostics.add(change.key(name), "must be a setting in force to be removed, found none");
      }
      present.remove(name);
    } else if (outermost && has_entries && value.IsMap() && before.IsDefined() && before.IsMap()) {
      applyChange(MapReader(value, name, {}, "", diagnostics), present[name], false, diagnostics);
      if (std::as_const(present)[name].size() == 0) {
        present.remove(name);
      }
    } else {
      present[name] = YAML::Clone(value);
    }
  }
}

}  // namespace

AlarmSettings readAlarmSettings(const YAML::Node& tree, const std::string& source,
                                const std::vector<std::string>& rotors,
                                const std::vector<std::string>& besides,
                                const std::vector<std::string>& stations) {
  AlarmSettings s;
  std::vector<std::string> known(std::begin(kSettingMaps), std::end(kSettingMaps));
  known.emplace_back("latch");
  for (const AlarmSetting& setting : alarmSettings()) {
    known.emplace_back(setting.key);
  }
  known.insert(known.end(), besides.begin(), besides.end());

  Diagnostics diagnostics(source);
  const MapReader map(tree, "", known, "parameter", diagnostics);
  for (const AlarmSetting& setting : alarmSettings()) {
    double& value = s.*setting.value;
    value = map.number(setting.key, Range::kAny, "", value);
  }
  for (const std::string& error : settingErrors(s)) {
    const auto colon = error.find(": ");
    diagnostics.add(error.substr(0, colon), error.substr(colon + 2));
  }

  const std::string latch =
      map.choice("latch", {"none", "danger", "all"}, "none, danger or all", "none");
  s.latch = latch == "all" ? Latch::kAll : latch == "danger" ? Latch::kDanger : Latch::kNone;

  if (map.has("delays")) {
    const std::vector<std::string> types(std::begin(alert_type::kAll), std::end(alert_type::kAll));
    const MapReader delays(map.at("delays"), "delays", types, "type of alert", diagnostics);
    for (const std::string& type : delays.names()) {
      const MapReader of(delays.at(type), delays.key(type), {"set", "clear"}, "key of delays",
                         diagnostics);
      AlarmDelays& delay = s.delays[type];
      delay.set = of.numberBetween("set", 0.0, kMaxDelay, "s", 0.0);
      delay.clear = of.numberBetween("clear", 0.0, kMaxDelay, "s", s.clear_delay);
    }
  }
  // Settings of rotors, each read by `read`(node, key).
  const auto each_rotor = [&](const char* name, auto& settings, const auto& read) {
    if (!map.has(name)) {
      return;
    }
    const MapReader of(map.at(name), name, rotors, "rotor of the scene", diagnostics);
    for (const std::string& rotor : of.names()) {
      if (rotors.empty()) {
        diagnostics.add(of.key(rotor), "needs a scene with a rotor, found none");
        continue;
      }
      if constexpr (std::is_same_v<decltype(settings), std::map<std::string, double>&>) {
        settings[rotor] = of.number(rotor, Range::kPositive, "m", std::nullopt);
      } else {
        settings[rotor] = read(of.at(rotor), of.key(rotor), diagnostics);
      }
    }
  };
  std::vector<std::string> sources = rotors;
  sources.insert(sources.end(), stations.begin(), stations.end());
  each_rotor("amplitude", s.amplitude, readLevels);
  each_rotor("voting", s.voting, [&](auto&&... node) { return readVoting(sources, node...); });
  each_rotor("zones", s.zones, readZones);
  each_rotor("subsynchronous", s.subsynchronous, nullptr);
  each_rotor("rub", s.rub, readRub);
  each_rotor("slow_roll", s.slow_roll, readSlowRoll);
  if (!diagnostics.all().empty()) {
    throw SceneError(diagnostics.all());
  }
  return s;
}

LiveAlarmSettings::LiveAlarmSettings(const YAML::Node& tree, const std::string& source,
                                     std::vector<std::string> rotors,
                                     const std::vector<std::string>& besides,
                                     std::vector<std::string> stations)
    : rotors_(std::move(rotors)),
      stations_(std::move(stations)),
      settings_(readAlarmSettings(tree, source, rotors_, besides, stations_)),
      tree_(YAML::Clone(tree)) {
  for (const std::string& name : besides) {
    tree_.remove(name);
  }
}

void LiveAlarmSettings::change(const std::string& text) {
  if (text.size() > kMaxChangeSize) {
    throw InputError(fmt::format("{}: must have at most {} bytes, found {}", kChange,
                                 kMaxChangeSize, text.size()));
  }
  const YAML::Node given = readYamlText(text, kChange, "settings of the monitor", "alarms");
  int left = kMaxChangedValues;
  if (!isTree(given, 0, left)) {
    throw InputError(fmt::format("{}: must have at most {} values, nested at most {} deep", kChange,
                                 kMaxChangedValues, kDeepest));
  }
  Diagnostics diagnostics(kChange);
  YAML::Node changed = YAML::Clone(tree_);
  applyChange(MapReader(given, "", {}, "", diagnostics), changed, true, diagnostics);
  std::vector<std::string> errors = diagnostics.all();
  AlarmSettings settings;
  try {
    settings = readAlarmSettings(changed, kChange, rotors_, {}, stations_);
  } catch (const SceneError& wrong) {
    errors.insert(errors.end(), wrong.errors().begin(), wrong.errors().end());
  }
  if (!errors.empty()) {
    throw SceneError(errors);
  }
  settings_ = std::move(settings);
  tree_ = changed;
}

bool LiveAlarmSettings::replace(const YAML::Node& tree, const std::string& source) {
  if (same(tree, tree_)) {
    return false;
  }
  settings_ = readAlarmSettings(tree, source, rotors_, {}, stations_);
  tree_ = YAML::Clone(tree);
  return true;
}

}  // namespace whirl_twin
