// Random systems of every model: parameters, states and loads in realistic ranges, with their
// fastest natural frequency.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "models/model_registry.h"
#include "scene/scene.h"

namespace whirl_twin {

class RandomSystems {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Fills parameters, q and v of a system whose model is set; its fastest frequency [rad/s].
  double fill(SystemSpec& spec, bool driven) {
    if (spec.model == "jeffcott_rotor") {
      return jeffcottRotor(spec, driven);
    }
    if (spec.model == "spinning_pendulum") {
      return spinningPendulum(spec);
    }
    if (spec.model == "double_pendulum") {
      return doublePendulum(spec);
    }
    if (spec.model == "rotating_pendulum") {
      return rotatingPendulum(spec);
    }
    if (spec.model == "cart_pendulum") {
      return cartPendulum(spec);
    }
    if (spec.model == "rod_slider") {
      return rodSlider(spec);
    }
    if (spec.model == "sprung_inverted_pendulum") {
      return sprungInvertedPendulum(spec);
    }
    if (spec.model == "rolling_disc") {
      return rollingDisc(spec);
    }
    if (spec.model == "two_bar_linkage") {
      return twoBarLinkage(spec);
    }
    if (spec.model == "hinged_beam") {
      return hingedBeam(spec);
    }
    if (spec.model == "friction_oscillator") {
      return frictionOscillator(spec);
    }
    if (spec.model == "sliding_mass_flywheel") {
      return slidingMassFlywheel(spec);
    }
    if (spec.model == "governor") {
      return governor(spec);
    }
    if (spec.model == "free_rotor") {
      return freeRotor(spec);
    }
    if (spec.model == "linear_system") {
      return linearSystem(spec);
    }
    if (spec.model == "cantilever_beam") {
      return cantileverBeam(spec);
    }
    throw std::invalid_argument("no random " + spec.model);
  }

 private:
  Eigen::Matrix3d random3() {
    Eigen::Matrix3d m;
    for (Eigen::Index i = 0; i < 9; ++i) {
      m.data()[i] = between(-1.0, 1.0);
    }
    return m;
  }
  /// Damped, gyroscopic, circulatory, with two harmonic loads.
  double linearSystem(SystemSpec& spec) {
    const Eigen::Matrix3d m = random3();
    const Eigen::Matrix3d k = random3();
    const Eigen::Matrix3d c = random3();
    const Eigen::Matrix3d g = random3();
    const Eigen::Matrix3d n = random3();
    const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
    spec.settings.matrices = {{"mass", m * m.transpose() + unit},
                              {"stiffness", 100.0 * (k * k.transpose() + unit)},
                              {"damping", c * c.transpose()},
                              {"gyroscopic", g - g.transpose()},
                              {"circulatory", n - n.transpose()}};
    for (const char* coordinate : {"q1", "q3"}) {
      spec.settings.tables["force"].push_back({{{"amplitude", between(0.0, 5.0)},
                                                {"frequency", between(0.0, 20.0)},
                                                {"phase", between(-3.0, 3.0)}},
                                               {{"coordinate", coordinate}}});
    }
    spec.q = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
    spec.v = {between(-9.0, 9.0), between(-9.0, 9.0), between(-9.0, 9.0)};
    return 25.0;  // sqrt(100 (1 + 3)) of the stiffest
  }

  double cantileverBeam(SystemSpec& spec) {
    const double mass = between(0.5, 5.0);
    const double length = between(0.5, 3.0);
    const double stiffness = between(10.0, 200.0);
    const double modes = std::floor(between(1.0, 5.0));
    spec.parameters = {{"mass_per_length", mass},
                       {"length", length},
                       {"bending_stiffness", stiffness},
                       {"modes", modes},
                       {"damping_ratio", between(0.0, 0.1)},
                       {"tip_force", between(0.0, 2.0)},
                       {"tip_force_frequency", between(0.0, 20.0)},
                       {"base_motion", between(0.0, 0.01)},
                       {"base_motion_frequency", between(0.0, 20.0)}};
    spec.q.assign(static_cast<std::size_t>(modes), 0.05);
    spec.v.assign(static_cast<std::size_t>(modes), 0.1);
    // The highest of four assumed modes lies at 282 sqrt(EI / m L^4).
    return 282.0 * std::sqrt(stiffness / mass) / (length * length) + 20.0;
  }

