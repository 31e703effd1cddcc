#include "monitoring/characteristic_speeds.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/sommerfeld_speeds.h"
#include "scene/held_rotor.h"

namespace whirl_twin {
namespace {

constexpr int kTorqueSamples = 100;  // speeds at which the motor's torque is compared with its drag

/// Would the motor take the shaft from one speed to the other if nothing whirled? [rad/s]
bool torqueSuffices(const Motor& motor, double from, double to) {
  for (int i = 0; i <= kTorqueSamples; ++i) {
    const double speed = from + (to - from) * i / kTorqueSamples;
    if (motor.torque(speed) <= motor.drag * speed) {
      return false;
    }
  }
  return true;
}

/// critical_speeds: those of the rotor with its shaft held, with their bands.
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
    if (band.empty()) {
      continue;
    }
    const auto holds = std::find_if(steady.begin(), steady.end(), [&](const SteadySpeed& s) {
      return s.stable && s.speed > passed && s.speed <= band.to;
    });
    if (holds != steady.end() && torqueSuffices(driven->motor, holds->speed, band.to)) {
      const auto next = holds + 1;
      const double escape = next == steady.end() ? band.to : std::min(next->speed, band.to);
      captures.push_back({holds->speed, escape, critical.speed, band});
    }
    passed = band.to;
  }
  return captures;
}

}  // namespace

double ThresholdSpeeds::lowest() const {
  return firstSpeed([](const StabilityThreshold& t) { return t.unstable_above; });
}

double ThresholdSpeeds::above(double speed) const {
  return firstSpeed([&](const StabilityThreshold& t) { return t.speed > std::fabs(speed); });
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

bool ThresholdSpeeds::between(double one, double other) const {
  return std::any_of(thresholds_.begin(), thresholds_.end(), [&](const StabilityThreshold& t) {
    return (std::fabs(one) > t.speed) != (std::fabs(other) > t.speed);
  });
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

CharacteristicSpeeds CharacteristicSpeeds::of(const BuiltSystem& system) {
  CharacteristicSpeeds speeds;
  const DataSpeeds tables = tableSpeeds(system);
  for (const CriticalSpeed& c : criticalSpeeds(*heldDynamics(system))) {
    if (tables.covers(c.speed)) {
      speeds.critical.push_back(c);
    }
  }
  speeds.captures = captureSpeeds(system, speeds.marginsAt(0.0));
  return speeds;
}

std::vector<state::CriticalSpeedMargin> CharacteristicSpeeds::marginsAt(double speed) const {
  std::vector<state::CriticalSpeedMargin> margins;
  for (const CriticalSpeed& c : critical) {
    margins.push_back(criticalSpeedMargin(speed, c.speed, c.forward ? "forward" : "backward",
                                          c.amplification_factor));
  }
  return margins;
}

}  // namespace whirl_twin
