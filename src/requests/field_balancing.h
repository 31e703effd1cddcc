// Field balancing: correction masses from trial runs or known influence coefficients, on the places
// that a plane has and within its limits, and the unbalance by the tolerance.
#pragma once

#include "requests/balancing_job.h"
#include "requests/document.h"

namespace whirl_twin {

/// JSON is in the SI, text in the units of the job. Angles and phases are in its conventions;
/// "phase_lag" is always a lag. Throws InputError where the runs do not separate the planes.
Document fieldBalancingDocument(const BalancingJob& job);

}  // namespace whirl_twin
