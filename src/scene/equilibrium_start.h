// Initial state at equilibrium: the static deflection of a system at the initial speed of its
// shaft, so that only its excitation makes it vibrate.
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

/// The equilibrium or steady motion at a shaft speed [rad/s] that the system approaches
/// quasi-statically from all coordinates at 0, a bounded one if there is any; without its inputs,
/// its controllers and its synchronous forces. The angle of a motor's shaft remains 0. Nothing if
/// there is no equilibrium, as of journals without an oil film.
std::optional<StartingState> equilibriumStart(const ModelInfo& model, const SystemSpec& spec,
                                              const ModelSetup& setup, const ModelContext& around,
                                              double speed);

/// Whether a scene without `initial` starts the system there: a rotor under the scene's gravity.
bool startsAtEquilibrium(const SystemSpec& spec, const ModelSetup& setup,
                         const ModelContext& around);

/// Shifts the drawn initial state of an ensemble sample from the equilibrium of the given system to
/// the sample's own equilibrium `own`, or to 0 if it has none. Throws InputError if the scene
/// requires an equilibrium that the sample does not have.
void moveToEquilibrium(const SystemSpec& given, const std::optional<StartingState>& own,
                       const ModelContext& around, SystemSpec& member);

}  // namespace whirl_twin
