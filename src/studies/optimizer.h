// Looks for the numbers at which a measure is least, or greatest, among those that meet what is
// required: by NLopt (S. G. Johnson), over the evaluator of points. No derivatives are asked for.
//
//   bobyqa   quadratic models in a trust region, no requirements (M. J. D. Powell, 2009)
//   cobyla   linear models of measure and requirements (Powell, 1994)
//   crs      controlled random search over the whole range, no requirements (Kaelo & Ali, 2006)
//   isres    evolution over the whole range, with requirements (Runarsson & Yao, 2005)
//
// The first two go down from where the scene is, and find the valley that they start in. Numbers
// are searched in parts of their ranges, of logarithms where they vary so. The same study has the
// same answer: randomness is of its seed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "studies/point_evaluator.h"
#include "studies/study.h"

namespace whirl_twin {

struct Optimum {
  std::vector<double> start;  ///< values of all that varies, where it began
  Outcome at_start;
  /// Of the best point that meets all requirements; empty: none was found that does.
  std::vector<double> values;
  std::vector<double> measures;
  std::uint64_t evaluations = 0;
  std::uint64_t failures = 0;  ///< of them
  bool converged = false;
  std::string ended;  ///< why
};

/// done(evaluations) is called after each. Throws Interrupted.
Optimum optimize(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop,
                 const std::function<void(std::uint64_t)>& done);

}  // namespace whirl_twin
