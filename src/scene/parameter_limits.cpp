#include "scene/parameter_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "analysis/mass_matrix.h"

namespace whirl_twin {

namespace {

/// The matrices of more coordinates take longer to make than anything else that a reader does.
constexpr int kMostCoordinates = 400;

double largestOf(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) {
    return 0.0;
  }
  return matrix.allFinite() ? matrix.cwiseAbs().maxCoeff()
                            : std::numeric_limits<double>::infinity();
}

/// [1/s]; 0 where there is none that is known.
double largestRate(const Dynamics& dynamics, const SystemSpec& spec, double speed) {
  const auto n = static_cast<Eigen::Index>(spec.q.size());
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(spec.q.data(), n);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const Moment<double> at{0.0, 0.0, speed, 0.0};
  if (massIsSingular(dynamics, q, zero, at)) {  // by its numbers, or at this place
    return dynamics.singularMass().empty() ? std::numeric_limits<double>::infinity() : 0.0;
  }
  const Linearization matrices = dynamics.linearization(q, zero, zero, at);
  if (!matrices.mass.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
  const double mass = matrices.mass.diagonal().cwiseAbs().minCoeff();
  const double damping = std::max(largestOf(matrices.damping), largestOf(matrices.gyroscopic));
  const double stiffness = std::max(largestOf(matrices.stiffness), largestOf(matrices.circulatory));
  return std::max(damping / mass, std::sqrt(stiffness / mass));
}

}  // namespace

std::string objectionToRates(const Dynamics& dynamics, const SystemSpec& spec, double speed) {
  if (dynamics.dof() > kMostCoordinates) {
    return "";
  }
  double rate = 0.0;
  try {
    rate = largestRate(dynamics, spec, speed);
  } catch (const std::exception&) {  // it has no small deviations from there
  }
  return rate <= kLargestRate ? ""
                              : fmt::format(
                                    "together give a fastest rate of {:.2g} 1/s: above {:.0e} 1/s "
                                    "the equations overflow",
                                    rate, kLargestRate);
}

}  // namespace whirl_twin
