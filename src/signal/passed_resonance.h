// The resonances that the actual run-ups and run-downs of a recording have passed, beside what the
// model says of them.
#pragma once

#include <limits>
#include <vector>

#include "messages/stability_margin.h"
#include "signal/run_up_response.h"

namespace whirl_twin {

/// The 1X component of a rotor and its non-synchronous part, as the twin publishes them.
struct OrderCourse {
  std::vector<double> time;       ///< [s], simulated, that it held at
  std::vector<double> speed;      ///< [rad/s], of the shaft
  std::vector<double> amplitude;  ///< [m], 1X, in the direction of rotation
  std::vector<double> deviation;  ///< [m], how far that may be off
  std::vector<double> lag;        ///< [rad], behind the phase mark, continued from one to the next
  std::vector<double> line_time, line_frequency;  ///< [s], [rad/s], of the largest line
};

struct PassedResonance {
  ResponsePeak peak;  ///< of 1X, in m
  // Of the model's critical speed that is nearest, within a fifth; NaN: there is none.
  double model_speed = std::numeric_limits<double>::quiet_NaN();   ///< [rad/s]
  double model_factor = std::numeric_limits<double>::quiet_NaN();  ///< [-]
};

/// As they were passed, each run's own: peaks with half power on both sides, and where a run has
/// none the highest. A peak that is not a twentieth of the highest, or is within what 1X may be
/// off, is none; neither is the beat of the ringing that a fast passage leaves behind.
std::vector<PassedResonance> passedResonances(const OrderCourse& orders,
                                              const std::vector<state::CriticalSpeedMargin>& model);

}  // namespace whirl_twin
