#include "mechanics/rotors/short_journal_bearing.h"

#include <cmath>

#include "algebra/constants.h"
#include "mechanics/gradient.h"

namespace whirl_twin {

namespace {

/// 1 / S of an eccentricity ratio: the load in units of D w mu L^3 / (8 c^2); it rises with e.
double loadNumber(double e) {
  const double rest = 1.0 - e * e;
  return e * std::sqrt(kPi * kPi * rest + 16.0 * e * e) / (rest * rest);
}

/// At a speed > 0, by the derivatives of the film's force.
BearingCoefficients derivatives(const ShortJournalBearing& bearing, double load, double speed) {
  using Dual = Gradient<double, 4>;
  const JournalPosition at = bearing.staticPosition(load, speed);
  const FilmForce<Dual> force =
      bearing.force(Dual(at.x, 0), Dual(at.y, 1), Dual(0.0, 2), Dual(0.0, 3), Dual(speed));
  const auto& x = force.x.slope;
  const auto& y = force.y.slope;
  return {-x[0], -x[1], -y[0], -y[1], -x[2], -x[3], -y[2], -y[3]};
}

}  // namespace

double ShortJournalBearing::eccentricity(double load, double speed) const {
  // 1 / S: D / 8 = R / 4.
  const double wanted = load / (forceScale() * speed);
  double low = 0.0;
  double high = 1.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) {
      return middle;
    }
    (loadNumber(middle) < wanted ? low : high) = middle;
  }
}

double ShortJournalBearing::speedAt(double load, double eccentricity_ratio) const {
  return load / (forceScale() * loadNumber(eccentricity_ratio));
}

JournalPosition ShortJournalBearing::staticPosition(double load, double speed) const {
  const double e = eccentricity(load, speed);
  const double attitude = std::atan2(kPi * std::sqrt(1.0 - e * e), 4.0 * e);
  return {clearance * e * std::sin(attitude), -clearance * e * std::cos(attitude), e, attitude};
}

BearingCoefficients ShortJournalBearing::coefficients(double load, double speed) const {
  const double slowest = speedAt(load, kMaxEccentricity);
  const double turning = std::fabs(speed);
  BearingCoefficients k = derivatives(*this, load, turning > slowest ? turning : slowest);
  // Under the reflection x -> -x a shaft rotates in the opposite direction.
  const double coupling = turning > slowest ? (speed < 0.0 ? -1.0 : 1.0) : speed / slowest;
  for (double* crossed : {&k.kxy, &k.kyx, &k.cxy, &k.cyx}) {
    *crossed *= coupling;
  }
  return k;
}

}  // namespace whirl_twin
