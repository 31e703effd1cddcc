#include "studies/scene_numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "controllers/controller_registry.h"
#include "messages/units.h"
#include "models/model_registry.h"
#include "scene/node_reader.h"
#include "scene/parameter_paths.h"
#include "scene/system_setup.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

namespace {

using Numbers = std::map<std::string, NamedNumber>;

/// The path "bearings[0].kxx" below a place.
SceneNumber below(SceneNumber place, const std::string& path) {
  std::string name;
  const auto end = [&] {
    if (!name.empty()) {
      place.emplace_back(name);
      name.clear();
    }
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.') {
      end();
    } else if (path[i] == '[') {
      end();
      std::size_t index = 0;
      std::from_chars(path.data() + i + 1, path.data() + path.size(), index);
      place.emplace_back(index);
      i = path.find(']', i);
    } else {
      name += path[i];
    }
  }
  end();
  return place;
}

/// All numbers in the tree, by their full keys.
void addScalars(const YAML::Node& node, const SceneNumber& place, const std::string& path,
                Numbers& all) {
  if (node.IsScalar()) {
    const auto written = writtenQuantity(node.Scalar());
    if (written && !path.empty() && (written->unit.empty() || isUnit(written->unit))) {
      NamedNumber number;
      number.places = {place};
      number.value = written->value;
      number.unit = written->unit.empty() ? "-" : written->unit;
      number.known = false;
      all.emplace(path, number);
    }
  } else if (node.IsMap()) {
    for (const auto& entry : node) {
      if (entry.first.IsScalar()) {
        SceneNumber inner = place;
        inner.emplace_back(entry.first.Scalar());
        addScalars(entry.second, inner, path + (path.empty() ? "" : ".") + entry.first.Scalar(),
                   all);
      }
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      SceneNumber inner = place;
      inner.emplace_back(i);
      addScalars(node[i], inner, fmt::format("{}[{}]", path, i), all);
    }
  }
}

void addSystem(const SystemSpec& spec, std::size_t place, Numbers& all) {
  const ModelInfo& model = *findModel(spec.model);
  const state::ParameterChange parameters = parametersOf(model, spec);
  const SceneNumber root{std::string("systems"), spec.name};
  for (std::size_t i = 0; i < parameters.names.size(); ++i) {
    NamedNumber number;
    number.places = {below(root, "parameters." + parameters.names[i])};
    number.value = parameters.values[i];
    number.unit = unitAt(parameters.names[i], model, spec);
    number.parameter = parameters.names[i];
    number.system = place;
    all.emplace(spec.name + "." + parameters.names[i], number);
    all.insert_or_assign("systems." + spec.name + ".parameters." + parameters.names[i], number);
  }
  if (spec.speed) {
    all.emplace(
        spec.name + ".speed",
        NamedNumber{{below(root, "parameters.speed")}, *spec.speed, "rad/s", true, "", place});
  }
  if (spec.rest && spec.rest->asked) {
    return;  // its start is computed
  }
  const std::vector<CoordinateInfo> coordinates = spec.setup->made.dynamics->coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const std::string& name = coordinates[i].name;
    const std::string& unit = coordinates[i].unit;
    all.emplace(spec.name + ".initial." + name,
                NamedNumber{{below(root, "initial." + name)}, spec.q[i], unit, true, "", place});
    all.emplace(
        spec.name + ".initial." + name + "_rate",
        NamedNumber{
            {below(root, "initial." + name + "_rate")}, spec.v[i], unit + "/s", true, "", place});
  }
}

void addDrive(const DriveSpec& drive, Numbers& all) {
  const SceneNumber root{std::string("drives"), drive.name};
  const auto add = [&](const std::string& key, double value, const std::string& unit) {
    all.insert_or_assign(drive.name + "." + key,
                         NamedNumber{{below(root, key)}, value, unit, true, "", 0});
  };
  add("speed", drive.speed, "rad/s");
  add("angle", drive.angle, "rad");
  const auto addOfAll = [&](const std::string& key, double SpeedMove::*number,
                            const std::string& unit) {
    std::vector<SceneNumber> places;
    double value = drive.profile.front().*number;
    for (std::size_t i = 0; i < drive.profile.size(); ++i) {
      places.push_back(below(root, fmt::format("profile[{}].{}", i, key)));
      if (drive.profile[i].*number != value) {
        value = std::numeric_limits<double>::quiet_NaN();
      }
    }
    all.insert_or_assign(drive.name + "." + key, NamedNumber{places, value, unit, true, "", 0});
  };
  if (!drive.profile.empty()) {
    addOfAll("max_acceleration", &SpeedMove::max_acceleration, "rad/s^2");
    addOfAll("max_jerk", &SpeedMove::max_jerk, "rad/s^3");
    addOfAll("dwell", &SpeedMove::dwell, "s");
  }
  for (std::size_t i = 0; i < drive.profile.size(); ++i) {
    const SpeedMove& move = drive.profile[i];
    add(fmt::format("profile[{}].speed", i), move.speed, "rad/s");
    add(fmt::format("profile[{}].max_acceleration", i), move.max_acceleration, "rad/s^2");
    add(fmt::format("profile[{}].max_jerk", i), move.max_jerk, "rad/s^3");
    add(fmt::format("profile[{}].dwell", i), move.dwell, "s");
  }
}

/// Adds shorter paths without the prefix of `owner`.
void addShort(const std::string& owner, const std::string& name, Numbers& all) {
  const std::string prefix = owner + "." + name + ".";
  std::map<std::string, NamedNumber> more;
  for (auto it = all.lower_bound(prefix);
       it != all.end() && it->first.compare(0, prefix.size(), prefix) == 0; ++it) {
    more.emplace(name + "." + it->first.substr(prefix.size()), it->second);
  }
  all.merge(more);
}

}  // namespace

Numbers numbersOf(const YAML::Node& tree, const Scene& scene) {
  Numbers all;
  addScalars(tree, {}, "", all);
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    addSystem(scene.systems[i], i, all);
    addShort("systems", scene.systems[i].name, all);
  }
  for (const DriveSpec& drive : scene.drives) {
    addDrive(drive, all);
    addShort("drives", drive.name, all);
  }
  for (const ControllerSpec& controller : scene.controllers) {
    const ControllerInfo* const info = findController(controller.type);
    if (info == nullptr) {
      continue;
    }
    const state::ParameterChange parameters = parametersOf(*info, controller);
    for (std::size_t i = 0; i < parameters.names.size(); ++i) {
      const std::string path =
          fmt::format("controllers.{}.parameters.{}", controller.name, parameters.names[i]);
      all.emplace(controller.name + "." + parameters.names[i],
                  NamedNumber{{below({}, path)}, parameters.values[i], "-", false, "", 0});
    }
    addShort("controllers", controller.name, all);
  }
  all.insert_or_assign(
      "gravity", NamedNumber{{{std::string("gravity")}}, scene.gravity, "m/s^2", true, "", 0});
  return all;
}

void put(YAML::Node tree, const SceneNumber& place, double value, const std::string& unit) {
  YAML::Node at;
  at.reset(tree);
  for (const auto& key : place) {
    if (const auto* const name = std::get_if<std::string>(&key)) {
      at.reset(at[*name]);
    } else {
      at.reset(at[std::get<std::size_t>(key)]);
    }
  }
  at = fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace whirl_twin
