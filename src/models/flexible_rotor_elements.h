// Nonlinear elements at a flexible rotor's nodes: forces on its shaft and its pedestals, and their
// linear part.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/linear_rotor.h"
#include "mechanics/local_force.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "models/local_element_settings.h"

namespace whirl_twin {

/// In the coordinates of `assembly`, without what is linear.
std::vector<LocalForce> forcesOf(const std::vector<NodeElement>& elements,
                                 const FlexibleShaft& shaft, const RotorAssembly& assembly);

/// The directions along x and y of forces. [dof x twice as many]
Eigen::MatrixXd directionsOf(const std::vector<LocalForce>& forces, Eigen::Index dof);

/// The shaft with what of these elements is linear.
FlexibleShaft withDamping(FlexibleShaft shaft, const std::vector<NodeElement>& elements);

/// The rotor for the choice of its retained modes: on journal bearings linearized under an equal
/// share of its weight.
LinearRotor inItsFilms(FlexibleShaft shaft, const std::vector<NodeElement>& elements);

}  // namespace whirl_twin
