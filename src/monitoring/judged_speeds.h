// The speeds of a system that do not hang on the one it runs at: they follow from its parameters,
// and are found where it is judged.
#pragma once

#include <vector>

#include "analysis/critical_speeds.h"
#include "messages/stability_margin.h"
#include "monitoring/capture_speeds.h"
#include "monitoring/threshold_speeds.h"

namespace whirl_twin {

struct JudgedSpeeds {
  std::vector<CriticalSpeed> critical;
  ThresholdSpeeds thresholds;
  std::vector<CaptureSpeed> captures;  ///< of a rotor on its motor

  /// Those that follow from its parameters alone. Critical speeds beyond the tables of its bearings
  /// and pedestals are left out: nobody has measured what would make them.
  static JudgedSpeeds of(const BuiltSystem& system);

  /// The critical speeds seen from a running speed [rad/s].
  std::vector<state::CriticalSpeedMargin> marginsAt(double speed) const;
};

}  // namespace whirl_twin
