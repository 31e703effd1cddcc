// Rotors without bearings, for tests: shafts of any number of elements with a disc.
#pragma once

#include "analysis/modal_reduction.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

/// A steel shaft with a disc of 10 kg in its middle; transverse inertia of a flat disc.
inline FlexibleShaft freeShaft(int elements, double length, double polar_inertia,
                               double internal_damping = 0.0) {
  FlexibleShaft shaft;
  shaft.material = {2.0e11, 8.0e10, 7800.0, true};
  shaft.internal_damping = internal_damping;
  for (int i = 0; i < elements; ++i) {
    shaft.elements.push_back({length / elements, 0.05, 0.0});
  }
  shaft.discs = {{elements / 2, 10.0, polar_inertia, 0.55 * polar_inertia}};
  return shaft;
}

/// In the coordinates of its nodes.
inline LinearRotor freeRotor(const FlexibleShaft& shaft) {
  return RotorAssembly(shaft).linearRotor();
}

/// In modal coordinates of a few modes.
inline LinearRotor reducedFreeRotor(const FlexibleShaft& shaft) {
  const RotorAssembly full(shaft);
  const LinearRotor rotor = full.linearRotor();
  return full.in(reduceRotor(rotor, full.stations(), usualHighestSpeed(rotor), 8).shapes)
      .linearRotor();
}

}  // namespace whirl_twin
