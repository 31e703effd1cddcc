// Multiple shooting: the residuals of windows, each with a start of its own, and how they hang on
// the unknowns of a study and on those starts.
//
// Derivatives are central differences of the predicted motion, each over a change that moves what
// is predicted by some 1e-6 of what is measured: truncation and rounding leave them six digits or
// more, for any model and method.
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
  /// Study and maker outlive it.
  Shooting(const FitStudy& study, const CandidateMaker& maker);

  const FitStudy& study() const { return study_; }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(maker_.unknowns().size()); }
  Eigen::Index startSize() const;

  /// Takes up a point, with its neighbours where derivatives are to follow. False where the model
  /// cannot have such parameters.
  bool setPoint(const Eigen::VectorXd& theta, bool derivatives);
  const Candidate& candidate() const { return *candidate_; }
  /// Finds the changes that differences are taken over, at the point taken up.
  void chooseDifferences(const std::vector<Window>& windows,
                         const std::vector<Eigen::VectorXd>& starts);
  /// Of each unknown, the change that moves what is predicted by as much as is measured, by the
  /// slope there was when differences were chosen; 0 where it moves nothing.
  const Eigen::VectorXd& movingAll() const { return moving_all_; }

  // From several threads at once.

  /// False where the motion does not get to the window's end.
  bool residuals(const Window& window, const Eigen::VectorXd& start, Eigen::VectorXd& out) const;
  /// by_unknowns stays empty where it is not `wanted`, by_start where starts are given.
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
