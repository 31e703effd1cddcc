// Every model in each of its forms, for tests that apply to all of them.
#pragma once

#include <cctype>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "integration/step_methods.h"
#include "models/model_registry.h"

namespace whirl_twin {

struct VariantUnderTest {
  std::string model;
  std::string when;  ///< as the model describes it
  Settings settings;
  ParameterValues parameters;    ///< those that choose the form
  std::optional<Motor> motor{};  ///< that turns it

  ModelContext around(double gravity) const {
    ModelContext all(gravity);
    all.motor = motor;
    return all;
  }
};

/// The methods for any motion that a form can step with.
inline std::vector<std::string> integratorsOf(const ModelVariant& variant) {
  std::vector<std::string> all;
  for (const std::string& integrator : variant.integrators) {
    if (!stepMethod(integrator).by_name) {
      all.push_back(integrator);
    }
  }
  return all;
}

/// A number that chooses a form of its model, or belongs to one: 0 in all others.
inline bool choosesForm(const std::string& parameter) {
  for (const char* start :
       {"regularization", "friction_force", "loss_factor", "rub_", "rotor_radius", "bearing_",
        "journal_", "stiffness_asymmetry", "motor_", "gear_", "drag"}) {
    if (parameter.rfind(start, 0) == 0) {
      return true;
    }
  }
  return false;
}

/// Some forms need more numbers than the one that chooses them.
inline void addCompanions(VariantUnderTest& v) {
  if (v.parameters.count("rub_stiffness") != 0) {
    for (const char* name : {"rub_clearance", "rub_friction", "rub_damping", "rotor_radius"}) {
      v.parameters[name] = 0.3;
    }
  }
  if (v.parameters.count("bearing_length") != 0) {
    for (const char* name : {"bearing_diameter", "bearing_viscosity", "journal_mass"}) {
      v.parameters[name] = 0.3;
    }
    v.parameters["bearing_clearance"] = 10.0;  // beyond every state of these tests
  }
  if (v.parameters.count("motor_inertia1") != 0) {
    v.settings.choices["coordinates"] = "relative";
    v.parameters["gear_ratio1"] = 3.0;
    v.parameters["motor_inertia2"] = 0.1;
    v.parameters["gear_ratio2"] = -2.0;
    v.parameters["drag2"] = 0.1;  // which this form has, too
    v.parameters["drag_reach2"] = 0.5;
  }
  if (v.parameters.count("drag1") != 0) {
    v.parameters["drag_reach1"] = 0.4;
    v.parameters["drag2"] = 0.2;
    v.parameters["drag_reach2"] = 0.6;
  }
  if (v.motor && v.model != "flexible_rotor") {  // whose elements have one
    v.parameters["polar_inertia"] = 0.3;
  }
}

inline void PrintTo(const VariantUnderTest& v, std::ostream* out) {
  *out << v.model << " " << v.when;
}

/// "setting: value" of the form becomes a choice; matrices that must be given are of two sprung
/// masses, tables have one row.
inline std::vector<VariantUnderTest> everyVariant() {
  std::vector<VariantUnderTest> all;
  for (const ModelInfo& model : models()) {
    for (const ModelVariant& variant : model.variants) {
      VariantUnderTest v{model.name, variant.when, {}, {}};
      const std::size_t colon = variant.when.find(": ");
      for (const SettingInfo& setting : model.settings) {
        if (setting.kind == SettingKind::kChoice) {
          const bool chosen = variant.when.substr(0, colon) == setting.name;
          v.settings.choices[setting.name] =
              chosen ? variant.when.substr(colon + 2) : setting.choices.front();
        } else if (setting.kind == SettingKind::kWordOrCount) {
          v.settings.choices[setting.name] = setting.choices.front();
        } else if (setting.kind == SettingKind::kTable && setting.required) {
          TableRow row;
          for (const ColumnInfo& column : setting.columns) {
            row.numbers[column.name] = !column.fallback_column.empty()
                                           ? row.numbers.at(column.fallback_column)
                                       : std::isnan(column.fallback) ? 0.3
                                                                     : column.fallback;
          }
          for (const std::string& word : setting.optional_words) {
            row.words[word] = "";
          }
          v.settings.tables[setting.name] = {row};
        } else if (setting.kind == SettingKind::kMatrix && setting.required) {
          v.settings.matrices[setting.name] =
              setting.name == "mass"
                  ? Eigen::MatrixXd(Eigen::Vector2d(1.0, 2.0).asDiagonal())
                  : (Eigen::MatrixXd(2, 2) << 30.0, -10.0, -10.0, 20.0).finished();
        }
      }
      for (const ParameterInfo& p : model.parameters) {
        if (variant.when.substr(0, variant.when.find(' ')) == p.name) {
          v.parameters[p.name] = 0.3;  // "regularization > 0"
        }
      }
      if (variant.motor) {
        v.motor = Motor::falling(0.5, 20.0, 0.01);
      }
      addCompanions(v);
      all.push_back(v);
    }
  }
  return all;
}

/// The name of a test of it.
inline std::string testName(const VariantUnderTest& v) {
  std::string name = v.model + (v.when.empty() ? "" : "_") + v.when;
  for (char& letter : name) {
    letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  }
  return name;
}

}  // namespace whirl_twin
