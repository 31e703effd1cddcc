// Stability of Stoermer-Cowell steps (stoermer.h) for a linear motion.
#pragma once

#include <Eigen/Core>

#include "integration/stoermer_weights.h"

namespace whirl_twin {

/// Largest growth in a step of h [s] of q'' = by_q q + by_v q' [n x n]: the largest root, in
/// magnitude, of the recurrence that the scheme makes of it. Of the motion itself it is e^(r h), r
/// the largest real part of its eigenvalues.
double growthInAStep(const StoermerScheme& scheme, const Eigen::MatrixXd& by_q,
                     const Eigen::MatrixXd& by_v, double h);

}  // namespace whirl_twin
