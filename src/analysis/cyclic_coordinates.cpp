#include "analysis/cyclic_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/banded_matrix.h"
#include "algebra/dense.h"
#include "analysis/quadratic_form.h"
#include "analysis/stability_margins.h"

namespace whirl_twin {

namespace {

/// Singular values of a stiffness below this part of the largest are rounding.
constexpr double kRank = 1.0e-12;
/// What damping and gyroscopic forces leave of a motion, of their largest: less is rounding.
constexpr double kResisted = 1.0e-11;
constexpr double kSurelyDefinite = 1.0e-9;  // a pivot of the unit-diagonal form

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

CyclicCoordinates ofNonlinear(const Dynamics& dynamics, const EvaluationPoint<double>& at) {
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

/// Is a symmetric matrix positive definite beyond doubt? Of its unit-diagonal form.
bool surelyDefinite(const Eigen::MatrixXd& symmetric) {
  if (!(symmetric.diagonal().array() > 0.0).all() || !symmetric.allFinite()) {
    return false;
  }
  return hasCholesky(BandedMatrix<double>::of(unitDiagonal(symmetric).form), kSurelyDefinite);
}

/// A turn of the columns of all images among themselves, those that some image keeps first and
/// those that every image leaves at zero last; how many the former are.
std::pair<Eigen::MatrixXd, Eigen::Index> resistedFirst(const std::vector<Eigen::MatrixXd>& images) {
  const Eigen::Index count = images.front().cols();
  Eigen::MatrixXd all(0, count);
  for (const Eigen::MatrixXd& image : images) {
    all.conservativeResize(all.rows() + image.rows(), Eigen::NoChange);
    all.bottomRows(image.rows()) = image;
  }
  const SingularVectors svd = singularVectors(all);
  return {svd.v, (svd.values.array() > kResisted).count()};
}

/// A matrix in units of its largest entry.
Eigen::MatrixXd inItsSize(const Eigen::MatrixXd& m) {
  const double largest = m.cwiseAbs().maxCoeff();
  return largest > 0.0 ? Eigen::MatrixXd(m / largest) : m;
}

CyclicCoordinates allShape(Eigen::Index n) {
  CyclicCoordinates all;
  all.basis = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    all.shape.push_back(i);
  }
  return all;
}

}  // namespace

CyclicCoordinates rigidBodyMotions(const Linearization& l) {
  const Eigen::Index n = l.mass.rows();
  if (surelyDefinite(l.stiffness)) {  // and K + N with it, as N takes no part in q^T (K + N) q
    return allShape(n);
  }
  // Scaled so that a soft coordinate next to a stiff one is not mistaken for a free one.
  const Eigen::MatrixXd stiffness = l.stiffness + l.circulatory;
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double largest =
        std::max(stiffness.row(i).cwiseAbs().maxCoeff(), stiffness.col(i).cwiseAbs().maxCoeff());
    scale[i] = largest > 0.0 ? 1.0 / std::sqrt(largest) : 1.0;
  }
  const Eigen::MatrixXd by_q = scale.asDiagonal() * stiffness * scale.asDiagonal();
  const SingularVectors svd = singularVectors(by_q);
  const Eigen::Index rank = (svd.values.array() > kRank * svd.values[0]).count();
  if (rank == n) {
    return allShape(n);
  }
  const Eigen::MatrixXd by_v =
      inItsSize(scale.asDiagonal() * (l.damping + l.gyroscopic) * scale.asDiagonal());
  const Eigen::MatrixXd modes = svd.v.rightCols(n - rank);
  const auto [turn, driven] =
      resistedFirst({by_v * modes, by_v.transpose() * modes, inItsSize(by_q).transpose() * modes});
  CyclicCoordinates all;
  Eigen::MatrixXd directions = svd.v;
  directions.rightCols(n - rank) = modes * turn;
  all.basis = scale.asDiagonal() * directions;
  for (Eigen::Index i = 0; i < n; ++i) {
    (i < rank ? all.shape : i < rank + driven ? all.driven : all.conserved).push_back(i);
  }
  return all;
}

CyclicCoordinates cyclicCoordinates(const Dynamics& dynamics, double speed) {
  const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
  const Dynamics& mean = dynamics.atMeanLoad();
  if (!mean.linear()) {
    return ofNonlinear(mean, at);
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mean.dof());
  return rigidBodyMotions(mean.linearization(zero, zero, zero, at));
}

