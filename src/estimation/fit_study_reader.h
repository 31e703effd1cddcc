// Reads what `twin fit` is asked.
#pragma once

#include <string>

#include "estimation/fit_study.h"

namespace whirl_twin {

/// The study of a YAML file, its scene, and its runs; their paths count from the folder of the
/// study. Throws Refusal with everything that is wrong with the study, its scene or its runs, each
/// "PATH: key: what was expected, what was found"; a system on a motor or with an ensemble cannot
/// be fitted.
FitStudy readFitStudy(const std::string& path, bool validate_only);

}  // namespace whirl_twin
