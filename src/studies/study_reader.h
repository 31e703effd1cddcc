// Reads the study of `twin sweep`.
#pragma once

#include <string>

#include "studies/study.h"

namespace whirl_twin {

/// Reads a study from a YAML file, and its scene, with a path relative to the folder of the study.
/// Throws InputError with all errors of both, each "PATH: key: what was expected, what was found".
Study readStudy(const std::string& path);

}  // namespace whirl_twin