Linearization atFixedMomenta(const Linearization& full, const CyclicCoordinates& cyclic) {
  const auto in_basis = [&](const Eigen::MatrixXd& m) -> Eigen::MatrixXd {
    return cyclic.basis.transpose() * m * cyclic.basis;
  };
  const Eigen::MatrixXd mass = in_basis(full.mass);
  const Eigen::MatrixXd by_v = in_basis(full.damping + full.gyroscopic);
  Eigen::MatrixXd by_q = in_basis(full.stiffness + full.circulatory);
  // Zero remains zero: rounding must not make damping of a motion without.
  const bool undamped = full.damping.isZero(0.0);
  const bool potential = full.circulatory.isZero(0.0);
  const auto& c = cyclic.conserved;
  CyclicCoordinates::Places s = cyclic.shape;
  s.insert(s.end(), cyclic.driven.begin(), cyclic.driven.end());
  for (const Eigen::Index i : cyclic.driven) {
    by_q.col(i).setZero();  // of a rigid-body mode it is so but for rounding
    if (potential) {
      by_q.row(i).setZero();
    }
  }
  Eigen::MatrixXd m = mass(s, s);
  Eigen::MatrixXd d = by_v(s, s);
  Eigen::MatrixXd k = by_q(s, s);
  if (!c.empty()) {
    // M_cc v_c + M_cs v_s + (D_cs) q_s = 0 to first order: the momenta are constant.
    const Ldlt inertia{Eigen::MatrixXd(mass(c, c))};
    const Eigen::MatrixXd by_rate = inertia.solve(Eigen::MatrixXd(mass(c, s)));
    const Eigen::MatrixXd by_place = inertia.solve(Eigen::MatrixXd(by_v(c, s)));
    m -= mass(s, c) * by_rate;
    d -= mass(s, c) * by_place + by_v(s, c) * by_rate;
    k -= by_v(s, c) * by_place;
  }
  Linearization l{0.5 * (m + m.transpose()), 0.5 * (d + d.transpose()), 0.5 * (d - d.transpose()),
                  0.5 * (k + k.transpose()), 0.5 * (k - k.transpose())};
  if (undamped) {  // by_v is skew, and so is the reduced matrix
    l.damping.setZero();
    if (potential) {
      l.circulatory.setZero();
    }
  }
  return l;
}

std::size_t zeroEigenvalues(const Linearization& linearization, const CyclicCoordinates& cyclic) {
  std::size_t zeros = 2 * cyclic.conserved.size() + cyclic.driven.size();
  if (cyclic.driven.empty()) {
    return zeros;
  }
  // A driven motion at a constant rate that nothing resists but the shape, which gives way.
  const Linearization l = atFixedMomenta(linearization, cyclic);
  const auto shapes = static_cast<Eigen::Index>(cyclic.shape.size());
  const auto driven = static_cast<Eigen::Index>(cyclic.driven.size());
  const Eigen::MatrixXd by_q = l.stiffness + l.circulatory;
  const Eigen::MatrixXd by_rate = (l.damping + l.gyroscopic).rightCols(driven);
  Eigen::MatrixXd resisted = by_rate.bottomRows(driven);
  if (shapes > 0) {
    resisted -= by_q.bottomLeftCorner(driven, shapes) *
                Lu(by_q.topLeftCorner(shapes, shapes)).solve(by_rate.topRows(shapes));
  }
  const double none = kResisted * by_rate.cwiseAbs().maxCoeff();
  return zeros + static_cast<std::size_t>((singularValues(resisted).array() <= none).count());
}

Stability reducedStability(const Linearization& linearization, const CyclicCoordinates& cyclic,
                           std::size_t modes) {
  if (!cyclic.any()) {
    return stability(linearization, 0, modes);
  }
  if (cyclic.shape.empty() && cyclic.driven.empty()) {
    Stability free;  // no other coordinate can move
    free.routh.verdict = Verdict::kMarginal;
    free.damping_ratio = free.log_decrement = std::numeric_limits<double>::quiet_NaN();
    return free;
  }
  return stability(atFixedMomenta(linearization, cyclic), cyclic.driven.size(), modes);
}

Stability stabilityWithRigidBodyModes(const Linearization& linearization,
                                      const CyclicCoordinates& cyclic, std::size_t modes) {
  if (!cyclic.any()) {
    return stability(linearization, 0, modes);
  }
  Stability s = reducedStability(linearization, cyclic, modes);
  const std::size_t set_aside = 2 * cyclic.conserved.size() + cyclic.driven.size();
  if (s.eigenvalues.empty() && linearization.mass.rows() <= kMaxExactCoordinates) {
    s.polynomial = {1.0};
  }
  s.eigenvalues.insert(s.eigenvalues.begin(), set_aside, 0.0);
  if (!s.polynomial.empty()) {
    s.polynomial.insert(s.polynomial.end(), set_aside, 0.0);
  }
  s.routh.imaginary += static_cast<int>(set_aside);
  s.routh.largest_imaginary_multiplicity =
      std::max(s.routh.largest_imaginary_multiplicity, static_cast<int>(set_aside));
  if (s.routh.verdict == Verdict::kAsymptoticallyStable || s.routh.verdict == Verdict::kMarginal) {
    // A conserved momentum moves its coordinate along, as does a rate that nothing resists.
    const bool drifts =
        !cyclic.conserved.empty() || zeroEigenvalues(linearization, cyclic) > set_aside;
    s.routh.verdict = drifts ? Verdict::kRepeatedImaginary : Verdict::kMarginal;
    s.decay_rate = 0.0;
    s.damping_ratio = std::isnan(s.damping_ratio) ? s.damping_ratio : 0.0;
    s.log_decrement = logDecrement(s.damping_ratio);
  }
  return s;
}

}  // namespace whirl_twin
