// Equilibria of linear systems under constant loads: K q = load, so that nothing accelerates there.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "analysis/equilibria.h"
#include "free_rotors.h"
#include "mechanics/linear_dynamics.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "models/model_registry.h"
#include "models_under_test.h"
#include "random_systems.h"
#include "scene/model_context.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace sag_test {

using Eigen::VectorXd;

/// The equilibrium of a linear system at a speed, where there has to be one that leaves no
/// acceleration of the parts that the load itself gives at the origin.
void expectRest(const Dynamics& dynamics, double speed, const std::string& what) {
  const auto all = equilibria(dynamics, speed);
  ASSERT_EQ(all.size(), 1u) << what;
  const Dynamics& mean = dynamics.atMeanLoad();
  const VectorXd zero = VectorXd::Zero(dynamics.dof());
  const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
  const Linearization l = mean.linearization(zero, zero, zero, at);
  // Forces, not accelerations: a light coordinate between stiff springs shows their rounding.
  const VectorXd left = mean.residualForce(all[0].q, zero, at);
  const VectorXd parts = mean.residualForce(zero, zero, at).cwiseAbs() +
                         (l.stiffness + l.circulatory).cwiseAbs() * all[0].q.cwiseAbs();
  EXPECT_LE((left.cwiseAbs() - 1.0e-12 * parts).maxCoeff(), 0.0) << what;
  const double falling = mean.acceleration(zero, zero, at).norm();
  EXPECT_LE(mean.acceleration(all[0].q, zero, at).norm(), 1.0e-6 * falling) << what;
}

// m = 2 kg, k = 20 kN/m: the sag is m g / k.
TEST(Sag, OfAJeffcottRotorIsItsWeightOverItsStiffness) {
  Settings settings;
  settings.choices["gravity_on_shaft"] = "true";
  const auto rotor =
      dynamicsOf("jeffcott_rotor", {{"mass", 2.0}, {"stiffness", 2.0e4}, {"damping", 20.0}},
                 9.80665, settings);
  for (const double speed : {0.0, 50.0, 300.0}) {
    const auto all = equilibria(*rotor, speed);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0].q[0], 0.0, 1.0e-18);
    EXPECT_NEAR(all[0].q[1], -9.80665e-4, 1.0e-15);
  }
}

// ROSS's rotor2, a shaft of two elements with a disc in springs of 1 MN/m: the position at which it
// settles.
TEST(Sag, OfAFlexibleRotorIsWhatItSettlesAt) {
  FlexibleShaft shaft;
  shaft.material = {2.11e11, 8.12e10, 7810.0, true};
  shaft.elements = {{0.25, 0.05, 0.0}, {0.25, 0.05, 0.0}};
  shaft.discs = {{1, 32.58972765, 0.32956362, 0.17808928}};
  shaft.bearings = {{0, {1.0e6, 0.0, 0.0, 1.0e6, 0.0, 0.0, 0.0, 0.0}},
                    {2, {1.0e6, 0.0, 0.0, 1.0e6, 0.0, 0.0, 0.0, 0.0}}};
  shaft.gravity = 9.80665;
  const RotorAssembly assembly(shaft);
  std::vector<CoordinateInfo> coordinates(static_cast<std::size_t>(assembly.dof()), {"q", "m"});
  const LinearRotorDynamics rotor({"rotor", coordinates, assembly.stations()},
                                  assembly.linearRotor());
  const auto all = equilibria(rotor, 100.0);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(assembly.station(0).along_y.dot(all[0].q), -1.9739e-4, 1.0e-8);
  EXPECT_NEAR(assembly.station(1).along_y.dot(all[0].q), -2.12454e-4, 1.0e-8);
}

TEST(Sag, LeavesNothingThatAcceleratesInAnyLinearScene) {
  int systems = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    const Scene scene = readSceneFile(entry.path().string());
    for (const SystemSpec& system : scene.systems) {
      const ModelInfo& model = *findModel(system.model);
      const auto dynamics =
          model.setUp(system.parameters, system.settings, surroundingsOf(scene, system)).dynamics;
      if (dynamics->linear()) {
        ++systems;
        for (const double speed : {0.0, 40.0, 400.0}) {
          expectRest(*dynamics, speed, entry.path().filename().string() + ", " + system.name);
        }
      }
    }
  }
  EXPECT_GT(systems, 10);
}

TEST(Sag, LeavesNothingThatAcceleratesInRandomSystems) {
  std::mt19937 random(8);
  for (int n = 1; n <= 12; ++n) {
    const RandomSystem springs = randomSystem(n, random);
    Eigen::MatrixXd circulatory(n, n);
    for (int i = 0; i < n; ++i) {
      circulatory.col(i) = randomVector(n, random);
    }
    circulatory = Eigen::MatrixXd(circulatory - circulatory.transpose());
    std::vector<CoordinateInfo> coordinates(static_cast<std::size_t>(n), {"q", "m"});
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(n, n);
    const LinearDynamics loaded(
        {"linear_system",
         coordinates,
         springs.mass,
         none,
         none,
         springs.stiffness,
         circulatory,
         {{randomVector(n, random), 0.0, 0.3}, {randomVector(n, random), 7.0, 0.0}}});
    expectRest(loaded, 0.0, std::to_string(n) + " coordinates");
    LinearRotor rotor;
    rotor.matrices = [=](double speed) {
      return Linearization{springs.mass, none, none, springs.stiffness, speed * circulatory};
    };
    rotor.load = randomVector(n, random);
    rotor.forces = {{randomVector(n, random).cast<std::complex<double>>(), 1, true}};
    const LinearRotorDynamics turning({"rotor", coordinates, {}}, rotor);
    expectRest(turning, 3.0, std::to_string(n) + " coordinates, turning");
  }
}

// A shaft without supports falls: there is no equilibrium, and none is reported.
TEST(Sag, OfAShaftWithoutBearingsIsNone) {
  for (const int elements : {1, 3, 8}) {
    FlexibleShaft shaft = freeShaft(elements, 1.0, 0.1);
    shaft.gravity = 9.81;
    const LinearRotor rotor = freeRotor(shaft);
    std::vector<CoordinateInfo> coordinates(static_cast<std::size_t>(rotor.dof()), {"q", "m"});
    const LinearRotorDynamics falling({"rotor", coordinates, {}}, rotor);
    for (const double speed : {0.0, 1000.0}) {
      EXPECT_TRUE(equilibria(falling, speed).empty());
      const VectorXd zero = VectorXd::Zero(rotor.dof());
      EXPECT_FALSE(operatingPoint(falling, zero, zero, speed).has_value());
    }
  }
}

// A free body pulled apart by two equal forces has a rest: they stretch it.
TEST(Sag, OfAFreeBodyIsTheStretchOfForcesThatBalance) {
  Eigen::Matrix2d spring;
  spring << 100.0, -100.0, -100.0, 100.0;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 2);
  const auto pulled = [&](double second) {
    return LinearDynamics({"linear_system",
                           {{"x1", "m"}, {"x2", "m"}},
                           Eigen::Matrix2d::Identity(),
                           none,
                           none,
                           spring,
                           none,
                           {{Eigen::Vector2d(-5.0, second), 0.0, 0.0}}});
  };
  const auto rest = equilibria(pulled(5.0), 0.0);
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_NEAR(rest[0].q[1] - rest[0].q[0], 0.05, 1.0e-15);
  EXPECT_TRUE(equilibria(pulled(4.9), 0.0).empty());
}

}  // namespace sag_test
}  // namespace whirl_twin
