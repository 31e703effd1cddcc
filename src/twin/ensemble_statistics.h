// Mean, standard deviation and percentiles of an ensemble.
#pragma once

#include <vector>

#include "messages/states.h"
#include "twin/ensemble.h"

namespace whirl_twin {

/// The percentile p [%] of values in ascending order, linear between them (Hyndman & Fan, The
/// American Statistician 50, 1996, definition 7). NaN of none.
double percentile(const std::vector<double>& ascending, double p);

/// Of one record of an ensemble, with its step, but without its time and system.
state::EnsembleState ensembleStatistics(const Ensemble& ensemble, const double* record);

}  // namespace whirl_twin
