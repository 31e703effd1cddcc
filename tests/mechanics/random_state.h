// Random parameters and states of every model, in realistic ranges.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "../models/every_variant.h"
#include "analysis/natural_modes.h"
#include "models/model_registry.h"

namespace whirl_twin {

struct RandomState {
  ParameterValues parameters;
  double gravity;  ///< [m/s^2]
  std::shared_ptr<const Dynamics> dynamics;
  Eigen::VectorXd q, v;
  EvaluationPoint<double> at;
};

/// One that may have a singular mass matrix.
inline RandomState anyRandomState(const VariantUnderTest& variant, std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const ModelInfo& model = *findModel(variant.model);
  RandomState s;
  for (const ParameterInfo& p : model.parameters) {
    if (p.name.rfind("motor_", 0) == 0 || p.name.rfind("gear_", 0) == 0 ||
        p.name.rfind("drag", 0) == 0) {
      s.parameters[p.name] = 0.0;  // unless the form overrides it
      continue;
    }
    // Positive ones over two decades; one in three that may be 0 is.
    const double size = std::pow(10.0, between(-1.0, 1.0));
    s.parameters[p.name] = p.range == Range::kAny          ? between(-3.0, 3.0)
                           : p.range == Range::kPositive   ? size
                           : p.range == Range::kCount      ? 3.0
                           : between(0.0, 1.0) < 1.0 / 3.0 ? 0.0
                                                           : size;
  }
  for (auto& [name, value] : s.parameters) {
    value = choosesForm(name) ? 0.0 : value;
  }
  if (s.parameters.count("stiffness_coupling") != 0) {  // small enough for a shaft
    s.parameters["stiffness_displacement"] = between(1.0, 4.0);
    s.parameters["stiffness_rotation"] = between(1.0, 4.0);
    s.parameters["stiffness_coupling"] = between(-0.9, 0.9);
  }
  if (s.parameters.count("density") != 0 && s.parameters["density"] == 0.0) {
    s.parameters["density"] = 1.0;  // else only discs would have a mass
  }
  if (s.parameters.count("poissons_ratio") != 0) {  // of a material that there is
    s.parameters["poissons_ratio"] = between(0.0, 0.5);
    s.parameters["shear_modulus"] =
        between(0.0, 1.0) < 0.5 ? 0.0 : between(0.34, 0.5) * s.parameters["youngs_modulus"];
  }
  if (s.parameters.count("regularization") != 0) {
    // Far from tipping, where the equations end.
    s.parameters["friction_coefficient"] = between(0.0, 0.5);
    s.parameters["height"] = s.parameters["half_spacing"] * between(0.0, 1.0);
  }
  for (const auto& [name, value] : variant.parameters) {
    s.parameters[name] = value;
  }
  s.gravity = between(0.0, 20.0);
  s.dynamics = model.setUp(s.parameters, variant.settings, variant.around(s.gravity)).dynamics;
  const auto n = static_cast<Eigen::Index>(s.dynamics->dof());
  s.q = s.v = Eigen::VectorXd(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    s.q[i] = between(-4.0, 4.0);
    s.v[i] = between(-5.0, 5.0);
  }
  s.at = {between(0.0, 10.0), between(-7.0, 7.0), between(-10.0, 10.0), between(-5.0, 5.0)};
  if (!model.has_shaft) {
    s.at.angle = s.at.speed = s.at.acceleration = 0.0;
  }
  return s;
}

/// One whose accelerations are more than rounding.
inline RandomState randomState(const VariantUnderTest& variant, std::mt19937_64& random) {
  RandomState s = anyRandomState(variant, random);
  while (massRegularity(*s.dynamics, s.q, s.v, s.at) < 1e-6) {
    s = anyRandomState(variant, random);
  }
  return s;
}

/// Of a model in its plain form.
inline RandomState randomState(const std::string& model, std::mt19937_64& random) {
  return randomState(VariantUnderTest{model, "", {}, {}, {}}, random);
}

}  // namespace whirl_twin
