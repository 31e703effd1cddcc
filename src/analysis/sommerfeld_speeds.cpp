#include "analysis/sommerfeld_speeds.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/bracketed_root.h"
#include "analysis/synchronous_poles.h"
#include "analysis/synchronous_response.h"

namespace whirl_twin {

namespace {

constexpr double kSlowest = 1.0e-4;  // of the highest speed
constexpr int kCoarse = 400;

}  // namespace

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
  const double lowest = kSlowest * highest;
  std::vector<double> speeds =
      speedsToLookAt(synchronousPoles(rotor, lowest, highest), lowest, highest, kCoarse);
  for (std::size_t i = 0; i < motor.count; ++i) {  // corners of the motor's law
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
