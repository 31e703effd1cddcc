// Flexible rotors from scene files: errors and their texts, and the model that is built.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ostream>

#include "../scene/scenes.h"
#include "algebra/dense.h"
#include "analysis/equilibria.h"
#include "models/model_registry.h"
#include "scene/parameter_paths.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace flexible_rotor_scene_test {

constexpr const char* kShaft =
    "youngs_modulus: 211.0e+9, density: 7810, elements: [{length: 0.25, outer_diameter: 0.05, "
    "count: 6}]";
constexpr const char* kRotor =
    "youngs_modulus: 211.0e+9, shear_modulus: 81.2e+9, density: 7810, elements: [{length: 0.25, "
    "outer_diameter: 0.05, count: 6}], discs: [{node: 2, mass: 32.59, polar_inertia: 0.3296, "
    "transverse_inertia: 0.1781}, {node: 4, mass: 51.53, polar_inertia: 0.8051, "
    "transverse_inertia: 0.4236}], bearings: [{node: 0, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100, cyy: "
    "100}, {node: 6, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100, cyy: 100}]";

std::string sceneText(const std::string& parameters) {
  return "{step: 0.001, systems: {r: {model: flexible_rotor, parameters: {speed: 100, " +
         parameters + "}}}}";
}

/// The setup of the scene's rotor.
ModelSetup setupOf(const std::string& parameters) {
  const Scene scene = sceneOf(sceneText(parameters));
  const SystemSpec& system = scene.systems[0];
  return findModel(system.model)->setUp(system.parameters, system.settings, scene.gravity);
}

struct InputError {
  std::string parameters;
  const char* message;  ///< after "test.yaml: systems.r.parameters."
};

void PrintTo(const InputError& inputError, std::ostream* out) {
  *out << inputError.message;
}

class RefusedFlexibleRotor : public testing::TestWithParam<InputError> {};

TEST_P(RefusedFlexibleRotor, IsToldWhatWasExpectedAndWhatFound) {
  try {
    sceneOf(sceneText(GetParam().parameters));
    FAIL() << "was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1u) << error.what();
    EXPECT_EQ(error.errors()[0],
              std::string("test.yaml: systems.r.parameters.") + GetParam().message);
  }
}

std::string withShaft(const std::string& more) {
  return std::string(kShaft) + ", " + more;
}

INSTANTIATE_TEST_SUITE_P(
    Parts, RefusedFlexibleRotor,
    testing::Values(
        InputError{
            "youngs_modulus: 2.0e+11, density: 7800, elements: [{length: 0.1, outer_diameter: "
            "0.05, inner_diameter: 0.06}]",
            "elements[0].inner_diameter: must be < outer_diameter = 0.05 m, found 0.06"},
        InputError{
            "youngs_modulus: 2.0e+11, density: 7800, elements: [{length: 0.1, outer_diameter: "
            "0.05, count: 60}, {length: 0.1, outer_diameter: 0.04, count: 41}]",
            "elements[1].count: must give at most 100 elements in total, found 101"},
        InputError{"youngs_modulus: 2.0e+11, density: 7800, elements: [{length: 0, outer_diameter: "
                   "0.05}]",
                   "elements[0].length: must be > 0 m, found 0"},
        InputError{withShaft("discs: [{node: 7, mass: 1}]"),
                   "discs[0].node: must be a whole number from 0 to 6, found 7"},
        InputError{withShaft("magnets: [{node: 7, ki: 100, ks: 1.0e+5}]"),
                   "magnets[0].node: must be a whole number from 0 to 6, found 7"},
        InputError{withShaft("magnets: [{node: 1, ki: 100, ks: 1}, {node: 1, ki: 100, ks: 1}]"),
                   "magnets[1].node: duplicate: node 1 already has one"},
        InputError{withShaft("bearings: [{node: 0, kxx: 1}, {node: 2.5, kxx: 1}]"),
                   "bearings[1].node: must be a whole number from 0 to 6, found 2.5"},
        InputError{withShaft("unbalances: [{node: 9, magnitude: 1}]"),
                   "unbalances[0].node: must be a whole number from 0 to 6, found 9"},
        InputError{withShaft("journal_bearings: [{node: 8, length: 0.03, diameter: 0.1, clearance: "
                             "1.0e-4, viscosity: 0.1, load: 500}]"),
                   "journal_bearings[0].node: must be a whole number from 0 to 6, found 8"},
        InputError{withShaft("probe_node: 12"),
                   "probe_node: must be auto or a whole number from 0 to 6, found 12"},
        InputError{
            withShaft("unbalances: [{node: 1, magnitud: 1, magnitude: 1}]"),
            "unbalances[0].magnitud: unknown key of unbalances; did you mean 'magnitude'?"}));

