// Members of an ensemble of a nonlinear model, stepped side by side in vectors with the method of
// their system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "twin/ensemble_members.h"

namespace whirl_twin {

/// nullptr: not for this model or method, not with inputs, or they are too few to gain by it.
std::unique_ptr<EnsembleSteps> membersSideBySide(const std::vector<EnsembleMember>& members,
                                                 const std::string& integrator,
                                                 const Excitation& excitation, double step);

}  // namespace whirl_twin
