#include "integration/lateral_rotor.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kRoundingOfCoupling = 1.0e-13;

bool isDiagonal(const Eigen::MatrixXd& m) {
  return m(0, 1) == 0.0 && m(1, 0) == 0.0;
}

/// All but the coupling is the same at this speed as at rest, and the coupling is on its line.
bool fits(const LateralRotor& found, const Linearization& rest, const Linearization& l,
          double speed) {
  const double coupling = found.couplingAt(speed) * found.mass;
  const double largest = std::max(std::fabs(coupling), rest.stiffness.cwiseAbs().maxCoeff());
  return l.mass == rest.mass && l.damping == rest.damping && l.stiffness == rest.stiffness &&
         l.gyroscopic.isZero(0.0) && l.circulatory(0, 1) == -l.circulatory(1, 0) &&
         l.circulatory(0, 0) == 0.0 && l.circulatory(1, 1) == 0.0 &&
         std::fabs(l.circulatory(0, 1) - coupling) <= kRoundingOfCoupling * largest;
}

}  // namespace

double LateralRotor::fastest() const noexcept {
  double rate = 0.0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double n = 0.5 * damping[axis];
    const double square = n * n - stiffness[axis];
    rate = std::max(rate, square > 0.0 ? n + std::sqrt(square) : std::sqrt(stiffness[axis]));
  }
  return rate;
}

std::optional<LateralRotor> lateralRotor(const LinearRotor& rotor) {
  if (rotor.dof() != 2 || !rotor.knots.empty()) {
    return std::nullopt;
  }
  const Linearization rest = rotor.matrices(0.0);
  constexpr double kFast = 1024.0;  // rad/s, a power of two
  LateralRotor found;
  found.mass = rest.mass(0, 0);
  if (rest.mass(1, 1) != found.mass || !isDiagonal(rest.mass) || !isDiagonal(rest.damping) ||
      !isDiagonal(rest.stiffness)) {
    return std::nullopt;
  }
  found.coupling = rest.circulatory(0, 1) / found.mass;
  if (rotor.speed_dependent) {
    found.coupling_slope =
        (rotor.matrices(kFast).circulatory(0, 1) - rest.circulatory(0, 1)) / kFast / found.mass;
  }
  for (const double speed : {0.0, kFast, -0.3 * kFast, 0.7 * kFast}) {
    if (!fits(found, rest, rotor.matrices(speed), speed)) {
      return std::nullopt;
    }
  }
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    found.damping[axis] = rest.damping(i, i) / found.mass;
    found.stiffness[axis] = rest.stiffness(i, i) / found.mass;
    found.load[axis] = rotor.load[i] / found.mass;
    for (const ShaftForce& force : rotor.forces) {
      if (force.harmonic != 1) {
        return std::nullopt;
      }
      (force.inertial ? found.eccentricity : found.bow_force)[axis] +=
          force.amplitude[i] / found.mass;
    }
    if (!(found.stiffness[axis] > 0.0)) {
      return std::nullopt;
    }
  }
  return found;
}

}  // namespace whirl_twin
