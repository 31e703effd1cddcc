// Of the ways to step a scene of one system the cheapest that is good enough, and the best if none
// is (step_choice.h).
#pragma once

#include <optional>

#include "accuracy/promise.h"
#include "accuracy/step_choice.h"
#include "algebra/constants.h"
#include "integration/step_methods.h"

namespace whirl_twin {

/// The implicit, symplectic method that the others are compared with.
inline constexpr const char* kReferenceMethod = "gauss_legendre_6";

StepSetting settingOf(const Scene& one, const StepChoice& choice);
int mostSubsteps(const Scene& one);
/// How often the substeps have to be doubled for so many times the error allowed.
int doublings(double times, int order);

class StepSearch {
 public:
  /// What it is given outlives it.
  StepSearch(const Scene& one, const ModelSetup& setup, StepJudge& judge)
      : one_(one), setup_(setup), judge_(judge) {}

  void tryMethod(const StepMethod& method);
  /// One that steps ahead of the twin, by as many steps as it may.
  void tryAhead(const StepMethod& method);
  bool found() const { return found_.has_value(); }
  /// With what there is to begin with if nothing was any good.
  StepChoice best() const;

 private:
  bool soundAtLongerSteps(const StepSetting& setting, int times, const StepMethod& method,
                          double excess);
  bool isProvenWithAPast(const StepSetting& setting, const StepMethod& method, double excess);
  bool hasOwnSteps(const StepSetting& setting, const StepMethod& method) const;

  const Scene& one_;
  const ModelSetup& setup_;
  StepJudge& judge_;
  std::optional<StepChoice> found_;
  std::optional<StepChoice> best_;
  double best_excess_ = kInfinity;
  double implicit_cost_ = kInfinity;
};

}  // namespace whirl_twin
