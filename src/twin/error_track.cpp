#include "twin/error_track.h"

#include <cmath>

namespace whirl_twin {

void ErrorTrack::observe(double time, double sum, double horizon) {
  const bool anew = std::isnan(sum_) || sum < sum_;
  const double kept = std::isnan(estimate_) ? 0.0 : estimate_ * std::exp(-(time - time_) / horizon);
  estimate_ = kept + (anew ? sum : sum - sum_);
  sum_ = sum;
  time_ = time;
}

}  // namespace whirl_twin
