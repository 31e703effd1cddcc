#include "estimation/estimator_scene.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

/// "" if missing or not a text.
std::string textOf(const YAML::Node& map, const char* key) {
  return map.IsMap() && map[key] && map[key].IsScalar() ? map[key].Scalar() : std::string();
}

std::vector<std::string> keysOf(const YAML::Node& map) {
  std::vector<std::string> keys;
  if (map.IsDefined() && map.IsMap()) {
    for (const auto& entry : map) {
      if (entry.first.IsScalar()) {
        keys.push_back(entry.first.Scalar());
      }
    }
  }
  return keys;
}

std::set<std::string> seenMotors(const YAML::Node& scene) {
  std::set<std::string> drives;
  const YAML::Node sensors = scene["sensors"], all = scene["drives"];
  for (const std::string& sensor : keysOf(sensors)) {
    const std::string drive = textOf(sensors[sensor], "keyphasor");
    if (!drive.empty() && all.IsDefined() && all.IsMap() && all[drive] && all[drive].IsMap() &&
        all[drive]["motor"]) {
      drives.insert(drive);
    }
  }
  return drives;
}

/// Does a list, or a single text, name one of these?
bool names(const YAML::Node& node, const std::set<std::string>& subjects) {
  if (!node.IsDefined()) {
    return false;
  }
  if (node.IsScalar()) {
    return subjects.count(node.Scalar()) != 0;
  }
  for (const auto& entry : node) {
    if (entry.IsDefined() && names(entry, subjects)) {
      return true;
    }
  }
  return false;
}

}  // namespace

Scene readEstimatorScene(const YAML::Node& scene, const std::string& source) {
  YAML::Node followed = YAML::Clone(scene);
  if (!followed.IsMap()) {
    return readScene(followed, source);
  }
  const std::set<std::string> drives = seenMotors(followed);
  std::set<std::string> spins, torques;
  for (const std::string& name : keysOf(followed["systems"])) {
    YAML::Node system = followed["systems"][name];
    if (drives.count(textOf(system, "drive")) != 0) {
      spins.insert({name + ".spin", name + ".spin_rate"});
      torques.insert(name + ".torque");
      if (system["inputs"] && system["inputs"].IsMap()) {
        system["inputs"].remove("torque");
      }
    }
  }
  for (const std::string& drive : drives) {
    followed["drives"][drive].remove("motor");
  }
  for (const std::string& name : keysOf(followed["controllers"])) {
    const YAML::Node controller = followed["controllers"][name];
    if (controller.IsMap() &&
        (names(controller["measures"], spins) || names(controller["acts_on"], torques))) {
      followed["controllers"].remove(name);
    }
  }
  if (followed["controllers"] && followed["controllers"].size() == 0) {
    followed.remove("controllers");
  }
  for (const std::string& sensor : keysOf(followed["sensors"])) {
    if (!followed["sensors"][sensor].IsMap()) {
      continue;  // reported by the scene's reader
    }
    const YAML::Node channels = followed["sensors"][sensor]["channels"];
    for (const std::string& channel : keysOf(channels)) {
      if (names(channels[channel], spins) ||
          (channels[channel].IsMap() && names(channels[channel]["measures"], spins))) {
        throw InputError(
            fmt::format("{}: sensors.{}.{}: must not measure the spin of a shaft on a motor: "
                        "remove the channel, its keyphasor measures the spin",
                        source, printable(sensor), printable(channel)));
      }
    }
  }
  return readScene(followed, source);
}

Scene readEstimatorSceneFile(const std::string& path) {
  YAML::Node tree;
  try {
    tree = readYamlFile(path, "a scene", "a step and at least one system");
  } catch (const InputError& inputError) {
    throw SceneError({inputError.what()});
  }
  return readEstimatorScene(tree, path);
}

}  // namespace whirl_twin
