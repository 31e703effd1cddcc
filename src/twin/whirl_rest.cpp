#include "twin/whirl_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/lu.h"

namespace whirl_twin {

namespace {

/// Of the radius, that a whirl may move where its shaft hardly turns.
constexpr double kPart = 0.9;
/// mu t, up to which it is followed, and e to the power of it.
constexpr double kGrown = 0.1;
constexpr double kGrowth = 1.1052;

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
  rest.sag_ = Eigen::PartialPivLU<Eigen::MatrixXd>(l.stiffness + l.circulatory).solve(rotor.load);
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
                        double turned) const {
  const double length = free_->length([&](Eigen::Index j) { return q[j] - sag_[j]; },
                                      [&](Eigen::Index j) { return v[j]; });
  const double part = kPart * (1.0 - 0.125 * turned * turned);  // 1 - x^2/8 <= cos(x/2)
  if (!(part > 0.0)) {
    return 0.0;
  }
  double room = std::numeric_limits<double>::infinity();  // of the integral of |y|
  for (const Place& place : places_) {
    double x = 0.0;
    double y = 0.0;
    for (Eigen::Index j = 0; j < sag_.size(); ++j) {
      x += place.along_x[j] * q[j];
      y += place.along_y[j] * q[j];
    }
    room = std::min(room, std::sqrt(x * x + y * y) / place.fastest);
  }
  room *= part;
  double longest = std::numeric_limits<double>::infinity();
  if (free_->growth() > 0.0) {
    room /= kGrowth;
    longest = kGrown / free_->growth();
  }
  const double push = steady_push_ + inertial_push_ * (speed * speed + acceleration);
  const double lasts = 2.0 * room / (length + std::sqrt(length * length + 2.0 * push * room));
  return lasts > 0.0 ? std::min(lasts, longest) : 0.0;
}

}  // namespace whirl_twin
