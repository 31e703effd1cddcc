// A system with the harmonic inputs that its scene gives it, as equations of their own. Small
// motions of a linear system do not see such an input. Those of any other are about the periodic
// motion that the input drives, and only its multipliers (analysis/floquet.h) judge them.
#pragma once

#include <memory>

#include "mechanics/dynamics.h"
#include "scene/scene.h"

namespace whirl_twin {

/// The dynamics that its stability is judged by: those given, where no harmonic input acts or they
/// are linear; with these inputs otherwise, at zero in atMeanLoad(). Inputs of other kinds are left
/// out: commands, tables and constants are no part of a system's own motion.
std::shared_ptr<const Dynamics> judgedDynamics(std::shared_ptr<const Dynamics> dynamics,
                                               const SystemSpec& spec);

}  // namespace whirl_twin
