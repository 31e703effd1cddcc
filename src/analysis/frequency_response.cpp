#include "analysis/frequency_response.h"

#include <fmt/format.h>

#include <cmath>

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kSingularReturn = 1e-13;  // a few hundred roundings of terms of size 1

}  // namespace

Eigen::MatrixXcd receptance(const Linearization& system, double frequency) {
  const double w = frequency;
  if (!std::isfinite(w)) {
    throw Refusal("frequency response: expected a finite frequency [rad/s]");
  }
  Eigen::MatrixXcd dynamic_stiffness(system.mass.rows(), system.mass.cols());
  dynamic_stiffness.real() = system.stiffness + system.circulatory - w * w * system.mass;
  dynamic_stiffness.imag() = w * (system.damping + system.gyroscopic);
  // Scaled by the largest term of each coordinate, the answer does not depend on units.
  const Eigen::ArrayXd terms = system.stiffness.diagonal().array().abs() +
                               w * w * system.mass.diagonal().array().abs() +
                               std::abs(w) * system.damping.diagonal().array().abs();
  const Eigen::VectorXd scale =
      (terms > 0.0).select(terms.max(1e-300).rsqrt(), Eigen::ArrayXd::Ones(terms.size()));
  const Eigen::MatrixXcd scaled = scale.asDiagonal() * dynamic_stiffness * scale.asDiagonal();
  const Eigen::VectorXd singular = singularValues(scaled);
  if (!(singular.minCoeff() > kSingularReturn)) {
    if (w == 0.0) {
      throw RunFailure(
          "frequency response: a constant force has no steady response: the stiffness is singular, "
          "and the force accelerates the system instead of deflecting it");
    }
    throw RunFailure(
        fmt::format("frequency response: undamped resonance at {:.6g} rad/s: the response grows "
                    "with time and has no steady amplitude",
                    w));
  }
  return scale.asDiagonal() * ComplexLu(scaled).inverse() * scale.asDiagonal();
}

Eigen::VectorXcd steadyResponse(const Linearization& system, const Eigen::VectorXcd& force,
                                double frequency) {
  if (force.size() != system.mass.rows()) {
    throw Refusal(fmt::format("frequency response: expected a force of {} entries, found {}",
                              system.mass.rows(), force.size()));
  }
  return receptance(system, frequency) * force;
}

}  // namespace whirl_twin
