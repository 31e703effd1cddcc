#include "scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <set>
#include <utility>

#include "analysis/natural_modes.h"
#include "analysis/validity.h"
#include "messages/names.h"
#include "models/model_registry.h"
#include "scene/avoidance_reader.h"
#include "scene/controller_reader.h"
#include "scene/drive_reader.h"
#include "scene/ensemble_reader.h"
#include "scene/equilibrium_start.h"
#include "scene/input_reader.h"
#include "scene/model_context.h"
#include "scene/node_reader.h"
#include "scene/parameter_limits.h"
#include "scene/parameter_reader.h"
#include "scene/sensor_reader.h"
#include "scene/shaft_reader.h"
#include "scene/signal_names.h"
#include "scene/system_setup.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

constexpr const char* kEquilibrium = "equilibrium";

void checkNames(const MapReader& map, const std::string& what, Diagnostics& diagnostics) {
  std::set<std::string> channels;
  for (const std::string& name : map.names()) {
    if (!isLegalName(name)) {
      diagnostics.add(
          map.key(name),
          fmt::format("the name of a {} must have at most {} letters, digits and _, a letter first",
                      what, kMaxNameLength));
    } else if (what != "drive" && name == "drives") {
      diagnostics.add(
          map.key(name),
          fmt::format(
              "the name of a {} must not be this: it is reserved for the topics of the drives",
              what));
    } else if (!channels.insert(capitals(name)).second) {
      diagnostics.add(
          map.key(name),
          fmt::format("duplicate: another {} has this name (upper and lower case are the same)",
                      what));
    }
  }
}

/// Converts seconds to a whole number of nanoseconds.
std::int64_t nanoseconds(const MapReader& map, const std::string& name, double seconds,
                         Diagnostics& diagnostics) {
  const double count = seconds * 1.0e9;
  const double whole = std::round(count);
  if (std::fabs(count - whole) > 1.0e-6 * std::max(1.0, std::fabs(whole) * 1.0e-9)) {
    diagnostics.add(map.key(name),
                    fmt::format("must be a whole number of nanoseconds, found {} s; nearest {} s",
                                seconds, whole / 1.0e9));
  }
  return static_cast<std::int64_t>(whole);
}

/// Whether a controller of the scene acts on an input of the system: its equilibrium then depends
/// on the control law.
bool isActedOn(const YAML::Node& controllers, const std::string& system) {
  if (!controllers.IsMap()) {
    return false;
  }
  for (const auto& controller : controllers) {
    const YAML::Node inputs =
        controller.second.IsMap() ? controller.second["acts_on"] : YAML::Node();
    for (std::size_t i = 0; inputs.IsSequence() && i < inputs.size(); ++i) {
      if (inputs[i].IsScalar() && inputs[i].Scalar().rfind(system + ".", 0) == 0) {
        return true;
      }
    }
  }
  return false;
}

/// Sets the initial state to the equilibrium at the initial speed of the shaft; false, without a
/// change, if there is none.
bool putAtEquilibrium(const ModelInfo& model, EquilibriumStart rest, SystemSpec& spec) {
  std::optional<StartingState> start;
  try {
    start = equilibriumStart(model, spec, spec.setup->made, spec.setup->around, rest.speed);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // Numbers beyond the range of double, or a singular mass: there is no equilibrium.
  }
  if (start) {
    spec.q = std::move(start->q);
    spec.v = std::move(start->v);
    spec.rest = rest;
  }
  return start.has_value();
}

