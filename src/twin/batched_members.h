// Batched integration (SIMD) of the samples of an ensemble of a nonlinear model, with the method of
// their system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "twin/ensemble_members.h"

namespace whirl_twin {

/// nullptr: not supported for this model, method or inputs, or too few samples to be faster.
std::unique_ptr<EnsembleSteps> batchedMembers(const std::vector<EnsembleMember>& members,
                                              const std::string& integrator,
                                              const StepContext& excitation, double step);

}  // namespace whirl_twin
