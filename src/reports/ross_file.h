// Files of rotors as ROSS's Rotor.save() writes them, TOML or JSON: a table for each element,
// "ShaftElement_TAG", "DiskElement_TAG", "BearingElement_TAG" ..., whose keys are the arguments
// that made it (SI).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/node_reader.h"

namespace whirl_twin {

struct RossEntry {
  std::string kind;  ///< "ShaftElement"
  std::string key;   ///< "ShaftElement_Shaft Element 0"
  const nlohmann::json* fields;
};

struct RossMaterial {
  double youngs_modulus = 0.0, shear_modulus = 0.0;  ///< Pa
  double density = 0.0;                              ///< kg/m^3
  std::string name;
};

/// What is not as it must be is added to the complaints, and is 0.
class RossFile {
 public:
  /// Throws Refusal for what is no such file.
  RossFile(const std::string& path, Complaints& complaints);
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
  /// At each of `count` frequencies; one number is one at all of them.
  std::vector<double> coefficient(const RossEntry& entry, const std::string& name,
                                  std::size_t count);
  /// Of a table, in rad/s.
  std::vector<double> frequencies(const RossEntry& entry);

 private:
  double number(const nlohmann::json& fields, const std::string& where, const char* name,
                const char* unit, std::optional<double> fallback = std::nullopt);

  nlohmann::json tree_;
  std::vector<RossEntry> entries_;
  Complaints& complaints_;
};

}  // namespace whirl_twin
