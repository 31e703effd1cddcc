#include "analysis/sommerfeld_speeds.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/polynomial_roots.h"
#include "analysis/stability.h"
#include "analysis/synchronous_poles.h"
#include "analysis/synchronous_response.h"

namespace whirl_twin {

namespace {

constexpr double kSlowest = 1.0e-4;  // of the highest speed
constexpr double kSlow = 1.0e-2;     // of the lowest natural frequency
constexpr int kSommerfeldGrid = 400;

constexpr double kFastest = 1.0e6;  // [rad/s], search limit for a motor without a speed limit

}  // namespace

double highestSpeed(const Motor& motor) {
  double speed = 1.0;
  for (std::size_t i = 0; i < motor.count; ++i) {
    speed = std::max(speed, motor.points[i].speed);
  }
  while (speed < kFastest && motor.torque(speed) > motor.drag * speed) {
    speed *= 2.0;
  }
  return std::min(speed, kFastest);
}

double whirlTorque(const LinearRotor& rotor, double speed) {
  const Eigen::VectorXcd x = synchronousResponse(rotor, {}, speed).q;
  const std::complex<double> power =
      0.5 * (std::complex<double>(0.0, speed) * x).dot(rotor.synchronousForce(speed));
  return power.real() / speed;
}

std::vector<SteadySpeed> sommerfeldSpeeds(const LinearRotor& rotor, const Motor& motor,
                                          double highest) {
  const auto surplus = [&](double speed) {
    return motor.torque(speed) - motor.drag * speed - whirlTorque(rotor, speed);
  };
  // The resonances are above its lowest natural frequency, however fast the motor could turn it.
  const auto frequencies = stability(rotor.matrices(0.0)).natural_frequencies;
  const double scale = frequencies.empty() ? highest : std::min(highest, frequencies.front());
  const double lowest = (highest > scale ? kSlow : kSlowest) * scale;
  std::vector<double> speeds =
      speedsToLookAt(synchronousPoles(rotor, lowest, highest), lowest, highest, kSommerfeldGrid);
  for (std::size_t i = 0; i < motor.count; ++i) {  // breakpoints of the motor's characteristic
    if (motor.points[i].speed > lowest && motor.points[i].speed < highest) {
      speeds.push_back(motor.points[i].speed);
    }
  }
  std::sort(speeds.begin(), speeds.end());
  std::vector<SteadySpeed> found;
  double low = speeds.front();
  double before = surplus(low);
  for (const double high : speeds) {
    const double after = surplus(high);
    if (high > low && std::isfinite(after) && (before < 0.0) != (after < 0.0)) {
      const double speed = bracketedRoot(surplus, low, high, before, after);
      found.push_back({speed, motor.torque(speed), after < 0.0});
    }
    if (std::isfinite(after)) {
      low = high;
      before = after;
    }
  }
  return found;
}

}  // namespace whirl_twin
