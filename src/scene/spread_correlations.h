// Which numbers of a spread go together: correlations, and the factor that draws of them need.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

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

}  // namespace whirl_twin