  double freeRotor(SystemSpec& spec) {
    const double m = between(0.5, 5.0);
    const double p = between(5.0, 20.0);
    const double e = between(1e-4, 1e-2);
    spec.parameters = {{"mass", m},
                       {"stiffness", m * p * p},
                       {"damping", m * p * between(0.02, 0.5)},
                       {"eccentricity", e},
                       {"polar_inertia", m * e * e * between(1.0, 1000.0)},
                       {"torque", m * e * e * p * p * between(0.0, 0.5)},
                       {"drag", 0.0}};
    spec.q = {between(-0.01, 0.01), between(-0.01, 0.01), between(-3.0, 3.0)};
    spec.v = {p * between(-0.01, 0.01), p * between(-0.01, 0.01), p * between(0.2, 2.0)};
    return 3.0 * p + 20.0;
  }

  bool maybe() { return between(0.0, 1.0) < 0.5; }

  double jeffcottRotor(SystemSpec& spec, bool driven) {
    const double m = between(0.5, 5.0);
    const double p = between(5.0, 20.0);
    spec.parameters = {{"mass", m},
                       {"stiffness", m * p * p},
                       {"stiffness_y", m * p * p * between(0.5, 1.0)},
                       {"damping", m * p * between(0.0, 0.5)},
                       {"damping_y", m * p * between(0.0, 0.5)},
                       {"internal_damping", driven ? 0.0 : m * between(0.0, 0.1)},
                       {"fluid_damping", m * between(0.0, 0.1)},
                       {"fluid_ratio", driven ? 0.0 : between(0.0, 0.6)},
                       {"cross_coupling", m * p * between(-0.1, 0.1)},
                       {"eccentricity", between(0.0, 1e-3)},
                       {"eccentricity_angle", between(-3.0, 3.0)},
                       {"bow", between(0.0, 1e-3)},
                       {"bow_angle", between(-3.0, 3.0)}};
    for (const ParameterInfo& effect : findModel(spec.model)->parameters) {
      spec.parameters.emplace(effect.name, effect.fallback.value_or(0.0));  // the others are off
    }
    spec.q = {between(-0.01, 0.01), between(-0.01, 0.01)};
    spec.v = {p * between(-0.01, 0.01), p * between(-0.01, 0.01)};
    return std::max(p, 20.0);
  }

  double spinningPendulum(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double l = between(0.2, 2.0);
    spec.parameters = {{"mass", m}, {"length", l}, {"damping", m * l * l * between(0.0, 1.0)}};
    spec.q = {between(-3.0, 3.0)};
    spec.v = {between(-3.0, 3.0)};
    return 20.0 + std::sqrt(10.0 / l);
  }

