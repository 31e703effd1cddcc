// Reads what `twin sweep` is asked.
#pragma once

#include <string>

#include "studies/study.h"

namespace whirl_twin {

/// The study of a YAML file and its scene, whose path counts from the folder of the study. Throws
/// Refusal with everything that is wrong with either, each "PATH: key: what was expected, what was
/// found".
Study readStudy(const std::string& path);

}  // namespace whirl_twin
