// A controller as scenes see it: its name and parameters, and how to make one.
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

/// x' = a x + b u, y = c x: what a controller acts on and measures, for small motions about where
/// it starts. States are the coordinates, then their rates, of each system in turn.
struct LinearPlant {
  Eigen::MatrixXd a;  ///< [n x n]
  Eigen::MatrixXd b;  ///< [n x outputs of the controller]
  Eigen::MatrixXd c;  ///< [measured by the controller x n]
};

/// What is around a controller.
struct ControllerPlan {
  double rate = 0.0;  ///< [Hz]
  std::size_t measured = 0;
  std::size_t outputs = 0;
  /// Of each output, in its unit: it is kept within +- this. Infinite: no limit.
  std::vector<double> limits;
  /// Of small motions; nothing where there is no telling.
  std::optional<LinearPlant> plant = std::nullopt;
  /// About the critical speeds of what a shaft turns, where a speed controller is to avoid them.
  std::vector<SpeedBand> critical_bands = {};
  /// The first band that its motor is known not to bring a shaft through.
  std::optional<SpeedBand> impassable = std::nullopt;
};

struct ControllerInfo {
  std::string name;
  std::string summary;
  std::vector<ParameterInfo> parameters;
  std::vector<SettingInfo> settings;

  /// With these parameters (all of `parameters`) and settings. Throws SetupError, a name of either
  /// with what is wrong.
  std::function<std::unique_ptr<Controller>(const ParameterValues&, const Settings&,
                                            const ControllerPlan&)>
      make;
};

}  // namespace whirl_twin
