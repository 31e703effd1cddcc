#include "analysis/known_steady_motions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kFirstWait = 1.0;  // s, and twice as long after every search

}  // namespace

KnownSteadyMotions::KnownSteadyMotions(std::shared_ptr<const Dynamics> dynamics)
    : dynamics_(std::move(dynamics)),
      cyclic_(cyclicCoordinates(*dynamics_, 0.0)),
      apply_(!dynamics_->linear() && !dynamics_->hasShaft() && cyclic_.conserved.empty() &&
             (!cyclic_.driven.empty() || !dynamics_->loadFrequencies().empty())),
      wait_(kFirstWait) {}

std::optional<Equilibrium> KnownSteadyMotions::operatingPoint(double time, const Eigen::VectorXd& q,
                                                              const Eigen::VectorXd& v) {
  if (!searched_at_) {
    search(q, v);
    searched_at_ = time;
  } else if (std::fabs(time - *searched_at_) >= wait_) {
    search(q, v);
    searched_at_ = time;
    wait_ *= 2.0;
  }
  return operatingPointAmong(*dynamics_, known_, q, v, 0.0);
}

void KnownSteadyMotions::search(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  for (const Equilibrium& found : equilibria(*dynamics_, 0.0, q, v)) {
    if (std::none_of(known_.begin(), known_.end(), [&](const Equilibrium& known) {
          return same(*dynamics_, cyclic_, found, known);
        })) {
      known_.push_back(found);
    }
  }
}

}  // namespace whirl_twin
