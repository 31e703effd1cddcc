// A flexible rotor as another program or a table describes it, and the scene that it makes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl_twin {

/// Keys of a row of a table, with their values as a scene has them.
using DrawnRow = std::vector<std::pair<std::string, std::string>>;

struct RotorDrawing {
  std::string name;                     ///< of the scene
  std::string origin;                   ///< where it comes from
  double youngs_modulus = 0.0;          ///< [Pa], of the shaft
  double shear_modulus = 0.0;           ///< [Pa]; 0: by Poisson's ratio
  double density = 0.0;                 ///< [kg/m^3]
  double mass_damping = 0.0;            ///< [1/s]
  double stiffness_damping = 0.0;       ///< [s]
  double speed = 0.0;                   ///< [rad/s]
  std::optional<double> highest_speed;  ///< [rad/s]
  bool shear_deformation = true;
  std::vector<DrawnRow> materials, elements, couplings, sleeves, discs, bearings, bearing_tables,
      pedestals, pedestal_tables;
  std::vector<std::string> left_out;  ///< what the scene does not say, a line each
};

/// The scene, with what it leaves out in its comments; elements alike that follow each other are
/// one row.
std::string sceneText(const RotorDrawing& drawing);

/// A number as a scene has it.
std::string drawn(double value);

/// A name for the scene of a file.
std::string nameOf(const std::string& path);

/// Of a file of ROSS (Rotor.save(): .toml, or .json) with shaft elements and their layers,
/// couplings, discs, point masses, bearings and seals by coefficients, constant or over speed, and
/// supports below them. Throws InputError: "FILE: ENTRY.KEY: what was expected, what was found",
/// all at once.
RotorDrawing drawingOfRoss(const std::string& path);

/// Of a table of elements from node 0 on (.csv), a row each, whose columns are those of `elements`
/// in a scene, each with its unit behind it if it is not in SI: `length (mm),outer_diameter (mm)`.
/// Steel, of 210 GPa and 7850 kg/m^3. Throws InputError likewise, by line and column.
RotorDrawing drawingOfElements(const std::string& path);

}  // namespace whirl_twin
