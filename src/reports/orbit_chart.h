// Orbits where they are along a shaft, seen from the side; of stations that are not apart, in the
// plane across it.
#pragma once

#include <string>
#include <vector>

#include "analysis/orbit.h"
#include "mechanics/linear_rotor.h"
#include "plots/chart.h"

namespace whirl_twin {

struct OrbitChart {
  Chart chart;
  bool along_shaft = false;  ///< else across it
};

/// The instant at which the shaft is drawn along the orbits: of a response as its phase mark passes
/// x; of a mode, whose phase is nobody's, as the widest orbit is highest.
enum class DrawnInstant { kPhaseMark, kWidestHighest };

/// `orbits` at each of the stations, in `unit`: blue where they run with the rotation, vermilion
/// where against it, and the shaft at one instant.
OrbitChart orbitChart(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                      const std::string& unit, DrawnInstant instant);

}  // namespace whirl_twin
