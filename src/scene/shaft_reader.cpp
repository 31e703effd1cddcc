#include "scene/shaft_reader.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "scene/model_context.h"

namespace whirl_twin {

namespace {

/// The drive that the system names; for an unknown one adds a diagnostic and returns the first.
std::size_t namedDrive(const MapReader& system, const Scene& scene, const DrivePlaces& places) {
  const YAML::Node node = system.at("drive");
  const auto found = node.IsScalar() ? places.find(node.Scalar()) : places.end();
  if (found != places.end()) {
    return found->second;
  }
  std::vector<std::string> names;
  for (const DriveSpec& drive : scene.drives) {
    names.push_back(drive.name);
  }
  static_cast<void>(system.choice("drive", names, "a drive of the scene", names.front()));
  return 0;
}

}  // namespace

void readShaft(const MapReader& system, const ModelInfo& model, const Scene& scene,
               const DrivePlaces& places, SystemSpec& spec, Diagnostics& diagnostics) {
  if (system.has("drive")) {
    if (!model.has_shaft) {
      diagnostics.add(system.key("drive"), model.name + " has no shaft to drive");
    } else if (scene.drives.empty()) {
      diagnostics.add(system.key("drive"), "the scene has no drives");
    } else {
      spec.drive_place = namedDrive(system, scene, places);
      spec.drive = scene.drives[spec.drive_place].name;
      if (surroundingsOf(scene, spec).motor && !model.takes_motor) {
        diagnostics.add(system.key("drive"), model.name +
                                                 " cannot be turned by a motor; name a drive "
                                                 "with a profile");
      }
    }
  }
  if (model.has_shaft && spec.drive && spec.speed) {
    diagnostics.add(system.key("parameters.speed"),
                    "the drive sets the speed: give drive or speed, not both");
  } else if (model.has_shaft && !spec.drive && !spec.speed && !system.has("drive")) {
    diagnostics.add(
        system.key("parameters.speed"),
        "missing; must be a finite number in rad/s, unless the key drive of the system names one");
  }
}

void startSpin(const MapReader& initial, const Scene& scene, SystemSpec& spec,
               Diagnostics& diagnostics) {
  const std::size_t place = scene.driveOf(spec);
  if (place == scene.drives.size() || !scene.drives[place].motor) {
    return;
  }
  const DriveSpec& drive = scene.drives[place];
  for (const char* name : {"spin", "spin_rate"}) {
    if (initial.has(name)) {
      diagnostics.add(initial.key(name),
                      fmt::format("must not be given: the shaft starts with the angle and speed of "
                                  "its drive; give them under drives.{}",
                                  drive.name));
    }
  }
  spec.q.back() = drive.angle;
  spec.v.back() = drive.speed;
}

void checkMotors(const Scene& scene, Diagnostics& diagnostics) {
  std::vector<int> turned(scene.drives.size() + 1);  // the last: systems without a drive
  for (const SystemSpec& system : scene.systems) {
    ++turned[scene.driveOf(system)];
  }
  for (std::size_t i = 0; i < scene.drives.size(); ++i) {
    if (scene.drives[i].motor && turned[i] != 1) {
      diagnostics.add(fmt::format("drives.{}.motor", scene.drives[i].name),
                      fmt::format("a motor turns exactly one system, found {}", turned[i]));
    }
  }
}

}  // namespace whirl_twin
