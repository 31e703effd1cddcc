// What a number of a scene must be, and the words for one that is not: the same where it is read
// and where it is changed while the twin runs.
#pragma once

#include <string>
#include <vector>

#include "mechanics/model_description.h"

namespace whirl_twin {

/// "> 0 kg", "a finite number in m"; the unit "-" is not said.
std::string expected(Range range, const std::string& unit);

/// Finite, and in the range.
bool inRange(Range range, double value);

/// "must be > 0 kg, found -1"; "" for a number in range.
std::string objection(Range range, const std::string& unit, double value);

/// "unknown parameter of jeffcott_rotor; did you mean 'damping'?"; "" for a name that is `known`.
std::string objectionToName(const std::string& name, const std::vector<std::string>& known,
                            const std::string& kind);

}  // namespace whirl_twin
