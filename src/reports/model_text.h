// The words for the parameters of models and controllers.
#pragma once

#include <string>
#include <vector>

#include "models/model_info.h"
#include "reports/output.h"

namespace whirl_twin {

/// What a setting holds: the columns of a table with their units; the words of a choice, its
/// default first.
std::string contentsText(const SettingInfo& setting);

/// A line each, of `twin models` and `twin controllers`; without: what one without a default is.
std::string parameterText(const ParameterInfo& parameter, const std::string& without = "required");
std::string settingText(const SettingInfo& setting);

/// {"unit", "range", "default", "required", "meaning"}
Json parameterJson(const ParameterInfo& parameter);
/// {"kind", "required", "meaning", "choices", "default", "columns"}
Json settingJson(const SettingInfo& setting);

/// "auto" and the methods that a form of a model can step with.
std::vector<std::string> integratorsOf(const ModelVariant& variant);

}  // namespace whirl_twin
