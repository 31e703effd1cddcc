// Draws the samples of an ensemble. A sample depends on the seed and its index only: a different
// count, or a different machine, gives the same samples.
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

// Correlations of the numbers with a spread, and the factor for drawing them.

/// Reads a list of [path of a number, path of another one, correlation], and fills the factor of an
/// ensemble whose spreads have been read; adds a diagnostic for every error.
void readCorrelations(const YAML::Node& node, const std::string& key, EnsembleSpec& ensemble,
                      Diagnostics& diagnostics);

/// Correlated deviations [each in the unit of its number] from independent ones of the same widths:
/// row i of the factor, times the deviations relative to their widths, times width i. Unchanged
/// without correlations.
std::vector<double> correlated(const EnsembleSpec& ensemble,
                               const std::vector<double>& independent);
/// The inverse of correlated(); 0 for a deviation that the others determine.
std::vector<double> independent(const EnsembleSpec& ensemble,
                                const std::vector<double>& correlated);

struct DrawnMember {
  SystemSpec spec;             ///< of a single system
  std::vector<double> values;  ///< of spec.ensemble.spread, in its order
};

/// Sample `index` of the ensemble of `spec`. A value outside its parameter's range is drawn again;
/// a parameter that defaults to another one (stiffness_y), and equals it in the scene, follows it.
/// Throws InputError if none of many draws is in range.
DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index);

/// The value in the scene of a number with a spread.
double centreOf(const Spread& spread, const SystemSpec& spec, const ModelInfo& model);

/// The system with these numbers, in the order of spec.ensemble.spread, and those that follow them;
/// nothing if one is out of its range.
std::optional<SystemSpec> memberAt(const SystemSpec& spec, const ModelInfo& model,
                                   const std::vector<double>& values);

/// Why an ensemble cannot be drawn; "" if it can.
std::string toleranceDiagnostic(const SystemSpec& spec, const ModelInfo& model);

}  // namespace whirl_twin