void readInitial(const MapReader& system, const Scene& scene, const ModelInfo& model,
                 bool controlled, SystemSpec& spec, Diagnostics& diagnostics) {
  const Dynamics& dynamics = *spec.setup->made.dynamics;
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  const bool given = system.has("initial");
  const bool asked = given && system.at("initial").IsScalar();
  if (asked && system.at("initial").Scalar() != kEquilibrium) {
    diagnostics.add(system.key("initial"),
                    fmt::format("must be a map of coordinates and their values, or {}, found {}",
                                kEquilibrium, shown(system.at("initial"))));
  }
  std::vector<std::string> known;
  for (const CoordinateInfo& c : coordinates) {
    known.push_back(c.name);
    known.push_back(c.name + "_rate");
  }
  const MapReader map(given && !asked ? system.at("initial") : YAML::Node(YAML::NodeType::Map),
                      system.key("initial"), known, "coordinate of " + spec.model, diagnostics);
  for (const CoordinateInfo& c : coordinates) {
    spec.q.push_back(map.number(c.name, Range::kAny, c.unit, 0.0));
    spec.v.push_back(map.number(c.name + "_rate", Range::kAny, c.unit + "/s", 0.0));
  }
  const std::size_t drive = scene.driveOf(spec);
  const EquilibriumStart rest{
      drive < scene.drives.size() ? scene.drives[drive].speed : spec.speed.value_or(0.0), asked};
  const bool by_default =
      !given && !controlled && startsAtEquilibrium(spec, spec.setup->made, spec.setup->around);
  if ((asked || by_default) && diagnostics.all().empty() && !putAtEquilibrium(model, rest, spec) &&
      asked) {
    diagnostics.add(
        system.key("initial"),
        fmt::format("no equilibrium was found{} to start at: give coordinates and their "
                    "values",
                    dynamics.hasShaft() || model.has_shaft
                        ? fmt::format(" at the initial {:g} rad/s of its shaft", rest.speed)
                        : ""));
  }
  startSpin(map, scene, spec, diagnostics);
}

void readIntegrator(const MapReader& system, const ModelSetup& setup, SystemSpec& spec,
                    Diagnostics& diagnostics) {
  spec.integrator =
      system.choice("integrator", integratorNames(), "the name of an integrator", "auto");
  spec.tolerance = system.number("tolerance", Range::kPositive, "-", spec.tolerance);
  spec.horizon = system.number("horizon", Range::kPositive, "s", spec.horizon);
  spec.substeps = system.integer("substeps", 1, 1000000, 1);
  const std::string objection =
      integratorDiagnostic(setup, spec.drive.has_value(), spec.integrator);
  if (!objection.empty()) {
    diagnostics.add(system.key("integrator"), objection);
  }
}

/// The folder of the scene file, the current one for standard input; "" if the scene is not from a
/// file.
std::string folderOf(const std::string& source) {
  if (source == kStandardInput) {
    return ".";
  }
  std::error_code error;
  const std::filesystem::path file(source);
  if (!std::filesystem::is_regular_file(file, error)) {
    return "";
  }
  return file.has_parent_path() ? file.parent_path().string() : ".";
}

/// Rejects an initial state with a singular mass matrix or outside the valid range of the model:
/// the accelerations are undefined there.
void checkStart(const MapReader& system, const Dynamics& dynamics, const SystemSpec& spec,
                const Scene& scene, Diagnostics& diagnostics) {
  const auto n = static_cast<Eigen::Index>(spec.q.size());
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(spec.q.data(), n);
  const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(spec.v.data(), n);
  const EvaluationPoint<double> at{static_cast<double>(scene.time) * 1.0e-9, 0.0,
                                   spec.speed.value_or(0.0), 0.0};
  if (massIsSingular(dynamics, q, v, at)) {
    const std::string reason = dynamics.singularMass();
    diagnostics.add(system.key("initial"), fmt::format("the mass matrix is singular here{}{}",
                                                       reason.empty() ? "" : ": ", reason));
    return;
  }
  if (!dynamics.acceleration(q, v, at).allFinite()) {
    const std::string broken = brokenText(validity(dynamics, q, v, at), Margins::kShown);
    if (!broken.empty()) {
      diagnostics.add(system.key("initial"), "the motion cannot start here: " + broken);
    }
  }
  double speed = std::fabs(spec.speed.value_or(0.0));
  if (const std::size_t drive = scene.driveOf(spec); spec.drive && drive < scene.drives.size()) {
    speed = std::fabs(scene.drives[drive].speed);
    for (const SpeedMove& move : scene.drives[drive].profile) {
      speed = std::fmax(speed, std::fabs(move.speed));
    }
  }
  const std::string objection = ratesDiagnostic(dynamics, spec, speed);
  if (!objection.empty()) {
    diagnostics.add(system.key("parameters"), objection);
  }
}

