// Solves for the unknowns of a study and the starts of its windows with Ceres: the steps of
// fitByShooting().
#pragma once

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/problem.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "estimation/information.h"
#include "estimation/shooting.h"
#include "mechanics/model_description.h"

namespace whirl_twin {

// Regularization of a fit: the distances of its unknowns from their start values.
//
// If runs identify only ratios of numbers, all may grow by any factor, and the factor counts: the
// distance of a number that cannot be 0 is a logarithm. For one that can be 0, such as a friction,
// it is so only upwards, since 0 is not far from its start value.

/// Distances from the start values, relative to the sizes of the unknowns.
class DistanceFromStart {
 public:
  DistanceFromStart() = default;
  /// ranges: of the unknowns' values; unknowns with a range other than kAny start above 0, at their
  /// size.
  DistanceFromStart(Eigen::VectorXd start, Eigen::VectorXd sizes, std::vector<Range> ranges);

  const Eigen::VectorXd& sizes() const { return sizes_; }
  double of(Eigen::Index unknown, double value) const;     ///< [-], 0 at the start
  double slope(Eigen::Index unknown, double value) const;  ///< derivative of it by the value

 private:
  /// Is the distance of this value logarithmic?
  bool byTimes(Eigen::Index unknown, double value) const;

  Eigen::VectorXd start_, sizes_;
  std::vector<Range> ranges_;
};

/// The residuals rows * distances [held x unknowns]. Block: the unknowns.
class HeldCost final : public ceres::CostFunction {
 public:
  /// The distance must outlive it.
  HeldCost(Eigen::MatrixXd rows, const DistanceFromStart& distance);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::MatrixXd rows_;
  const DistanceFromStart& distance_;
};

/// Windows with their estimated starts.
struct ShootingStage {
  std::vector<Window> windows;
  std::vector<Eigen::VectorXd> starts;
};

/// Residuals of windows.
struct LeftOver {
  double deviation = 0.0;  ///< standard deviation of a residual
  /// Number of consecutive residuals with the information of one, because they are correlated, as
  /// with a wrong model: (1 + r) / (1 - r) with their lag-one correlation r; 1 for white ones.
  double rows_alike = 1.0;

  /// Equivalent standard deviation of an independent residual.
  double deviationAlone() const { return deviation * std::sqrt(rows_alike); }
};

class ShootingSolver final : public ceres::EvaluationCallback {
 public:
  /// Length of the first part of a window [s], over which even a poor model follows.
  static constexpr double kFirstWindow = 0.5;
  static constexpr double kLonger = 3.0;  ///< factor from one part, or stage, to the next

  /// At the start values of the study, which must outlive it. Throws InputError if they are invalid
  /// for the model.
  explicit ShootingSolver(const FitStudy& study) : ShootingSolver(study, CandidateMaker(study)) {}
  ShootingSolver(const FitStudy& study, CandidateMaker maker);

  const CandidateMaker& maker() const { return maker_; }
  const Eigen::VectorXd& theta() const { return theta_; }
  const Candidate& candidate() const { return shooting_.candidate(); }
  int iterations() const { return iterations_; }
  bool converged() const { return converged_; }

  /// Determines the sizes of the unknowns: their start values; if these are (nearly) 0, the change
  /// that moves the predicted motion in these windows.
  void findSizes(const ShootingStage& stage);
  const DistanceFromStart& distance() const { return distance_; }
  /// Rows of a HeldCost that fix each unknown at its start value with a standard deviation of its
  /// size, for residuals of this deviation.
  Eigen::MatrixXd aboutStart(double deviation) const;

  /// Moves the unknowns to an approximate minimum of the equation error along the runs, and in
  /// unidentifiable directions no further than necessary.
  void regress();
  /// The windows [s] of the training runs, or of one run, with measured starts.
  ShootingStage stageOf(double length, std::optional<std::size_t> run);
  /// Fits the starts alone, over increasing parts of their windows. False for a window whose motion
  /// stops.
  std::vector<bool> findStarts(ShootingStage& stage);
  /// Fits unknowns and starts together; `thorough` for the last stage. Throws RunFailure.
  void solve(ShootingStage& stage, bool thorough, const Eigen::MatrixXd& held);
  LeftOver leftOver(const ShootingStage& stage) const;
  NormalEquations normalEquations(const ShootingStage& stage);
  /// Predicted states of a stage's window [2n x rows]; NaN where the motion stops.
  Eigen::MatrixXd states(const ShootingStage& stage, std::size_t window);

  void PrepareForEvaluation(bool derivatives, bool new_point) override;

 private:
  const Unknown& unknown(Eigen::Index i) const {
    return maker_.unknowns()[static_cast<std::size_t>(i)];
  }
  void hold(ceres::Problem& problem, const Eigen::MatrixXd& held);
  void setBounds(ceres::Problem& problem);
  std::vector<Window> growing(const Window& window) const;
  bool findStart(const Window& window, Eigen::VectorXd& start);

  const FitStudy& study_;
  CandidateMaker maker_;
  Shooting shooting_;
  Eigen::VectorXd theta_;
  DistanceFromStart distance_;
  int iterations_ = 0;
  bool converged_ = true;
};

}  // namespace whirl_twin
