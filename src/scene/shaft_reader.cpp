#include "scene/shaft_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/surroundings.h"

namespace whirl_twin {

void readShaft(const MapReader& system, const ModelInfo& model, const Scene& scene,
               SystemSpec& spec, Complaints& complaints) {
  if (system.has("drive")) {
    const std::string drive = system.text("drive", "");
    std::vector<std::string> drives;
    for (const DriveSpec& d : scene.drives) {
      drives.push_back(d.name);
    }
    if (!model.has_shaft) {
      complaints.add(system.key("drive"), model.name + " has no shaft to drive");
    } else if (drives.empty()) {
      complaints.add(system.key("drive"), "the scene has no drives");
    } else {
      spec.drive = system.choice("drive", drives, "a drive of the scene", drives.front());
      if (surroundingsOf(scene, spec).motor && !model.takes_motor) {
        complaints.add(system.key("drive"), model.name +
                                                " cannot be turned by a motor; name a drive "
                                                "with a profile");
      }
    }
  }
  if (model.has_shaft && spec.drive && spec.speed) {
    complaints.add(system.key("parameters.speed"),
                   "the drive sets the speed: give one or the other");
  } else if (model.has_shaft && !spec.drive && !spec.speed && !system.has("drive")) {
    complaints.add(system.key("parameters.speed"),
                   "missing; must be a finite number in rad/s, or name a drive");
  }
}

void startSpin(const MapReader& initial, const Scene& scene, SystemSpec& spec,
               Complaints& complaints) {
  const auto named =
      std::find_if(scene.drives.begin(), scene.drives.end(),
                   [&](const DriveSpec& drive) { return spec.drive && drive.name == *spec.drive; });
  if (named == scene.drives.end() || !named->motor) {
    return;
  }
  for (const char* name : {"spin", "spin_rate"}) {
    if (initial.has(name)) {
      complaints.add(initial.key(name),
                     fmt::format("the shaft starts with the angle and the speed of its drive: give "
                                 "them under drives.{}",
                                 named->name));
    }
  }
  spec.q.back() = named->angle;
  spec.v.back() = named->speed;
}

void checkMotors(const Scene& scene, Complaints& complaints) {
  for (const DriveSpec& drive : scene.drives) {
    const auto turned = std::count_if(
        scene.systems.begin(), scene.systems.end(),
        [&](const SystemSpec& system) { return system.drive && *system.drive == drive.name; });
    if (drive.motor && turned != 1) {
      complaints.add(fmt::format("drives.{}.motor", drive.name),
                     fmt::format("a motor turns exactly one system, found {}", turned));
    }
  }
}

}  // namespace whirl_twin
