// Models of the registry with the parameters of a test; the others at their defaults.
#pragma once

#include <memory>

#include "models/model_registry.h"

namespace whirl_twin {

/// Missing parameters take their defaults; gravity [m/s^2].
inline std::shared_ptr<const Dynamics> dynamicsOf(const std::string& model, ParameterValues values,
                                                  double gravity = 9.81,
                                                  const Settings& settings = {}) {
  const ModelInfo& info = *findModel(model);
  for (const ParameterInfo& p : info.parameters) {
    if (values.count(p.name) == 0) {
      values[p.name] =
          p.fallback_parameter.empty() ? p.fallback.value() : values.at(p.fallback_parameter);
    }
  }
  return info.setUp(values, settings, gravity).dynamics;
}

}  // namespace whirl_twin
