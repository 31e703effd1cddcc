// How far the steps of a method with a past (stoermer.h) are from growing what does not grow.
#pragma once

#include "accuracy/trajectory.h"
#include "models/model_info.h"

namespace whirl_twin {

/// Would small deviations from a motion of a scene of one system, looked at here and there along
/// it, grow no faster than they do by themselves, in steps so many times as long as the setting's?
/// The method is one with a past.
bool growsNothing(const Scene& one, const ModelSetup& setup, const Trajectory& motion,
                  const StepSetting& setting, int times);

}  // namespace whirl_twin
