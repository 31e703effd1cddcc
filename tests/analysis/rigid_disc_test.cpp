// The tilting rigid disc: whirl speeds and a run-up against the reference rotors, its two frames
// against each other, and an anisotropic shaft against the closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../integration/running_system.h"
#include "analysis/equilibria.h"
#include "analysis/stability.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace rigid_disc_test {

using Json = nlohmann::json;

Json expected(const std::string& id, const std::string& name) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  for (const Json& reference : Json::parse(file)) {
    for (const Json& entry : reference["expected"]) {
      if (reference["id"] == id && entry["name"] == name) {
        return entry["value"];
      }
    }
  }
  throw std::logic_error("nothing expected of " + id + " " + name);
}

/// The overhung disc of the reference rotors: steel, 20 mm, 0.3 m.
RunningSystem::Setup overhung(ParameterValues effects) {
  RunningSystem::Setup s;
  s.model = "rigid_disc_rotor";
  s.parameters = std::move(effects);
  s.parameters["mass"] = 6.0;
  s.parameters["polar_inertia"] = 0.0768;
  s.parameters["transverse_inertia"] = 0.03845;
  const double pi = 3.14159265358979323846;
  s.settings.tables["overhung"] = {
      {{{"length", 0.3}, {"bending_stiffness", 205.0e9 * pi * std::pow(0.02, 4) / 64.0}}, {}}};
  return s;
}

std::shared_ptr<const Dynamics> dynamicsOf(const RunningSystem::Setup& s) {
  const ModelInfo& model = *findModel(s.model);
  return model.setUp(completed(model, s.parameters), s.settings, s.gravity).dynamics;
}

TEST(RigidDisc, WhirlsForwardsAndBackwardsAsTheReferenceRotor) {
  const auto dynamics = dynamicsOf(overhung({}));
  for (const Json& at : expected("C01_stodola_green_overhung", "whirl_rad_s")) {
    std::vector<double> whirl;
    for (const auto& root : eigenvalues(
             linearizationAtRest(*dynamics, Eigen::VectorXd::Zero(4), at["Om"].get<double>()))) {
      if (root.imag() > 0.0) {
        whirl.push_back(root.imag());
        EXPECT_NEAR(root.real(), 0.0, 1e-9 * root.imag());
      }
    }
    std::vector<double> reference = at["forward"];
    reference.insert(reference.end(), at["backward"].begin(), at["backward"].end());
    std::sort(whirl.begin(), whirl.end());
    std::sort(reference.begin(), reference.end());
    ASSERT_EQ(whirl.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(whirl[i], reference[i], 1e-9 * reference[i]) << at["Om"];
    }
  }
}

TEST(RigidDisc, RunsUpThroughItsForwardCriticalSpeedAsTheReferenceRotor) {
  RunningSystem::Setup s = overhung({{"damping_displacement", 20.0},
                                     {"damping_rotation", 0.02},
                                     {"eccentricity", 2.0e-5},
                                     {"skew", 3.0e-4}});
  s.speed = 20.0;
  s.profile = {{260.0, 60.0, 0.0, 0.0}};
  const Json times = expected("C06_gyro_speed_ramp", "t");
  const Json q = expected("C06_gyro_speed_ramp", "q");
  const Json v = expected("C06_gyro_speed_ramp", "qdot");
  // The fastest whirl rotates by 0.08 rad in a step, 0.016 rad for the method of order 4: after 0.5
  // s, when this transient is most of the motion, the relative error of either is below 1e-6.
  for (const auto& [method, step] :
       {std::pair("gauss_legendre_6", 100000), {"runge_kutta_4", 20000}}) {
    RunningSystem system(s, method, step);
    for (std::size_t i = 0; i < times.size(); ++i) {
      ASSERT_EQ(system.run(std::llround((times[i].get<double>() - system.time()) * 1.0e9 / step)),
                StepStatus::kOk);
      // The reference's slopes dx/dz and dy/dz are beta and -alpha.
      const double found[] = {system.q(0), system.q(1), system.q(3), -system.q(2)};
      const double rates[] = {system.v(0), system.v(1), system.v(3), -system.v(2)};
      for (std::size_t j = 0; j < 4; ++j) {
        const std::size_t pair = j < 2 ? 0 : 2;
        EXPECT_NEAR(found[j], q[i][j].get<double>(),
                    1e-6 * std::hypot(q[i][pair].get<double>(), q[i][pair + 1].get<double>()))
            << method << " t = " << times[i] << " coordinate " << j;
        EXPECT_NEAR(rates[j], v[i][j].get<double>(),
                    1e-6 * std::hypot(v[i][pair].get<double>(), v[i][pair + 1].get<double>()))
            << method << " t = " << times[i] << " rate " << j;
      }
    }
  }
}

