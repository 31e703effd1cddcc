// Linear systems for the tests of their steps.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "integration/linear_stepper.h"
#include "mechanics/linear_dynamics.h"

namespace whirl_twin {

/// Unit masses that nothing holds.
inline LinearModel freeMasses(Eigen::Index n) {
  LinearModel model;
  model.model = "linear_system";
  for (Eigen::Index i = 0; i < n; ++i) {
    model.coordinates.push_back({"q" + std::to_string(i + 1), "m"});
  }
  model.mass = Eigen::MatrixXd::Identity(n, n);
  model.damping = model.gyroscopic = model.stiffness = model.circulatory =
      Eigen::MatrixXd::Zero(n, n);
  return model;
}

/// Every matrix full, frequencies of some 10 rad/s, forces of three frequencies.
inline LinearModel fullSystem(Eigen::Index n) {
  std::mt19937_64 random(1889);
  const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(
        rows, columns, [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }));
  };
  const auto size = static_cast<double>(n);
  LinearModel model = freeMasses(n);
  const Eigen::MatrixXd a = matrix(n, n);
  const Eigen::MatrixXd b = matrix(n, n);
  const Eigen::MatrixXd c = matrix(n, n);
  model.mass += 0.5 / size * a * a.transpose();
  model.damping = 0.3 / size * b * b.transpose();
  model.gyroscopic = (b - b.transpose()) / std::sqrt(size);
  model.stiffness = 50.0 * Eigen::MatrixXd::Identity(n, n) + 50.0 / size * c * c.transpose();
  model.circulatory = (c - c.transpose()) / std::sqrt(size);
  model.forces = {{matrix(n, 1), 0.0, 0.3},
                  {matrix(n, 1), 4.0, -0.8},
                  {matrix(n, 1), 11.0, 0.0},
                  {matrix(n, 1), 4.0, 2.0}};
  return model;
}

/// One mass m on a spring of natural frequency p [rad/s], driven by F cos(w t).
inline LinearModel drivenMass(double m, double p, double force, double w) {
  LinearModel model = freeMasses(1);
  model.mass *= m;
  model.stiffness(0, 0) = m * p * p;
  model.forces = {{Eigen::VectorXd::Constant(1, force), w, 0.0}};
  return model;
}

/// A state in general position.
inline LinearMotion startOf(const LinearModel& model) {
  LinearMotion motion(model.mass.rows());
  motion.q().setLinSpaced(-0.6, 0.8);
  motion.v().setLinSpaced(3.0, -1.0);
  return motion;
}

/// The state after `steps` of h [s] from time 0.
inline LinearMotion after(const LinearModel& model, const std::string& method, double h, long steps,
                          LinearMotion motion) {
  LinearStep step(model, method, h);
  for (long i = 0; i < steps; ++i) {
    step.advance(static_cast<double>(i) * h, motion);
  }
  return motion;
}

/// T + V [J].
inline double energy(const LinearModel& model, const LinearMotion& motion) {
  return 0.5 * motion.v().dot(model.mass * motion.v()) +
         0.5 * motion.q().dot(model.stiffness * motion.q());
}

}  // namespace whirl_twin
