#include "twin/steady_whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/cholesky.h"
#include "algebra/eigenvalues.h"
#include "algebra/lu.h"
#include "analysis/orbit.h"
#include "analysis/synchronous_poles.h"

namespace whirl_twin {

namespace {

/// The rest may be this part of what is ahead. About the sag an eighth of a turn to each side, so
/// that with the mark of a step, less than a quarter, it stays below half a turn.
constexpr double kPartOfTurning = 0.9;
constexpr double kPartOfSag = 0.7;
/// Part of a matrix that may be other than its mirror image.
constexpr double kRounding = 1.0e-12;

bool symmetric(const Eigen::MatrixXd& m, double sign) {
  return (m - sign * m.transpose()).cwiseAbs().maxCoeff() <= kRounding * m.cwiseAbs().maxCoeff();
}

double largestEigenvalue(const Eigen::MatrixXd& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// R^-1 m S^-T of lower triangles R and S.
Eigen::MatrixXd between(const Eigen::MatrixXd& r, const Eigen::MatrixXd& m,
                        const Eigen::MatrixXd& s) {
  const Eigen::MatrixXd left = r.triangularView<Eigen::Lower>().solve(m);
  return s.triangularView<Eigen::Lower>().solve(left.transpose()).transpose();
}

}  // namespace

std::optional<SteadyWhirl> SteadyWhirl::of(const Dynamics& dynamics,
                                           const std::vector<Station>& stations, double speed) {
  const LinearRotor rotor = dynamics.linearRotor();
  const bool once_a_turn = std::all_of(rotor.forces.begin(), rotor.forces.end(),
                                       [](const ShaftForce& f) { return f.harmonic == 1; });
  const Linearization l = rotor.matrices(speed);
  const Eigen::LLT<Eigen::MatrixXd> mass(l.mass);
  const Eigen::LLT<Eigen::MatrixXd> stiffness(l.stiffness);
  if (!once_a_turn || !symmetric(l.mass, 1.0) || !symmetric(l.stiffness, 1.0) ||
      !symmetric(l.gyroscopic, -1.0) || mass.info() != Eigen::Success ||
      stiffness.info() != Eigen::Success) {
    return std::nullopt;
  }
  SteadyWhirl steady;
  steady.speed_ = speed;
  steady.mass_root_ = mass.matrixL();
  steady.stiffness_root_ = stiffness.matrixL();
  const Eigen::Index n = l.mass.rows();
  const Eigen::MatrixXd damping = between(steady.mass_root_, l.damping, steady.mass_root_);
  const Eigen::MatrixXd turning = between(steady.mass_root_, l.circulatory, steady.stiffness_root_);
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  rate.topRightCorner(n, n) = -0.5 * turning.transpose();
  rate.bottomLeftCorner(n, n) = -0.5 * turning;
  rate.bottomRightCorner(n, n) = -0.5 * (damping + damping.transpose());
  steady.growth_ = std::max(0.0, largestEigenvalue(rate));
  steady.sag_ = Eigen::PartialPivLU<Eigen::MatrixXd>(l.stiffness + l.circulatory).solve(rotor.load);
  steady.response_ = Eigen::PartialPivLU<Eigen::MatrixXcd>(synchronousStiffness(l, speed))
                         .solve(rotor.synchronousForce(speed));
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
  Eigen::MatrixXd along(station.along_x.size(), 2);
  along << station.along_x, station.along_y;
  const Eigen::MatrixXd reach = stiffness_root_.triangularView<Eigen::Lower>().solve(along);
  const double furthest = std::sqrt(largestEigenvalue(reach.transpose() * reach));
  StationBound found;
  const double beside_turning = kPartOfTurning * forward - (backward + sag);
  const double beside_sag = kPartOfSag * sag - (forward + backward);
  found.keeps = beside_turning > beside_sag ? Kept::kLag : Kept::kDirection;
  const double room = std::max(beside_turning, beside_sag);
  found.largest_free = room / furthest;
  found.least_radius =
      found.keeps == Kept::kLag ? (1.0 - kPartOfTurning) * forward : (1.0 - kPartOfSag) * sag;
  return room > 0.0 && found.largest_free > 0.0 ? std::optional(found) : std::nullopt;
}

double SteadyWhirl::lasts(const double* q, const double* v, double angle) const {
  const auto n = sag_.size();
  const std::complex<double> turn = std::polar(1.0, angle);
  const std::complex<double> turning(-speed_ * turn.imag(), speed_ * turn.real());
  // y = (L_K^T e, L_M^T e'), row by row of the triangles.
  double square = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    double place = 0.0;
    double rate = 0.0;
    for (Eigen::Index j = i; j < n; ++j) {
      const std::complex<double> x = response_[j];
      place += stiffness_root_(j, i) *
               (q[j] - sag_[j] - (x.real() * turn.real() - x.imag() * turn.imag()));
      rate += mass_root_(j, i) * (v[j] - (x.real() * turning.real() - x.imag() * turning.imag()));
    }
    square += place * place + rate * rate;
  }
  const double free = std::sqrt(square);
  double least = std::numeric_limits<double>::infinity();
  for (const StationBound& station : stations_) {
    least = std::min(least, station.largest_free);
  }
  if (!(free < least)) {
    return 0.0;
  }
  return growth_ > 0.0 ? std::log(least / free) / growth_ : std::numeric_limits<double>::infinity();
}

}  // namespace whirl_twin
