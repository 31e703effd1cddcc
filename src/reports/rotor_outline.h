// A rotor from the side, as areas of a chart along its axis: shaft, sleeves, discs, and where its
// bearings are; and orbits where they are along it.
#pragma once

#include <string>
#include <vector>

#include "analysis/orbit.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "reports/figure.h"

namespace whirl_twin {

/// How a disc is drawn [m]: one without dimensions as the cylinder of its inertias, and one without
/// inertias, a point mass, as thin as the shaft is there.
struct DrawnDisc {
  double radius = 0.0, width = 0.0;
};
DrawnDisc drawnDisc(const FlexibleShaft& shaft, const RotorDisc& disc);

/// [m], the largest of anything drawn.
double largestRadius(const FlexibleShaft& shaft);

/// Nodes that bearings are at, ascending.
std::vector<int> bearingNodes(const FlexibleShaft& shaft);

/// Heights are radii times `scale`; `pale`: share of white, for what stands behind something else.
std::vector<Series> rotorOutline(const FlexibleShaft& shaft, double scale, double pale);

struct OrbitChart {
  Chart chart;
  bool along_shaft = false;  ///< else across it
  Chart plane;               ///< the widest of them across the shaft, with equal axes
};

/// The instant at which the shaft is drawn along the orbits: of a response as its phase mark passes
/// x; of a mode, whose phase is nobody's, as the widest orbit is highest.
enum class DrawnInstant { kPhaseMark, kWidestHighest };

/// `orbits` at each of the stations, in `unit`: blue where they run with the rotation, vermilion
/// where against it, and the shaft at one instant.
OrbitChart orbitChart(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                      const std::string& unit, DrawnInstant instant);

}  // namespace whirl_twin
