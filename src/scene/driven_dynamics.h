// A system with the harmonic inputs of its scene as one set of equations. Small motions of a linear
// system do not depend on such an input. For any other system they are about the periodic motion
// that the input drives, whose stability follows from its multipliers (analysis/floquet.h).
#pragma once

#include <memory>

#include "mechanics/dynamics.h"
#include "scene/scene.h"

namespace whirl_twin {

/// The dynamics for the stability analysis: the given ones if no harmonic input acts or they are
/// linear; otherwise with these inputs, which are zero in atMeanLoad(). Inputs of other kinds are
/// excluded: commands, tables and constants are not part of a system's free motion.
std::shared_ptr<const Dynamics> judgedDynamics(std::shared_ptr<const Dynamics> dynamics,
                                               const SystemSpec& spec);

}  // namespace whirl_twin
