// Rotors on pins and clamps, and shafts without mass: critical speeds and forces by the closed
// forms of beams, and dense solutions without the rows of fixed coordinates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "analysis/campbell.h"
#include "analysis/rotor_statics.h"
#include "models/flexible_shaft_settings.h"
#include "scene/built_scene.h"
#include "scene/scene_error.h"

namespace whirl_twin {
namespace rigid_supports_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kYoung = 2.1e11;

/// I [m^4] of a round shaft.
double areaMoment(double diameter) {
  return kPi * std::pow(diameter, 4) / 64.0;
}

Scene sceneWith(const std::string& parameters) {
  return sceneOf(
      "{step: 0.001, systems: {r: {model: flexible_rotor, parameters: {speed: 0, "
      "youngs_modulus: 2.1e+11, " +
      parameters + "}}}}");
}

/// [rad/s], ascending.
std::vector<double> criticalSpeedsOf(const BuiltScene& scene, double highest) {
  const Dynamics& dynamics = *scene.systems[0]->dynamics;
  std::vector<double> speeds;
  for (int k = 0; k <= 20; ++k) {
    speeds.push_back(highest * k / 20.0);
  }
  std::vector<double> found;
  for (const CampbellCrossing& c :
       campbell(dynamics.linearRotor(), dynamics.stations(), {speeds}).crossings) {
    found.push_back(c.speed);
  }
  std::sort(found.begin(), found.end());
  return found;
}

// 48 E I / L^3, whatever the mesh, and whether modes are reduced or not.
TEST(MasslessShaft, BetweenPinsCarriesADiscAsAStringOfItsStiffness) {
  const double length = 0.5;
  const double mass = 10.0;
  const double expected = std::sqrt(48.0 * kYoung * areaMoment(0.03) / std::pow(length, 3) / mass);
  for (const int half : {1, 2, 10}) {
    for (const char* modes : {"0", "auto"}) {
      const BuiltScene scene = build(sceneWith(fmt::format(
          "density: 0, shear_deformation: false, modes: {}, elements: [{{length: {:.17g}, "
          "outer_diameter: 0.03, count: {}}}], discs: [{{node: {}, mass: {}}}], "
          "bearings: [{{node: 0, pin: true}}, {{node: {}, pin: true}}]",
          modes, 0.5 * length / half, 2 * half, half, mass, 2 * half)));
      EXPECT_EQ(scene.systems[0]->dynamics->dof(), 2);
      const std::vector<double> found = criticalSpeedsOf(scene, 1000.0);
      ASSERT_EQ(found.size(), 2U) << half << modes;
      EXPECT_NEAR(found[0], expected, 1.0e-9 * expected) << half << modes;
      EXPECT_NEAR(found[1], expected, 1.0e-9 * expected) << half << modes;
    }
  }
}

// Deflection and slope of a cantilever's end under a force and a moment: (12 EI/L^3 - w^2 m)
// (4 EI/L - w^2 (I_t -+ I_p)) = (6 EI/L^2)^2.
TEST(MasslessShaft, FromAClampHasTheOverhungDiscsBackwardAndForwardCriticalSpeed) {
  const double length = 0.4, mass = 25.447, polar = 0.28628, across = 0.14844;
  const BuiltScene scene = build(sceneWith(
      "density: 0, shear_deformation: false, elements: [{length: 0.1, outer_diameter: 0.05, "
      "count: 4}], discs: [{node: 4, mass: 25.447, polar_inertia: 0.28628, transverse_inertia: "
      "0.14844}], bearings: [{node: 0, clamp: true}]"));
  const double ei = kYoung * areaMoment(0.05);
  const double a = 12.0 * ei / std::pow(length, 3), b = 6.0 * ei / (length * length),
               c = 4.0 * ei / length;
  std::vector<double> expected;
  for (const double inertia : {across + polar, across - polar}) {
    const double p = mass * inertia, q = a * inertia + c * mass, r = a * c - b * b;
    for (const double sign : {-1.0, 1.0}) {
      const double squared = (q + sign * std::sqrt(q * q - 4.0 * p * r)) / (2.0 * p);
      if (squared > 0.0) {
        expected.push_back(std::sqrt(squared));
      }
    }
  }
  std::sort(expected.begin(), expected.end());
  const std::vector<double> found = criticalSpeedsOf(scene, 2000.0);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1.0e-9 * expected[i]);
  }
}

