// Files of rotors as ROSS's Rotor.save() writes them, TOML or JSON: a table for each element,
// "ShaftElement_TAG", "DiskElement_TAG", "BearingElement_TAG" ..., whose keys are the arguments
// that made it (SI).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/rotor_drawing.h"
#include "scene/node_reader.h"

namespace whirl_twin {

struct RossEntry {
  std::string kind;  ///< "ShaftElement"
  std::string key;   ///< "ShaftElement_Shaft Element 0"
  const nlohmann::json* fields;

  bool is(const char* beginning) const { return kind.rfind(beginning, 0) == 0; }
  /// Whatever has coefficients of a bearing.
  bool isSupport() const;
  /// Gears, too, and whatever else has the mass and the inertias of one.
  bool isDisc() const;
};

struct RossMaterial {
  double youngs_modulus = 0.0, shear_modulus = 0.0;  ///< Pa
  double density = 0.0;                              ///< kg/m^3
  std::string name;
};

/// Of a table of coefficients: `speed` of the shaft, `frequency` of the whirl (ROSS 3), [rad/s]. In
/// ROSS 2 a `frequency` is a speed. With both, coefficients are rows over the frequency, one for
/// each speed; of each the value at a frequency of that speed is taken, linear between its
/// neighbours and held beyond.
struct RossAxes {
  std::vector<double> places;       ///< of the table, along its first axis
  std::vector<double> frequencies;  ///< along the second, if there are two
  const char* name = "speed";       ///< of the first
  bool of_whirl = false;            ///< the first is the frequency of the whirl
  std::size_t count() const { return places.empty() ? 1 : places.size(); }
};

/// Invalid values are 0, and are added to the diagnostics.
class RossFile {
 public:
  /// Throws InputError for what is no such file.
  RossFile(const std::string& path, Diagnostics& diagnostics);
  RossFile(const RossFile&) = delete;
  RossFile& operator=(const RossFile&) = delete;

  const std::vector<RossEntry>& entries() const { return entries_; }
  /// Of the rotor as a whole; 0 where it does not say.
  double parameter(const char* name, const char* unit);

  double number(const RossEntry& entry, const char* name, const char* unit,
                std::optional<double> fallback = std::nullopt);
  int node(const RossEntry& entry, const char* name = "n");
  /// True where it does not say.
  static bool flag(const RossEntry& entry, const char* name);
  /// kg, along x and y.
  std::pair<double, double> mass(const RossEntry& entry);
  RossMaterial material(const RossEntry& entry);
  /// The speeds and frequencies that the coefficients of a support are given for.
  RossAxes axes(const RossEntry& entry);
  /// At each place of a table (RossAxes::count); one number is one at all of them.
  std::vector<double> coefficient(const RossEntry& entry, const std::string& name,
                                  const RossAxes& axes);

 private:
  double number(const nlohmann::json& fields, const std::string& where, const char* name,
                const char* unit, std::optional<double> fallback = std::nullopt);

  std::vector<double> numbers(const RossEntry& entry, const char* name);
  /// Of the row of a table with two axes, at a frequency of the speed of the row.
  double synchronous(const nlohmann::json& row, double speed, const RossAxes& axes);

  nlohmann::json tree_;
  std::vector<RossEntry> entries_;
  Diagnostics& diagnostics_;
};

struct RossCoupling {
  DrawnRow row;                ///< of couplings
  std::vector<DrawnRow> hubs;  ///< of discs, at its two nodes
  std::vector<std::string> left_out;
};

/// The one from `node` to the next, whose element has the same number.
RossCoupling rossCoupling(RossFile& file, const RossEntry& entry, int node);

}  // namespace whirl_twin