/// A station is published under a name that must differ from those of all systems and stations.
void checkStations(const Scene& scene, const MapReader& systems, Diagnostics& diagnostics) {
  std::set<std::string> taken;
  for (const SystemSpec& system : scene.systems) {
    taken.insert(capitals(system.name));
  }
  for (const SystemSpec& system : scene.systems) {
    if (!system.setup) {
      continue;
    }
    std::vector<std::string> names = publishedStations(system.name, *system.setup->made.dynamics);
    names.erase(names.begin());
    for (const std::string& name : names) {
      if (!isLegalName(name) || !taken.insert(capitals(name)).second) {
        diagnostics.add(
            systems.key(system.name) + ".parameters.stations",
            fmt::format("is published as {}, which must be unique and have at most {} characters",
                        name, kMaxNameLength));
      }
    }
  }
}

/// The parameters of a controller are published under its name, as those of a system are.
void checkControllerNames(const Scene& scene, const MapReader& controllers,
                          Diagnostics& diagnostics) {
  checkNames(controllers, "controller", diagnostics);
  std::set<std::string> taken;
  for (const SystemSpec& system : scene.systems) {
    taken.insert(capitals(system.name));
    if (system.setup) {
      for (const std::string& name : publishedStations(system.name, *system.setup->made.dynamics)) {
        taken.insert(capitals(name));
      }
    }
  }
  for (const std::string& name : controllers.names()) {
    if (taken.count(capitals(name)) > 0) {
      diagnostics.add(
          controllers.key(name),
          "duplicate: a system or a station has this name, and parameters are published by name");
    }
  }
}

SystemSpec readSystem(const YAML::Node& node, const std::string& key, const std::string& name,
                      const Scene& scene, const DrivePlaces& places, bool controlled,
                      Diagnostics& diagnostics) {
  SystemSpec spec;
  spec.name = name;
  const MapReader map(node, key,
                      {"model", "drive", "integrator", "tolerance", "horizon", "substeps",
                       "parameters", "initial", "inputs", "count", "seed", "spread"},
                      "key of a system", diagnostics);
  if (!map.usable()) {
    return spec;
  }
  if (!map.has("model")) {
    diagnostics.add(map.key("model"),
                    "missing; must be the name of a model, as listed by `twin models`");
    return spec;
  }
  const YAML::Node named = map.at("model");
  const ModelInfo* model = named.IsScalar() ? findModel(named.Scalar()) : nullptr;
  if (model == nullptr) {  // choice() adds a diagnostic with the models available
    static_cast<void>(map.choice("model", modelNames(), "the name of a model", ""));
    return spec;
  }
  spec.model = model->name;
  const std::size_t before = diagnostics.all().size();
  readParameters(map, *model, spec, diagnostics);
  const bool fit = diagnostics.all().size() == before;
  readShaft(map, *model, scene, places, spec, diagnostics);
  try {
    spec.setup = setUp(*model, spec, surroundingsOf(scene, spec));
    const ModelSetup& setup = spec.setup->made;
    readInitial(map, scene, *model, controlled, spec, diagnostics);
    spec.inputs = readInputs(map, setup.dynamics->inputs(), folderOf(scene.source), diagnostics);
    readIntegrator(map, setup, spec, diagnostics);
    readEnsemble(map, *model, setup.dynamics->coordinates(), spec, diagnostics);
    if (fit) {
      checkStart(map, *setup.dynamics, spec, scene, diagnostics);
    }
  } catch (const SetupError& error) {
    if (fit) {  // otherwise a consequence of the errors in the parameters
      diagnostics.add(map.key("parameters." + error.parameter()), error.what());
    }
  } catch (const std::bad_alloc&) {
    throw;  // not caused by the parameters
  } catch (const std::exception& error) {
    if (fit) {
      diagnostics.add(map.key("parameters"), error.what());
    }
  }
  return spec;
}