INSTANTIATE_TEST_SUITE_P(
    AsItIsBuilt, RefusedFlexibleRotor,
    testing::Values(
        InputError{
            withShaft("shear_modulus: 81.2"),
            "shear_modulus: must be from 2.11e+09 to 2.11e+12 Pa, 0.01 to 10 times youngs_modulus "
            "(usual: 8.12e+10 Pa), found 81.2 Pa"},
        InputError{withShaft("poissons_ratio: 0.6"),
                   "poissons_ratio: must be from 0 to 0.5, found 0.6"},
        InputError{withShaft("materials: [{name: bronze, youngs_modulus: 1.1e+11, density: 8800}], "
                             "sleeves: [{from: 0, to: 1, outer_diameter: 0.06, material: bronse}]"),
                   "sleeves[0].material: must be a name of materials, found 'bronse'; did you mean "
                   "'bronze'?"},
        InputError{
            withShaft("sleeves: [{from: 0, to: 1, outer_diameter: 0.04}]"),
            "sleeves[0].outer_diameter: must be > 0.05 m, the outer diameter below it, found 0.04"},
        InputError{withShaft("sleeves: [{from: 2, to: 2, outer_diameter: 0.06}]"),
                   "sleeves[0].to: must be > from = 2, found 2"},
        InputError{withShaft("discs: [{node: 1}]"),
                   "discs[0].mass: missing; in kg, or outer_diameter and width in m"},
        InputError{withShaft("discs: [{node: 1, outer_diameter: 0.3}]"),
                   "discs[0].width: must be > 0 m for a disc by its geometry"},
        InputError{withShaft("pedestals: [{node: 0, mass: 9, kxx: 1}]"),
                   "pedestals[0].node: must be a node with a bearing, found 0"},
        InputError{
            withShaft("bearings: [{node: 0, kxx: 1}], pedestals: [{node: 0, mass: 0, kxx: 1}]"),
            "pedestals[0].mass: must be > 0 kg, found 0; a spring without a mass is part of "
            "the bearing, k1 k2 / (k1 + k2)"},
        InputError{
            withShaft("magnets: [{node: 1, ki: 100, ks: 1}], pedestals: [{node: 1, mass: 9}]"),
            "pedestals[0].node: must be a node without a magnet, whose force acts between "
            "shaft and ground, found 1"},
        InputError{
            withShaft("couplings: [{element: 6, lateral_stiffness: 1, bending_stiffness: 1}]"),
            "couplings[0].element: must be a whole number from 0 to 5, found 6"},
        InputError{
            withShaft("couplings: [{element: 2, lateral_stiffness: 1, bending_stiffness: 1}], "
                      "sleeves: [{from: 2, to: 3, outer_diameter: 0.06}]"),
            "sleeves[0]: must sit on a shaft; element 2 is a coupling"},
        InputError{withShaft("modal_damping: [{ratio: 0.01}, {ratio: 0.02}]"),
                   "modal_damping[1].frequency: must be > 0 rad/s, the row before, found 0"},
        InputError{
            withShaft("bearings: [{node: 0, kxx: 1, mxx: 1, mxy: 2}]"),
            "bearings[0].mxy: must give a positive semidefinite mass matrix, mxy^2 <= mxx myy "
            "= 1 kg^2, found 2"}));

