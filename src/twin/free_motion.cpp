#include "twin/free_motion.h"

#include <algorithm>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Part of a matrix that may be other than its mirror image.
constexpr double kRounding = 1.0e-12;

bool symmetric(const Eigen::MatrixXd& m, double sign) {
  return (m - sign * m.transpose()).cwiseAbs().maxCoeff() <= kRounding * m.cwiseAbs().maxCoeff();
}

double largestEigenvalue(const Eigen::MatrixXd& m) {
  return symmetricEigenvalues(m).maxCoeff();
}

double squareOfNorm(const Eigen::MatrixXd& m) {
  return largestEigenvalue(m.transpose() * m);
}

/// R^-1 m S^-T of lower triangles R and S.
Eigen::MatrixXd between(const Eigen::MatrixXd& r, const Eigen::MatrixXd& m,
                        const Eigen::MatrixXd& s) {
  const Eigen::MatrixXd left = r.triangularView<Eigen::Lower>().solve(m);
  return s.triangularView<Eigen::Lower>().solve(left.transpose()).transpose();
}

/// Of a place, for a motion whose length is that by R^T.
double largest(const Station& at, const Eigen::MatrixXd& r) {
  Eigen::MatrixXd along(at.along_x.size(), 2);
  along << at.along_x, at.along_y;
  const Eigen::MatrixXd reach = r.triangularView<Eigen::Lower>().solve(along);
  return std::sqrt(largestEigenvalue(reach.transpose() * reach));
}

}  // namespace

std::optional<FreeMotion> FreeMotion::of(const Linearization& l) {
  const Cholesky mass(l.mass);
  const Cholesky stiffness(l.stiffness);
  if (!symmetric(l.mass, 1.0) || !symmetric(l.stiffness, 1.0) || !symmetric(l.gyroscopic, -1.0) ||
      !mass.succeeded() || !stiffness.succeeded()) {
    return std::nullopt;
  }
  FreeMotion free;
  free.mass_root_ = mass.lower();
  free.stiffness_root_ = stiffness.lower();
  const Eigen::Index n = l.mass.rows();
  const Eigen::MatrixXd damping = between(free.mass_root_, l.damping, free.mass_root_);
  const Eigen::MatrixXd turning = between(free.mass_root_, l.circulatory, free.stiffness_root_);
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  rate.topRightCorner(n, n) = -0.5 * turning.transpose();
  rate.bottomLeftCorner(n, n) = -0.5 * turning;
  rate.bottomRightCorner(n, n) = -0.5 * (damping + damping.transpose());
  free.growth_ = std::max(0.0, largestEigenvalue(rate));
  const Eigen::MatrixXd of_place =
      between(free.mass_root_, l.stiffness + l.circulatory, free.stiffness_root_);
  const Eigen::MatrixXd of_rate =
      between(free.mass_root_, l.damping + l.gyroscopic, free.mass_root_);
  free.pull_ = std::sqrt(squareOfNorm(of_place) + squareOfNorm(of_rate));
  return free;
}

double FreeMotion::furthest(const Station& at) const {
  return largest(at, stiffness_root_);
}

double FreeMotion::fastest(const Station& at) const {
  return largest(at, mass_root_);
}

double FreeMotion::pushed(const Eigen::VectorXcd& force) const {
  Eigen::MatrixXd parts(force.size(), 2);
  parts << force.real(), force.imag();
  return mass_root_.triangularView<Eigen::Lower>().solve(parts).norm();
}

}  // namespace whirl_twin
