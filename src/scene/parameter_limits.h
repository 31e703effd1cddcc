// Parameters that are in range one by one and together make rates that no double carries: a mass of
// 5e-324 kg on a spring of 1e4 N/m.
#pragma once

#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/model_description.h"
#include "scene/scene.h"

namespace whirl_twin {

// What a number of a scene must be, and the words for one that is not: the same where it is read
// and where it is changed while the twin runs.

/// "> 0 kg", "a finite number in m"; the unit "-" is not said.
std::string expected(Range range, const std::string& unit);

/// Finite, and in the range.
bool inRange(Range range, double value);

/// "must be > 0 kg, found -1"; "" for a number in range.
std::string objection(Range range, const std::string& unit, double value);

/// "unknown parameter of jeffcott_rotor; did you mean 'damping'?"; "" for a name that is `known`.
std::string objectionToName(const std::string& name, const std::vector<std::string>& known,
                            const std::string& kind);

/// [1/s], of a system: damping over mass, and the root of stiffness over mass. The product of four
/// is a coefficient of a characteristic polynomial of two coordinates.
inline constexpr double kLargestRate = 1.0e75;

/// Why no evaluation of a system can be right, by the matrices of its small deviations where it
/// starts, at rest, with a shaft that turns at `speed` [rad/s]; "": they are within kLargestRate.
std::string objectionToRates(const Dynamics& dynamics, const SystemSpec& spec, double speed);

}  // namespace whirl_twin
