// Square matrices whose entries lie near the diagonal, as those of a chain do, and their
// factorizations: work in proportion to the size, where dense matrices take its cube.
//
// LU with partial pivoting and Cholesky as in LAPACK's gbtf2 and pbtf2 (G. Golub, C. Van Loan,
// Matrix Computations, 4th edition, 4.3). Own, because LAPACK would be the one Fortran library of
// the core, and its reference build is no faster at widths of seven.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace whirl_twin {

/// Entries (i, j) with |i - j| <= width; all others are zero.
template <class Scalar>
class BandedMatrix {
 public:
  using Index = Eigen::Index;
  using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  BandedMatrix() = default;
  BandedMatrix(Index size, Index width) : width_(width), columns_(2 * width + 1, size) {
    columns_.setZero();
  }
  /// With the smallest bandwidth that contains all nonzero entries.
  static BandedMatrix of(const Dense& dense);

  Index size() const { return columns_.cols(); }
  Index width() const { return width_; }
  Scalar& operator()(Index row, Index column) { return columns_(width_ + row - column, column); }
  Scalar operator()(Index row, Index column) const {
    return columns_(width_ + row - column, column);
  }
  bool isZero() const { return (columns_.array() == Scalar(0)).all(); }
  double largest() const { return columns_.size() == 0 ? 0.0 : columns_.cwiseAbs().maxCoeff(); }
  Eigen::VectorXd diagonal() const { return columns_.row(width_).real(); }

  /// this + factor * other, as wide as the wider of both.
  template <class Other, class Factor>
  void add(const Factor& factor, const BandedMatrix<Other>& other) {
    widen(other.width());
    columns_.middleRows(width_ - other.width(), 2 * other.width() + 1) +=
        factor * other.columns().template cast<Scalar>();
  }
  /// S this S with a diagonal S.
  BandedMatrix scaled(const Eigen::VectorXd& scale) const;
  void widen(Index width);

  /// [size x n], of vectors in columns, real or complex.
  template <class Vectors>
  Eigen::Matrix<typename Vectors::Scalar, Eigen::Dynamic, Eigen::Dynamic> times(
      const Vectors& x) const {
    Eigen::Matrix<typename Vectors::Scalar, Eigen::Dynamic, Eigen::Dynamic> y =
        Eigen::Matrix<typename Vectors::Scalar, Eigen::Dynamic, Eigen::Dynamic>::Zero(size(),
                                                                                      x.cols());
    for (Index c = 0; c < x.cols(); ++c) {
      for (Index j = 0; j < size(); ++j) {
        const Index first = j < width_ ? 0 : j - width_;
        const Index last = j + width_ < size() ? j + width_ : size() - 1;
        const typename Vectors::Scalar by = x(j, c);
        for (Index i = first; i <= last; ++i) {
          y(i, c) += columns_(width_ + i - j, j) * by;
        }
      }
    }
    return y;
  }
  Dense dense() const;
  /// Diagonals in rows [2 width + 1 x size]: entry (i, j) in row width + i - j, column j.
  const Dense& columns() const { return columns_; }

 private:
  Index width_ = 0;
  Dense columns_;
};

/// P A = L U.
template <class Scalar>
class BandedLU {
 public:
  using Index = Eigen::Index;
  using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  BandedLU() = default;
  explicit BandedLU(const BandedMatrix<Scalar>& a) { compute(a); }
  void compute(const BandedMatrix<Scalar>& a);
  /// A pivot is zero: there is no solution.
  bool singular() const { return singular_; }
  /// A^-1 b, of columns b. Not finite of a singular matrix.
  Dense solve(const Dense& b) const;
  /// det A / |det A|; 0 of a singular matrix.
  std::complex<double> determinantPhase() const;

 private:
  Index width_ = 0;
  Dense factors_;  // entry (i, j) in row 2 width + i - j, column j
  std::vector<Index> pivots_;
  bool singular_ = false;
};

/// Whether a Hermitian matrix has a Cholesky factorization with squared pivots above `least`. Reads
/// the lower triangle only.
template <class Scalar>
bool hasCholesky(const BandedMatrix<Scalar>& a, double least = 0.0);

extern template class BandedMatrix<double>;
extern template class BandedMatrix<std::complex<double>>;
extern template class BandedLU<double>;
extern template class BandedLU<std::complex<double>>;
extern template bool hasCholesky(const BandedMatrix<double>&, double);
extern template bool hasCholesky(const BandedMatrix<std::complex<double>>&, double);

}  // namespace whirl_twin
