// Limits of parameters. Values that are each in range may together give rates that overflow a
// double: a mass of 5e-324 kg on a spring of 1e4 N/m.
#pragma once

#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/model_description.h"
#include "scene/scene.h"

namespace whirl_twin {

// Range of a number of a scene, and the text for a violation: the same when the scene is read and
// when the number is changed while the twin runs.

/// "> 0 kg", "a finite number in m"; the unit "-" is omitted.
std::string expected(Range range, const std::string& unit);

/// Finite, and in the range.
bool inRange(Range range, double value);

/// "must be > 0 kg, found -1"; "" for a number in range.
std::string objection(Range range, const std::string& unit, double value);

/// "unknown parameter of jeffcott_rotor; did you mean 'damping'?"; "" for a name that is `known`.
std::string nameDiagnostic(const std::string& name, const std::vector<std::string>& known,
                           const std::string& kind);

/// [1/s], largest rate of a system: damping over mass, and the square root of stiffness over mass.
/// The product of four of them is a coefficient of a characteristic polynomial of two coordinates.
inline constexpr double kMaxRate = 1.0e75;

/// Why the equations of a system overflow, from its linearization at the initial coordinates, with
/// zero rates and a shaft that turns at `speed` [rad/s]; "" if the rates are within kMaxRate.
std::string ratesDiagnostic(const Dynamics& dynamics, const SystemSpec& spec, double speed);

}  // namespace whirl_twin
