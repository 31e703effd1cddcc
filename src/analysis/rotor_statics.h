// Mass properties of a flexible rotor and its static deflection under its weight, to be checked
// against the drawing, with the diagrams of shear force and bending moment (S. Timoshenko, Strength
// of Materials, 1930).
//
//   K q = weight,   V(z) = sum of the forces along y left of z,   M(z) = integral of V
//
// M > 0: the shaft sags. Likewise along x, where bearings couple the two.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

struct RotorBody {
  double mass = 0.0;                ///< [kg]
  double centre = 0.0;              ///< [m], of gravity, from node 0
  double polar_inertia = 0.0;       ///< [kg m^2], about the shaft
  double transverse_inertia = 0.0;  ///< [kg m^2], about a diameter through the centre of gravity
};

RotorBody rotorBody(const FlexibleShaft& shaft);

/// Along x and y.
struct Across {
  double x = 0.0, y = 0.0;
};

struct BearingLoad {
  int node = 0;
  Across force;  ///< [N], on the rotor
};

/// At a node; where a force acts the shear force jumps.
struct SagAtNode {
  double position = 0.0;  ///< [m], from node 0
  Across deflection;      ///< [m]
  Across shear_before;    ///< [N], towards node 0
  Across shear_after;     ///< [N]
  Across moment;          ///< [N m]
};

struct RotorStatics {
  std::vector<BearingLoad>
      bearings;  ///< in the shaft's order, those that follow the speed, rigid ones
  std::vector<SagAtNode> nodes;
};

/// Under `gravity` [m/s^2] along -y, with the bearing coefficients at a speed [rad/s]. Nothing for
/// a rotor with a rigid-body mode.
std::optional<RotorStatics> rotorStatics(const FlexibleShaft& shaft, double gravity, double speed);

}  // namespace whirl_twin
