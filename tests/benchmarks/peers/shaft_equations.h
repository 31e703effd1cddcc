// A shaft of 40 coordinates at constant speed, from the matrices of our own model:
//   M q'' + (C + G) q' + (K + N) q = Re[F e^(i w t)]
// solved for q'' once, in long double.
//
// At run time only a product with 40 x 80 coefficients remains, optimized as an expert would by
// hand: masses and stiffnesses do not couple the two planes of bending, dampers and gyroscopic
// moments act on a few rates; so two thirds of the entries are zero and omitted. The others use the
// widest vector registers of the machine.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/align/aligned_allocator.hpp>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "mechanics/linear_rotor.h"

namespace whirl_twin::comparison {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongComplexVector = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, 1>;

/// q'' = by_q q + by_v q' + Re[forced e^(i w t)]
struct ShaftMatrices {
  LongMatrix by_q, by_v;
  LongComplexVector forced;
};
ShaftMatrices shaftMatrices(const LinearRotor& rotor, double speed);

/// A matrix whose rows fall into two planes of 20, each with its own columns that are not zero.
class TwoPlaneProduct {
 public:
  static constexpr std::size_t kRows = 20;  ///< of a plane
  static constexpr std::size_t kRoom = 24;  ///< three vectors of eight

  TwoPlaneProduct() = default;
  /// The rows of the first plane are those that `pattern`, with as many rows, couples with row 0.
  /// Throws std::invalid_argument unless there are 20 of them and 20 others.
  TwoPlaneProduct(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& pattern);

  /// result = M x; the last two columns are multiplied by c and s.
  void multiply(const double* x, double c, double s, double* result) const;

 private:
  std::array<std::array<std::size_t, kRows>, 2> rows_{};
  std::vector<std::array<std::size_t, 2>> columns_;
  /// Two columns at a time, one of each plane; those of c and s come first.
  std::vector<double, boost::alignment::aligned_allocator<double, 64>> entries_;
};

class ShaftEquations {
 public:
  static constexpr std::size_t kCoordinates = 40;
  static constexpr std::size_t kStates = 80;
  static constexpr double kRate = 100.0;  ///< [1/s]

  /// Throws std::invalid_argument for a rotor of another size.
  ShaftEquations(const LinearRotor& rotor, double speed);

  void operator()(const double* x, double* slope, double t) const {
    for (std::size_t i = 0; i < kCoordinates; ++i) {
      slope[i] = kRate * x[kCoordinates + i];
    }
    product_.multiply(x, std::cos(speed_ * t), std::sin(speed_ * t), slope + kCoordinates);
  }
  /// By columns, kStates x kStates.
  void jacobian(double* columns) const;

 private:
  double speed_;
  Eigen::MatrixXd rates_;  ///< of the rates, by x and by cos, sin
  TwoPlaneProduct product_;
};

}  // namespace whirl_twin::comparison
