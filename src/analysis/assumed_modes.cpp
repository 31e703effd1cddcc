#include "analysis/assumed_modes.h"

#include <fmt/format.h>

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

void requireIndependentShapes(const Eigen::MatrixXd& shapes, Eigen::Index coordinates) {
  if (shapes.rows() != coordinates || shapes.cols() < 1 || shapes.cols() > coordinates) {
    throw Refusal(
        fmt::format("assumed modes: expected 1 to {0} shapes of {0} entries, found {1} of {2}",
                    coordinates, shapes.cols(), shapes.rows()));
  }
  if (!shapes.allFinite()) {
    throw Refusal("assumed modes: expected finite entries");
  }
  const PivotedQr factors(shapes.colwise().normalized(), 1e-10);
  if (factors.rank() < shapes.cols() || shapes.colwise().squaredNorm().minCoeff() == 0.0) {
    throw Refusal(
        fmt::format("assumed modes: must be linearly independent shapes, found {} of rank {}",
                    shapes.cols(), factors.rank()));
  }
}

Eigen::MatrixXd projected(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& shapes) {
  return shapes.transpose() * matrix * shapes;
}

}  // namespace

Linearization reduced(const Linearization& system, const Eigen::MatrixXd& shapes) {
  requireIndependentShapes(shapes, system.mass.rows());
  return {projected(system.mass, shapes), projected(system.damping, shapes),
          projected(system.gyroscopic, shapes), projected(system.stiffness, shapes),
          projected(system.circulatory, shapes)};
}

RitzModes ritzModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                    const Eigen::MatrixXd& shapes) {
  requireSameSize(mass, stiffness);
  requireIndependentShapes(shapes, mass.rows());
  RitzModes ritz;
  ritz.mass = projected(mass, shapes);
  ritz.stiffness = projected(stiffness, shapes);
  ritz.assumed = naturalModes(ritz.mass, ritz.stiffness);
  ritz.shapes = shapes * ritz.assumed.shapes;
  return ritz;
}

}  // namespace whirl_twin
