// The pendulums on a cart, with a slider, held by a spring and rotating freely against the lecture
// notes' reference numbers.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "analysis/stability.h"
#include "note_system.h"

namespace whirl_twin {

namespace {

NoteSystem cart(const NoteCase& c, ParameterValues loads) {
  loads.insert({{"cart_mass", c.at("m1")},
                {"rod_mass", c.at("m2")},
                {"rod_length", c.at("l")},
                {"stiffness", c.at("k")}});
  return {c, "cart_pendulum", loads};
}

/// Steady amplitudes of x and theta under a load f at a frequency, times det(K - w^2 M).
Eigen::Vector2d scaledResponse(const Linearization& l, const Eigen::Vector2d& f, double w) {
  const Eigen::Matrix2d z = l.stiffness - w * w * l.mass;
  return {z(1, 1) * f[0] - z(0, 1) * f[1], z(0, 0) * f[1] - z(1, 0) * f[0]};
}

}  // namespace

std::vector<double> rodSliderAnswers(const NoteCase& c) {
  const NoteSystem system(c, "rod_slider",
                          {{"slider_mass", c.at("m0")},
                           {"rod_mass", c.at("m")},
                           {"rod_length", c.at("l")},
                           {"stiffness", c.at("k")},
                           {"free_length", c.at("r0")}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const double theta =
      c.startsWith("rod_slider.rstpi.") || c.startsWith("rod_slider.p2pi.") ? M_PI : 0.0;
  const double rest = zeroBetween(-5.0, 5.0, [&](double r) {
    return system.holdingForce({r, theta})[0];
  });
  const Linearization l = system.linearAt({rest, theta});
  const auto squaredFrequency = [&](int i) { return l.stiffness(i, i) / l.mass(i, i); };
  if (c.startsWith("rod_slider.rst")) {
    return {rest};
  }
  if (c.startsWith("rod_slider.pr.")) {  // bounce and swing do not couple
    return {std::sqrt(squaredFrequency(0))};
  }
  if (c.startsWith("rod_slider.ptheta.")) {
    return {std::sqrt(squaredFrequency(1))};
  }
  if (c.startsWith("rod_slider.p2pi.")) {
    return {squaredFrequency(1)};
  }
  return {};
}

std::vector<double> cartAnswers(const NoteCase& c) {
  const NoteSystem system = cart(c, {{"force_amplitude", c.at("F0", 0.0)},
                                     {"force_frequency", c.at("Om", 0.0)},
                                     {"support_amplitude", c.at("Y0", 0.0)},
                                     {"support_frequency", c.at("Om", 0.0)}});
  if (c.startsWith("inv.h0.cart_pendulum_support")) {
    // The case counts the whole spring as an outside force, the model as potential energy
    // k (x - y)^2 / 2, with y = 0 at the start: the same motion, another h.
    return {system.commonAnswer() - 0.5 * c.at("k") * c.at("ic_x") * c.at("ic_x")};
  }
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  // About theta = 0, at rest; the loads of unit amplitude at the moment they are largest.
  const NoteSystem unloaded = cart(c, {});
  const Linearization l = unloaded.linearAt({0.0, 0.0});
  const auto load = [&](const ParameterValues& loads, double time) {
    const NoteSystem loaded = cart(c, loads);
    return Eigen::Vector2d(loaded.dynamics().residualForce(
        Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), {time, 0.0, 0.0, 0.0}));
  };
  const Eigen::Vector2d of_force = load({{"force_amplitude", 1.0}}, 0.0);
  const Eigen::Vector2d of_support =
      load({{"support_amplitude", 1.0}, {"support_frequency", 1.0}}, 0.5 * M_PI);
  if (c.startsWith("cart.p2_")) {
    return {squaredFrequencies(l)[c.contains(".p2_1.") ? 0 : 1]};
  }
  if (c.id == "cart.antires.theta") {
    return {zeroBetween(0.1, 10.0, [&](double w) { return scaledResponse(l, of_force, w)[1]; })};
  }
  if (c.id == "cart.antires.x") {
    return {zeroBetween(0.1, 10.0, [&](double w) { return scaledResponse(l, of_support, w)[0]; })};
  }
  if (c.startsWith("cart.frf.")) {
    const Eigen::Vector2d f = c.contains(".F.") ? Eigen::Vector2d(c.at("F0") * of_force)
                                                : Eigen::Vector2d(c.at("Y0") * of_support);
    const double determinant = (l.stiffness - c.at("Om") * c.at("Om") * l.mass).determinant();
    return {scaledResponse(l, f, c.at("Om"))[c.contains(".Theta") ? 1 : 0] / determinant};
  }
  return {};
}

std::vector<double> invertedSpringAnswers(const NoteCase& c) {
  const NoteSystem system(c, "sprung_inverted_pendulum",
                          {{"mass", c.at("m")},
                           {"length", c.at("L")},
                           {"stiffness", c.at("k")},
                           {"damping", c.at("c", 0.0)}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const auto leaning = [&] {
    return zeroBetween(0.05, 3.0, [&](double theta) { return system.holdingForce({theta})[0]; });
  };
  const auto potential = [&](double theta) {
    return system.dynamics().energies(vector({theta}), vector({0.0}), {}).potential;
  };
  if (c.startsWith("inverted.theta0.")) {
    return {leaning()};
  }
  if (c.startsWith("inverted.p2_")) {
    const double theta = c.contains(".p2_th0.") ? leaning() : c.contains(".p2_pi.") ? M_PI : 0.0;
    return {squaredFrequencies(system.linearAt({theta}))[0]};
  }
  if (c.id == "inverted.barrier") {
    return {potential(leaning()) - potential(0.0)};
  }
  return {};
}

std::vector<double> rotatingPendulumAnswers(const NoteCase& c) {
  const double m = c.at("m", 1.0);
  const double l = c.at("l");
  const double w = c.at("w", 0.0);
  // The notes' theta'' + 2 c theta' + p^2 theta = 0 takes c over 2 m l^2.
  const double damping = c.startsWith("rotpend.s.") ? 2.0 * m * l * l * c.at("c") : c.at("c", 0.0);
  const NoteSystem system(
      c, "rotating_pendulum",
      {{"mass", m}, {"length", l}, {"hub_inertia", c.at("J", 1.0)}, {"damping", damping}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  // Relative equilibria: steady turning at phi' = w at an angle theta that stays.
  const auto cone = [&] {
    return zeroBetween(0.05, 0.5 * M_PI, [&](double theta) {
      return system.dynamics().acceleration(vector({theta, 0.0}), vector({0.0, w}), {})[0];
    });
  };
  if (c.startsWith("rotpend.theta0.")) {
    return {cone()};
  }
  if (c.startsWith("rotpend.p.")) {
    return {std::abs(eigenvalues(system.linearAt({cone(), 0.0}, {0.0, w})).back())};
  }
  if (c.id == "rotpend.wcrit") {
    return {zeroBetween(0.1, 100.0, [&](double spin) {
      return system.linearAt({0.0, 0.0}, {0.0, spin}).stiffness(0, 0);
    })};
  }
  if (c.startsWith("rotpend.s.")) {  // hanging, theta does not couple with phi
    const Linearization about = system.linearAt({0.0, 0.0}, {0.0, w});
    Eigen::Matrix2d state;
    state << 0.0, 1.0, -about.stiffness(0, 0) / about.mass(0, 0),
        -about.damping(0, 0) / about.mass(0, 0);
    return {Eigen::EigenSolver<Eigen::Matrix2d>(state).eigenvalues().real().maxCoeff()};
  }
  return {};
}

}  // namespace whirl_twin
