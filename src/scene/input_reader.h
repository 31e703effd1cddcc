// Reads the input signals of a system: a number, a harmonic, or a table, in the scene or in a file
// of comma-separated values, direct or through an input shaper.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "control/input_signal.h"
#include "mechanics/dynamics.h"
#include "scene/node_reader.h"

namespace whirl_twin {

/// Largest instant of a table or of the start of a scene [s].
inline constexpr double kMaxInstant = 1.0e9;

/// Reads the `inputs` of a system, by name. `folder`: base of relative paths of tables; "": the
/// scene has none.
std::map<std::string, InputSignal> readInputs(const MapReader& system,
                                              const std::vector<InputInfo>& inputs,
                                              const std::string& folder, Diagnostics& diagnostics);

/// One signal for each input of a model, in its order; inputs not given are zero. Throws
/// std::logic_error for a name that the model does not have.
std::vector<InputSignal> signalsOf(const std::vector<InputInfo>& inputs,
                                   const std::map<std::string, InputSignal>& given);

}  // namespace whirl_twin
