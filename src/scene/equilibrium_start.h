// A start at rest: where a system hangs, sags or stands at the speed that its shaft starts with, so
// that nothing but what excites it makes it vibrate.
#pragma once

#include <optional>
#include <vector>

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

struct StartingState {
  std::vector<double> q;  ///< [rad] or [m]
  std::vector<double> v;  ///< [rad/s] or [m/s], zero but for cyclic coordinates
};

/// The equilibrium or steady motion at a speed of the shaft [rad/s] that the system creeps to from
/// all coordinates at 0, a bounded one if there is any; without its inputs, its controllers and
/// what turns with its shaft. The angle of a motor's shaft stays at 0. Nothing where it rests
/// nowhere, as journals without a film.
std::optional<StartingState> equilibriumStart(const ModelInfo& model, const SystemSpec& spec,
                                              const ModelSetup& setup, const Surroundings& around,
                                              double speed);

/// Whether a scene that gives no `initial` starts it there: a rotor that feels the scene's gravity.
bool startsAtEquilibrium(const SystemSpec& spec, const ModelSetup& setup,
                         const Surroundings& around);

/// A member of an ensemble starts as far from its own equilibrium `own` as it was drawn from that
/// of the system as given; where it has none, from 0. Throws Refusal where an equilibrium was asked
/// for.
void moveToEquilibrium(const SystemSpec& given, const std::optional<StartingState>& own,
                       const Surroundings& around, SystemSpec& member);

}  // namespace whirl_twin