  double doublePendulum(SystemSpec& spec) {
    const double l1 = between(0.5, 2.0);
    const double l2 = between(0.5, 2.0);
    const bool bodies = maybe();
    const double friction = bodies ? 0.5 : 0.0;
    spec.settings.choices["coordinates"] = maybe() ? "relative" : "absolute";
    spec.parameters = {{"mass1", between(0.5, 2.0)},
                       {"mass2", between(0.5, 2.0)},
                       {"length1", l1},
                       {"length2", l2},
                       {"center1", bodies ? l1 * between(0.4, 1.0) : l1},
                       {"center2", bodies ? l2 * between(0.4, 1.0) : l2},
                       {"inertia1", bodies ? l1 * l1 * between(0.0, 0.1) : 0.0},
                       {"inertia2", bodies ? l2 * l2 * between(0.0, 0.1) : 0.0},
                       {"damping1", between(0.0, 0.2)},
                       {"damping2", between(0.0, 0.2)},
                       {"coulomb1", friction * between(0.0, 1.0)},
                       {"coulomb2", friction * between(0.0, 1.0)},
                       {"coulomb_rate", between(2.0, 5.0)},  // wide enough for steps to follow it
                       {"motor_inertia1", 0.0},
                       {"motor_inertia2", 0.0},
                       {"gear_ratio1", 1.0},
                       {"gear_ratio2", 1.0},
                       {"drag1", 0.0},
                       {"drag2", 0.0},
                       {"drag_reach1", l1},
                       {"drag_reach2", l2}};
    spec.q = {between(-2.0, 2.0), between(-2.0, 2.0)};
    spec.v = {between(-2.0, 2.0), between(-2.0, 2.0)};
    return 25.0;  // the lower arm whips round, faster than it swings
  }

  double rotatingPendulum(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double l = between(0.2, 2.0);
    spec.parameters = {{"mass", m},
                       {"length", l},
                       {"hub_inertia", m * l * l * between(0.5, 2.0)},
                       {"damping", m * l * l * between(0.0, 1.0)}};
    spec.q = {between(-2.5, 2.5), between(-3.0, 3.0)};
    spec.v = {between(-2.0, 2.0), between(-6.0, 6.0)};
    return 20.0 + std::sqrt(10.0 / l);  // swung in, a light hub turns three times as fast
  }

  double cartPendulum(SystemSpec& spec) {
    spec.parameters = {
        {"cart_mass", between(0.5, 5.0)},
        {"rod_mass", between(0.5, 2.0)},
        {"rod_length", between(0.5, 2.0)},
        {"stiffness", between(0.0, 100.0)},
        {"damping", between(0.0, 1.0)},
        {"force_amplitude", between(-5.0, 5.0)},
        {"force_frequency", between(0.0, 10.0)},
        {"support_amplitude", between(-0.05, 0.05)},
        {"support_frequency", between(0.0, 10.0)},
        {"friction_force", maybe() ? between(0.0, 5.0) : 0.0},  // which can hold the cart
        {"friction_width", 0.0}};
    spec.q = {between(-0.3, 0.3), between(-2.5, 2.5)};
    spec.v = {between(-1.0, 1.0), between(-2.0, 2.0)};
    return 30.0;
  }

  double rodSlider(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double p = between(7.0, 15.0);
    const double r = between(0.5, 1.0);
    spec.parameters = {{"slider_mass", m},
                       {"rod_mass", between(0.2, 2.0)},
                       {"rod_length", between(1.0, 2.0)},
                       {"stiffness", m * p * p},
                       {"free_length", r}};
    spec.q = {r + between(-0.1, 0.3), between(-1.5, 1.5)};
    spec.v = {between(-0.5, 0.5), between(-2.0, 2.0)};
    return 25.0;
  }

  double sprungInvertedPendulum(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double l = between(0.2, 2.0);
    const double p = between(1.0, 10.0);  // of the spring alone
    spec.parameters = {
        {"mass", m}, {"length", l}, {"stiffness", m * p * p}, {"damping", m * between(0.0, 1.0)}};
    spec.q = {between(-3.0, 3.0)};
    spec.v = {between(-3.0, 3.0)};
    return 20.0 + std::sqrt(10.0 / l);
  }

  double rollingDisc(SystemSpec& spec) {
    const double m = between(0.5, 3.0);
    const double r = between(0.2, 0.5);
    const double p = between(0.0, 10.0);
    spec.parameters = {{"friction_coefficient", 0.0},
                       {"disc_mass", m},
                       {"disc_inertia", m * r * r * between(0.3, 1.0)},
                       {"radius", r},
                       {"stiffness", m * p * p},
                       {"damping", m * between(0.0, 1.0)},
                       {"offset_mass", m * between(0.0, 0.5)},
                       {"offset", r * between(0.0, 0.9)}};
    spec.q = {r * between(-2.0, 2.0)};
    spec.v = {r * between(-3.0, 3.0)};
    return 40.0;  // the weight swings at sqrt(g / r), twice that in the rolling mass
  }

