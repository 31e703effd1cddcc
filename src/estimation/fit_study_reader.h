// Reads what `twin fit` is asked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimation/fit_study.h"

namespace whirl_twin {

/// Reads the columns of a run: path, name of the time, names of the columns.
using RunReader = std::function<MeasuredRun(const std::string&, const std::string&,
                                            const std::vector<std::string>&)>;

/// The study of a YAML file, its scene, and its runs; their paths count from the folder of the
/// study. Throws Refusal with everything that is wrong with the study, its scene or its runs, each
/// "PATH: key: what was expected, what was found"; a system on a motor or with an ensemble cannot
/// be fitted.
FitStudy readFitStudy(const std::string& path, bool validate_only,
                      const RunReader& read = readMeasuredRun);

}  // namespace whirl_twin
