#include "twin/whirl_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Of the radius, or of a line's distance from the centre, that a whirl may move beside it where
/// nothing turns far in a step.
constexpr double kPart = 0.9;
/// The tangent of the angle by which a line may be aimed towards the centre.
constexpr double kAimed = 0.17;
/// mu t, up to which it is followed, and e to the power of it.
constexpr double kGrown = 0.1;
constexpr double kGrowth = 1.1052;

/// kPart of the cosine of half the angle, or less: 1 - x^2/8 <= cos(x/2). 0 from where that is.
double part(double turned) {
  return kPart * std::max(0.0, 1.0 - 0.125 * turned * turned);
}

}  // namespace

std::optional<WhirlRest> WhirlRest::of(const Dynamics& dynamics,
                                       const std::vector<Station>& stations) {
  const LinearRotor rotor = dynamics.linearRotor();
  if (rotor.speed_dependent) {
    return std::nullopt;
  }
  const Linearization l = rotor.matrices(0.0);
  WhirlRest rest;
  rest.free_ = FreeMotion::of(l);
  if (!rest.free_) {
    return std::nullopt;
  }
  rest.sag_ = Lu(l.stiffness + l.circulatory).solve(rotor.load);
  for (const ShaftForce& force : rotor.forces) {
    (force.inertial ? rest.inertial_push_ : rest.steady_push_) +=
        rest.free_->pushed(force.amplitude);
  }
  for (const Station& at : stations) {
    rest.places_.push_back({at.along_x, at.along_y, rest.free_->fastest(at)});
  }
  return rest;
}

double WhirlRest::lasts(const double* q, const double* v, double speed, double acceleration,
                        double step, double longest) const {
  const double length = free_->length([&](Eigen::Index j) { return q[j] - sag_[j]; },
                                      [&](Eigen::Index j) { return v[j]; });
  const double push = steady_push_ + inertial_push_ * (speed * speed + acceleration);
  double grown = 1.0;
  if (free_->growth() > 0.0) {
    grown = kGrowth;
    longest = std::min(longest, kGrown / free_->growth());
  }
  const double curved = grown * (free_->pull() * (length + push * longest / 3.0) + push);
  const double turned = speed * step;
  double lasts = longest;
  for (const Place& place : places_) {
    double x = 0.0;
    double y = 0.0;
    double x_rate = 0.0;
    double y_rate = 0.0;
    for (Eigen::Index j = 0; j < sag_.size(); ++j) {
      x += place.along_x[j] * q[j];
      y += place.along_y[j] * q[j];
      x_rate += place.along_x[j] * v[j];
      y_rate += place.along_y[j] * v[j];
    }
    const double radius = std::sqrt(x * x + y * y);
    const double room = part(turned) * radius / (place.fastest * grown);
    double here = 0.0;
    const double outwards = x * x_rate + y * y_rate;
    const double around = std::fabs(x * y_rate - y * x_rate);
    if (outwards > -kAimed * around) {
      const double rate = std::sqrt(x_rate * x_rate + y_rate * y_rate);
      const double distance = outwards < 0.0 ? around / rate : radius;
      const double beside = part(turned + rate * step / distance) * distance;
      here = std::sqrt(2.0 * beside / (place.fastest * curved));
    }
    if (!(here * length >= room)) {  // which the way to the side of the centre is no longer than
      here = std::max(here, 2.0 * room / (length + std::sqrt(length * length + 2.0 * push * room)));
    }
    if (!(here >= lasts)) {  // also where it is no number
      lasts = here;
    }
  }
  return lasts > 0.0 ? lasts : 0.0;
}

}  // namespace whirl_twin
