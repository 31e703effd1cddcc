// A rotor from the side, as areas of a chart along its axis: shaft, sleeves, discs, and where its
// bearings are.
#pragma once

#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "plots/chart.h"

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

}  // namespace whirl_twin
