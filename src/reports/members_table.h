// The members of an ensemble as comma-separated values: what was drawn and what came of it.
#pragma once

#include <string>
#include <vector>

#include "twin/twin.h"

namespace whirl_twin {

/// Writes a row for each member of the one ensemble among `systems`: its number, the values drawn,
/// then each quantity now and at its peak; 17 significant digits, nan for one that has stopped.
/// Throws RunFailure.
void writeMembers(const Twin& twin, const std::vector<std::size_t>& systems,
                  const std::string& path);

}  // namespace whirl_twin
