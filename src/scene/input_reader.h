// Reads what the inputs of a system follow: a number, a harmonic, or a table, in the scene or in a
// file of comma-separated values, as it is or through an input shaper.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "control/input_signal.h"
#include "mechanics/dynamics.h"
#include "scene/node_reader.h"

namespace whirl_twin {

/// Largest instant accepted, of a table or of the scene's start [s].
inline constexpr double kMaxInstant = 1.0e9;

/// Those under `inputs` of a system, by name. `folder`: where tables with a relative path lie; "":
/// the scene has none.
std::map<std::string, InputSignal> readInputs(const MapReader& system,
                                              const std::vector<InputInfo>& inputs,
                                              const std::string& folder, Complaints& complaints);

/// One signal for each input of a model, in its order; those not given do not act. Throws
/// std::logic_error for a name that the model does not have.
std::vector<InputSignal> signalsOf(const std::vector<InputInfo>& inputs,
                                   const std::map<std::string, InputSignal>& given);

}  // namespace whirl_twin
