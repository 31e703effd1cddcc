#include "analysis/cyclic_coordinates.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

/// Singular values of a stiffness below this part of the largest are rounding.
constexpr double kRank = 1.0e-12;

/// States in general position, without symmetry: fast, slow and at rest, far and near, so that no
/// law that levels off, such as dry friction, is met only where it is level.
struct Anywhere {
  Eigen::VectorXd q, v, a;
};

std::vector<Anywhere> places(Eigen::Index n) {
  return {
      {Eigen::VectorXd::LinSpaced(n, 0.7, 1.3), Eigen::VectorXd::LinSpaced(n, 0.9, -1.7),
       Eigen::VectorXd::LinSpaced(n, -0.4, 1.1)},
      {Eigen::VectorXd::LinSpaced(n, -1.1, 2.3), Eigen::VectorXd::LinSpaced(n, -0.6, 1.2),
       Eigen::VectorXd::LinSpaced(n, 1.9, 0.3)},
      {Eigen::VectorXd::LinSpaced(n, 0.07, 0.23), Eigen::VectorXd::LinSpaced(n, -0.6e-3, 1.2e-3),
       Eigen::VectorXd::LinSpaced(n, 0.5, -0.8)},
      {Eigen::VectorXd::LinSpaced(n, -0.02, 0.013), Eigen::VectorXd::Zero(n),
       Eigen::VectorXd::Zero(n)}};
}

CyclicCoordinates ofNonlinear(const Dynamics& dynamics, const Moment<double>& at) {
  const Eigen::Index n = dynamics.dof();
  CyclicCoordinates all;
  all.basis = Eigen::MatrixXd::Identity(n, n);
  std::vector<bool> cyclic(static_cast<std::size_t>(n), true);
  std::vector<bool> free = cyclic;
  for (const Anywhere& x : places(n)) {
    const Linearization l = dynamics.linearization(x.q, x.v, x.a, at);
    const Eigen::MatrixXd by_q = l.stiffness + l.circulatory;
    const Eigen::VectorXd applied = dynamics.appliedForce(x.q, x.v, at);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto place = static_cast<std::size_t>(i);
      cyclic[place] = cyclic[place] && (by_q.col(i).array() == 0.0).all();
      free[place] = free[place] && applied[i] == 0.0;
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto place = static_cast<std::size_t>(i);
    (!cyclic[place] ? all.shape : free[place] ? all.conserved : all.driven).push_back(i);
  }
  return all;
}

CyclicCoordinates ofLinear(const Dynamics& dynamics, const Moment<double>& at) {
  const Eigen::Index n = dynamics.dof();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const Linearization l = dynamics.linearization(zero, zero, zero, at);
  // Scaled so that a soft coordinate beside a stiff one is not taken for a free one.
  const Eigen::MatrixXd stiffness = l.stiffness + l.circulatory;
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double largest =
        std::max(stiffness.row(i).cwiseAbs().maxCoeff(), stiffness.col(i).cwiseAbs().maxCoeff());
    scale[i] = largest > 0.0 ? 1.0 / std::sqrt(largest) : 1.0;
  }
  const Eigen::MatrixXd by_q = scale.asDiagonal() * stiffness * scale.asDiagonal();
  const Eigen::MatrixXd by_v = scale.asDiagonal() * (l.damping + l.gyroscopic) * scale.asDiagonal();
  CyclicCoordinates all;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(by_q, Eigen::ComputeFullV);
  const double largest = svd.singularValues()[0];
  Eigen::Index rank = 0;
  while (rank < n && svd.singularValues()[rank] > kRank * largest) {
    ++rank;
  }
  const Eigen::MatrixXd modes = svd.matrixV().rightCols(n - rank);
  all.basis = rank < n ? Eigen::MatrixXd(scale.asDiagonal() * svd.matrixV())
                       : Eigen::MatrixXd::Identity(n, n);
  const double small = kRank * std::max(by_v.cwiseAbs().maxCoeff(), 1.0e-300);
  const bool free = rank < n && (by_v * modes).cwiseAbs().maxCoeff() <= small &&
                    (modes.transpose() * by_v).cwiseAbs().maxCoeff() <= small &&
                    (modes.transpose() * by_q).cwiseAbs().maxCoeff() <= kRank * largest;
  for (Eigen::Index i = 0; i < n; ++i) {
    (i < rank ? all.shape : free ? all.conserved : all.driven).push_back(i);
  }
  return all;
}

}  // namespace

CyclicCoordinates cyclicCoordinates(const Dynamics& dynamics, double speed) {
  const Moment<double> at{0.0, 0.0, speed, 0.0};
  const Dynamics& mean = dynamics.atMeanLoad();
  return mean.linear() ? ofLinear(mean, at) : ofNonlinear(mean, at);
}

Linearization atFixedMomenta(const Linearization& full, const CyclicCoordinates& cyclic) {
  const auto in_basis = [&](const Eigen::MatrixXd& m) -> Eigen::MatrixXd {
    return cyclic.basis.transpose() * m * cyclic.basis;
  };
  const Eigen::MatrixXd mass = in_basis(full.mass);
  const Eigen::MatrixXd by_v = in_basis(full.damping + full.gyroscopic);
  Eigen::MatrixXd by_q = in_basis(full.stiffness + full.circulatory);
  const auto& c = cyclic.conserved;
  CyclicCoordinates::Places s = cyclic.shape;
  s.insert(s.end(), cyclic.driven.begin(), cyclic.driven.end());
  for (const Eigen::Index i : cyclic.driven) {
    by_q.col(i).setZero();  // of a rigid-body mode it is so but for rounding
  }
  Eigen::MatrixXd m = mass(s, s);
  Eigen::MatrixXd d = by_v(s, s);
  Eigen::MatrixXd k = by_q(s, s);
  if (!c.empty()) {
    // M_cc v_c + M_cs v_s + (D_cs) q_s = 0 to first order: the momenta stay what they are.
    const Eigen::LDLT<Eigen::MatrixXd> inertia{Eigen::MatrixXd(mass(c, c))};
    const Eigen::MatrixXd by_rate = inertia.solve(Eigen::MatrixXd(mass(c, s)));
    const Eigen::MatrixXd by_place = inertia.solve(Eigen::MatrixXd(by_v(c, s)));
    m -= mass(s, c) * by_rate;
    d -= mass(s, c) * by_place + by_v(s, c) * by_rate;
    k -= by_v(s, c) * by_place;
  }
  return {0.5 * (m + m.transpose()), 0.5 * (d + d.transpose()), 0.5 * (d - d.transpose()),
          0.5 * (k + k.transpose()), 0.5 * (k - k.transpose())};
}

Stability reducedStability(const Linearization& linearization, const CyclicCoordinates& cyclic) {
  if (!cyclic.any()) {
    return stability(linearization);
  }
  if (cyclic.shape.empty() && cyclic.driven.empty()) {
    Stability free;  // nothing is left that could move otherwise
    free.routh.verdict = Verdict::kMarginal;
    free.damping_ratio = free.log_decrement = std::numeric_limits<double>::quiet_NaN();
    return free;
  }
  return stability(atFixedMomenta(linearization, cyclic), cyclic.driven.size());
}

}  // namespace whirl_twin