INSTANTIATE_TEST_SUITE_P(
    ModesAndTables, RefusedFlexibleRotor,
    testing::Values(
        InputError{withShaft("modes: many"),
                   "modes: must be a whole number >= 0 or auto, found 'many'"},
        InputError{withShaft("modes: 2.5"),
                   "modes: must be a whole number >= 0 or auto, found 2.5"},
        InputError{withShaft("modes: 29"),
                   "modes: must be auto or a whole number from 0 to 28, four per node, found 29"},
        InputError{withShaft("bearing_tables: [{bearing: 0, speed: 1}]"),
                   "bearing_tables[0].bearing: needs a row in bearings to refer to"},
        InputError{withShaft("bearings: [{node: 0}], bearing_tables: [{bearing: 1, speed: 1}]"),
                   "bearing_tables[0].bearing: must be a whole number from 0 to 0, found 1"},
        InputError{
            withShaft("bearings: [{node: 0}], bearing_tables: [{bearing: 0, speed: 5}, "
                      "{bearing: 0, speed: 5}]"),
            "bearing_tables[1].speed: must be > 5 rad/s, the row before of this bearing, found "
            "5"},
        InputError{withShaft("pedestal_tables: [{pedestal: 0, speed: 1}]"),
                   "pedestal_tables[0].pedestal: needs a row in pedestals to refer to"},
        InputError{
            withShaft("bearings: [{node: 0, kxx: 1}], pedestals: [{node: 0, mass: 9, kxx: 1}], "
                      "pedestal_tables: [{pedestal: 0, speed: 5, kxx: 1}]"),
            "pedestals[0]: must give its node and mass only: pedestal_tables gives its "
            "coefficients"},
        InputError{
            withShaft("bearings: [{node: 0, kxx: 3}], bearing_tables: [{bearing: 0, speed: 5, "
                      "kxx: 1}]"),
            "bearings[0]: must give its node only: bearing_tables gives its coefficients"}));

TEST(FlexibleRotorScene, NeedsElements) {
  try {
    sceneOf(sceneText("youngs_modulus: 2.0e+11, density: 7800"));
    FAIL() << "was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1u) << error.what();
    EXPECT_NE(error.errors()[0].find("systems.r.parameters.elements: missing"), std::string::npos);
  }
}

TEST(FlexibleRotorScene, KeepsEveryNodeCoordinateWithModesZero) {
  const ModelSetup setup = setupOf(std::string(kRotor) + ", modes: 0");
  const auto names = setup.dynamics->coordinates();
  ASSERT_EQ(names.size(), 28u);
  EXPECT_EQ(names[0].name, "x_0");
  EXPECT_EQ(names[5].name, "y_1");
  EXPECT_EQ(names[26].name, "alpha_6");
  EXPECT_EQ(names[27].unit, "rad");
  EXPECT_EQ(setup.note, "");
  EXPECT_TRUE(setup.dynamics->isRotor());
  EXPECT_TRUE(setup.dynamics->speedDependent()) << "gyroscopic moments";
}

TEST(FlexibleRotorScene, HoldsAlongYAsAlongXAndSaysSo) {
  const ModelSetup setup = setupOf(std::string(kShaft) +
                                   ", modes: 0, bearings: [{node: 0, kxx: 1.0e+6, cxx: 10}, {node: "
                                   "6, kxx: 1.0e+6, kyy: 0}]");
  const LinearRotor rotor = setup.dynamics->linearRotor();
  const Linearization l = rotor.matrices(0.0);
  EXPECT_NEAR(l.stiffness(1, 1), l.stiffness(0, 0), 1.0);
  EXPECT_NEAR(l.stiffness(25, 25), l.stiffness(24, 24) - 1.0e6, 1.0);
  EXPECT_EQ(setup.note, "cyy as cxx, default (bearings[0]); kyy as kxx, default (bearings[0])");
}

