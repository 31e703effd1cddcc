#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// A right-hand side of one column goes by the solver of vectors, which is faster.
template <class Factors, class Scalar>
DenseMatrix<Scalar> solutionWith(const Factors& factors, const DenseArgument<Scalar>& b) {
  if (b.cols() == 1) {
    return factors.solve(b.col(0));
  }
  return factors.solve(b);
}

}  // namespace

template <class Scalar>
LuFactors<Scalar>::LuFactors(const DenseArgument<Scalar>& a)
    : factors_(std::make_shared<const Eigen::PartialPivLU<DenseMatrix<Scalar>>>(a)) {}
template <class Scalar>
DenseMatrix<Scalar> LuFactors<Scalar>::solution(const DenseArgument<Scalar>& b) const {
  return solutionWith(*factors_, b);
}
template <class Scalar>
DenseMatrix<Scalar> LuFactors<Scalar>::inverse() const {
  return factors_->inverse();
}
template <class Scalar>
double LuFactors<Scalar>::rcond() const {
  return factors_->rcond();
}
template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, 1> LuFactors<Scalar>::pivots() const {
  return factors_->matrixLU().diagonal();
}
template class LuFactors<double>;
template class LuFactors<std::complex<double>>;

Cholesky::Cholesky(const DenseArgument<double>& a)
    : factors_(std::make_shared<const Eigen::LLT<Eigen::MatrixXd>>(a)) {}
bool Cholesky::succeeded() const {
  return factors_->info() == Eigen::Success;
}
Eigen::MatrixXd Cholesky::solution(const DenseArgument<double>& b) const {
  return solutionWith(*factors_, b);
}
Eigen::MatrixXd Cholesky::lowerSolution(const DenseArgument<double>& b) const {
  return solutionWith(factors_->matrixL(), b);
}
Eigen::MatrixXd Cholesky::upperSolution(const DenseArgument<double>& b) const {
  return solutionWith(factors_->matrixU(), b);
}
Eigen::MatrixXd Cholesky::lower() const {
  return factors_->matrixL();
}

Ldlt::Ldlt(const DenseArgument<double>& a)
    : factors_(std::make_shared<const Eigen::LDLT<Eigen::MatrixXd>>(a)) {}
Eigen::MatrixXd Ldlt::solution(const DenseArgument<double>& b) const {
  return solutionWith(*factors_, b);
}
bool Ldlt::succeeded() const {
  return factors_->info() == Eigen::Success;
}
Eigen::VectorXd Ldlt::pivots() const {
  return factors_->vectorD();
}

PivotedQr::PivotedQr(const DenseArgument<double>& a, double threshold) {
  const auto factors = std::make_shared<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>>();
  if (threshold > 0.0) {
    factors->setThreshold(threshold);
  }
  factors->compute(a);
  factors_ = factors;
}
Eigen::Index PivotedQr::rank() const {
  return factors_->rank();
}
Eigen::MatrixXd PivotedQr::solution(const DenseArgument<double>& b) const {
  return solutionWith(*factors_, b);
}
Eigen::MatrixXd PivotedQr::orthogonal() const {
  return factors_->householderQ();
}

Eigen::MatrixXd orthogonalFactor(const DenseArgument<double>& a) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ();
}
Eigen::MatrixXd orthonormalBasis(const DenseArgument<double>& a) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ() *
         Eigen::MatrixXd::Identity(a.rows(), a.cols());
}
Eigen::MatrixXcd orthonormalBasis(const DenseArgument<std::complex<double>>& a) {
  Eigen::MatrixXcd basis = a;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    for (int pass = 0; pass < 2; ++pass) {  // Gram and Schmidt's, twice is enough
      for (Eigen::Index i = 0; i < k; ++i) {
        basis.col(k) -= basis.col(i).dot(basis.col(k)) * basis.col(i);
      }
    }
    basis.col(k).normalize();
  }
  return basis;
}

}  // namespace whirl_twin
