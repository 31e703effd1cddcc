// A system of a scene as built: its model set up, its method chosen. What stands here never
// changes and is shared by all who ask it (analysis, monitor, displays) or step it (the twin); a
// change of parameters makes another one. No step is prepared: that is the twin's.
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
  /// With the setup of what it says.
  SystemSpec spec;
  const ModelInfo* model = nullptr;
  std::shared_ptr<const Dynamics> dynamics;
  std::string integrator;         ///< the method it steps with
  std::string integrator_reason;  ///< why, where `auto` chose
  std::size_t drive = 0;          ///< place among BuiltScene::drives() of the one that turns it

  const ModelSetup& setup() const { return spec.setup->made; }

  /// With other numbers at these paths (parameter_paths.h). Throws Refusal in the words of a scene,
  /// each complaint with the key systems.NAME.parameters… and `source` before it, for paths that it
  /// does not have, values out of range, parameters that do not fit together or would make it a
  /// system of another kind, and for a system with an ensemble.
  std::shared_ptr<const BuiltSystem> with(const std::vector<std::string>& paths,
                                          const std::vector<double>& values,
                                          const std::string& source) const;
  /// With the complete set of numbers that a twin told of; nullptr for one of another system, or
  /// that this one cannot have.
  std::shared_ptr<const BuiltSystem> with(const state::ParameterChange& set) const;

  /// All numbers with their values; nothing `changed`.
  state::ParameterChange parameters() const;
  /// The number at a path; nothing if there is none.
  std::optional<double> parameter(const std::string& path) const;
};

using SharedSystem = std::shared_ptr<const BuiltSystem>;

/// Throws std::logic_error where there is no such model, and what the model throws of
/// parameters that do not fit together.
SharedSystem build(SystemSpec spec, const Surroundings& around, std::size_t drive);

}  // namespace whirl_twin
