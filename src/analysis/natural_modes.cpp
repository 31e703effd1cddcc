#include "analysis/natural_modes.h"

#include <fmt/format.h>

#include <stdexcept>

#include "algebra/dense.h"
#include "analysis/rigid_body_modes.h"

namespace whirl_twin {

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

}  // namespace whirl_twin
