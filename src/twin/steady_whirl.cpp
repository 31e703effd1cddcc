#include "twin/steady_whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/dense.h"
#include "analysis/orbit.h"
#include "analysis/synchronous_poles.h"

namespace whirl_twin {

namespace {

/// The rest may be this part of what is ahead. About the sag an eighth of a turn to each side, so
/// that with the mark of a step, less than a quarter, it stays below half a turn.
constexpr double kPartOfTurning = 0.9;
constexpr double kPartOfSag = 0.7;

}  // namespace

std::optional<SteadyWhirl> SteadyWhirl::of(const Dynamics& dynamics,
                                           const std::vector<Station>& stations, double speed) {
  const LinearRotor rotor = dynamics.linearRotor();
  const bool once_a_turn = std::all_of(rotor.forces.begin(), rotor.forces.end(),
                                       [](const ShaftForce& f) { return f.harmonic == 1; });
  const Linearization l = rotor.matrices(speed);
  SteadyWhirl steady;
  steady.speed_ = speed;
  steady.free_ = FreeMotion::of(l);
  if (!once_a_turn || !steady.free_) {
    return std::nullopt;
  }
  steady.sag_ = Lu(l.stiffness + l.circulatory).solve(rotor.load);
  steady.response_ = ComplexLu(synchronousStiffness(l, speed)).solve(rotor.synchronousForce(speed));
  for (const Station& station : stations) {
    const std::optional<StationBound> bound = steady.bound(station);
    if (!bound) {
      return std::nullopt;
    }
    steady.stations_.push_back(*bound);
  }
  return steady;
}

std::optional<SteadyWhirl::StationBound> SteadyWhirl::bound(const Station& station) const {
  const Orbit turns(station.along_x.cast<std::complex<double>>().dot(response_),
                    station.along_y.cast<std::complex<double>>().dot(response_));
  const double forward = std::abs(turns.forward);
  const double backward = std::abs(turns.backward);
  const double sag = std::hypot(station.along_x.dot(sag_), station.along_y.dot(sag_));
  StationBound found;
  const double beside_turning = kPartOfTurning * forward - (backward + sag);
  const double beside_sag = kPartOfSag * sag - (forward + backward);
  found.keeps = beside_turning > beside_sag ? Kept::kLag : Kept::kDirection;
  const double room = std::max(beside_turning, beside_sag);
  found.largest_free = room / free_->furthest(station);
  found.least_radius =
      found.keeps == Kept::kLag ? (1.0 - kPartOfTurning) * forward : (1.0 - kPartOfSag) * sag;
  return room > 0.0 && found.largest_free > 0.0 ? std::optional(found) : std::nullopt;
}

double SteadyWhirl::lasts(const double* q, const double* v, double angle) const {
  const std::complex<double> turn = std::polar(1.0, angle);
  const std::complex<double> turning(-speed_ * turn.imag(), speed_ * turn.real());
  const double free = free_->length(
      [&](Eigen::Index j) {
        const std::complex<double> x = response_[j];
        return q[j] - sag_[j] - (x.real() * turn.real() - x.imag() * turn.imag());
      },
      [&](Eigen::Index j) {
        const std::complex<double> x = response_[j];
        return v[j] - (x.real() * turning.real() - x.imag() * turning.imag());
      });
  double least = std::numeric_limits<double>::infinity();
  for (const StationBound& station : stations_) {
    least = std::min(least, station.largest_free);
  }
  if (!(free < least)) {
    return 0.0;
  }
  return free_->growth() > 0.0 ? std::log(least / free) / free_->growth()
                               : std::numeric_limits<double>::infinity();
}

}  // namespace whirl_twin
