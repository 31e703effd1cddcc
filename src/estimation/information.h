// Identifiability of the unknowns of a study from its runs: standard deviations, correlations, and
// unidentifiable directions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/shooting.h"

namespace whirl_twin {

/// The normal equations of a study at its solution, with the windows' starts eliminated.
struct NormalEquations {
  Eigen::MatrixXd matrix;  ///< J'J [unknowns x unknowns]
  double squares = 0.0;    ///< of the residuals, summed
  Eigen::Index residuals = 0;
  Eigen::Index starts = 0;  ///< degrees of freedom used by the starts

  /// Adds the derivatives of a window.
  void add(const WindowDerivatives& window);
  /// Variance of a residual, from the remaining sum of squares.
  double variance() const;
};

/// A direction in which the runs do not identify the unknowns: they can change together, each by
/// this multiple of its size.
struct UnidentifiableDirection {
  Eigen::VectorXd parts;  ///< the largest is 1 or -1
  double deviation;       ///< along it, relative to the sizes; infinite: no residual changes
  /// Of each unknown: whether it changes along the direction by a tenth of its size, or by a tenth
  /// of its value and more than its other uncertainty. Unknowns that take no part are identifiable.
  std::vector<bool> takes_part;
};

struct Information {
  Eigen::VectorXd deviation;    ///< standard deviations; NaN: not identifiable
  Eigen::MatrixXd correlation;  ///< of identifiable unknowns; NaN elsewhere
  std::vector<UnidentifiableDirection> unidentifiable;

  bool isIdentifiable(Eigen::Index unknown) const;
};

/// An unknown is identifiable if its standard deviation is below its size (> 0), with only one
/// independent residual in `rows_alike`. The standard deviations assume white residuals: for
/// correlated residuals they are too small.
Information information(const NormalEquations& normal, const Eigen::VectorXd& theta,
                        const Eigen::VectorXd& sizes, double rows_alike);

}  // namespace whirl_twin
