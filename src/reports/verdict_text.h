// The words for a verdict on stability and for its margins.
#pragma once

#include <string>
#include <vector>

#include "analysis/routh.h"

namespace whirl_twin {

/// A number for a report, or the words for one that is not defined (NaN).
std::string defined(double x, const char* undefined);

/// "asymptotically stable", "marginal: ..." and so on.
std::string verdictText(Verdict verdict);

/// Lines of a report: root counts and the first column of Routh's table.
std::string routhText(const RouthResult& routh);

/// Lines of a report. decay_rate [1/s]; a NaN is a margin that is not defined.
std::string marginsText(double decay_rate, double damping_ratio, double log_decrement);

/// What API 617 asks of a running speed beside a critical speed (analysis/separation_margin.h), and
/// what an amplification factor is: a line each.
std::vector<std::string> separationConditions();

}  // namespace whirl_twin