TEST(FlexibleRotorScene, WhatFollowsAnotherGoesAlongWhenThatChanges) {
  Scene scene = sceneOf(sceneText(
      withShaft("bearings: [{node: 0, kxx: 1.0e+6}, {node: 6, kxx: 1.0e+6, kyy: 2.0e+6}]")));
  SystemSpec& system = scene.systems[0];
  const ModelInfo& model = *findModel(system.model);
  Diagnostics diagnostics("test.yaml");
  ASSERT_TRUE(setParameter("bearings[0].kxx", 3.0e6, model, system, diagnostics));
  ASSERT_TRUE(setParameter("bearings[1].kxx", 3.0e6, model, system, diagnostics));
  EXPECT_EQ(parameterAt("bearings[0].kyy", model, system), 3.0e6);
  EXPECT_EQ(parameterAt("bearings[1].kyy", model, system), 2.0e6);
  ASSERT_TRUE(setParameter("bearings[0].kyy", 4.0e6, model, system, diagnostics));
  ASSERT_TRUE(setParameter("bearings[0].kxx", 5.0e6, model, system, diagnostics));
  EXPECT_EQ(parameterAt("bearings[0].kyy", model, system), 4.0e6);
}

TEST(FlexibleRotorScene, HasItsPedestalsBehindTheirNodes) {
  const std::string pedestals =
      ", pedestals: [{node: 0, mass: 20, kxx: 5.0e+6, kyy: 4.0e+6}, {node: 0, mass: 90, kxx: "
      "1.0e+8, kyy: 1.0e+8}, {node: 6, mass: 20, kxx: 5.0e+6, kyy: 4.0e+6}]";
  const auto names = setupOf(kRotor + pedestals + ", modes: 0").dynamics->coordinates();
  ASSERT_EQ(names.size(), 34u);
  EXPECT_EQ(names[4].name, "pedestal_x_0");
  EXPECT_EQ(names[7].name, "pedestal_y_0_2");
  EXPECT_EQ(names[8].name, "x_1");
  EXPECT_EQ(names[33].name, "pedestal_y_6");
  const ModelSetup reduced = setupOf(kRotor + pedestals + ", modes: 8");
  EXPECT_EQ(reduced.note.rfind("8 of 34 modes", 0), 0u) << reduced.note;
}

// Couplings, torque, modal damping and speed-dependent pedestals read from a scene;
// tests/mechanics/rotor_parts_test.cpp compares their mechanics with closed forms.
TEST(FlexibleRotorScene, HasItsCouplingsTorquesAndDampings) {
  const auto with = [](const std::string& more) {
    return setupOf(std::string(kShaft) +
                   ", modes: 0, bearings: [{node: 0, kxx: 1.0e+6}, {node: 6, "
                   "kxx: 1.0e+6}], discs: [{node: 2, mass: 9}, {node: 3, "
                   "mass: 9}]" +
                   more)
        .dynamics->linearRotor()
        .matrices(50.0);
  };
  const Linearization plain = with("");
  const Linearization joined = with(
      ", couplings: [{element: 2, lateral_stiffness: 1.0e+5, bending_stiffness: 2.0e+3, "
      "lateral_damping: 40}]");
  EXPECT_LT(joined.mass.sum(), plain.mass.sum());
  EXPECT_NEAR(joined.stiffness(8, 12), -1.0e5, 1e-6);
  EXPECT_NEAR(joined.stiffness(11, 15), 1.0e5 * 0.125 * 0.125 - 2.0e3, 1e-6);
  EXPECT_NEAR(joined.circulatory(8, 13), -50.0 * 40.0, 1e-6) << "it turns with the shaft";
  const Linearization damped = with(", modal_damping: [{ratio: 0.02}]");
  EXPECT_GT(damped.damping.trace(), 0.0);
  EXPECT_EQ(damped.circulatory.norm(), 0.0);
  const Linearization standing = with(
      ", pedestals: [{node: 0, mass: 30}], pedestal_tables: [{pedestal: 0, speed: 0, kxx: 4.0e+6}, "
      "{pedestal: 0, speed: 100, kxx: 2.0e+6}]");
  EXPECT_NEAR(standing.stiffness(4, 4), 1.0e6 + 3.0e6, 1.0);
  const std::string twisted =
      "youngs_modulus: 211.0e+9, density: 7810, modes: 0, elements: [{length: 0.25, "
      "outer_diameter: 0.05, torque: 800, count: 2}]";
  EXPECT_NEAR(setupOf(twisted).dynamics->linearRotor().matrices(0.0).circulatory(2, 3), -400.0,
              1e-9);
}

