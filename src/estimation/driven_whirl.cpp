#include "estimation/driven_whirl.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kHalfBand = 3.0e-3;  // of the lowest natural frequency

/// q' = v, v' = -M^-1 ((K + N) q + (C + G) v).
Eigen::MatrixXd stateMatrix(const Linearization& at) {
  const Eigen::Index n = at.mass.rows();
  const Lu mass(at.mass);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -mass.solve(at.stiffness + at.circulatory);
  a.bottomRightCorner(n, n) = -mass.solve(at.damping + at.gyroscopic);
  return a;
}

}  // namespace

DrivenWhirl::DrivenWhirl(const LinearRotor& rotor, const std::vector<ShaftForce>& forces)
    : rotor_(rotor), forces_(rotor.dof(), static_cast<Eigen::Index>(forces.size())) {
  for (std::size_t j = 0; j < forces.size(); ++j) {
    forces_.col(static_cast<Eigen::Index>(j)) = forces[j].amplitude;
    inertial_.push_back(forces[j].inertial);
  }
  setModes(0.0);
  const Eigen::ArrayXd sizes = middle_.cwiseAbs();
  double lowest = sizes.maxCoeff();
  for (const double size : sizes) {
    lowest = size > 1.0e-6 * sizes.maxCoeff() ? std::min(lowest, size) : lowest;
  }
  half_band_ = kHalfBand * lowest;
}

void DrivenWhirl::setModes(double centre) {
  const Eigen::Index n = rotor_.dof();
  const Linearization at = rotor_.matrices(centre);
  const EigenPairs eigen = eigenPairs(stateMatrix(at));
  centre_ = centre;
  middle_ = eigen.values;
  shapes_ = eigen.vectors;
  inverse_ = ComplexLu(shapes_).inverse();
  if (!inverse_.allFinite()) {
    throw RunFailure("the rotor has critically damped modes without independent mode shapes");
  }
  slope_ = Eigen::VectorXcd::Zero(middle_.size());
  if (rotor_.speed_dependent && half_band_ > 0.0) {
    const Eigen::MatrixXd change = (stateMatrix(rotor_.matrices(centre + half_band_)) -
                                    stateMatrix(rotor_.matrices(centre - half_band_))) /
                                   (2.0 * half_band_);
    slope_ = (inverse_ * change.cast<std::complex<double>>() * shapes_).diagonal();
  }
  const ComplexLu mass(at.mass.cast<std::complex<double>>());
  excitation_ = inverse_.rightCols(n) * mass.solve(forces_);
}

/// The modes of the band of a speed.
void DrivenWhirl::setSpeed(double speed) {
  constexpr double kBeyond = 1.2;  // so that a speed at the edge does not go to and fro
  speed_ = speed;
  if (!rotor_.speed_dependent || std::fabs(speed - centre_) < kBeyond * half_band_) {
    return;
  }
  const Eigen::MatrixXcd state = shapes_ * modal_;
  setModes(2.0 * half_band_ * std::round(speed / (2.0 * half_band_)));
  modal_ = inverse_ * state;
}

void DrivenWhirl::start(double speed) {
  modal_ = Eigen::MatrixXcd::Zero(middle_.size(), forces_.cols());
  setSpeed(speed);
  for (Eigen::Index k = 0; k < modal_.rows(); ++k) {
    const std::complex<double> away =
        kImaginaryUnit * speed - middle_[k] - slope_[k] * (speed - centre_);
    for (Eigen::Index j = 0; j < modal_.cols(); ++j) {
      const double factor = inertial_[static_cast<std::size_t>(j)] ? speed * speed : 1.0;
      modal_(k, j) = away == 0.0 ? 0.0 : excitation_(k, j) * factor / away;
    }
  }
}

void DrivenWhirl::advance(double time, double turn, double speed) {
  const double before = speed_;
  const double mean = turn / time;
  setSpeed(speed);
  // Of theta = mean t + ((speed - before) / (2 time)) t (t - time) the second part is small: its
  // mean.
  const std::complex<double> bent = 1.0 - kImaginaryUnit * (speed - before) * time / 12.0;
  const std::complex<double> turned = std::polar(1.0, turn);
  for (Eigen::Index k = 0; k < modal_.rows(); ++k) {
    const std::complex<double> s = middle_[k] + slope_[k] * (0.5 * (before + speed) - centre_);
    const std::complex<double> decayed = std::exp(s * time);
    const std::complex<double> away = kImaginaryUnit * mean - s;
    const bool resonant = std::abs(away) * time < 1.0e-7;
    const std::complex<double> steady =
        resonant ? time * decayed : (turned - decayed) / away * bent;
    // -(e^(i theta))'' by parts.
    const std::complex<double> inertial =
        -(kImaginaryUnit * speed * turned - kImaginaryUnit * before * decayed) -
        s * (turned - decayed) - s * s * steady;
    for (Eigen::Index j = 0; j < modal_.cols(); ++j) {
      const std::complex<double> pushed =
          inertial_[static_cast<std::size_t>(j)] ? inertial : steady;
      modal_(k, j) = (decayed * modal_(k, j) + excitation_(k, j) * pushed) / turned;
    }
  }
}

}  // namespace whirl_twin