TEST(RigidDisc, TakesNoEnergyForItsGyroscopicMoment) {
  RunningSystem::Setup s = overhung({});
  s.speed = 600.0;
  s.q = {1.0e-4, 0.0, 1.0e-3, -5.0e-4};
  s.v = {0.0, 0.02, 0.1, 0.3};
  RunningSystem system(s, "gauss_legendre_6", 200000);
  const double energy = system.energies().kinetic + system.energies().potential;
  ASSERT_EQ(system.run(20000), StepStatus::kOk);
  EXPECT_NEAR(system.energies().kinetic + system.energies().potential, energy, 1e-9 * energy);
}

// One motion in both frames, every effect on, the speed changing.
TEST(RigidDisc, MovesAlikeInBothFrames) {
  RunningSystem::Setup s = overhung({{"damping_displacement", 20.0},
                                     {"damping_rotation", 0.05},
                                     {"internal_damping", 2.0e-4},
                                     {"eccentricity", 2.0e-5},
                                     {"eccentricity_angle", 0.5},
                                     {"skew", 3.0e-4},
                                     {"skew_angle", -1.0}});
  s.settings.choices["gravity_on_shaft"] = "true";
  s.profile = {{150.0, 100.0, 0.0, 0.0}};
  s.q = {1.0e-4, -2.0e-4, 1.0e-3, 2.0e-3};
  RunningSystem fixed(s, "gauss_legendre_6", 100000);
  s.settings.choices["frame"] = "rotating";
  RunningSystem turning(s, "gauss_legendre_6", 100000);
  ASSERT_EQ(fixed.run(10000), StepStatus::kOk);
  ASSERT_EQ(turning.run(10000), StepStatus::kOk);
  const auto turn = std::polar(1.0, turning.drive().at(0.0).angle);
  for (const std::size_t i : {0u, 2u}) {
    const std::complex<double> a(fixed.q(i), fixed.q(i + 1));
    const std::complex<double> b = turn * std::complex<double>(turning.q(i), turning.q(i + 1));
    EXPECT_LT(std::abs(a - b), 1e-9 * std::abs(a)) << i;
  }
}

// Without coupling, tilt and damping apart: s^4 + (k1 + k2 + 2 w^2) s^2 + (k1 - w^2)(k2 - w^2) = 0
// in k / m = 100 (1 +- 0.2).
TEST(RigidDisc, OnAShaftThatIsNotRoundIsUnstableBetweenItsTwoCriticalSpeeds) {
  RunningSystem::Setup s;
  s.model = "rigid_disc_rotor";
  s.parameters = {{"mass", 1.0},
                  {"polar_inertia", 0.02},
                  {"transverse_inertia", 0.01},
                  {"stiffness_displacement", 1.0e4},
                  {"stiffness_rotation", 1.0e4},
                  {"stiffness_asymmetry", 0.2}};
  s.settings.choices["frame"] = "rotating";
  const auto dynamics = dynamicsOf(s);
  const double k1 = 1.2e4;
  const double k2 = 0.8e4;
  for (const double w : {50.0, 89.0, 90.0, 100.0, 109.0, 110.0, 150.0}) {
    const double b = k1 + k2 + 2.0 * w * w;
    const double c = (k1 - w * w) * (k2 - w * w);
    const double square = 0.5 * (-b + std::sqrt(b * b - 4.0 * c));
    double growth = 0.0;
    for (const auto& root :
         eigenvalues(linearizationAtRest(*dynamics, Eigen::VectorXd::Zero(4), w))) {
      growth = std::max(growth, root.real());
    }
    EXPECT_NEAR(growth, square > 0.0 ? std::sqrt(square) : 0.0, 1e-8 * w) << w;
    EXPECT_EQ(square > 0.0, w > std::sqrt(k2) && w < std::sqrt(k1));
  }
}

TEST(RigidDisc, RefusesShaftsThatThereAreNot) {
  const auto complaint = [](ParameterValues values, bool table) -> std::string {
    RunningSystem::Setup s = overhung(std::move(values));
    if (!table) {
      s.settings.tables.clear();
    }
    try {
      dynamicsOf(s);
    } catch (const SetupError& error) {
      return error.parameter();
    }
    return "";
  };
  EXPECT_EQ(complaint({}, true), "");
  EXPECT_EQ(complaint({}, false), "stiffness_displacement");
  EXPECT_EQ(complaint({{"stiffness_displacement", 1.0}}, false), "stiffness_rotation");
  EXPECT_EQ(complaint({{"stiffness_displacement", 1.0}}, true), "overhung");
  EXPECT_EQ(complaint({{"stiffness_displacement", 1.0},
                       {"stiffness_rotation", 1.0},
                       {"stiffness_coupling", -1.0}},
                      false),
            "stiffness_coupling");
  EXPECT_EQ(complaint({{"stiffness_asymmetry", 0.1}}, true), "stiffness_asymmetry");
}

}  // namespace rigid_disc_test
}  // namespace whirl_twin