/// [rad/s^2], of K phi = w^2 (M - i G1) phi without the rows of fixed coordinates.
std::vector<double> struckOut(const FlexibleShaft& shaft, double highest) {
  using Long = std::complex<long double>;
  using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
  const Linearization l = RotorAssembly::unsupported(shaft).matrices(1.0);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < l.mass.rows(); ++i) {
    bool held = false;
    for (const RigidSupport& support : shaft.rigid_supports) {
      held = held || (i / 4 == support.node && (i % 4 < 2 || support.clamps));
    }
    if (!held) {
      free.push_back(i);
    }
  }
  const LongMatrix inertia =
      l.mass(free, free).cast<Long>() - Long(0.0L, 1.0L) * l.gyroscopic(free, free).cast<Long>();
  const LongMatrix stiffness = l.stiffness(free, free).cast<Long>();
  const Eigen::GeneralizedSelfAdjointEigenSolver<LongMatrix> solver(
      inertia, stiffness, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  std::vector<double> speeds;
  for (const long double mu : solver.eigenvalues()) {
    if (mu > 0.0L && std::sqrt(mu) * highest >= 1.0L) {
      speeds.push_back(static_cast<double>(1.0L / std::sqrt(mu)));
    }
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

// Of random shafts, from none to the density of steel.
TEST(RigidSupports, StrikeOutTheRowsThatTheyHold) {
  std::mt19937 draws(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  std::size_t all = 0;
  for (int k = 0; k < 12; ++k) {
    const int elements = static_cast<int>(between(2.0, 12.99));
    const bool clamp = k % 3 == 0;
    std::string discs;
    for (int i = 0; i < 2; ++i) {
      const double mass = between(1.0, 20.0);
      discs += fmt::format(
          "{}{{node: {}, mass: {:.17g}, polar_inertia: {:.17g}, transverse_inertia: {:.17g}}}",
          i == 0 ? "" : ", ", static_cast<int>(between(1.0, elements + 0.99)), mass,
          mass * between(0.0, 4.0e-3), i == 0 && k % 2 == 0 ? 0.0 : 3.0e-3 * mass);
    }
    const BuiltScene scene = build(sceneWith(fmt::format(
        "density: {:.17g}, modes: 0, elements: [{{length: {:.17g}, outer_diameter: {:.17g}, count: "
        "{}}}], discs: [{}], bearings: [{{node: 0, {}: true}}{}]",
        k % 2 == 0 ? 0.0 : std::pow(10.0, between(-6.0, 3.9)), between(0.4, 1.2) / elements,
        between(0.02, 0.06), elements, discs, clamp ? "clamp" : "pin",
        clamp ? "" : fmt::format(", {{node: {}, pin: true}}", elements))));
    const SystemSpec& spec = scene.systems[0]->spec;
    const std::vector<double> expected =
        struckOut(flexibleShaft(spec.parameters, spec.settings, 9.8), 3000.0);
    const std::vector<double> found = criticalSpeedsOf(scene, 3000.0);
    ASSERT_EQ(found.size(), expected.size()) << k;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 1.0e-6 * expected[i]) << k;
    }
    all += expected.size();
  }
  EXPECT_GT(all, 20U);
}

// m x'' = -k (x - z), c z' = k (x - z) - k_b z: a third root, real, of each direction.
TEST(MasslessShaft, OnDampedBearingsIsASpringInSeriesWithThem) {
  const double stiffness = 48.0 * kYoung * areaMoment(0.03) / std::pow(0.5, 3);
  const double mass = 10.0, bearing = 2.0e6, damping = 2.0e3;  // both of them together
  const BuiltScene scene = build(sceneWith(
      "density: 0, shear_deformation: false, modes: 0, elements: [{length: 0.25, outer_diameter: "
      "0.03, count: 2}], discs: [{node: 1, mass: 10}], bearings: [{node: 0, kxx: 1.0e+6, cxx: "
      "1.0e+3}, {node: 2, kxx: 1.0e+6, cxx: 1.0e+3}]"));
  // m c s^3 + m (k + k_b) s^2 + k c s + k k_b = 0
  Eigen::Matrix3d companion;
  companion << 0, 1, 0, 0, 0, 1, -stiffness * bearing / (mass * damping), -stiffness / mass,
      -(stiffness + bearing) / damping;
  const Eigen::Vector3cd expected = companion.eigenvalues();
  const Dynamics& dynamics = *scene.systems[0]->dynamics;
  const auto modes = whirlModes(dynamics.linearRotor(), dynamics.stations(), 0.0).modes;
  ASSERT_GE(modes.size(), 2U);
  for (const WhirlMode& mode : {modes[0], modes[1]}) {
    double nearest = 1.0e9;
    for (const std::complex<double> root : expected) {
      nearest = std::min(nearest, std::abs(root - mode.eigenvalue));
    }
    EXPECT_LT(nearest, 1.0e-6 * std::abs(mode.eigenvalue));
  }
  EXPECT_NE(scene.systems[0]->setup().note.find("have no mass"), std::string::npos);
}

// A pin on a pedestal: the pedestal and the shaft's end are one mass.
TEST(RigidSupports, MoveWithThePedestalThatTheyStandOn) {
  const std::string shaft =
      "density: 7850, modes: 0, elements: [{length: 0.1, outer_diameter: 0.03, count: 4}], discs: "
      "[{node: 2, mass: 5}], bearings: [{node: 0, pin: true}, {node: 4, ";
  const auto rigid = criticalSpeedsOf(
      build(sceneWith(shaft + "pin: true}], pedestals: [{node: 4, mass: 3, kxx: 1.0e+7}]")),
      3000.0);
  const auto stiff = criticalSpeedsOf(
      build(sceneWith(shaft + "kxx: 1.0e+16}], pedestals: [{node: 4, mass: 3, kxx: 1.0e+7}]")),
      3000.0);
  ASSERT_EQ(rigid.size(), stiff.size());
  ASSERT_GE(rigid.size(), 2U);
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    EXPECT_NEAR(rigid[i], stiff[i], 1.0e-6 * stiff[i]);
  }
}

