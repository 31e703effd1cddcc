// The whirl_twin participant: a scene of one system, stepped by a Twin with each integrator of its
// model.
#pragma once

#include <string>
#include <vector>

#include "contender.h"

namespace whirl_twin::comparison {

/// `text`: the scene in YAML, without its step.
void addTwin(const std::string& text, const Output& output, std::vector<Contender>& contenders);

}  // namespace whirl_twin::comparison
