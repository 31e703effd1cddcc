#include "monitoring/live_alarm_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "monitoring/alarm_settings_reader.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"
#include "scene/yaml_file.h"

namespace whirl_twin {
namespace {

constexpr char kSource[] = "settings";
constexpr std::size_t kMaxChangeSize = 65536;  // bytes of a change
constexpr int kDeepest = 8;                    // maps and lists in each other: settings have three
constexpr int kMaxChangedValues = 10000;       // values

/// Whether a tree can be gone through at all: in YAML a list may contain itself.
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

/// Whether two trees say the same, in whatever order and spelling of numbers.
bool same(const YAML::Node& a, const YAML::Node& b) {
  if (!a.IsDefined() || !b.IsDefined() || a.Type() != b.Type()) {
    return false;
  }
  if (a.IsScalar()) {
    const std::optional<double> x = parseNumber(a.Scalar());
    return a.Scalar() == b.Scalar() || (x && x == parseNumber(b.Scalar()));
  }
  if (a.size() != b.size()) {
    return false;
  }
  if (a.IsSequence()) {
    return std::equal(a.begin(), a.end(), b.begin(),
                      [](const auto& x, const auto& y) { return same(x, y); });
  }
  return !a.IsMap() || std::all_of(a.begin(), a.end(), [&b](const auto& entry) {
    return same(entry.second, b[entry.first.Scalar()]);
  });
}

/// Puts what a change says into what is set.
void applyChange(const MapReader& change, YAML::Node present, bool outermost,
                 Complaints& complaints) {
  for (const std::string& name : change.names()) {
    const YAML::Node value = change.at(name);
    const YAML::Node before = std::as_const(present)[name];
    const bool has_entries = name == "delays" || name == "amplitude" || name == "voting" ||
                             name == "zones" || name == "subsynchronous" || name == "rub" ||
                             name == "slow_roll";
    if (value.IsNull()) {
      if (!before.IsDefined()) {
        complaints.add(change.key(name), "must be a setting in force to be removed, found none");
      }
      present.remove(name);
    } else if (outermost && has_entries && value.IsMap() && before.IsDefined() && before.IsMap()) {
      applyChange(MapReader(value, name, {}, "", complaints), present[name], false, complaints);
      if (std::as_const(present)[name].size() == 0) {
        present.remove(name);
      }
    } else {
      present[name] = YAML::Clone(value);
    }
  }
}

}  // namespace

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
    throw Refusal(fmt::format("{}: must have at most {} bytes, found {}", kSource, kMaxChangeSize,
                              text.size()));
  }
  const YAML::Node told = readYamlText(text, kSource, "settings of the monitor", "alarms");
  int left = kMaxChangedValues;
  if (!isTree(told, 0, left)) {
    throw Refusal(fmt::format("{}: must have at most {} values, nested at most {} deep", kSource,
                              kMaxChangedValues, kDeepest));
  }
  Complaints complaints(kSource);
  YAML::Node changed = YAML::Clone(tree_);
  applyChange(MapReader(told, "", {}, "", complaints), changed, true, complaints);
  std::vector<std::string> errors = complaints.all();
  AlarmSettings settings;
  try {
    settings = readAlarmSettings(changed, kSource, rotors_, {}, stations_);
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

std::string LiveAlarmSettings::text() const {
  YAML::Emitter out;
  out << YAML::Flow << tree_;
  return out.c_str();
}

}  // namespace whirl_twin