// A disc of 0.3 m, bore 0.05 m and 0.04 m: m = rho pi (D^2 - d^2) b / 4, I_p = m (D^2 + d^2) / 8,
// I_d = I_p / 2 + m b^2 / 12.
TEST(FlexibleRotorScene, WeighsADiscByItsGeometry) {
  const auto with = [](const std::string& disc) {
    return setupOf(std::string(kShaft) + ", modes: 0, discs: [" + disc + "]")
        .dynamics->linearRotor()
        .matrices(1.0);
  };
  const double mass = 7810.0 * 3.14159265358979323846 / 4.0 * (0.09 - 0.0025) * 0.04;
  const double polar = mass * (0.09 + 0.0025) / 8.0;
  const Linearization shape =
      with("{node: 3, outer_diameter: 0.3, inner_diameter: 0.05, width: 0.04}");
  const Linearization point = with("{node: 3, mass: 1.0e-9}");
  EXPECT_NEAR(shape.mass(12, 12) - point.mass(12, 12), mass, 1e-8);
  EXPECT_NEAR(shape.mass(14, 14) - point.mass(14, 14), 0.5 * polar + mass * 0.0016 / 12.0, 1e-9);
  EXPECT_NEAR(shape.gyroscopic(14, 15) - point.gyroscopic(14, 15), polar, 1e-9);
}

TEST(FlexibleRotorScene, SaysWhatIsUnusual) {
  const ModelSetup setup = setupOf(
      "youngs_modulus: 2.0e+11, shear_modulus: 1.2e+11, density: 7800, modes: 0, elements: "
      "[{length: 125, outer_diameter: 5, count: 2}]");
  EXPECT_NE(setup.note.find("shear_modulus = 1.2e+11 Pa is outside"), std::string::npos);
  EXPECT_NE(setup.note.find("the shaft is 250 m long; lengths are in m"), std::string::npos)
      << setup.note;
}

// Millimetres entered as metres; and Ip <= Ix + Iy of every body.
TEST(FlexibleRotorScene, SaysWhatNoShaftAndNoDiscIs) {
  const auto noteOf = [](double diameter, double polar) {
    return setupOf(fmt::format("youngs_modulus: 2.0e+11, density: 7800, modes: 0, "
                               "elements: [{{length: 0.03, outer_diameter: {}, count: 8}}], "
                               "discs: [{{node: 3, mass: 8, polar_inertia: {}, "
                               "transverse_inertia: 0.1}}]",
                               diameter, polar))
        .note;
  };
  EXPECT_EQ(noteOf(0.03, 0.2), "");
  EXPECT_EQ(noteOf(10.0, 0.2), "the shaft is 10 m thick and 0.24 m long; lengths are in m");
  EXPECT_EQ(
      noteOf(0.03, 1.0),
      "discs[0]: polar_inertia, 1 kg m^2, should be at most twice transverse_inertia, 0.1 kg m^2");
}

TEST(FlexibleRotorScene, IsReducedAndSaysSo) {
  const ModelSetup eight = setupOf(std::string(kRotor) + ", modes: 8");
  ASSERT_EQ(eight.dynamics->coordinates().size(), 8u);
  EXPECT_EQ(eight.dynamics->coordinates()[7].name, "q8");
  EXPECT_EQ(eight.note.rfind("8 of 28 modes", 0), 0u) << eight.note;
  const ModelSetup automatic = setupOf(std::string(kRotor) + ", highest_speed: 200");
  EXPECT_GE(automatic.dynamics->dof(), 6);
  EXPECT_LE(automatic.dynamics->dof(), 20);
  EXPECT_NE(automatic.note.find("<= 1e-06 up to 200 rad/s"), std::string::npos) << automatic.note;
}

