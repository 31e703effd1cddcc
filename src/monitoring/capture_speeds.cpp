#include "monitoring/capture_speeds.h"

#include <algorithm>

#include "analysis/sommerfeld_speeds.h"
#include "scene/held_rotor.h"

namespace whirl_twin {
namespace {

constexpr int kLooks = 100;  // speeds at which the motor's torque is compared with its drag

/// Would the motor take the shaft from one speed to the other if nothing whirled? [rad/s]
bool passes(const Motor& motor, double from, double to) {
  for (int i = 0; i <= kLooks; ++i) {
    const double speed = from + (to - from) * i / kLooks;
    if (motor.torque(speed) <= motor.drag * speed) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<CaptureSpeed> captureSpeeds(
    const BuiltSystem& system, const std::vector<state::CriticalSpeedMargin>& critical_speeds) {
  const std::optional<RotorOnMotor> driven = rotorOnMotor(system);
  if (!driven || !driven->held->linear() || !driven->held->hasShaft()) {
    return {};
  }
  const std::vector<SteadySpeed> steady =
      sommerfeldSpeeds(driven->held->linearRotor(), driven->motor, highestSpeed(driven->motor));
  std::vector<CaptureSpeed> captures;
  double passed = 0.0;
  for (const state::CriticalSpeedMargin& critical : critical_speeds) {
    const SpeedBand band{critical.band_low, critical.band_high};
    const auto holds = std::find_if(steady.begin(), steady.end(), [&](const SteadySpeed& s) {
      return s.stable && s.speed > passed && s.speed <= band.to;
    });
    if (!band.empty() && holds != steady.end() && passes(driven->motor, holds->speed, band.to)) {
      const auto next = holds + 1;
      const double escape = next == steady.end() ? band.to : std::min(next->speed, band.to);
      captures.push_back({holds->speed, escape, critical.speed, band});
    }
    passed = band.empty() ? passed : band.to;
  }
  return captures;
}

}  // namespace whirl_twin
