// What `twin analyze` shows of a flexible rotor before it turns: its mass, where it balances, and
// its sag, bearing loads, shear forces and bending moments under its weight.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "analysis/rotor_statics.h"
#include "mechanics/dynamics.h"
#include "reports/csv_table.h"
#include "reports/output.h"
#include "reports/shown_units.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct RotorSheet {
  RotorBody body;
  double gravity = 0.0;                 ///< [m/s^2]
  std::optional<RotorStatics> statics;  ///< nothing where some motion is free
};

/// The bearings as they are at a speed [rad/s]. Nothing of another model.
std::optional<RotorSheet> rotorSheet(const BuiltSystem& system, double speed);

Json json(const RotorSheet& sheet);
std::string text(const RotorSheet& sheet);
CsvTable table(const RotorSheet& sheet);

struct LargestSag {
  std::string station;
  double x = 0.0, y = 0.0;  ///< [m]
};

/// Where along the shaft of a rotor its equilibrium q is farthest from the line of its bearings.
/// Nothing of another system, and of a rotor that nothing bends.
std::optional<LargestSag> largestSag(const Dynamics& dynamics, const Eigen::VectorXd& q);

/// "0.00098 m at disc (x 0 m, y -0.00098 m)"
std::string text(const LargestSag& sag, const ShownUnits& units = {});
Json json(const std::optional<LargestSag>& sag);

}  // namespace whirl_twin