Scene readTree(const YAML::Node& tree, const std::string& source, Diagnostics& diagnostics) {
  Scene scene;
  scene.source = source;
  const MapReader map(
      tree, "", {"name", "step", "time", "gravity", "drives", "systems", "sensors", "controllers"},
      "key of a scene", diagnostics);
  if (!map.usable()) {
    return scene;
  }
  scene.name = map.text("name", "scene");
  const double step = map.numberBetween("step", 1.0e-9, 10.0, "s", std::nullopt);
  const double time = map.numberBetween("time", -kMaxInstant, kMaxInstant, "s", 0.0);
  scene.step = nanoseconds(map, "step", step, diagnostics);
  scene.time = nanoseconds(map, "time", time, diagnostics);
  scene.gravity = map.number("gravity", Range::kNotNegative, "m/s^2", scene.gravity);
  DrivePlaces places;
  if (map.has("drives")) {
    const MapReader drives(map.at("drives"), "drives", {}, "", diagnostics);
    checkNames(drives, "drive", diagnostics);
    for (const std::string& name : drives.names()) {
      places.emplace(name, scene.drives.size());
      scene.drives.push_back(
          readDrive(drives.at(name), drives.key(name), name, scene.time, diagnostics));
    }
  }
  if (!map.has("systems")) {
    diagnostics.add("systems", "missing; a scene needs at least one system");
    return scene;
  }
  const MapReader systems(map.at("systems"), "systems", {}, "", diagnostics);
  if (systems.usable() && systems.names().empty()) {
    diagnostics.add("systems", "a scene needs at least one system, found none");
  }
  checkNames(systems, "system", diagnostics);
  for (const std::string& name : systems.names()) {
    const bool controlled = map.has("controllers") && isActedOn(map.at("controllers"), name);
    scene.systems.push_back(readSystem(systems.at(name), systems.key(name), name, scene, places,
                                       controlled, diagnostics));
  }
  checkMotors(scene, diagnostics);
  readAvoidedSpeeds(map, scene, diagnostics);
  checkStations(scene, systems, diagnostics);
  if (map.has("sensors")) {
    scene.sensors = readSensors(map.at("sensors"), "sensors", scene, diagnostics);
  }
  if (map.has("controllers")) {
    const YAML::Node controllers = map.at("controllers");
    if (controllers.IsMap()) {
      checkControllerNames(scene, MapReader(controllers, "controllers", {}, "", diagnostics),
                           diagnostics);
    }
    readControllers(controllers, "controllers", scene, diagnostics);
  }
  return scene;
}

}  // namespace

Scene readScene(const YAML::Node& tree, const std::string& source) {
  Diagnostics diagnostics(source);
  Scene scene;
  try {
    scene = readTree(tree, source, diagnostics);
  } catch (const YAML::Exception& error) {
    diagnostics.add("", fmt::format("not a scene: {}", error.what()));
  }
  if (!diagnostics.all().empty()) {
    throw SceneError(diagnostics.all());
  }
  return scene;
}

Scene readSceneFile(const std::string& path) {
  YAML::Node tree;
  try {
    tree = readYamlFile(path, "a scene", "a step and at least one system");
  } catch (const InputError& inputError) {
    throw SceneError({inputError.what()});
  }
  return readScene(tree, path == "-" ? kStandardInput : path);
}

}  // namespace whirl_twin
