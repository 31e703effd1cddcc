// Block Krylov space of the inverse linearization of a quadratic pencil (lowest_roots.h), extended
// as needed: V^H V = 1, B V = V H + rest, and the eigenvalues of H near those of B.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/banded_matrix.h"
#include "algebra/dense.h"
#include "analysis/lowest_roots.h"

namespace whirl_twin {

constexpr Eigen::Index kKrylovBlock = 2;

/// A root as the Krylov space has it.
struct Ritz {
  std::complex<double> root;
  double residual = 0.0;   ///< of 1/s, relative
  Eigen::VectorXcd parts;  ///< of the basis
};

/// Of (A0 + s A1 + s^2 A2) phi = 0, starting from a random block that is always the same.
template <class Scalar>
class KrylovSpace {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit KrylovSpace(const BandedPencil<Scalar>& pencil)
      : pencil_(pencil), inverse_(pencil.a0), order_(pencil.a0.size()) {
    std::mt19937_64 numbers(1);
    random_ = numbers;
    next_ = Matrix::Zero(2 * order_, kKrylovBlock);
    basis_.resize(2 * order_, 0);
    refill(next_.col(0));
    refill(next_.col(1));
    orthonormalise(nullptr);
  }

  bool singular() const { return inverse_.singular(); }
  Eigen::Index dimension() const { return basis_.cols(); }

  void grow(Eigen::Index dimension) {
    const Eigen::Index from = basis_.cols();
    basis_.conservativeResize(Eigen::NoChange, dimension);
    // Rows and columns that come are zero.
    Matrix wider = Matrix::Zero(dimension + kKrylovBlock, dimension);
    wider.topLeftCorner(projected_.rows(), projected_.cols()) = projected_;
    projected_ = std::move(wider);
    for (Eigen::Index at = from; at < dimension; at += kKrylovBlock) {
      basis_.middleCols(at, kKrylovBlock) = next_;
      next_ = image(next_);
      const Eigen::Index known = at + kKrylovBlock;
      for (int pass = 0; pass < 2; ++pass) {
        const Matrix along = basis_.leftCols(known).adjoint() * next_;
        next_.noalias() -= basis_.leftCols(known) * along;
        projected_.block(0, at, known, kKrylovBlock) += along;
      }
      known_ = known;
      Eigen::Matrix<Scalar, kKrylovBlock, kKrylovBlock> rest;
      orthonormalise(&rest);
      projected_.block(known, at, kKrylovBlock, kKrylovBlock) = rest;
    }
  }

  /// By rising modulus of the root.
  std::vector<Ritz> ritz() const {
    const Eigen::Index m = dimension();
    const EigenPairs solver = eigenPairs(projected_.topRows(m));
    if (!solver.succeeded) {
      return {};
    }
    const Eigen::VectorXcd& values = solver.values;
    const Eigen::MatrixXcd& vectors = solver.vectors;
    const Eigen::MatrixXcd rest = projected_.bottomRows(kKrylovBlock)
                                      .rightCols(kKrylovBlock)
                                      .template cast<std::complex<double>>() *
                                  vectors.bottomRows(kKrylovBlock);
    std::vector<Ritz> all;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (values[i] != 0.0) {
        all.push_back({1.0 / values[i], rest.col(i).norm() / std::abs(values[i]), vectors.col(i)});
      }
    }
    std::sort(all.begin(), all.end(), [](const Ritz& a, const Ritz& b) {
      const double x = std::abs(a.root);
      const double y = std::abs(b.root);
      return x != y ? x < y : a.root.imag() < b.root.imag();
    });
    return all;
  }
  Eigen::VectorXcd shape(const Ritz& ritz) const {
    return (basis_.topRows(order_).template cast<std::complex<double>>() * ritz.parts).normalized();
  }

 private:
  Matrix image(const Matrix& state) const {
    const Matrix force =
        pencil_.a1.times(state.topRows(order_)) + pencil_.a2.times(state.bottomRows(order_));
    Matrix next(2 * order_, state.cols());
    next.topRows(order_) = -inverse_.solve(force);
    next.bottomRows(order_) = state.topRows(order_);
    return next;
  }
  template <class Column>
  void refill(Column column) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      column[i] = number(random_);
    }
  }
  /// The next block's columns, each at right angles to all; what was left of them in `rest`.
  void orthonormalise(Eigen::Matrix<Scalar, kKrylovBlock, kKrylovBlock>* rest) {
    if (rest != nullptr) {
      rest->setZero();
    }
    for (Eigen::Index j = 0; j < kKrylovBlock; ++j) {
      auto column = next_.col(j);
      const double before = column.norm();
      for (int pass = 0; pass < 2; ++pass) {
        for (Eigen::Index i = 0; i < j; ++i) {
          const Scalar along = next_.col(i).dot(column);
          column -= along * next_.col(i);
          if (rest != nullptr) {
            (*rest)(i, j) += along;
          }
        }
      }
      double length = column.norm();
      const bool spent = !(length > 1.0e-14 * before);
      if (rest != nullptr) {
        (*rest)(j, j) = spent ? 0.0 : length;
      }
      if (spent) {  // an invariant space: continue with a new direction
        refill(column);
        for (int pass = 0; pass < 2; ++pass) {
          column -= basis_.leftCols(known_) * (basis_.leftCols(known_).adjoint() * column);
          for (Eigen::Index i = 0; i < j; ++i) {
            column -= next_.col(i).dot(column) * next_.col(i);
          }
        }
        length = column.norm();
      }
      column /= length;
    }
  }

  BandedPencil<Scalar> pencil_;
  BandedLU<Scalar> inverse_;
  Eigen::Index order_;
  Eigen::Index known_ = 0;
  std::mt19937_64 random_;
  Matrix basis_, next_, projected_;
};

}  // namespace whirl_twin
