// Search of the cheapest step setting of a scene of one system that satisfies the tolerance, or of
// the most accurate if none does (step_choice.h).
#pragma once

#include <optional>

#include "accuracy/error_bound.h"
#include "accuracy/step_choice.h"
#include "algebra/constants.h"
#include "integration/step_methods.h"

namespace whirl_twin {

/// The implicit, symplectic method that the others are compared with.
inline constexpr const char* kReferenceMethod = "gauss_legendre_6";

StepSetting settingOf(const Scene& one, const StepChoice& choice);
int mostSubsteps(const Scene& one);
/// Number of doublings of the substeps for a given ratio of error to tolerance.
int doublings(double times, int order);

class StepSearch {
 public:
  /// The arguments must outlive it.
  StepSearch(const Scene& one, const ModelSetup& setup, StepJudge& judge)
      : one_(one), setup_(setup), judge_(judge) {}

  void tryMethod(const StepMethod& method);
  /// One that steps ahead of the twin, by as many steps as it may.
  void tryAhead(const StepMethod& method);
  bool found() const { return found_.has_value(); }
  /// The initial setting if no candidate satisfies the tolerance.
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
