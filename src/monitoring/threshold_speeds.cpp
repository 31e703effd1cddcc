#include "monitoring/threshold_speeds.h"

#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {
double ThresholdSpeeds::lowest() const {
  for (const StabilityThreshold& threshold : thresholds_) {
    if (threshold.unstable_above) {
      return threshold.speed;
    }
  }
  return kNaN;
}

double ThresholdSpeeds::below(double speed) const {
  double nearest = kNaN;
  for (const StabilityThreshold& threshold : thresholds_) {
    if (threshold.speed > 0.0 && threshold.speed <= std::fabs(speed)) {
      nearest = threshold.speed;
    }
  }
  return nearest;
}

double ThresholdSpeeds::above(double speed) const {
  for (const StabilityThreshold& threshold : thresholds_) {
    if (threshold.speed > std::fabs(speed)) {
      return threshold.speed;
    }
  }
  return kNaN;
}

bool ThresholdSpeeds::between(double one, double other) const {
  for (const StabilityThreshold& threshold : thresholds_) {
    if ((std::fabs(one) > threshold.speed) != (std::fabs(other) > threshold.speed)) {
      return true;
    }
  }
  return false;
}

bool ThresholdSpeeds::unstableAt(double speed) const {
  bool unstable = !thresholds_.empty() && !thresholds_.front().unstable_above;
  for (const StabilityThreshold& threshold : thresholds_) {
    if (std::fabs(speed) > threshold.speed) {
      unstable = threshold.unstable_above;
    }
  }
  return unstable;
}

}  // namespace whirl_twin
