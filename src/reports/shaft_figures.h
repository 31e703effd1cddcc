// A flexible rotor on paper: its drawing to scale, and the diagrams of its weight.
#pragma once

#include "mechanics/rotors/rotor_assembly.h"
#include "plots/chart.h"
#include "reports/rotor_sheet.h"

namespace whirl_twin {

/// From the side: shaft, sleeves, discs D1, D2 ... in the order of the scene, bearings with their
/// nodes.
Figure drawingFigure(const FlexibleShaft& shaft);

/// Sag, shear force and bending moment along y. Of a sheet with statics.
Figure staticsFigure(const RotorSheet& sheet);

}  // namespace whirl_twin
