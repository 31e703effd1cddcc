#include "analysis/unstable_root_bound.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kPivotRounding = 1.0e-12;  // of a unit diagonal
constexpr double kNear = 1.01;
constexpr int kMaxRadiusDoublings = 40;

/// 1 / sqrt of the diagonal; 1 where that is zero.
Eigen::VectorXd unitScale(const BandedMatrix<double>& m) {
  const Eigen::ArrayXd diagonal = m.diagonal().array();
  return (diagonal > 0.0).select(diagonal.max(1.0e-300).rsqrt(), 1.0);
}

/// Sets the zero diagonal entries of a matrix, which mark zero rows, to 1.
void fillZeros(BandedMatrix<double>& m) {
  for (Index i = 0; i < m.size(); ++i) {
    if (m(i, i) == 0.0) {
      m(i, i) = 1.0;
    }
  }
}

/// Is row i exactly zero?
bool isZeroRow(const BandedMatrix<double>& m, Index i) {
  const Index last = std::min(m.size() - 1, i + m.width());
  for (Index j = std::max<Index>(0, i - m.width()); j <= last; ++j) {
    if (m(i, j) != 0.0) {
      return false;
    }
  }
  return true;
}

/// Is it >= 0, to its rounding?
bool semidefinite(const BandedMatrix<double>& m) {
  BandedMatrix<double> scaled = m.scaled(unitScale(m));
  for (Index i = 0; i < m.size(); ++i) {
    if (scaled(i, i) < 0.0 || (scaled(i, i) == 0.0 && !isZeroRow(m, i))) {
      return false;
    }
  }
  fillZeros(scaled);
  for (Index i = 0; i < m.size(); ++i) {
    scaled(i, i) += kPivotRounding;
  }
  return hasCholesky(scaled);
}

}  // namespace

std::optional<double> unstableRootBound(const BandedLinearization& l) {
  if (!semidefinite(l.stiffness) || !semidefinite(l.damping)) {
    return std::nullopt;
  }
  if (l.circulatory.isZero()) {
    return 0.0;
  }
  for (Index i = 0; i < l.size(); ++i) {
    if (l.damping(i, i) == 0.0 && !isZeroRow(l.circulatory, i)) {
      return std::nullopt;
    }
  }
  const Eigen::VectorXd scale = unitScale(l.damping);
  BandedMatrix<double> damping = l.damping.scaled(scale);
  const BandedMatrix<double> circulatory = l.circulatory.scaled(scale);
  fillZeros(damping);
  for (Index i = 0; i < l.size(); ++i) {
    damping(i, i) += kPivotRounding;
  }
  const auto covers = [&](double rate) {
    BandedMatrix<Complex> form(l.size(), 0);
    form.add(rate, damping);
    form.add(Complex(0.0, 1.0), circulatory);
    return hasCholesky(form);
  };
  double high = circulatory.largest();  // no less will do, by its minors of two rows
  double low = high;
  for (int doubling = 0; !covers(high); ++doubling) {
    if (doubling == kMaxRadiusDoublings) {
      return std::nullopt;
    }
    low = high;
    high *= 2.0;
  }
  while (high > kNear * low) {
    const double middle = std::sqrt(low * high);
    (covers(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace whirl_twin
