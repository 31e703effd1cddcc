// What a flexible rotor is made of: tables of its parts, its drawing to scale, and the diagrams of
// its weight.
#pragma once

#include <string>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "reports/figure.h"
#include "reports/rotor_sheet.h"

namespace whirl_twin {

struct PartsTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// Elements (alike ones that follow each other in one row), couplings, sleeves, discs, bearings and
/// pedestals with their coefficients at a speed [rad/s], damping by mode, unbalances: those that it
/// has.
std::vector<PartsTable> partsTables(const FlexibleShaft& shaft, double speed);

/// From the side: shaft, sleeves, discs D1, D2 ... in the order of the scene, bearings with their
/// nodes.
Figure drawingFigure(const FlexibleShaft& shaft);

/// Sag, shear force and bending moment along y. Of a sheet with statics.
Figure staticsFigure(const RotorSheet& sheet);

}  // namespace whirl_twin
