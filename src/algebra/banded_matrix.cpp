#include "algebra/banded_matrix.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

using Eigen::Index;
using Complex = std::complex<double>;

double realOf(double x) {
  return x;
}
double realOf(const Complex& x) {
  return x.real();
}
double conjugate(double x) {
  return x;
}
Complex conjugate(const Complex& x) {
  return std::conj(x);
}
double product(double a, double b) {
  return a * b;
}
/// Without the care of std::complex's operator for infinities.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
/// Its size, for pivots: to a factor of the square root of two.
double sizeOf(double x) {
  return std::fabs(x);
}
double sizeOf(const Complex& x) {
  return std::fabs(x.real()) + std::fabs(x.imag());
}

}  // namespace

template <class Scalar>
BandedMatrix<Scalar> BandedMatrix<Scalar>::of(const Dense& dense) {
  const Index n = dense.rows();
  Index width = 0;
  for (Index j = 0; j < n; ++j) {
    Index first = 0;
    while (first + width < j && dense(first, j) == Scalar(0)) {
      ++first;
    }
    width = std::max(width, j - first);
    Index last = n - 1;
    while (last - width > j && dense(last, j) == Scalar(0)) {
      --last;
    }
    width = std::max(width, last - j);
  }
  BandedMatrix banded(n, width);
  for (Index j = 0; j < n; ++j) {
    const Index first = std::max<Index>(0, j - width);
    const Index count = std::min(n - 1, j + width) - first + 1;
    banded.columns_.col(j).segment(width + first - j, count) = dense.col(j).segment(first, count);
  }
  return banded;
}

template <class Scalar>
void BandedMatrix<Scalar>::widen(Index width) {
  if (width <= width_) {
    return;
  }
  Dense wider = Dense::Zero(2 * width + 1, size());
  wider.middleRows(width - width_, 2 * width_ + 1) = columns_;
  columns_ = std::move(wider);
  width_ = width;
}

template <class Scalar>
BandedMatrix<Scalar> BandedMatrix<Scalar>::scaled(const Eigen::VectorXd& scale) const {
  BandedMatrix result = *this;
  for (Index j = 0; j < size(); ++j) {
    const Index last = std::min(size() - 1, j + width_);
    for (Index i = std::max<Index>(0, j - width_); i <= last; ++i) {
      result(i, j) *= scale[i] * scale[j];
    }
  }
  return result;
}

template <class Scalar>
typename BandedMatrix<Scalar>::Dense BandedMatrix<Scalar>::dense() const {
  Dense all = Dense::Zero(size(), size());
  for (Index j = 0; j < size(); ++j) {
    const Index first = std::max<Index>(0, j - width_);
    const Index count = std::min(size() - 1, j + width_) - first + 1;
    all.col(j).segment(first, count) = columns_.col(j).segment(width_ + first - j, count);
  }
  return all;
}

template <class Scalar>
void BandedLU<Scalar>::compute(const BandedMatrix<Scalar>& a) {
  const Index n = a.size();
  width_ = a.width();
  singular_ = false;
  factors_.setZero(3 * width_ + 1, n);
  factors_.bottomRows(2 * width_ + 1) = a.columns();
  pivots_.resize(static_cast<std::size_t>(n));
  const Index rows = factors_.rows();
  const Index middle = 2 * width_;
  Scalar* const all = factors_.data();
  for (Index j = 0; j < n; ++j) {
    Scalar* const column = all + j * rows + middle - j;  // column[i]: entry (i, j)
    const Index last = std::min(n - 1, j + width_);
    Index pivot = j;
    for (Index i = j + 1; i <= last; ++i) {
      if (sizeOf(column[i]) > sizeOf(column[pivot])) {
        pivot = i;
      }
    }
    pivots_[static_cast<std::size_t>(j)] = pivot;
    if (column[pivot] == Scalar(0)) {
      singular_ = true;
      return;
    }
    std::swap(column[j], column[pivot]);
    const Scalar inverse = Scalar(1) / column[j];
    for (Index i = j + 1; i <= last; ++i) {
      column[i] = product(column[i], inverse);
    }
    const Index end = std::min(n - 1, j + 2 * width_);
    for (Index k = j + 1; k <= end; ++k) {
      Scalar* const other = all + k * rows + middle - k;
      std::swap(other[j], other[pivot]);
      const Scalar by = other[j];
      if (by == Scalar(0)) {
        continue;
      }
      for (Index i = j + 1; i <= last; ++i) {
        other[i] -= product(column[i], by);
      }
    }
  }
}

template <class Scalar>
typename BandedLU<Scalar>::Dense BandedLU<Scalar>::solve(const Dense& b) const {
  const Index n = factors_.cols();
  const Index rows = factors_.rows();
  const Index middle = 2 * width_;
  const Scalar* const all = factors_.data();
  Dense x = b;
  if (singular_) {
    x.setConstant(Scalar(std::nan("")));
    return x;
  }
  for (Index c = 0; c < x.cols(); ++c) {
    Scalar* const y = x.data() + c * n;
    for (Index j = 0; j < n; ++j) {
      std::swap(y[j], y[pivots_[static_cast<std::size_t>(j)]]);
      const Scalar* const column = all + j * rows + middle - j;
      const Scalar by = y[j];
      const Index last = std::min(n - 1, j + width_);
      for (Index i = j + 1; i <= last; ++i) {
        y[i] -= product(column[i], by);
      }
    }
    for (Index j = n - 1; j >= 0; --j) {
      const Scalar* const column = all + j * rows + middle - j;
      const Scalar by = y[j] / column[j];
      y[j] = by;
      for (Index i = std::max<Index>(0, j - 2 * width_); i < j; ++i) {
        y[i] -= product(column[i], by);
      }
    }
  }
  return x;
}

template <class Scalar>
Complex BandedLU<Scalar>::determinantPhase() const {
  if (singular_) {
    return 0.0;
  }
  Complex phase = 1.0;
  for (Index j = 0; j < factors_.cols(); ++j) {
    const Scalar pivot = factors_(2 * width_, j);
    phase = product(phase, Complex(pivot) / std::abs(pivot));
    if (pivots_[static_cast<std::size_t>(j)] != j) {
      phase = -phase;
    }
  }
  return phase;
}

template <class Scalar>
bool hasCholesky(const BandedMatrix<Scalar>& a, double least) {
  const Index n = a.size();
  const Index width = a.width();
  typename BandedMatrix<Scalar>::Dense lower = a.columns().bottomRows(width + 1);
  const Index rows = lower.rows();
  for (Index j = 0; j < n; ++j) {
    Scalar* const column = lower.data() + j * rows;  // column[i]: entry (j + i, j)
    const double pivot = realOf(column[0]);
    if (!(pivot > least)) {
      return false;
    }
    const double inverse = 1.0 / std::sqrt(pivot);
    const Index count = std::min(n - 1 - j, width);
    for (Index i = 0; i <= count; ++i) {
      column[i] *= inverse;
    }
    for (Index k = 1; k <= count; ++k) {
      Scalar* const other = lower.data() + (j + k) * rows;
      const Scalar by = conjugate(column[k]);
      for (Index i = k; i <= count; ++i) {
        other[i - k] -= product(column[i], by);
      }
    }
  }
  return true;
}

template class BandedMatrix<double>;
template class BandedMatrix<Complex>;
template class BandedLU<double>;
template class BandedLU<Complex>;
template bool hasCholesky(const BandedMatrix<double>&, double);
template bool hasCholesky(const BandedMatrix<Complex>&, double);

}  // namespace whirl_twin
