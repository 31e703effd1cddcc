#include "scene/built_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "models/model_registry.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/parameter_limits.h"
#include "scene/parameter_paths.h"
#include "scene/signal_names.h"

namespace whirl_twin {

namespace {

/// "x [m], theta [rad]"
std::string coordinateNames(const Dynamics& dynamics) {
  std::string names;
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    names += fmt::format("{}{} [{}]", names.empty() ? "" : ", ", c.name, c.unit);
  }
  return names;
}

/// Why a running system cannot be replaced by the new one; "" if it can.
std::string objectionToReplace(const BuiltSystem& before, const BuiltSystem& next) {
  const std::string had = coordinateNames(*before.dynamics);
  const std::string has = coordinateNames(*next.dynamics);
  if (has != had || next.dynamics->isRotor() != before.dynamics->isRotor()) {
    return fmt::format("would change the coordinates from {} to {}: restart with another scene",
                       had, has);
  }
  if (publishedStations("", *before.dynamics) != publishedStations("", *next.dynamics)) {
    return "would change the published stations: restart with another scene";
  }
  const std::string objection =
      integratorDiagnostic(next.setup(), next.spec.drive.has_value(), next.spec.integrator);
  return objection.empty() ? "" : "integrator: " + objection;
}

}  // namespace

SharedSystem build(SystemSpec spec, const ModelContext& around, std::size_t drive) {
  BuiltSystem built;
  const SystemSetup& setup = setupOf(spec, around);
  built.model = setup.model;
  built.dynamics = setup.made.dynamics;
  built.integrator = spec.integrator;
  built.drive = drive;
  if (spec.integrator == "auto") {
    const bool on_drive = spec.drive.has_value();
    // A calibrated choice may not suit changed parameters.
    if (canStepWith(setup.made, on_drive, spec.chosen_integrator)) {
      built.integrator = spec.chosen_integrator;
      built.integrator_reason = spec.choice_reason;
    } else {
      const IntegratorChoice choice = chooseIntegrator(setup.made, on_drive);
      built.integrator = choice.integrator;
      built.integrator_reason = choice.reason;
    }
  }
  built.spec = std::move(spec);
  return std::make_shared<const BuiltSystem>(std::move(built));
}

SharedSystem BuiltSystem::with(const std::vector<std::string>& paths,
                               const std::vector<double>& values, const std::string& source) const {
  Diagnostics diagnostics(source);
  const std::string key = "systems." + spec.name + ".parameters";
  if (spec.ensemble.count > 0) {
    diagnostics.add(
        key, "belong to an ensemble, drawn at the start: they cannot be changed while it runs");
  }
  SystemSpec changed = spec;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    setParameter(paths[i], values[i], *model, changed, diagnostics);
  }
  SharedSystem next;
  if (diagnostics.all().empty()) {
    try {
      next = build(std::move(changed), spec.setup->around, drive);
      for (const std::string& objection :
           {objectionToReplace(*this, *next),
            ratesDiagnostic(*next->dynamics, next->spec, next->spec.speed.value_or(0.0))}) {
        if (!objection.empty()) {
          diagnostics.add(key, objection);
        }
      }
    } catch (const SetupError& error) {
      diagnostics.add(key + "." + error.parameter(), error.what());
    } catch (const std::exception& error) {  // numerically unusable values
      diagnostics.add(key, error.what());
    }
  }
  if (!diagnostics.all().empty()) {
    throw InputError(errorList(diagnostics.all()));
  }
  return next;
}

SharedSystem BuiltSystem::with(const state::ParameterChange& set) const {
  const state::ParameterChange known = parameters();
  if (set.system != spec.name || set.names != known.names ||
      set.values.size() != set.names.size()) {
    return nullptr;
  }
  if (set.values == known.values) {  // a repeated message
    return std::make_shared<const BuiltSystem>(*this);
  }
  // A parameter that follows another, with equal values in the set, continues to follow it.
  std::vector<std::string> paths;
  std::vector<double> values;
  for (std::size_t i = 0; i < set.names.size(); ++i) {
    const auto followed = spec.following.find(set.names[i]);
    if (followed != spec.following.end()) {
      const auto source = std::find(set.names.begin(), set.names.end(), followed->second);
      if (source != set.names.end() &&
          set.values[static_cast<std::size_t>(source - set.names.begin())] == set.values[i]) {
        continue;
      }
    }
    paths.push_back(set.names[i]);
    values.push_back(set.values[i]);
  }
  try {
    return with(paths, values, "parameters");
  } catch (const InputError&) {
    return nullptr;
  }
}

state::ParameterChange BuiltSystem::parameters() const {
  return parametersOf(*model, spec);
}

std::optional<double> BuiltSystem::parameter(const std::string& path) const {
  return parameterAt(path, *model, spec);
}

}  // namespace whirl_twin
