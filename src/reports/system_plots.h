// What a system did, as charts, and what it looks like.
#pragma once

#include <string>
#include <vector>

#include "plots/canvas.h"
#include "reports/plot_history.h"
#include "twin/twin.h"

namespace whirl_twin {

struct SystemPlot {
  std::string kind;   ///< "picture", "time", "phase", "energy" or "ensemble"
  std::string image;  ///< the file
};

/// Its picture (where it has one), time history, phase portrait (of a rotor: orbit) and energies,
/// and its ensemble, at the end of the run, unless that is null. Throws RunFailure.
std::vector<SystemPlot> systemPlots(const BuiltSystem& system, const Ensemble* ensemble,
                                    const PlotHistory& history, ImageFormat format);

}  // namespace whirl_twin
