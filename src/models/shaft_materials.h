// Materials of a flexible rotor's shaft: the default material of the scene, and named ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanics/rotors/shaft_element.h"
#include "models/model_info.h"

namespace whirl_twin {

std::vector<ParameterInfo> materialParameters();
SettingInfo materialsSetting();

class ShaftMaterials {
 public:
  /// Throws SetupError for a duplicate name and for a shear modulus that is implausible for its
  /// Young's modulus.
  ShaftMaterials(const ParameterValues& values, const Settings& settings);

  const ShaftMaterial& own() const { return own_; }
  /// The one that a row names in its column `material`, or own(). Throws SetupError for a name that
  /// is not among `materials`, `key` being the row's in the scene.
  const ShaftMaterial& of(const TableRow& row, const std::string& key) const;
  /// Notes on unusual values.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  ShaftMaterial material(const std::map<std::string, double>& numbers, const std::string& key);

  bool shear_deformation_;
  std::vector<std::string> notes_;
  ShaftMaterial own_;
  std::map<std::string, ShaftMaterial> named_;
};

}  // namespace whirl_twin
