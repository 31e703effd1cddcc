// External excitation of a system during a step: the drive of its shaft, and its inputs.
#pragma once

#include "control/drive.h"
#include "control/inputs.h"

namespace whirl_twin {

/// Both outlive the stepper, and are at the start of each step.
struct StepContext {
  const Drive& drive;
  const Inputs* inputs = nullptr;  ///< in the order of Dynamics::inputs(); nullptr: nothing acts

  StepContext(const Drive& on_drive, const Inputs* with_inputs = nullptr)
      : drive(on_drive),
        inputs(with_inputs != nullptr && with_inputs->any() ? with_inputs : nullptr) {}
};

}  // namespace whirl_twin
