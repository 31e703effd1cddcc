// A system of a scene with its model set up and its integrator chosen. Immutable, and shared by
// analysis, monitor, displays and the twin; a change of parameters creates a new one. Contains no
// prepared step: the twin has them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "messages/states.h"
#include "models/model_info.h"
#include "scene/scene.h"
#include "scene/system_setup.h"

namespace whirl_twin {

struct BuiltSystem {
  /// The setup of spec.
  SystemSpec spec;
  const ModelInfo* model = nullptr;
  std::shared_ptr<const Dynamics> dynamics;
  std::string integrator;         ///< name of the integration method
  std::string integrator_reason;  ///< why `auto` chose it
  std::size_t drive = 0;          ///< index of its drive in BuiltScene::drives()

  const ModelSetup& setup() const { return spec.setup->made; }

  /// The system with other numbers at these paths (parameter_paths.h). Throws InputError with the
  /// diagnostics of a scene, each with `source` and the key systems.NAME.parameters…, for unknown
  /// paths, values out of range, inconsistent parameters, parameters that change the coordinates,
  /// stations or integrator, and for a system with an ensemble.
  std::shared_ptr<const BuiltSystem> with(const std::vector<std::string>& paths,
                                          const std::vector<double>& values,
                                          const std::string& source) const;
  /// The system with the complete set of numbers that a twin has published; nullptr if the set
  /// belongs to a different system, or is invalid for this one.
  std::shared_ptr<const BuiltSystem> with(const state::ParameterChange& set) const;

  /// All numbers with their values; `changed` is empty.
  state::ParameterChange parameters() const;
  /// The number at a path; nothing if there is none.
  std::optional<double> parameter(const std::string& path) const;
};

using SharedSystem = std::shared_ptr<const BuiltSystem>;

/// Throws std::logic_error for an unknown model, and what the model throws for inconsistent
/// parameters.
SharedSystem build(SystemSpec spec, const ModelContext& around, std::size_t drive);

}  // namespace whirl_twin
