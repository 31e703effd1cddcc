// The matrices of small deviations.
#pragma once

#include <Eigen/Core>

#include "algebra/banded_matrix.h"

namespace whirl_twin {

/// M q'' + (C + G) q' + (K + N) q = 0 for small deviations; C, K symmetric, G, N skew. [n x n]
struct Linearization {
  Eigen::MatrixXd mass, damping, gyroscopic, stiffness, circulatory;
};

// The matrices of small deviations of a chain, such as a shaft of elements: all that is not zero
// lies near their diagonals.

/// M q'' + (C + G) q' + (K + N) q = 0, as Linearization has it.
struct BandedLinearization {
  BandedMatrix<double> mass, damping, gyroscopic, stiffness, circulatory;

  Eigen::Index size() const { return mass.size(); }
  /// C + G.
  BandedMatrix<double> byRate() const {
    BandedMatrix<double> sum = damping;
    sum.add(1.0, gyroscopic);
    return sum;
  }
  /// K + N.
  BandedMatrix<double> byPlace() const {
    BandedMatrix<double> sum = stiffness;
    sum.add(1.0, circulatory);
    return sum;
  }
};

inline BandedLinearization banded(const Linearization& l) {
  using Banded = BandedMatrix<double>;
  return {Banded::of(l.mass), Banded::of(l.damping), Banded::of(l.gyroscopic),
          Banded::of(l.stiffness), Banded::of(l.circulatory)};
}

}  // namespace whirl_twin
