// A model as scenes see it: its name, coordinates, parameters and methods, and how to build one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/drive.h"
#include "mechanics/dynamics.h"
#include "mechanics/model_description.h"
#include "scene/system.h"

namespace whirl_twin {

using ParameterValues = std::map<std::string, double>;

struct ParameterInfo {
  std::string name;
  std::string unit;
  Range range;
  std::string meaning;
  std::optional<double> fallback;  ///< absent, with no fallback_parameter: must be given
  std::string fallback_parameter;  ///< default: the value of this one
};

struct ModelInfo {
  std::string name;
  std::string summary;
  std::vector<Coordinate> coordinates;
  std::vector<ParameterInfo> parameters;
  bool linear = false;
  bool has_shaft = false;  ///< a scene gives it a drive or a constant speed
  bool rotor = false;      ///< x, y of a whirling disc: published as WhirlState
  std::vector<std::string> integrators;

  /// The model with these parameters (all of `parameters`), in a field of gravity [m/s^2].
  std::function<std::shared_ptr<const Dynamics>(const ParameterValues&, double gravity)> dynamics;
  /// The same, stepping with one of `integrators`: step [s] in `substeps` parts, on a drive that
  /// outlives it.
  std::function<std::unique_ptr<System>(const ParameterValues&, double gravity,
                                        const std::string& integrator, const Drive&, double step,
                                        int substeps)>
      system;
};

/// "> 0", ">= 0" or "finite".
const char* describe(Range range);

}  // namespace whirl_twin
