// Controllers made as by a scene: parameters that are not given have their defaults.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "controllers/controller_registry.h"

namespace whirl_twin {

/// Around a controller: `axes` measured, as many outputs without limits.
inline ControllerPlan planOf(double rate, std::size_t axes) {
  ControllerPlan plan;
  plan.rate = rate;
  plan.measured = axes;
  plan.outputs = axes;
  plan.limits.assign(axes, std::numeric_limits<double>::infinity());
  return plan;
}

inline std::unique_ptr<Controller> made(const std::string& name, const ParameterValues& given,
                                        Settings settings, const ControllerPlan& plan) {
  const ControllerInfo* info = findController(name);
  if (info == nullptr) {
    throw std::logic_error("no controller " + name);
  }
  ParameterValues values;
  for (const ParameterInfo& parameter : info->parameters) {
    const auto found = given.find(parameter.name);
    values[parameter.name] = found != given.end() ? found->second
                             : parameter.fallback ? *parameter.fallback
                                                  : values.at(parameter.fallback_parameter);
  }
  for (const SettingInfo& setting : info->settings) {
    if (setting.kind == SettingKind::kChoice) {
      settings.choices.insert({setting.name, setting.choices.front()});
    }
  }
  return info->make(values, settings, plan);
}

/// Parameter and text of the error; empty if it is made.
inline std::pair<std::string, std::string> inputError(const std::string& name,
                                                      const ParameterValues& given,
                                                      const Settings& settings,
                                                      const ControllerPlan& plan) {
  try {
    made(name, given, settings, plan);
  } catch (const SetupError& error) {
    return {error.parameter(), error.what()};
  }
  return {};
}

/// A sample of a controller without a shaft.
inline ControlSample sampleOf(const double* values, std::int64_t index = 0) {
  return {values, index, 0, {}, 0.0};
}

}  // namespace whirl_twin
