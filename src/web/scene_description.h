// What the page must know of a scene: its systems with their coordinates, parameters and inputs,
// its drives and controllers, with units and ranges.
#pragma once

#include <string>
#include <vector>

#include "reports/output.h"
#include "twin/twin.h"

namespace whirl_twin {

/// The name of a parameter of a system or controller for clients: "rotor/discs[1].mass".
std::string parameterName(const std::string& subject, const std::string& path);
/// Its parts; an empty path where the name has none.
struct ParameterPlace {
  std::string subject, path;
};
ParameterPlace parameterPlace(const std::string& name);

/// With the values of the scene's start.
Json sceneDescription(const Twin& twin, bool read_only);

}  // namespace whirl_twin
