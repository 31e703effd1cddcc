// What runs tell about the unknowns of a study: deviations, correlations, and the directions in
// which they tell nothing.
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
  Eigen::Index starts = 0;  ///< numbers that the starts have taken up

  /// Takes the derivatives of a window.
  void add(const WindowDerivatives& window);
  /// Of a residual, from what is left over.
  double variance() const;
};

/// A combination of unknowns that runs do not tell: they can change together, each by this part of
/// its own size.
struct UntoldDirection {
  Eigen::VectorXd parts;  ///< the largest is 1 or -1
  double deviation;       ///< along it, in parts of sizes; infinite: no residual changes at all
  /// Of each unknown: it changes along it by a tenth of its size, or by a tenth of its value and
  /// more than it is known to else. Who takes no part is told all the same.
  std::vector<bool> takes_part;
};

struct Information {
  Eigen::VectorXd deviation;    ///< standard deviations; NaN where an unknown is not told
  Eigen::MatrixXd correlation;  ///< of those that are told; NaN elsewhere
  std::vector<UntoldDirection> untold;

  bool told(Eigen::Index unknown) const;
};

/// An unknown is told when it is known better than to its own size (> 0), of residuals of which
/// only one of `rows_alike` tells anything. Deviations are those of white ones: where residuals are
/// not white they are too small.
Information information(const NormalEquations& normal, const Eigen::VectorXd& theta,
                        const Eigen::VectorXd& sizes, double rows_alike);

}  // namespace whirl_twin
