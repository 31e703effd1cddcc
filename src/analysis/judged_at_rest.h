// What cannot be judged where no equilibrium of it was found.
#pragma once

#include "analysis/stability.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Whether it can be judged only about an equilibrium: a nonlinear rotor elsewhere, with journals
/// that no film carries, is in no steady motion, and one that alternating loads drive in no
/// periodic one. Any other system is linearized where it is.
bool isJudgedOnlyAtRest(const Dynamics& dynamics);
/// The verdict kUncertain, without numbers: of one like that for which no equilibrium was found.
Stability unjudged();

}  // namespace whirl_twin
