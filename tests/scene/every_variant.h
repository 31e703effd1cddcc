// Every model in each of its forms, for tests that hold for all of them.
#pragma once

#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "scene/model_registry.h"

namespace whirl_twin {

struct VariantUnderTest {
  std::string model;
  std::string when;  ///< as the model says it
  Settings settings;
  ParameterValues parameters;  ///< those that choose the form
};

inline void PrintTo(const VariantUnderTest& v, std::ostream* out) {
  *out << v.model << " " << v.when;
}

/// "setting: value" of the form becomes a choice; matrices that must be given are of two sprung
/// masses.
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
