#include "twin/error_track.h"

#include <cmath>

namespace whirl_twin {

void ErrorTrack::observe(double time, double sum, double horizon, bool anew) {
  const double kept = std::isnan(estimate_) ? 0.0 : estimate_ * std::exp(-(time - time_) / horizon);
  const double now = kept + (anew || std::isnan(sum_) ? sum : sum - sum_);
  estimate_ = now < 0.0 ? 0.0 : now;  // NaN stays
  sum_ = sum;
  time_ = time;
}

}  // namespace whirl_twin