// A cantilever under its disc's weight: W at the clamp, W L there, W L^3 / 3 E I at its end.
TEST(RigidSupports, CarryTheWeight) {
  const Scene scene = sceneWith(
      "density: 0, shear_deformation: false, elements: [{length: 0.1, outer_diameter: 0.05, count: "
      "4}], discs: [{node: 4, mass: 25}], bearings: [{node: 0, clamp: true}]");
  const FlexibleShaft shaft =
      flexibleShaft(scene.systems[0].parameters, scene.systems[0].settings, 10.0);
  const auto statics = rotorStatics(shaft, 10.0, 0.0);
  ASSERT_TRUE(statics);
  ASSERT_EQ(statics->bearings.size(), 1U);
  EXPECT_NEAR(statics->bearings[0].force.y, 250.0, 1.0e-7);
  EXPECT_NEAR(statics->nodes.front().moment.y, -100.0, 1.0e-7);
  EXPECT_NEAR(statics->nodes.back().moment.y, 0.0, 1.0e-7);
  const double sag = 250.0 * std::pow(0.4, 3) / (3.0 * kYoung * areaMoment(0.05));
  EXPECT_NEAR(statics->nodes.back().deflection.y, -sag, 1.0e-9 * sag);
}

// Where they do not move, and where nothing without mass could follow a force, there is no input.
TEST(RigidSupports, HaveNoForceInputs) {
  const BuiltScene scene = build(sceneWith(
      "density: 0, elements: [{length: 0.1, outer_diameter: 0.05, count: 4}], discs: [{node: 2, "
      "mass: 25}], bearings: [{node: 0, pin: true}, {node: 4, pin: true}]"));
  const std::vector<InputInfo> inputs = scene.systems[0]->dynamics->inputs();
  ASSERT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs[0].name, "force_x_2");
}

void expectRefused(const std::string& parameters, const std::string& message) {
  try {
    sceneWith("elements: [{length: 0.1, outer_diameter: 0.05, count: 4}], " + parameters);
    ADD_FAILURE() << parameters << " was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1U) << error.what();
    EXPECT_EQ(error.errors()[0], "test.yaml: systems.r.parameters." + message);
  }
}

TEST(RigidSupports, AreRefusedBesideWhatYields) {
  const std::string disc = "density: 7850, discs: [{node: 2, mass: 25}], ";
  expectRefused(disc + "bearings: [{node: 0, pin: true, kxx: 1.0e+6}]",
                "bearings[0].kxx: a pin is rigid: must not have kxx, found 1000000");
  expectRefused(disc + "bearings: [{node: 0, pin: true, clamp: true}]",
                "bearings[0]: must give pin or clamp, not both: a clamp includes a pin");
  expectRefused(disc + "bearings: [{node: 0, pin: yes}]",
                "bearings[0].pin: must be true or false, found 'yes'");
  expectRefused(disc +
                    "bearings: [{node: 0, clamp: true}], bearing_tables: [{bearing: 0, speed: "
                    "1, kxx: 1}]",
                "bearings[0]: must not have rows in bearing_tables, because a clamp is rigid");
  expectRefused(disc + "bearings: [{node: 0, clamp: true}, {node: 0, kxx: 1.0e+6}]",
                "bearings: node 0 has a pin or clamp: no other bearing, film, magnet, spring or "
                "rub can act on the shaft there");
  expectRefused(disc + "bearings: [{node: 0, clamp: true}], probe_node: 0",
                "probe_node: must be a free node; node 0 has a pin or clamp");
  expectRefused("density: 0, bearings: [{node: 0, clamp: true}]",
                "elements: no free coordinate has a mass");
  expectRefused("density: 0, discs: [{node: 2, mass: 25}]",
                "elements: a massless part of the rotor is not supported by springs");
}

}  // namespace rigid_supports_test
}  // namespace whirl_twin
