#include "shaft_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

#include "integration/simd_vector.h"

namespace whirl_twin::comparison {
namespace {

/// sums of both planes = entries x: a pair of columns after the other.
void multiplyColumns(const double* entries, const std::array<std::size_t, 2>* columns,
                     std::size_t count, const double* x, double c, double s,
                     double* result) noexcept {
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    using Some = typename Vector<decltype(lanes)::value>::Type;
    constexpr std::size_t kVectors = 2 * TwoPlaneProduct::kRoom / decltype(lanes)::value;
    const Some* entry = reinterpret_cast<const Some*>(entries);
    Some sums[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k) {
      sums[k] = entry[k] * c + entry[kVectors + k] * s;
    }
    entry += 2 * kVectors;
    for (std::size_t j = 0; j < count; ++j, entry += kVectors) {
      const double first = x[columns[j][0]];
      const double second = x[columns[j][1]];
      for (std::size_t k = 0; k < kVectors / 2; ++k) {
        sums[k] += entry[k] * first;
        sums[kVectors / 2 + k] += entry[kVectors / 2 + k] * second;
      }
    }
    for (std::size_t k = 0; k < kVectors; ++k) {
      reinterpret_cast<Some*>(result)[k] = sums[k];
    }
  });
}

}  // namespace

ShaftMatrices shaftMatrices(const LinearRotor& rotor, double speed) {
  const Linearization at_speed = rotor.matrices(speed);
  const LongMatrix mass = at_speed.mass.cast<long double>();
  const Eigen::LLT<LongMatrix> factor(mass);
  const Eigen::VectorXcd force = rotor.synchronousForce(speed);
  const LongMatrix real = factor.solve(force.real().cast<long double>());
  const LongMatrix imaginary = factor.solve(force.imag().cast<long double>());
  ShaftMatrices matrices;
  matrices.by_q = -factor.solve(at_speed.stiffness.cast<long double>() +
                                at_speed.circulatory.cast<long double>());
  matrices.by_v =
      -factor.solve(at_speed.damping.cast<long double>() + at_speed.gyroscopic.cast<long double>());
  matrices.forced.resize(rotor.dof());
  matrices.forced.real() = real;
  matrices.forced.imag() = imaginary;
  return matrices;
}

TwoPlaneProduct::TwoPlaneProduct(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& pattern) {
  std::array<std::vector<std::size_t>, 2> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows[pattern(i, 0) != 0.0 ? 0 : 1].push_back(static_cast<std::size_t>(i));
  }
  if (rows[0].size() != kRows || rows[1].size() != kRows) {
    throw std::invalid_argument("a shaft with two uncoupled planes of 20 coordinates was expected");
  }
  const Eigen::Index forced = matrix.cols() - 2;
  std::array<std::vector<std::size_t>, 2> columns;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    std::copy(rows[plane].begin(), rows[plane].end(), rows_[plane].begin());
    for (Eigen::Index j = 0; j < forced; ++j) {
      const bool used = std::any_of(rows[plane].begin(), rows[plane].end(), [&](std::size_t row) {
        return matrix(static_cast<Eigen::Index>(row), j) != 0.0;
      });
      if (used) {
        columns[plane].push_back(static_cast<std::size_t>(j));
      }
    }
  }
  const auto append = [&](std::size_t plane, Eigen::Index column, bool zero) {
    for (std::size_t k = 0; k < kRoom; ++k) {
      entries_.push_back(
          zero || k >= kRows ? 0.0 : matrix(static_cast<Eigen::Index>(rows_[plane][k]), column));
    }
  };
  for (Eigen::Index j = forced; j < matrix.cols(); ++j) {
    append(0, j, false);
    append(1, j, false);
  }
  for (std::size_t k = 0; k < std::max(columns[0].size(), columns[1].size()); ++k) {
    std::array<std::size_t, 2> pair{};
    for (std::size_t plane = 0; plane < 2; ++plane) {
      const bool none = k >= columns[plane].size();
      pair[plane] = none ? 0 : columns[plane][k];
      append(plane, static_cast<Eigen::Index>(pair[plane]), none);
    }
    columns_.push_back(pair);
  }
}

void TwoPlaneProduct::multiply(const double* x, double c, double s, double* result) const {
  alignas(64) std::array<double, 2 * kRoom> sums;
  multiplyColumns(entries_.data(), columns_.data(), columns_.size(), x, c, s, sums.data());
  for (std::size_t k = 0; k < kRows; ++k) {
    result[rows_[0][k]] = sums[k];
    result[rows_[1][k]] = sums[kRoom + k];
  }
}

ShaftEquations::ShaftEquations(const LinearRotor& rotor, double speed) : speed_(speed) {
  constexpr auto n = static_cast<Eigen::Index>(kCoordinates);
  if (rotor.dof() != n) {
    throw std::invalid_argument("a shaft of 40 coordinates was expected, found " +
                                std::to_string(rotor.dof()));
  }
  const ShaftMatrices matrices = shaftMatrices(rotor, speed);
  rates_.resize(n, 2 * n + 2);
  rates_.leftCols(n) = (matrices.by_q / static_cast<long double>(kRate)).cast<double>();
  rates_.middleCols(n, n) = matrices.by_v.cast<double>();
  rates_.col(2 * n) = (matrices.forced.real() / static_cast<long double>(kRate)).cast<double>();
  rates_.col(2 * n + 1) =
      (-matrices.forced.imag() / static_cast<long double>(kRate)).cast<double>();
  product_ = TwoPlaneProduct(rates_, rates_.leftCols(n));
}

void ShaftEquations::jacobian(double* columns) const {
  constexpr auto n = static_cast<Eigen::Index>(kCoordinates);
  Eigen::Map<Eigen::MatrixXd> matrix(columns, 2 * n, 2 * n);
  matrix.setZero();
  matrix.topRightCorner(n, n).diagonal().setConstant(kRate);
  matrix.bottomRows(n) = rates_.leftCols(2 * n);
}

}  // namespace whirl_twin::comparison
