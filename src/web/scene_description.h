// What a scene has for clients: a description for the page, of its systems with their coordinates,
// parameters and inputs, its drives and controllers, with units and ranges; channels; parameters.
#pragma once

#include <string>
#include <vector>

#include "reports/output.h"
#include "scene/built_scene.h"
#include "twin/step_messages.h"
#include "web/web_channels.h"

namespace whirl_twin {

/// The name of a parameter of a system or controller for clients: "rotor/discs[1].mass".
std::string parameterName(const std::string& subject, const std::string& path);
/// Its parts; an empty path where the name has none.
struct ParameterPlace {
  std::string subject, path;
};
ParameterPlace parameterPlace(const std::string& name);

/// With the values of the scene's start.
Json sceneDescription(const BuiltScene& scene, bool read_only);

/// The channels of a scene's twin and its monitor, and those for the page.
void addTwinChannels(WebChannels& channels, const BuiltScene& scene, const StepMessages& messages);
/// The parameters of a description, with its values. Before the server starts.
void addParameters(Protocol& protocol, const Json& description);

}  // namespace whirl_twin
