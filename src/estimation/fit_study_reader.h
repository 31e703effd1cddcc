// Reads the study of `twin fit`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimation/fit_study.h"

namespace whirl_twin {

/// Reads the columns of a run: path, how its table is written, the columns.
using RunReader = std::function<MeasuredRun(const std::string&, const TableSettings&,
                                            const std::vector<WantedColumn>&)>;

/// Reads a study from a YAML file, with its scene and its runs; their paths are relative to the
/// folder of the study. Throws InputError with all errors of the study, its scene and its runs,
/// each "PATH: key: what was expected, what was found"; a system on a motor or with an ensemble
/// cannot be fitted.
FitStudy readFitStudy(const std::string& path, bool validate_only,
                      const RunReader& read = readMeasuredRun);

}  // namespace whirl_twin
