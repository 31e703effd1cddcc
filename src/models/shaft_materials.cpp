#include "models/shaft_materials.h"

#include <fmt/format.h>

#include "messages/names.h"
#include "models/settings.h"

namespace whirl_twin {

namespace {

constexpr double kUsualPoissonsRatio = 0.3;
// Of Young's modulus: between them lie all materials, wound fibres too, and no mistake of a unit.
constexpr double kMinShear = 0.01;
constexpr double kMaxShear = 10.0;

/// The key of a number among the parameters or in a row.
std::string below(const std::string& key, const char* name) {
  return key.empty() ? name : key + "." + name;
}

}  // namespace

std::vector<ParameterInfo> materialParameters() {
  return {{"youngs_modulus", "Pa", Range::kPositive, "of the shaft", {}, ""},
          {"shear_modulus", "Pa", Range::kNotNegative,
           "of the shaft; 0: youngs_modulus / 2 (1 + poissons_ratio)", 0.0, ""},
          {"poissons_ratio", "-", Range::kNotNegative, "of the shaft, without shear_modulus",
           kUsualPoissonsRatio, ""},
          {"density", "kg/m^3", Range::kNotNegative, "of the shaft; 0: massless shaft", {}, ""}};
}

SettingInfo materialsSetting() {
  SettingInfo info{"materials", SettingKind::kTable, "",
                   "named materials for elements, sleeves and discs that differ from the shaft's"};
  info.columns = {{"youngs_modulus", "Pa", Range::kPositive, kRequired},
                  {"shear_modulus", "Pa", Range::kNotNegative, 0.0},
                  {"poissons_ratio", "-", Range::kNotNegative, kUsualPoissonsRatio},
                  {"density", "kg/m^3", Range::kNotNegative, kRequired}};
  info.word_columns = {"name"};
  return info;
}

ShaftMaterials::ShaftMaterials(const ParameterValues& values, const Settings& settings)
    : shear_deformation_(settings.choices.at("shear_deformation") == "true"),
      own_(material(values, "")) {
  const std::vector<TableRow>& rows = rowsOf(settings, "materials");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("materials[{}]", i);
    const std::string& name = rows[i].words.at("name");
    if (!named_.emplace(name, material(rows[i].numbers, key)).second) {
      throw SetupError(key + ".name",
                       fmt::format("duplicate: material '{}' is already defined", name));
    }
  }
}

const ShaftMaterial& ShaftMaterials::of(const TableRow& row, const std::string& key) const {
  const std::string& name = row.words.at("material");
  if (name.empty()) {
    return own_;
  }
  const auto found = named_.find(name);
  if (found == named_.end()) {
    std::vector<std::string> known;
    for (const auto& [each, material] : named_) {
      known.push_back(each);
    }
    const std::string near = nearestName(name, known);
    throw SetupError(key + ".material",
                     fmt::format("must be a name of materials, found '{}'{}", name,
                                 near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  }
  return found->second;
}

ShaftMaterial ShaftMaterials::material(const std::map<std::string, double>& numbers,
                                       const std::string& key) {
  const double youngs_modulus = numbers.at("youngs_modulus");
  const double poissons_ratio = numbers.at("poissons_ratio");
  if (!(poissons_ratio <= 0.5)) {
    throw SetupError(below(key, "poissons_ratio"),
                     fmt::format("must be from 0 to 0.5, found {}", poissons_ratio));
  }
  const double given = numbers.at("shear_modulus");
  if (given > 0.0 &&
      !(given >= kMinShear * youngs_modulus && given <= kMaxShear * youngs_modulus)) {
    throw SetupError(
        below(key, "shear_modulus"),
        fmt::format("must be from {:.3g} to {:.3g} Pa, 0.01 to 10 times youngs_modulus (usual: "
                    "{:.3g} Pa), found {} Pa",
                    kMinShear * youngs_modulus, kMaxShear * youngs_modulus,
                    youngs_modulus / (2.0 * (1.0 + kUsualPoissonsRatio)), given));
  }
  if (given > 0.0 && !(given >= youngs_modulus / 3.0 && given <= youngs_modulus / 2.0)) {
    notes_.push_back(fmt::format(
        "{} = {:.4g} Pa is outside youngs_modulus / 3 ... / 2, the range of isotropic materials",
        below(key, "shear_modulus"), given));
  }
  return {youngs_modulus, given > 0.0 ? given : youngs_modulus / (2.0 * (1.0 + poissons_ratio)),
          numbers.at("density"), shear_deformation_};
}

}  // namespace whirl_twin
