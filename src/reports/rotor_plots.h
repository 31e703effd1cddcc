// What is drawn of a rotor's run: whirl radius and lag over time, orbits, and when it passes its
// critical speeds.
#pragma once

#include <vector>

#include "plots/chart.h"
#include "reports/plot_history.h"
#include "scene/built_system.h"

namespace whirl_twin {

/// Whirl radius, phase lag where there is one to be seen, and the speed of the shaft, over time.
std::vector<Chart> rotorCharts(const PlotHistory& history);

/// When a rotor that changes its speed passes its critical speeds: named in the first chart, and
/// across all of them. Of a speed that is passed again and again (a controller holds it) nothing,
/// nor of a rotor that controllers hold: its critical speeds are theirs too.
void markCriticalSpeeds(const BuiltSystem& system, const PlotHistory& history,
                        std::vector<Chart>& charts);

/// At constant speed the whole path; else single turns of the shaft, the widest one among them.
Figure orbitFigure(const PlotHistory& history);

}  // namespace whirl_twin
