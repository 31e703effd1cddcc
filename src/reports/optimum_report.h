// What `twin sweep` says of a study that looks for an optimum.
#pragma once

#include <string>

#include "reports/output.h"
#include "studies/optimizer.h"

namespace whirl_twin {

std::string text(const Study& study, const Optimum& optimum);
Json json(const Study& study, const Optimum& optimum);

}  // namespace whirl_twin
