#include "analysis/natural_modes.h"

#include <fmt/format.h>

#include <stdexcept>

#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

Eigen::VectorXd naturalUnits(const Dynamics& dynamics) {
  Eigen::VectorXd unit(dynamics.dof());
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    unit[i] = coordinates[static_cast<std::size_t>(i)].isAngle() ? 1.0 : dynamics.naturalLength();
  }
  return unit;
}

bool massIsSingular(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at) {
  const Eigen::MatrixXd mass = dynamics.massMatrix(q, v, at);
  const Eigen::VectorXd diagonal = mass.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) {
    return true;
  }
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  constexpr double kRounding = 1.0e-15;
  return !(symmetricEigenvalues(scale.asDiagonal() * mass * scale.asDiagonal())[0] > kRounding);
}

double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const EvaluationPoint<double>& at) {
  const Eigen::VectorXd all_units = naturalUnits(dynamics);
  const Eigen::VectorXd unit = all_units / all_units.maxCoeff();  // their ratio is what matters
  const Eigen::VectorXd values =
      symmetricEigenvalues(unit.asDiagonal() * dynamics.massMatrix(q, v, at) * unit.asDiagonal());
  const double largest = values.cwiseAbs().maxCoeff();
  return largest > 0.0 ? values[0] / largest : 0.0;
}

Eigen::MatrixXd rigidBodyModes(const Eigen::MatrixXd& stiffness) {
  if (definiteness(stiffness, "stiffness") == Definiteness::kIndefinite) {
    throw RunFailure(
        "stiffness: it is negative for some motion, so the position is statically unstable: a "
        "small "
        "displacement grows instead of vibrating");
  }
  const ScaledForm scaled = unitDiagonal(stiffness);
  const SymmetricModes<double> solver = symmetricModes(scaled.form);
  const Eigen::Index free = (solver.values.array() <= kZeroEigenvalue).count();
  if (free == 0) {
    return Eigen::MatrixXd(stiffness.rows(), 0);
  }
  const Eigen::MatrixXd motions = scaled.scale.asDiagonal() * solver.vectors.leftCols(free);
  return orthonormalBasis(motions.leftCols(free));
}

void requireSameSize(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  if (mass.rows() != stiffness.rows() || mass.cols() != stiffness.cols()) {
    throw std::logic_error(
        fmt::format("mass and stiffness: expected the same size, found {} x {} and {} x {}",
                    mass.rows(), mass.cols(), stiffness.rows(), stiffness.cols()));
  }
}

NaturalModes naturalModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  const Eigen::MatrixXd rigid = rigidBodyModes(stiffness);
  const Eigen::Index n = mass.rows();
  const Eigen::Index free = rigid.cols();
  NaturalModes modes;
  modes.rigid_body_modes = static_cast<int>(free);
  modes.frequencies = Eigen::VectorXd::Zero(n);
  modes.shapes.resize(n, n);

  // The elastic motions are those without momentum in any rigid-body mode, rigid^T m q = 0.
  Eigen::MatrixXd elastic = Eigen::MatrixXd::Identity(n, n);
  if (free > 0) {
    const Eigen::MatrixXd rigid_mass = rigid.transpose() * mass * rigid;
    // rigid (L^-1)^T is mass-normalised if L L^T = rigid_mass.
    modes.shapes.leftCols(free) = Cholesky(rigid_mass).solveLower(rigid.transpose()).transpose();
    elastic = orthogonalFactor(mass * rigid);
  }
  if (free == n) {
    return modes;
  }
  const Eigen::MatrixXd basis = elastic.rightCols(n - free);
  const Cholesky mass_factor(basis.transpose() * mass * basis);
  const Cholesky stiffness_factor(basis.transpose() * stiffness * basis);
  const Eigen::MatrixXd stiffness_root = stiffness_factor.lower();
  const SingularVectors solver = singularVectors(mass_factor.solveLower(stiffness_root));
  modes.frequencies.tail(n - free) = solver.values.reverse();
  modes.shapes.rightCols(n - free) = basis * mass_factor.solveUpper(solver.u).rowwise().reverse();
  return modes;
}

namespace {

void requireIndependentShapes(const Eigen::MatrixXd& shapes, Eigen::Index coordinates) {
  if (shapes.rows() != coordinates || shapes.cols() < 1 || shapes.cols() > coordinates) {
    throw InputError(
        fmt::format("assumed modes: expected 1 to {0} shapes of {0} entries, found {1} of {2}",
                    coordinates, shapes.cols(), shapes.rows()));
  }
  if (!shapes.allFinite()) {
    throw InputError("assumed modes: expected finite entries");
  }
  const PivotedQr factors(shapes.colwise().normalized(), 1e-10);
  if (factors.rank() < shapes.cols() || shapes.colwise().squaredNorm().minCoeff() == 0.0) {
    throw InputError(
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
