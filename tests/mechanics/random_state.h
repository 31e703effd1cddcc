// Random parameters and states of every model, in the ranges that machines have.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "scene/model_registry.h"

namespace whirl_twin {

struct RandomState {
  ParameterValues parameters;
  double gravity;  ///< [m/s^2]
  std::shared_ptr<const Dynamics> dynamics;
  Eigen::VectorXd q, v;
  Moment<double> at;
};

inline RandomState randomState(const std::string& model_name, std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const ModelInfo& model = *findModel(model_name);
  RandomState s;
  for (const ParameterInfo& p : model.parameters) {
    // Positive ones over two decades; one in three that may be 0 is.
    const double size = std::pow(10.0, between(-1.0, 1.0));
    s.parameters[p.name] = p.range == Range::kAny          ? between(-3.0, 3.0)
                           : p.range == Range::kPositive   ? size
                           : between(0.0, 1.0) < 1.0 / 3.0 ? 0.0
                                                           : size;
  }
  s.gravity = between(0.0, 20.0);
  s.dynamics = model.dynamics(s.parameters, s.gravity);
  const auto n = static_cast<Eigen::Index>(model.coordinates.size());
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

inline std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const ModelInfo& model : models()) {
    names.push_back(model.name);
  }
  return names;
}

}  // namespace whirl_twin
