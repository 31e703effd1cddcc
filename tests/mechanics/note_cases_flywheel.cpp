// The flywheel with sliding masses and the governor against the lecture notes' reference numbers:
// steady rotations, and the linearized motion about them.
#include <Eigen/LU>

#include "note_system.h"

namespace whirl_twin {

namespace {

ParameterValues flywheelParameters(const NoteCase& c) {
  return {{"inertia", c.at("J", 1.0)},
          {"slider_mass", c.at("m")},
          {"stiffness", c.at("k")},
          {"free_length", c.at("a", 1.0)}};
}

/// Where the sliders stay at the speed w.
double steadyRadius(const NoteSystem& symmetric, double w) {
  return zeroBetween(0.0, 10.0, [&](double rho) {
    return symmetric.dynamics().residualForce(vector({rho, 0.0}), vector({0.0, w}), {})[0];
  });
}

}  // namespace

std::vector<double> symmetricFlywheelAnswers(const NoteCase& c) {
  const NoteSystem system(c, "sliding_mass_flywheel", flywheelParameters(c),
                          choice("symmetric", "true"));
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  if (c.id == "flywheel.wmax") {  // the same at every radius
    return {zeroBetween(0.1, 100.0, [&](double spin) {
      return system.linearAt({1.0, 0.0}, {0.0, spin}).stiffness(0, 0);
    })};
  }
  const double w = c.at("w");
  const double rho = steadyRadius(system, w);
  if (c.startsWith("flywheel.r.")) {
    return {rho};
  }
  // The wheel reacts to the slider's motion so that its angular momentum is conserved: det(M s^2 +
  // G s + K) = s^2 [M11 M22 s^2 + K11 M22 - G12 G21].
  const Linearization l = system.linearAt({rho, 0.0}, {0.0, w});
  const double squared =
      (l.stiffness(0, 0) - l.gyroscopic(0, 1) * l.gyroscopic(1, 0) / l.mass(1, 1)) / l.mass(0, 0);
  if (c.startsWith("flywheel.pretension.p2.")) {
    return {squared};
  }
  if (c.startsWith("flywheel.p.")) {
    return {std::sqrt(squared)};
  }
  return {};
}

std::vector<double> flywheelAnswers(const NoteCase& c) {
  const NoteSystem system(c, "sliding_mass_flywheel", flywheelParameters(c));
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  if (c.startsWith("flywheel.panti.")) {
    const NoteSystem symmetric(c, "sliding_mass_flywheel", flywheelParameters(c),
                               choice("symmetric", "true"));
    const double w = c.at("w");
    const double rho = steadyRadius(symmetric, w);
    const Linearization l = system.linearAt({rho, rho, 0.0}, {0.0, 0.0, w});
    // One mass out, the other in: a mode that leaves the wheel's speed alone.
    const Eigen::Vector3d shape(1.0, -1.0, 0.0);
    const Eigen::Vector3d inertia = l.mass * shape;
    const Eigen::Vector3d restoring = l.stiffness * shape;
    const double squared = shape.dot(restoring) / shape.dot(inertia);
    const double left = (restoring - squared * inertia).norm() + (l.gyroscopic * shape).norm();
    return {std::sqrt(squared) + left};
  }
  return {};
}

std::vector<double> governorAnswers(const NoteCase& c) {
  const NoteSystem system(c, "governor",
                          {{"mass", c.at("m")},
                           {"length", c.at("l")},
                           {"inertia", c.at("J")},
                           {"damping", c.at("c")},
                           {"torque", c.at("kap")},
                           {"load", c.at("F")}});
  const auto force = [&](double theta, double w, int coordinate) {
    return system.dynamics().residualForce(vector({theta, 0.0}), vector({0.0, w}), {})[coordinate];
  };
  const double theta =
      zeroBetween(0.0, 0.5 * M_PI, [&](double angle) { return force(angle, 0.0, 1); });
  const double w = zeroBetween(0.0, 100.0, [&](double speed) { return force(theta, speed, 0); });
  const Linearization l = system.linearAt({theta, 0.0}, {0.0, w});
  const Eigen::Matrix2d by_q = l.mass.inverse() * (l.stiffness + l.circulatory);
  const Eigen::Matrix2d by_v = l.mass.inverse() * (l.damping + l.gyroscopic);
  // The angle of the shaft does not enter: three states, theta, theta' and the shaft's speed.
  Eigen::Matrix3d state;
  state << 0.0, 1.0, 0.0, -by_q(0, 0), -by_v(0, 0), -by_v(0, 1), -by_q(1, 0), -by_v(1, 0),
      -by_v(1, 1);
  if (c.startsWith("governor.margin.")) {
    const double a2 = -state.trace();
    const double a1 = 0.5 * (a2 * a2 - (state * state).trace());
    const double a0 = -state.determinant();
    return {a1 * a2 - a0};
  }
  return {};
}

}  // namespace whirl_twin
