// Multiple shooting: the residuals of windows, each with its own start, and their derivatives by
// the unknowns of a study and by those starts.
//
// Derivatives are central differences of the predicted motion, each with a change that moves the
// prediction by some 1e-6 of the measured signal: truncation and rounding leave at least six
// digits, for any model and method.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "estimation/window_motion.h"

namespace whirl_twin {

struct WindowDerivatives {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd by_unknowns;  ///< [residuals x unknowns]
  Eigen::MatrixXd by_start;     ///< [residuals x 2n]
};

class Shooting {
 public:
  /// Study and maker must outlive it.
  Shooting(const FitStudy& study, const CandidateMaker& maker);

  const FitStudy& study() const { return study_; }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(maker_.unknowns().size()); }
  Eigen::Index startSize() const;

  /// Sets the evaluation point, with its neighbours if derivatives are to follow. False where the
  /// parameters are invalid for the model.
  bool setPoint(const Eigen::VectorXd& theta, bool derivatives);
  const Candidate& candidate() const { return *candidate_; }
  /// Chooses the steps of the finite differences at the current point.
  void chooseDifferences(const std::vector<Window>& windows,
                         const std::vector<Eigen::VectorXd>& starts);
  /// For each unknown, the change that moves the prediction by as much as is measured, from the
  /// slope when the differences were chosen; 0 where it has no effect.
  const Eigen::VectorXd& movingAll() const { return moving_all_; }

  // May be called from several threads at once.

  /// False if the motion stops before the window's end.
  bool residuals(const Window& window, const Eigen::VectorXd& start, Eigen::VectorXd& out) const;
  /// by_unknowns stays empty unless wanted, by_start if starts are given.
  bool derivatives(const Window& window, const Eigen::VectorXd& start, bool unknowns_wanted,
                   WindowDerivatives& out) const;

 private:
  bool residualsOf(const Candidate& candidate, const Window& window, const Eigen::VectorXd& start,
                   Eigen::VectorXd& out) const;

  const FitStudy& study_;
  const CandidateMaker& maker_;
  Eigen::VectorXd theta_;
  Eigen::VectorXd change_;  // of each unknown
  Eigen::VectorXd moving_all_;
  Eigen::VectorXd start_change_;  // of each number of a start
  std::optional<Candidate> candidate_;
  struct Neighbours {
    std::optional<Candidate> above, below;  // none beyond a bound
    double apart = 0.0;
  };
  std::vector<Neighbours> neighbours_;
};

}  // namespace whirl_twin
