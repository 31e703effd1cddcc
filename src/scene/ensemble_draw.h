// Draws the members of an ensemble. A member depends on the seed and its own number only: another
// count, or another machine, gives the same members.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

// Which numbers of a spread go together: correlations, and the factor that draws of them need.

/// Reads a list of [one number, another, correlation], by their paths, and fills the factor of an
/// ensemble whose spreads have been read; complains of everything that does not fit.
void readCorrelations(const YAML::Node& node, const std::string& key, EnsembleSpec& ensemble,
                      Complaints& complaints);

/// The deviations [each in the unit of its number] that independent ones of the same widths make:
/// row i of the factor, times the deviations in parts of their widths, times width i. As they are
/// where nothing is correlated.
std::vector<double> correlated(const EnsembleSpec& ensemble,
                               const std::vector<double>& independent);
/// The other way round; 0 of one that the others tell.
std::vector<double> independent(const EnsembleSpec& ensemble,
                                const std::vector<double>& correlated);

struct DrawnMember {
  SystemSpec spec;             ///< of a single system
  std::vector<double> values;  ///< of spec.ensemble.spread, in its order
};

/// Member `index` of the ensemble of `spec`. A value outside its parameter's range is drawn again;
/// a parameter that by default is another's (stiffness_y), and has that one's value in the scene,
/// goes with it. Throws Refusal where hardly a draw is in range.
DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index);

/// What a number is spread about.
double centreOf(const Spread& spread, const SystemSpec& spec, const ModelInfo& model);

/// The system with these numbers, in the order of spec.ensemble.spread, and those that go with
/// them; nothing where one is out of its range.
std::optional<SystemSpec> memberAt(const SystemSpec& spec, const ModelInfo& model,
                                   const std::vector<double>& values);

/// Why an ensemble cannot be drawn; "" if it can.
std::string spreadObjection(const SystemSpec& spec, const ModelInfo& model);

}  // namespace whirl_twin
