// The words for a model's parameters.
#pragma once

#include <string>
#include <vector>

#include "models/model_info.h"

namespace whirl_twin {

/// What a setting holds: the columns of a table with their units; the words of a choice, its
/// default first.
std::string contentsText(const SettingInfo& setting);

/// "auto" and the methods that a form of a model can step with.
std::vector<std::string> integratorsOf(const ModelVariant& variant);

}  // namespace whirl_twin