  double twoBarLinkage(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double l = between(0.5, 2.0);
    spec.parameters = {{"bar_mass", m},
                       {"bar_length", l},
                       {"force", m * between(-10.0, 10.0)},
                       {"damping", m * l * l * between(0.0, 1.0)}};
    spec.q = {between(-3.0, 3.0)};
    spec.v = {between(-2.0, 2.0)};
    return 40.0;
  }

  double hingedBeam(SystemSpec& spec) {
    const double m = between(1.0, 20.0);
    const double p = between(3.0, 15.0);  // at small angles
    spec.settings.choices["geometry"] = maybe() ? "small" : "finite";
    spec.parameters = {{"mass", m},
                       {"length", between(0.5, 2.0)},
                       {"stiffness", m * p * p * 4.0 / 3.0},
                       {"damping", m * between(0.0, 1.0)},
                       {"load_amplitude", m * between(-5.0, 5.0)},
                       {"load_frequency", maybe() ? between(0.0, 10.0) : 0.0}};
    spec.q = {between(-2.0, 2.0)};
    spec.v = {between(-2.0, 2.0)};
    return 30.0;
  }

  double frictionOscillator(SystemSpec& spec) {
    const double mu = between(0.1, 0.5);
    const double a = between(0.1, 0.5);
    const double p = std::sqrt(mu * 9.8 / a);  // of a flat plank
    spec.parameters = {
        {"mass", between(0.5, 2.0)},
        {"friction_coefficient", mu},
        {"half_spacing", a},
        {"height", a * between(0.0, 0.8)},
        {"roller_speed", between(1.0, 2.0)},
        {"regularization", maybe() ? between(0.5, 1.0) : 0.0}};  // wide enough for steps
    // Amplitudes that keep the plank on both rollers.
    spec.q = {a * between(-0.3, 0.3)};
    spec.v = {p * a * between(-0.3, 0.3)};
    return 30.0;
  }

  double slidingMassFlywheel(SystemSpec& spec) {
    const double m = between(0.2, 1.0);
    const double p = between(10.0, 20.0);
    const double w = between(-5.0, 5.0);
    const bool symmetric = maybe();
    spec.settings.choices["symmetric"] = symmetric ? "true" : "false";
    spec.parameters = {{"inertia", m * 0.09 * between(1.0, 3.0)},
                       {"slider_mass", m},
                       {"stiffness", m * p * p},
                       {"free_length", between(-0.1, 0.3)}};
    spec.q = {between(0.1, 0.3), between(-3.0, 3.0)};
    spec.v = {between(-0.5, 0.5), w};
    if (!symmetric) {
      spec.q.insert(spec.q.begin(), between(0.1, 0.3));
      spec.v.insert(spec.v.begin(), between(-0.5, 0.5));
    }
    return 20.0 + p;  // with its masses at the centre the wheel turns three times as fast
  }

  double governor(SystemSpec& spec) {
    const double m = between(0.5, 2.0);
    const double l = between(0.2, 0.5);
    const double torque = between(1.0, 4.0);
    spec.parameters = {{"mass", m},
                       {"length", l},
                       {"inertia", between(0.5, 2.0)},
                       {"damping", m * l * l * between(0.0, 2.0)},
                       {"torque", torque},
                       {"load", torque * between(0.3, 0.9)}};
    spec.q = {between(0.0, 1.2), between(-3.0, 3.0)};
    spec.v = {between(-1.0, 1.0), between(3.0, 10.0)};
    return 60.0;  // the engine runs away until its governor closes the throttle
  }

  std::mt19937_64 random_{20};
};

}  // namespace whirl_twin