TEST(FlexibleRotorScene, PublishesTheFirstUnbalanceElseTheFirstDiscElseTheMiddle) {
  const auto published = [](const std::string& parameters) {
    return setupOf(parameters).dynamics->stations().front().name;
  };
  const std::string rotor = std::string(kRotor) + ", modes: 4";
  EXPECT_EQ(published(rotor + ", unbalances: [{node: 5, magnitude: 1.0e-3, angle: 0.7}]"),
            "node_5");
  EXPECT_EQ(published(rotor), "node_2");
  EXPECT_EQ(published(withShaft("modes: 4")), "node_3");
  EXPECT_EQ(published(rotor + ", probe_node: 0"), "node_0");
  const auto stations = setupOf(rotor).dynamics->stations();
  ASSERT_EQ(stations.size(), 7u);
  EXPECT_EQ(stations[0].position, 0.5);
  // The phase reference mark is an independent parameter, whatever unbalance there is.
  EXPECT_EQ(setupOf(rotor + ", unbalances: [{node: 5, magnitude: 1.0e-3, angle: 0.7}]")
                .dynamics->phaseMark(),
            0.0);
  EXPECT_EQ(setupOf(rotor + ", phase_mark: 0.7").dynamics->phaseMark(), 0.7);
}

TEST(FlexibleRotorScene, BearingsFollowTheSpeed) {
  const ModelSetup setup = setupOf(
      withShaft("modes: 0, bearings: [{node: 0}, {node: 6, kxx: 1.0e+6, kyy: 1.0e+6}], "
                "bearing_tables: [{bearing: 0, speed: 0, kxx: 2.0e+6}, {bearing: 0, speed: 100, "
                "kxx: 5.0e+6}], journal_bearings: [{node: 3, length: 0.03, diameter: 0.1, "
                "clearance: 1.0e-4, viscosity: 0.1, load: 525}]"));
  const LinearRotor rotor = setup.dynamics->linearRotor();
  const double change = rotor.matrices(300.0).stiffness(0, 0) - rotor.matrices(0.0).stiffness(0, 0);
  EXPECT_NEAR(change, 3.0e6, 1.0);
  // Reference case E05 at 2000 rpm; kxy = 22025300.7, kyx = -28956901.0: half their difference.
  const double speed = 2000.0 * 3.14159265358979323846 / 30.0;
  EXPECT_NEAR(rotor.matrices(speed).circulatory(12, 13), 0.5 * (22025300.7 + 28956901.0), 1.0);
  ASSERT_EQ(rotor.knots.size(), 4u);
  EXPECT_EQ(rotor.knots[3], 100.0);
}

// The run at constant speed, from rest, ends in the whirl that its matrices predict.
const InputInfo& inputOf(const std::vector<InputInfo>& inputs, const std::string& name) {
  return *std::find_if(inputs.begin(), inputs.end(),
                       [&](const InputInfo& input) { return input.name == name; });
}

