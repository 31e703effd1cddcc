#include "analysis/quadratic_form.h"

#include <fmt/format.h>

#include "algebra/banded_matrix.h"
#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

Eigen::VectorXd scaledEigenvalues(const Eigen::MatrixXd& form) {
  return symmetricEigenvalues(unitDiagonal(form).form);
}

}  // namespace

void requireSymmetric(const Eigen::MatrixXd& form, const std::string& name) {
  std::string found;
  if (form.rows() != form.cols() || form.rows() == 0) {
    found = fmt::format("one of size {} x {}", form.rows(), form.cols());
  } else if (!form.allFinite()) {
    found = "an entry that is not finite";
  } else {
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    const double asymmetry = (form - form.transpose()).cwiseAbs().maxCoeff(&row, &column);
    if (asymmetry <= 1e-9 * form.cwiseAbs().maxCoeff()) {
      return;
    }
    found = fmt::format("{} in row {}, column {} and {} opposite to it", form(row, column), row + 1,
                        column + 1, form(column, row));
  }
  throw InputError(
      fmt::format("{}: expected a symmetric matrix of finite numbers, found {}", name, found));
}

ScaledForm unitDiagonal(const Eigen::MatrixXd& form) {
  const Eigen::ArrayXd diagonal = form.diagonal().array().abs();
  const Eigen::VectorXd scale =
      (diagonal > 0.0).select(diagonal.max(1e-300).rsqrt(), Eigen::ArrayXd::Ones(diagonal.size()));
  return {scale.asDiagonal() * form * scale.asDiagonal(), scale};
}

Definiteness definiteness(const Eigen::MatrixXd& form, const std::string& name) {
  requireSymmetric(form, name);
  // By Cholesky factorizations of the form without and with so much stiffness more: of a chain
  // they cost no more than in proportion to its length.
  auto shifted = BandedMatrix<double>::of(unitDiagonal(form).form);
  const auto shift = [&](double by) {
    for (Eigen::Index i = 0; i < shifted.size(); ++i) {
      shifted(i, i) += by;
    }
  };
  shift(-kZeroEigenvalue);
  if (hasCholesky(shifted)) {
    return Definiteness::kPositiveDefinite;
  }
  shift(2.0 * kZeroEigenvalue);
  return hasCholesky(shifted) ? Definiteness::kPositiveSemidefinite : Definiteness::kIndefinite;
}

void requirePositiveDefinite(const Eigen::MatrixXd& form, const std::string& name) {
  const Definiteness found = definiteness(form, name);
  if (found != Definiteness::kPositiveDefinite) {
    throw InputError(fmt::format(
        "{}: expected a positive definite matrix, found one that is {} for some motion (smallest "
        "eigenvalue, scaled to unit diagonal: {:.3g})",
        name, found == Definiteness::kPositiveSemidefinite ? "zero" : "negative",
        scaledEigenvalues(form)[0]));
  }
}

}  // namespace whirl_twin
