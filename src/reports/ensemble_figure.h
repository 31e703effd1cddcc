// An ensemble as a picture: percentiles over time, and how the peaks of its members are spread.
#pragma once

#include "plots/chart.h"
#include "reports/plot_history.h"
#include "twin/ensemble.h"

namespace whirl_twin {

/// Of an ensemble at the end of a run, and of the system beside it.
Figure ensembleFigure(const Ensemble& ensemble, const PlotHistory& history);

}  // namespace whirl_twin
