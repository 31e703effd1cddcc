// Minimizes or maximizes a measure over varied numbers, subject to requirements, by derivative-free
// methods of NLopt (S. G. Johnson) and the evaluator of points.
//
//   bobyqa   quadratic models in a trust region, no requirements (M. J. D. Powell, 2009)
//   cobyla   linear models of measure and requirements (Powell, 1994)
//   crs      controlled random search over the whole range, no requirements (Kaelo & Ali, 2006)
//   isres    evolution over the whole range, with requirements (Runarsson & Yao, 2005)
//
// The first two are local and start from the nominal scene. Numbers are normalized to their ranges,
// logarithmically for log-uniform ones. Results are reproducible: random numbers follow from the
// seed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "studies/point_evaluator.h"
#include "studies/study.h"

namespace whirl_twin {

struct Optimum {
  std::vector<double> start;  ///< start values of all varied numbers
  Outcome at_start;
  /// Best point that meets all requirements; empty: none.
  std::vector<double> values;
  std::vector<double> measures;
  std::uint64_t evaluations = 0;
  std::uint64_t failures = 0;  ///< failed ones of them
  bool converged = false;
  std::string ended;  ///< reason of the end
};

/// done(evaluations) is called after each. Throws Interrupted.
Optimum optimize(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop,
                 const std::function<void(std::uint64_t)>& done);

}  // namespace whirl_twin
