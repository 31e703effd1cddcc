// Factorizations, eigenvalues and singular values of dense matrices of any size, real and complex.
// The algorithms are Eigen's, compiled once, in dense_factors.cpp and dense_modes.cpp: their
// templates take longer to compile than all else that most files that use them contain. Arguments
// may be any expressions of Eigen; shapes are [rows x columns].
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>

namespace whirl_twin {

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using DenseArgument = Eigen::Ref<const DenseMatrix<Scalar>>;
/// A solution for right-hand sides of the type Right.
template <class Scalar, class Right>
using DenseSolution = Eigen::Matrix<Scalar, Eigen::Dynamic, Right::ColsAtCompileTime>;

/// P A = L U with row pivoting, of a square matrix.
template <class Scalar>
class LuFactors {
 public:
  LuFactors() = default;
  explicit LuFactors(const DenseArgument<Scalar>& a);
  /// A^-1 b, not finite of a singular matrix.
  template <class Right>
  DenseSolution<Scalar, Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solution(b);
  }
  DenseMatrix<Scalar> inverse() const;
  /// An estimate of 1 / (|A| |A^-1|), in the 1-norm.
  double rcond() const;
  /// The diagonal of U.
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> pivots() const;

 private:
  DenseMatrix<Scalar> solution(const DenseArgument<Scalar>& b) const;
  std::shared_ptr<const Eigen::PartialPivLU<DenseMatrix<Scalar>>> factors_;
};
using Lu = LuFactors<double>;
using ComplexLu = LuFactors<std::complex<double>>;

/// A = L L^T of a symmetric positive definite matrix, of which the lower triangle is read.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const DenseArgument<double>& a);
  /// False where the matrix is not positive definite.
  bool succeeded() const;
  /// A^-1 b.
  template <class Right>
  DenseSolution<double, Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solution(b);
  }
  /// L^-1 b.
  template <class Right>
  DenseSolution<double, Right> solveLower(const Eigen::MatrixBase<Right>& b) const {
    return lowerSolution(b);
  }
  /// L^-T b.
  template <class Right>
  DenseSolution<double, Right> solveUpper(const Eigen::MatrixBase<Right>& b) const {
    return upperSolution(b);
  }
  /// L, zero above its diagonal.
  Eigen::MatrixXd lower() const;

 private:
  Eigen::MatrixXd solution(const DenseArgument<double>& b) const;
  Eigen::MatrixXd lowerSolution(const DenseArgument<double>& b) const;
  Eigen::MatrixXd upperSolution(const DenseArgument<double>& b) const;
  std::shared_ptr<const Eigen::LLT<Eigen::MatrixXd>> factors_;
};

/// P A P^T = L D L^T of a symmetric matrix that is positive or negative semidefinite, of which the
/// lower triangle is read.
class Ldlt {
 public:
  Ldlt() = default;
  explicit Ldlt(const DenseArgument<double>& a);
  /// A^-1 b; zero in directions in which A is.
  template <class Right>
  DenseSolution<double, Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solution(b);
  }
  /// False where the factorization failed.
  bool succeeded() const;
  /// The diagonal of D.
  Eigen::VectorXd pivots() const;

 private:
  Eigen::MatrixXd solution(const DenseArgument<double>& b) const;
  std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> factors_;
};

/// A P = Q R with column pivoting, of a matrix of any shape: reveals the rank, and solves least
/// squares.
class PivotedQr {
 public:
  /// Pivots below `threshold` of the largest count as zero; 0: below rounding.
  explicit PivotedQr(const DenseArgument<double>& a, double threshold = 0.0);
  Eigen::Index rank() const;
  /// The x that minimizes |A x - b|, [columns of A x columns of b].
  template <class Right>
  DenseSolution<double, Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solution(b);
  }
  /// Q, square: its first rank() columns span those of A.
  Eigen::MatrixXd orthogonal() const;

 private:
  Eigen::MatrixXd solution(const DenseArgument<double>& b) const;
  std::shared_ptr<const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> factors_;
};
/// Q of A = Q R without pivoting, square.
Eigen::MatrixXd orthogonalFactor(const DenseArgument<double>& a);
/// An orthonormal basis of the columns of a matrix of full column rank, as many.
Eigen::MatrixXd orthonormalBasis(const DenseArgument<double>& a);
Eigen::MatrixXcd orthonormalBasis(const DenseArgument<std::complex<double>>& a);

/// Values and vectors of A = U diag(values) V^H, the values falling.
struct SingularVectors {
  Eigen::VectorXd values;
  Eigen::MatrixXd u, v;
};
/// U and V square.
SingularVectors singularVectors(const DenseArgument<double>& a);
Eigen::VectorXd singularValues(const DenseArgument<double>& a);
Eigen::VectorXd singularValues(const DenseArgument<std::complex<double>>& a);
/// The minimum-norm least-squares solution of A x = b; singular values below rounding count as
/// zero.
Eigen::MatrixXd leastSquares(const DenseArgument<double>& a, const DenseArgument<double>& b);
Eigen::MatrixXcd leastSquares(const DenseArgument<std::complex<double>>& a,
                              const DenseArgument<std::complex<double>>& b);
/// U has as many columns as A has rows or columns, whichever are fewer.
struct ComplexLeftSingularVectors {
  Eigen::VectorXd values;
  Eigen::MatrixXcd u;
};
ComplexLeftSingularVectors complexLeftSingularVectors(const DenseArgument<std::complex<double>>& a);

/// Eigenvalues, ascending, and orthonormal eigenvectors in columns.
template <class Scalar>
struct SymmetricModes {
  bool succeeded = false;
  Eigen::VectorXd values;
  DenseMatrix<Scalar> vectors;
};
/// Of a symmetric matrix, of which the lower triangle is read.
SymmetricModes<double> symmetricModes(const DenseArgument<double>& a);
Eigen::VectorXd symmetricEigenvalues(const DenseArgument<double>& a);
/// Of a Hermitian matrix, of which the lower triangle is read; `vectors`: compute them too.
SymmetricModes<std::complex<double>> hermitianModes(const DenseArgument<std::complex<double>>& a,
                                                    bool vectors = true);
/// A x = lambda B x of a symmetric A and a positive definite B, with x^T B x = 1.
SymmetricModes<double> generalizedModes(const DenseArgument<double>& a,
                                        const DenseArgument<double>& b);

/// Of a square matrix, in the order of the algorithm; vectors in columns, of length 1. All are NaN
/// where the algorithm did not converge.
struct EigenPairs {
  bool succeeded = false;
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
EigenPairs eigenPairs(const DenseArgument<double>& a);
EigenPairs eigenPairs(const DenseArgument<std::complex<double>>& a);
/// Without vectors. `max_iterations`: of the QR algorithm; 0: Eigen's default, 40 a row.
EigenPairs eigenvalues(const DenseArgument<double>& a, Eigen::Index max_iterations = 0);
EigenPairs eigenvalues(const DenseArgument<std::complex<double>>& a);

/// A = U T U^H of a real square matrix: U unitary, T upper triangular.
struct ComplexSchur {
  Eigen::MatrixXcd t, u;
};
ComplexSchur complexSchur(const DenseArgument<double>& a);

}  // namespace whirl_twin
