#include "scene/built_scene.h"

#include <algorithm>
#include <stdexcept>

#include "scene/control_parts.h"
#include "scene/input_reader.h"
#include "scene/model_context.h"
#include "scene/signal_names.h"

namespace whirl_twin {

namespace {

Drive constantDrive(const BuiltSystem& system) {
  return {system.spec.speed.value_or(0.0), 0.0};
}

Drive prescribedDrive(const DriveSpec& spec, std::int64_t start) {
  return {spec.speed, spec.angle, spec.profile, start, ExclusionBands(spec.avoid)};
}

}  // namespace

std::vector<Drive> BuiltScene::drives() const {
  std::vector<Drive> all;
  for (const DriveSpec& spec : scene.drives) {
    all.push_back(prescribedDrive(spec, scene.time));
  }
  for (const SharedSystem& system : systems) {
    if (!system->spec.drive) {
      all.push_back(constantDrive(*system));
    }
  }
  for (Drive& drive : all) {
    drive.begin(scene.time);
  }
  return all;
}

Drive BuiltScene::driveOf(const BuiltSystem& system) const {
  Drive drive = system.drive < scene.drives.size()
                    ? prescribedDrive(scene.drives[system.drive], scene.time)
                    : constantDrive(system);
  drive.begin(scene.time);
  return drive;
}

Inputs BuiltScene::inputsOf(const BuiltSystem& system) const {
  const auto place = static_cast<std::size_t>(
      std::find_if(scene.systems.begin(), scene.systems.end(),
                   [&](const SystemSpec& known) { return known.name == system.spec.name; }) -
      scene.systems.begin());
  const bool controlled = isControlled(scene, place);
  Inputs inputs;
  if (controlled || !system.spec.inputs.empty()) {
    inputs = Inputs(signalsOf(system.dynamics->inputs(), system.spec.inputs));
  }
  if (controlled) {
    inputs.setParts(partLengths(scene));
  }
  inputs.begin(scene.time);
  return inputs;
}

BuiltScene build(const Scene& scene) {
  BuiltScene built;
  built.scene = scene;
  std::size_t constant = scene.drives.size();
  for (SystemSpec& spec : built.scene.systems) {
    std::size_t drive = scene.driveOf(spec);
    if (!spec.drive) {
      drive = constant++;
    } else if (drive == scene.drives.size()) {
      throw std::logic_error("no drive named " + *spec.drive);
    }
    built.systems.push_back(build(spec, surroundingsOf(scene, spec), drive));
    spec.setup = built.systems.back()->spec.setup;
  }
  return built;
}

BuiltScene::RotorNames BuiltScene::rotorNames() const {
  RotorNames names;
  for (const SharedSystem& system : systems) {
    if (system->dynamics->isRotor()) {
      names.rotors.push_back(system->spec.name);
      const auto published = publishedStations(system->spec.name, *system->dynamics);
      names.stations.insert(names.stations.end(), published.begin() + 1, published.end());
    }
  }
  return names;
}

}  // namespace whirl_twin
