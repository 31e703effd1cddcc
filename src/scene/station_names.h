// Under which names a rotor's whirl is published: the system's own for the station published first,
// SYSTEM_STATION for every further one. Topics and channels follow from them as from a system's.
#pragma once

#include <string>
#include <vector>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// "rotor_node_3"
std::string stationName(const std::string& system, const Station& station);

/// All names of a system, its own first; of what is no rotor only that.
std::vector<std::string> publishedStations(const std::string& system, const Dynamics& dynamics);

}  // namespace whirl_twin
