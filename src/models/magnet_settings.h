// Magnetic bearings as scenes give them, for every rotor that may have them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/local_force.h"
#include "models/settings.h"

namespace whirl_twin {

/// Along x, and so along y: a force ki i + ks x for small motions about the middle.
struct RotorMagnet {
  double ki = 0.0;  ///< [N/A], of its control current
  double ks = 0.0;  ///< [N/m], of the displacement: it pulls away from the middle
  /// 0: it is linear (mechanics/magnetic_bearing.h)
  double gap = 0.0;         ///< [m]
  double bias = 0.0;        ///< [A]
  double saturation = 0.0;  ///< [N], of a pole; 0: none
};

/// A table `magnets` whose rows begin with `first`; `inputs` names the control currents.
SettingInfo magnetsSetting(std::vector<ColumnInfo> first, const std::string& inputs);
/// Its rows as given, none if it is not; of every rotor's settings.
const std::vector<TableRow>& magnetRows(const Settings& settings);
/// The row at a key, "magnets[0]". Throws SetupError.
RotorMagnet rotorMagnet(const TableRow& row, const std::string& key);

/// Where a magnet is, and what its inputs are called: current_x_SUFFIX, or current_x without one.
struct PlacedMagnet {
  RotorMagnet magnet;
  std::string suffix;
  Eigen::VectorXd along_x, along_y;
};
/// Its control currents.
std::vector<InputInfo> currentsOf(const PlacedMagnet& placed);
/// The nonlinear part of those that have a gap; the inputs of the first are from `first_input` on,
/// and those of the others follow in order.
std::vector<LocalForce> localForcesOf(const std::vector<PlacedMagnet>& magnets,
                                      std::size_t first_input);

}  // namespace whirl_twin
