// Every model in each of its forms, by each of its methods, moving in general position.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "../models/every_variant.h"
#include "scene/scene.h"

namespace whirl_twin {

struct MovingVariant {
  VariantUnderTest variant;
  std::string integrator;
};

inline void PrintTo(const MovingVariant& m, std::ostream* out) {
  *out << testName(m.variant) << " by " << m.integrator;
}

inline std::string testName(const MovingVariant& m) {
  return testName(m.variant) + "_" + m.integrator;
}

inline std::vector<MovingVariant> everyMovingVariant() {
  std::vector<MovingVariant> all;
  for (const VariantUnderTest& variant : everyVariant()) {
    for (const ModelVariant& v : findModel(variant.model)->variants) {
      for (const std::string& integrator : integratorsOf(v)) {
        if (v.when == variant.when) {
          all.push_back({variant, integrator});
        }
      }
    }
  }
  return all;
}

/// An implicit method that iterates for its stages.
inline bool iterates(const std::string& integrator) {
  return integrator.rfind("gauss_legendre", 0) == 0 || integrator == "implicit_midpoint";
}

/// The system; on a shaft of 5 rad/s, `own`, that it adds to the scene if it needs one.
inline SystemSpec inGeneralPosition(const MovingVariant& moving, Scene& scene) {
  const VariantUnderTest& variant = moving.variant;
  const ModelInfo& model = *findModel(variant.model);
  SystemSpec spec;
  spec.name = "moving";
  spec.model = model.name;
  spec.integrator = moving.integrator;
  if (model.has_shaft) {
    DriveSpec drive;
    drive.name = "own";
    drive.speed = 5.0;
    drive.motor = variant.motor;
    scene.drives.push_back(drive);
    spec.drive = drive.name;
  }
  for (const ParameterInfo& p : model.parameters) {
    spec.parameters[p.name] = choosesForm(p.name)              ? 0.0
                              : p.range == Range::kCount       ? 3.0
                              : p.name == "stiffness_coupling" ? 0.1
                                                               : 0.3;
  }
  for (const auto& [name, value] : variant.parameters) {
    spec.parameters[name] = value;
  }
  spec.settings = variant.settings;
  const auto dynamics =
      model.setUp(spec.parameters, spec.settings, variant.around(scene.gravity)).dynamics;
  const auto n = static_cast<std::size_t>(dynamics->dof());
  for (std::size_t i = 0; i < n; ++i) {
    spec.q.push_back(0.5 - 0.1 * static_cast<double>(i));
    spec.v.push_back(0.1 + 0.05 * static_cast<double>(i));
  }
  return spec;
}

}  // namespace whirl_twin
