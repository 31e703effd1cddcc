// Draws the members of an ensemble. A member depends on the seed and its own number only: another
// count, or another machine, gives the same members.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

struct DrawnMember {
  SystemSpec spec;             ///< of a single system
  std::vector<double> values;  ///< of spec.ensemble.spread, in its order
};

/// Member `index` of the ensemble of `spec`. A value outside its parameter's range is drawn again;
/// a parameter that by default is another's (stiffness_y), and has that one's value in the scene,
/// goes with it. Throws Refusal where hardly a draw is in range.
DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index);

/// What a number is spread about.
double centreOf(const Spread& spread, const SystemSpec& spec, const ModelInfo& model);

/// The system with these numbers, in the order of spec.ensemble.spread, and those that go with
/// them; nothing where one is out of its range.
std::optional<SystemSpec> memberAt(const SystemSpec& spec, const ModelInfo& model,
                                   const std::vector<double>& values);

/// Why an ensemble cannot be drawn; "" if it can.
std::string spreadObjection(const SystemSpec& spec, const ModelInfo& model);

}  // namespace whirl_twin
