// Solves for the unknowns of a study and the starts of its windows, by Ceres: the parts that
// fitByShooting() is made of.
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

// What a fit holds of its unknowns: their distances from where they start.
//
// Where runs tell numbers only as multiples of each other, all may be any number of times as large,
// and it is the times that count: of a number that cannot be 0 the distance is a logarithm. So it
// is of one that can be, a friction say, but only upwards, for 0 is not far from where it starts.

/// Distances from the start, in sizes of the unknowns.
class DistanceFromStart {
 public:
  DistanceFromStart() = default;
  /// ranges: of the unknowns' values; those that are not kAny start above 0, at their size.
  DistanceFromStart(Eigen::VectorXd start, Eigen::VectorXd sizes, std::vector<Range> ranges);

  const Eigen::VectorXd& sizes() const { return sizes_; }
  double of(Eigen::Index unknown, double value) const;     ///< [-], 0 at the start
  double slope(Eigen::Index unknown, double value) const;  ///< of that, by the value

 private:
  /// Is the distance of this value a logarithm?
  bool byTimes(Eigen::Index unknown, double value) const;

  Eigen::VectorXd start_, sizes_;
  std::vector<Range> ranges_;
};

/// rows * distances counts as residuals do [held x unknowns]. Block: the unknowns.
class HeldCost final : public ceres::CostFunction {
 public:
  /// The distance outlives it.
  HeldCost(Eigen::MatrixXd rows, const DistanceFromStart& distance);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::MatrixXd rows_;
  const DistanceFromStart& distance_;
};

/// Windows, each with the start that was found for it.
struct ShootingStage {
  std::vector<Window> windows;
  std::vector<Eigen::VectorXd> starts;
};

/// What windows leave between measured and predicted.
struct LeftOver {
  double deviation = 0.0;  ///< of a residual
  /// Residuals in a row that tell no more than one of them, for they go on from one to the next as
  /// those of a model that is wrong do: (1 + r) / (1 - r) of their correlation r; 1 of white ones.
  double rows_alike = 1.0;

  /// Of a residual that stands for itself alone.
  double deviationAlone() const { return deviation * std::sqrt(rows_alike); }
};

class ShootingSolver final : public ceres::EvaluationCallback {
 public:
  /// A first part of a window: a model that is far off follows for so long [s].
  static constexpr double kFirstWindow = 0.5;
  static constexpr double kLonger = 3.0;  ///< from one part, or one stage, to the next

  /// At the start values of the study, which outlives it. Throws Refusal for those that the model
  /// cannot have.
  explicit ShootingSolver(const FitStudy& study) : ShootingSolver(study, CandidateMaker(study)) {}
  ShootingSolver(const FitStudy& study, CandidateMaker maker);

  const CandidateMaker& maker() const { return maker_; }
  const Eigen::VectorXd& theta() const { return theta_; }
  const Candidate& candidate() const { return shooting_.candidate(); }
  int iterations() const { return iterations_; }
  bool converged() const { return converged_; }

  /// Finds what changes of the unknowns are measured by: their start values; of those that start at
  /// 0, or next to it, what moves the predicted motion in these windows.
  void findSizes(const ShootingStage& stage);
  const DistanceFromStart& distance() const { return distance_; }
  /// Rows of a HeldCost by which each unknown is known at its start to its own size, by residuals
  /// of this deviation.
  Eigen::MatrixXd aboutStart(double deviation) const;

  /// Brings the unknowns to where the equations of motion hold along the runs, roughly, and along
  /// what these do not tell no further than they have to.
  void regress();
  /// The windows [s] of the runs that are trained on, or of one run, with measured starts.
  ShootingStage stageOf(double length, std::optional<std::size_t> run);
  /// The starts alone, over longer and longer parts of their windows. False for a window that is
  /// not got through.
  std::vector<bool> findStarts(ShootingStage& stage);
  /// Unknowns and starts together; `thorough` for the last stage. Throws RunFailure.
  void solve(ShootingStage& stage, bool thorough, const Eigen::MatrixXd& held);
  LeftOver leftOver(const ShootingStage& stage) const;
  NormalEquations normalEquations(const ShootingStage& stage);
  /// Predicted states of a stage's window [2n x rows]; NaN where it is not got through.
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
