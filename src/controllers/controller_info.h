// Description of a type of controller for scenes: its name and parameters, and its factory.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/exclusion_bands.h"
#include "controllers/controller.h"
#include "models/model_info.h"

namespace whirl_twin {

/// x' = a x + b u, y = c x: the linearized plant of a controller about its initial state. States
/// are the coordinates, then their rates, of each system in turn.
struct LinearPlant {
  Eigen::MatrixXd a;  ///< [n x n]
  Eigen::MatrixXd b;  ///< [n x outputs of the controller]
  Eigen::MatrixXd c;  ///< [measured by the controller x n]
};

/// The surroundings of a controller.
struct ControllerPlan {
  double rate = 0.0;  ///< [Hz]
  std::size_t measured = 0;
  std::size_t outputs = 0;
  /// Of each output, in its unit: saturation at +- this. Infinite: no limit.
  std::vector<double> limits;
  /// Linearized; empty where there is none.
  std::optional<LinearPlant> plant = std::nullopt;
  /// About the critical speeds of the rotors on a shaft, where a speed controller is to avoid them.
  std::vector<SpeedBand> critical_bands = {};
  /// The first band known to exceed the motor's capability.
  std::optional<SpeedBand> impassable = std::nullopt;
};

struct ControllerInfo {
  std::string name;
  std::string summary;
  std::vector<ParameterInfo> parameters;
  std::vector<SettingInfo> settings;

  /// With these parameters (all of `parameters`) and settings. Throws SetupError with the name of
  /// the one in error.
  std::function<std::unique_ptr<Controller>(const ParameterValues&, const Settings&,
                                            const ControllerPlan&)>
      make;
};

}  // namespace whirl_twin
