// What `twin analyze` shows of a flexible rotor before it turns: its mass, where it balances, and
// its sag, bearing loads, shear forces and bending moments under its weight.
#pragma once

#include <optional>
#include <string>

#include "analysis/rotor_statics.h"
#include "reports/csv_table.h"
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

}  // namespace whirl_twin
