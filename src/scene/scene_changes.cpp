#include "scene/scene_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <variant>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/node_reader.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

using Part = std::variant<std::string, std::size_t>;  // a key, or the index of a list
using Names = std::vector<std::string>;

const Names kTopKeys{"name",   "step",    "time",    "gravity",
                     "drives", "systems", "sensors", "controllers"};
const Names kOwners{"systems", "controllers", "drives", "sensors"};
const Names kSystemKeys{"model",      "drive",   "integrator", "tolerance", "horizon", "substeps",
                        "parameters", "initial", "inputs",     "count",     "seed",    "spread"};
const Names kControllerKeys{"type",     "rate",       "measures", "acts_on", "delay",     "sensor",
                            "actuator", "parameters", "mode",     "timeout", "on_timeout"};
const Names kMoveKeys{"max_acceleration", "max_jerk", "dwell"};

bool isAmong(const std::string& name, const Names& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

/// "discs[0].mass" in its parts; nothing for another form.
std::optional<std::vector<Part>> partsOf(const std::string& path) {
  std::vector<Part> parts;
  std::size_t at = 0;
  while (at < path.size()) {
    if (path[at] == '[') {
      std::size_t index = 0;
      const char* const last = path.data() + path.size();
      const auto [end, error] = std::from_chars(path.data() + at + 1, last, index);
      if (parts.empty() || error != std::errc() || end == last || *end != ']') {
        return std::nullopt;
      }
      parts.emplace_back(index);
      at = static_cast<std::size_t>(end - path.data()) + 1;
    } else {
      if (!parts.empty()) {
        if (path[at] != '.') {
          return std::nullopt;
        }
        ++at;
      }
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      if (end == at) {
        return std::nullopt;
      }
      parts.emplace_back(path.substr(at, end - at));
      at = end;
    }
  }
  return parts.empty() ? std::nullopt : std::optional(parts);
}

std::string keyOf(const std::vector<Part>& place) {
  std::string key;
  for (const Part& part : place) {
    const auto* const name = std::get_if<std::string>(&part);
    key += name == nullptr ? fmt::format("[{}]", std::get<std::size_t>(part))
                           : (key.empty() ? "" : ".") + *name;
  }
  return key;
}

class Changer {
 public:
  /// `option`: in front of what is given, in errors.
  Changer(YAML::Node& tree, const std::string& given, const char* option)
      : tree_(tree), change_{given, {}}, option_(option) {}

  /// Of "PATH=VALUE".
  SceneChange apply() {
    const std::size_t equals = change_.given.find('=');
    if (equals == std::string::npos) {
      refuse("must be PATH=VALUE, such as rotor.damping=8");
    }
    return apply(trimmed(change_.given.substr(0, equals)),
                 valueOf(trimmed(change_.given.substr(equals + 1))));
  }

  SceneChange apply(const std::string& path, const YAML::Node& value) {
    const auto parts = partsOf(path);
    if (!parts) {
      refuse("must begin with a path, such as rotor.damping or rotor.discs[0].mass");
    }
    value_ = value;
    for (const std::vector<Part>& place : places(*parts)) {
      put(place);
    }
    return change_;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}{}: {}", option_, printable(change_.given), why));
  }

  YAML::Node valueOf(const std::string& text) const {
    if (text.empty() || (text.front() != '[' && text.front() != '{')) {
      return YAML::Node(text);
    }
    try {
      return separated(readYamlText(text, "value", "a value", "entries"));
    } catch (const InputError& error) {
      refuse(error.what());
    }
  }

  /// The places in the tree that a path means.
  std::vector<std::vector<Part>> places(const std::vector<Part>& parts) const {
    const std::string first = std::get<std::string>(parts.front());
    if (isAmong(first, kTopKeys)) {
      return {parts};
    }
    for (const std::string& owner : kOwners) {
      const YAML::Node owned = std::as_const(tree_)[owner];
      if (owned.IsDefined() && owned.IsMap() && owned[first].IsDefined()) {
        return inOwner(owner, owned[first], parts);
      }
    }
    refuse(fmt::format("there is no system, controller, drive or sensor {}{}", inQuotes(first),
                       hint(first, owners())));
  }

  std::vector<std::vector<Part>> inOwner(const std::string& owner, const YAML::Node& node,
                                         const std::vector<Part>& parts) const {
    std::vector<Part> place = parts;
    place.insert(place.begin(), owner);
    const auto* const key = parts.size() > 1 ? std::get_if<std::string>(&parts[1]) : nullptr;
    if (key == nullptr) {
      refuse(fmt::format("must name a value of {}, such as {}.{}", keyOf({parts.front()}),
                         keyOf({parts.front()}), owner == "drives" ? "speed" : "damping"));
    }
    const bool parameter = (owner == "systems" && !isAmong(*key, kSystemKeys)) ||
                           (owner == "controllers" && !isAmong(*key, kControllerKeys));
    if (parameter) {
      place.insert(place.begin() + 2, std::string("parameters"));
    }
    const YAML::Node profile =
        node.IsMap() && node["profile"].IsDefined() ? node["profile"] : YAML::Node();
    if (owner != "drives" || !isAmong(*key, kMoveKeys) || !profile.IsSequence()) {
      return {place};
    }
    std::vector<std::vector<Part>> all;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      all.push_back({owner, parts.front(), std::string("profile"), i, *key});
    }
    return all;
  }

  Names owners() const {
    Names names;
    for (const std::string& owner : kOwners) {
      const YAML::Node owned = std::as_const(tree_)[owner];
      if (owned.IsDefined() && owned.IsMap()) {
        for (const auto& entry : owned) {
          names.push_back(entry.first.Scalar());
        }
      }
    }
    return names;
  }

  /// Maps on the way that are missing are created; lists keep their lengths.
  void put(const std::vector<Part>& place) {
    YAML::Node at;
    at.reset(tree_);
    std::vector<Part> way;
    for (const Part& part : place) {
      const std::string key = keyOf(way);
      if (const auto* const name = std::get_if<std::string>(&part)) {
        if (at.IsDefined() && !at.IsNull() && !at.IsMap()) {
          refuse(fmt::format("{} is {}, which has no {}", key, shown(at), inQuotes(*name)));
        }
        if (value_.IsNull() && way.size() + 1 == place.size()) {
          at.remove(*name);
          return;
        }
        at.reset(at[*name]);
      } else {
        const std::size_t index = std::get<std::size_t>(part);
        if (!at.IsDefined() || !at.IsSequence() || index >= at.size()) {
          refuse(at.IsDefined() && at.IsSequence()
                     ? fmt::format("{} has {} entries, counted from 0", key, at.size())
                     : fmt::format("{} must be a list in the scene, found {}", key, shown(at)));
        }
        at.reset(at[index]);
      }
      way.push_back(part);
    }
    at = YAML::Clone(value_);
    change_.keys.push_back(keyOf(place));
  }

  YAML::Node& tree_;
  SceneChange change_;
  const char* option_;
  YAML::Node value_;
};

}  // namespace

