#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <limits>

#include "algebra/constants.h"
#include "algebra/dense.h"

namespace whirl_twin {

SingularVectors singularVectors(const DenseArgument<double>& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}
Eigen::VectorXd singularValues(const DenseArgument<double>& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a).singularValues();
}
Eigen::VectorXd singularValues(const DenseArgument<std::complex<double>>& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(a).singularValues();
}
ComplexLeftSingularVectors complexLeftSingularVectors(
    const DenseArgument<std::complex<double>>& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, Eigen::ComputeThinU);
  return {svd.singularValues(), svd.matrixU()};
}

Eigen::MatrixXd leastSquares(const DenseArgument<double>& a, const DenseArgument<double>& b) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  const double rounding =
      static_cast<double>(values.size()) * std::numeric_limits<double>::epsilon();
  const Eigen::Index rank =
      values.size() == 0 ? 0 : (values.array() > rounding * values[0]).count();
  return svd.matrixV().leftCols(rank) * values.head(rank).cwiseInverse().asDiagonal() *
         (svd.matrixU().leftCols(rank).transpose() * b);
}
Eigen::MatrixXcd leastSquares(const DenseArgument<std::complex<double>>& a,
                              const DenseArgument<std::complex<double>>& b) {
  // As a real problem of twice the size: a complex one would be compiled for this alone.
  Eigen::MatrixXd real(2 * a.rows(), 2 * a.cols());
  real << a.real(), -a.imag(), a.imag(), a.real();
  Eigen::MatrixXd right(2 * b.rows(), b.cols());
  right << b.real(), b.imag();
  const Eigen::MatrixXd x = leastSquares(real, right);
  Eigen::MatrixXcd result(a.cols(), b.cols());
  result.real() = x.topRows(a.cols());
  result.imag() = x.bottomRows(a.cols());
  return result;
}

SymmetricModes<double> symmetricModes(const DenseArgument<double>& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}
Eigen::VectorXd symmetricEigenvalues(const DenseArgument<double>& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}
SymmetricModes<std::complex<double>> hermitianModes(const DenseArgument<std::complex<double>>& a,
                                                    bool vectors) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(
      a, vectors ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly);
  SymmetricModes<std::complex<double>> modes{
      solver.info() == Eigen::Success, solver.eigenvalues(), {}};
  if (vectors) {
    modes.vectors = solver.eigenvectors();
  }
  return modes;
}
SymmetricModes<double> generalizedModes(const DenseArgument<double>& a,
                                        const DenseArgument<double>& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}

namespace {

EigenPairs notConverged(Eigen::Index n) {
  return {false, Eigen::VectorXcd::Constant(n, kNaN), Eigen::MatrixXcd::Constant(n, n, kNaN)};
}

}  // namespace

EigenPairs eigenPairs(const DenseArgument<double>& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, true);
  if (solver.info() != Eigen::Success) {
    return notConverged(a.rows());
  }
  return {true, solver.eigenvalues(), solver.eigenvectors()};
}
EigenPairs eigenvalues(const DenseArgument<double>& a, Eigen::Index max_iterations) {
  Eigen::EigenSolver<Eigen::MatrixXd> solver(a.rows());
  if (max_iterations > 0) {
    solver.setMaxIterations(max_iterations);
  }
  solver.compute(a, false);
  if (solver.info() != Eigen::Success) {
    return notConverged(a.rows());
  }
  return {true, solver.eigenvalues(), {}};
}
EigenPairs eigenPairs(const DenseArgument<std::complex<double>>& a) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a, true);
  if (solver.info() != Eigen::Success) {
    return notConverged(a.rows());
  }
  return {true, solver.eigenvalues(), solver.eigenvectors()};
}
EigenPairs eigenvalues(const DenseArgument<std::complex<double>>& a) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a, false);
  if (solver.info() != Eigen::Success) {
    return notConverged(a.rows());
  }
  return {true, solver.eigenvalues(), {}};
}

ComplexSchur complexSchur(const DenseArgument<double>& a) {
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(a);
  return {schur.matrixT(), schur.matrixU()};
}

}  // namespace whirl_twin
