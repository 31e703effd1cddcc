// What a flexible rotor is made of, in tables: to be held beside the drawing.
#pragma once

#include <string>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"

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

}  // namespace whirl_twin