std::vector<SceneChange> changeScene(YAML::Node& tree, const std::vector<std::string>& changes) {
  std::vector<SceneChange> all;
  if (changes.empty()) {
    return all;
  }
  if (!tree.IsMap()) {
    throw InputError(fmt::format("--set {}: the scene must be a map of keys and values, found {}",
                                 printable(changes.front()), shown(tree)));
  }
  tree = separated(tree);
  all.reserve(changes.size());
  for (const std::string& change : changes) {
    all.push_back(Changer(tree, change, "--set ").apply());
  }
  return all;
}

void changeScene(YAML::Node& tree, const std::string& path, const YAML::Node& value) {
  Changer(tree, path, "").apply(path, value);
}

std::string namedByChange(const std::string& error, const std::string& source,
                          const std::vector<SceneChange>& changes) {
  const std::string begin = source + ": ";
  for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
    for (const std::string& key : change->keys) {
      const std::size_t after = begin.size() + key.size();
      if (error.compare(0, begin.size(), begin) == 0 &&
          error.compare(begin.size(), key.size(), key) == 0 && after < error.size() &&
          std::string(":.[").find(error[after]) != std::string::npos) {
        return fmt::format("--set {}: {}", printable(change->given), error.substr(begin.size()));
      }
    }
  }
  return error;
}

Scene readChangedScene(const YAML::Node& tree, const std::string& source,
                       const std::vector<SceneChange>& changes) {
  try {
    return readScene(tree, source);
  } catch (const SceneError& error) {
    std::vector<std::string> named;
    for (const std::string& one : error.errors()) {
      named.push_back(namedByChange(one, source, changes));
    }
    throw SceneError(named);
  }
}

}  // namespace whirl_twin