// f = ki i + ks x: a current is a force of ki times it, and the displacement is pulled on.
TEST(FlexibleRotorScene, MagnetsPullAwayFromTheMiddleAndObeyTheirCurrents) {
  for (const char* modes : {"0", "6"}) {
    const std::string kept = std::string("modes: ") + modes + ", ";
    const ModelSetup magnets = setupOf(withShaft(
        kept + "magnets: [{node: 1, ki: 120, ks: 3.0e+5}, {node: 5, ki: 80, ks: 2.0e+5}]"));
    const ModelSetup springs =
        setupOf(withShaft(
            kept + "bearings: [{node: 1, kxx: -3.0e+5, kyy: -3.0e+5}, {node: 5, kxx: -2.0e+5, kyy: "
                   "-2.0e+5}]"));
    const auto stiffness = [](const ModelSetup& setup) {
      const Eigen::VectorXd rest = Eigen::VectorXd::Zero(setup.dynamics->dof());
      return linearizationAbout(*setup.dynamics, rest, rest, 100.0).stiffness;
    };
    EXPECT_EQ(stiffness(magnets), stiffness(springs)) << modes;
    const std::vector<InputInfo> inputs = magnets.dynamics->inputs();
    for (const char* along : {"x", "y"}) {
      const std::string axis = along;
      const InputInfo& current = inputOf(inputs, "current_" + axis + "_5");
      EXPECT_EQ(current.unit, "A");
      EXPECT_EQ(current.direction, 80.0 * inputOf(inputs, "force_" + axis + "_5").direction);
    }
  }
}

TEST(FlexibleRotorScene, WhirlsAsItsMatricesSay) {
  Twin twin(sceneOf(
      sceneText(std::string(kRotor) +
                ", modes: 6, highest_speed: 150, unbalances: [{node: 2, magnitude: 1.0e-3}]")));
  const Dynamics& dynamics = *twin.systems()[0]->dynamics;
  const LinearRotor rotor = dynamics.linearRotor();
  const double w = 100.0;
  const Linearization l = rotor.matrices(w);
  const Eigen::MatrixXcd dynamic =
      (l.stiffness + l.circulatory - w * w * l.mass).cast<std::complex<double>>() +
      std::complex<double>(0.0, w) * (l.damping + l.gyroscopic);
  const Eigen::VectorXcd whirl = ComplexLu(dynamic).solve(rotor.synchronousForce(w));
  // The slowest mode decays at 0.15 / s: after 200 s it has vanished.
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    twin.step();
  }
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  const std::complex<double> turn = std::polar(1.0, w * 1.0e-3 * kSteps);
  for (Eigen::Index i = 0; i < whirl.size(); ++i) {
    EXPECT_NEAR(twin.layout().system(record.data(), 0).q()[static_cast<std::size_t>(i)],
                (whirl[i] * turn).real(), 1e-8 * whirl.norm());
  }
}

TEST(FlexibleRotorScene, IsDrawnWithItsDiscsAndBearings) {
  const ModelSetup setup = setupOf(std::string(kRotor) + ", modes: 6");
  const Sketch sketch = setup.dynamics->sketch(Eigen::VectorXd::Zero(6), {});
  EXPECT_EQ(sketch.rods.size(), 6u);
  EXPECT_EQ(sketch.discs.size(), 2u);
  EXPECT_EQ(sketch.springs.size(), 2u);
  EXPECT_EQ(sketch.rods[2].radius, 0.025);
  // A steel disc 0.28 m across and 0.07 m wide, on this shaft (32.6 kg; its bore is filled here).
  EXPECT_NEAR(sketch.discs[0].radius, 0.14, 0.005);
  // A support far softer than the bearings is a seal: a stationary ring around the shaft.
  const ModelSetup sealed = setupOf(
      withShaft("modes: 0, bearings: [{node: 0, kxx: 1.0e+6}, {node: 3, kxx: 5.0e+4}, {node: 6, "
                "kxx: 1.0e+6}]"));
  const Sketch whirling = sealed.dynamics->sketch(Eigen::VectorXd::Constant(28, 1.0e-3), {});
  EXPECT_EQ(whirling.springs.size(), 2u);
  ASSERT_EQ(whirling.rods.size(), 7u);
  EXPECT_GT(whirling.rods[6].radius, 0.025);
  EXPECT_EQ(whirling.rods[6].from.z, 0.0);
  EXPECT_NEAR(0.5 * (whirling.rods[6].from.x + whirling.rods[6].to.x), 0.75, 1e-12);
}

