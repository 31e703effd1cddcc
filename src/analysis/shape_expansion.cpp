#include "analysis/shape_expansion.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/dense.h"
#include "analysis/synchronous_response.h"

namespace whirl_twin {

namespace {

constexpr double kSameSpeed = 5.0e-3;      // of the speed: the shapes change no more than is seen
constexpr double kFreeStiffness = 1.0e-9;  // of the stiffness: what is less holds nothing
constexpr double kSamePlace = 1.0e-12;     // of what the places give, where they are but one

/// Of K, or, where that is singular or indefinite, of K plus a small multiple of the rotor's mass.
struct Holding {
  Cholesky factor;
  bool by_itself = true;
};

Holding holding(const Linearization& l) {
  const Eigen::VectorXd unit = l.stiffness.diagonal().cwiseAbs().cwiseSqrt();
  const Eigen::MatrixXd k = l.stiffness;
  Holding held{
      Cholesky(k - Eigen::MatrixXd((kFreeStiffness * unit.cwiseProduct(unit)).asDiagonal())), true};
  if (held.factor.succeeded()) {
    held.factor = Cholesky(k);
    return held;
  }
  held.by_itself = false;
  double added =
      kFreeStiffness * k.diagonal().cwiseAbs().cwiseQuotient(l.mass.diagonal()).maxCoeff();
  do {
    held.factor = Cholesky(k + added * l.mass);
    added *= 10.0;
  } while (!held.factor.succeeded() && std::isfinite(added));
  return held;
}

}  // namespace

ShapeExpansion::ShapeExpansion(LinearRotor rotor, const std::vector<Station>& seen)
    : rotor_(std::move(rotor)), places_(rotor_.dof(), 2 * static_cast<Eigen::Index>(seen.size())) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    places_.col(2 * static_cast<Eigen::Index>(i)) = seen[i].along_x;
    places_.col(2 * static_cast<Eigen::Index>(i) + 1) = seen[i].along_y;
  }
}

void ShapeExpansion::prepare(double speed) {
  const Linearization l = rotor_.matrices(speed);
  const Holding held = holding(l);
  resting_ = Eigen::VectorXd::Zero(rotor_.dof());
  steady_ = Eigen::VectorXcd::Zero(rotor_.dof());
  if (held.by_itself) {
    resting_ = held.factor.solve(rotor_.load);
    if (speed != 0.0 && hasSynchronousForce(rotor_)) {
      steady_ = synchronousResponse(rotor_, {}, speed).q;
    }
  }
  // Of unit forces there, and of the inertia of what they bend: nearly the lowest modes.
  const Eigen::MatrixXd bent = held.factor.solve(l.mass * held.factor.solve(places_));
  Eigen::MatrixXd given = places_.transpose() * bent;
  given.diagonal().array() += kSamePlace * given.trace();
  corrections_ =
      bent * Cholesky(given).solve(Eigen::MatrixXd::Identity(given.rows(), given.cols()));
  speed_ = speed;
  prepared_ = true;
}

Eigen::VectorXd ShapeExpansion::at(double angle, double speed, const Eigen::VectorXd& whirl) {
  if (!prepared_ || std::fabs(speed - speed_) > kSameSpeed * std::fabs(speed_)) {
    prepare(speed);
  }
  Eigen::VectorXd q = resting_;
  const Eigen::VectorXd steady = (steady_ * std::polar(1.0, angle)).real();
  const Eigen::VectorXd shown = places_.transpose() * steady;
  if (steady.allFinite() && shown.squaredNorm() > 0.0) {
    const double share = shown.dot(whirl - places_.transpose() * q) / shown.squaredNorm();
    q += std::clamp(share, 0.0, 1.0) * steady;
  }
  return q + corrections_ * (whirl - places_.transpose() * q);
}

}  // namespace whirl_twin