TEST(FlexibleRotor, WhirlsAtItsPublishedNodeAsTheHarmonicResponseSays) {
  // Heavily damped, so that the start is forgotten in 4 s; with all coordinates and with few.
  std::string rotor = kRotor;
  for (std::size_t at; (at = rotor.find("cxx: 100, cyy: 100")) != std::string::npos;) {
    rotor.replace(at, 18, "cxx: 3000, cyy: 3000");
  }
  rotor += ", unbalances: [{node: 2, magnitude: 0.001, angle: 0.4}], highest_speed: 300, modes: ";
  for (const char* modes : {"0", "auto"}) {
    Twin twin(sceneOf(sceneText(rotor + modes)));
    const LinearRotor matrices = twin.systems()[0]->dynamics->linearRotor();
    const Station node = twin.systems()[0]->dynamics->stations().front();
    EXPECT_EQ(node.name, "node_2");
    const double w = 100.0;
    const Linearization l = matrices.matrices(w);
    const std::complex<double> i(0.0, 1.0);
    const Eigen::MatrixXcd dynamic =
        (l.stiffness + l.circulatory - w * w * l.mass).cast<std::complex<double>>() +
        i * w * (l.damping + l.gyroscopic).cast<std::complex<double>>();
    const Eigen::VectorXcd q = ComplexLu(dynamic).solve(matrices.synchronousForce(w));
    const std::complex<double> x = node.along_x.cast<std::complex<double>>().cwiseProduct(q).sum();
    const std::complex<double> y = node.along_y.cast<std::complex<double>>().cwiseProduct(q).sum();
    for (int step = 0; step < 4000; ++step) {
      twin.step();
    }
    Observer observer(twin);
    const state::WhirlState whirl = observer.whirl(0);
    const std::complex<double> turn = std::polar(1.0, whirl.shaft_angle);
    EXPECT_NEAR(whirl.x, (x * turn).real(), 1.0e-6 * std::abs(x)) << modes;
    EXPECT_NEAR(whirl.y, (y * turn).real(), 1.0e-6 * std::abs(y)) << modes;
    // The axes depend on the rates, where a little of the start remains.
    EXPECT_NEAR(whirl.orbit_major, 0.5 * (std::abs(x + i * y) + std::abs(x - i * y)),
                1.0e-4 * std::abs(x))
        << modes;
  }
}

TEST(FlexibleRotor, KeepsThePromiseOfModesAutoInARunUp) {
  // Through the first four critical speeds, 83 to 282 rad/s, against every coordinate.
  const auto runUp = [](const char* modes) {
    return sceneOf(
        "{step: 0.0005, drives: {shaft: {speed: 0, profile: [{speed: 350, "
        "max_acceleration: 50, max_jerk: 200}]}}, systems: {r: {model: flexible_rotor, "
        "drive: shaft, parameters: {" +
        std::string(kRotor) +
        ", unbalances: [{node: 2, magnitude: 0.001}], highest_speed: 350, tolerance: "
        "1.0e-6, modes: " +
        modes + "}}}}");
  };
  Twin reduced(runUp("auto"));
  Twin full(runUp("0"));
  EXPECT_LT(reduced.systems()[0]->dynamics->dof(), full.systems()[0]->dynamics->dof());
  Observer of_reduced(reduced);
  Observer of_full(full);
  std::vector<double> record(full.layout().size);
  double largest = 0.0;
  double difference = 0.0;
  while (full.time() < 8.0) {
    for (auto [twin, observer] : {std::pair{&reduced, &of_reduced}, std::pair{&full, &of_full}}) {
      twin->step();
      twin->write(record.data());
      observer->observe(record.data());
    }
    const state::WhirlState a = of_reduced.whirl(0);
    const state::WhirlState b = of_full.whirl(0);
    largest = std::max(largest, b.radius);
    difference = std::max(difference, std::hypot(a.x - b.x, a.y - b.y));
  }
  EXPECT_GT(largest, 1.0e-4);
  EXPECT_LT(difference, 1.0e-6 * largest);
}

}  // namespace flexible_rotor_scene_test
}  // namespace whirl_twin
