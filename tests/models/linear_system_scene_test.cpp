// Linear systems from scene files: errors and their texts, the model that is built, and its motion
// according to its matrices.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "../scene/scenes.h"
#include "integration/linear_methods.h"
#include "models/model_registry.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace linear_system_scene_test {

std::string sceneText(const std::string& parameters, const std::string& more = "") {
  return "{step: 0.01, systems: {s: {model: linear_system, parameters: {" + parameters + "}" +
         (more.empty() ? "" : ", " + more) + "}}}";
}

constexpr const char* kTwo = "mass: [[2, 0], [0, 1]], stiffness: [[30, -10], [-10, 10]]";

struct InputError {
  const char* parameters;
  const char* message;  ///< after "test.yaml: systems.s.parameters."
};

void PrintTo(const InputError& inputError, std::ostream* out) {
  *out << inputError.message;
}

class RefusedLinearSystem : public testing::TestWithParam<InputError> {};

TEST_P(RefusedLinearSystem, IsToldWhatWasExpectedAndWhatFound) {
  try {
    sceneOf(sceneText(GetParam().parameters));
    FAIL() << "was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1u) << error.what();
    EXPECT_EQ(error.errors()[0],
              std::string("test.yaml: systems.s.parameters.") + GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Matrices, RefusedLinearSystem,
    testing::Values(
        InputError{"mass: [[1, 0]], stiffness: [[1]]", "mass: must be square, found 1 x 2"},
        InputError{"mass: [[1, 0], [0, 1]], stiffness: [[1]]",
                   "stiffness: must be 2 x 2 like mass, found 1 x 1"},
        InputError{"mass: [[1, 0.5], [0.25, 1]], stiffness: [[1, 0], [0, 1]]",
                   "mass: must be symmetric, found [0][1] = 0.5 and [1][0] = 0.25"},
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], gyroscopic: [[0, 2], [2, 0]]",
            "gyroscopic: must be skew-symmetric, [0][1] = -[1][0], found [0][1] = 2 and "
            "[1][0] = 2"},
        InputError{"mass: [[1]], stiffness: [[1]], circulatory: [[3]]",
                   "circulatory: must be skew-symmetric, with a zero diagonal, found [0][0] = 3"},
        InputError{
            "mass: [[1, 0], [0, 0]], stiffness: [[1, 0], [0, 1]]",
            "mass: must be positive definite: a coordinate or combination without mass has no "
            "independent motion; found [1][1] = 0 kg"},
        InputError{
            "mass: [[1, 1, 0], [1, 1, 0], [0, 0, 1]], stiffness: [[1, 0, 0], [0, 1, 0], [0, 0, "
            "1]], names: [left, right, top]",
            "mass: must be positive definite: a coordinate or combination without mass has no "
            "independent motion; found no mass for a combination of left, right"},
        InputError{
            "mass: [[1, 2], [2, 1]], stiffness: [[1, 0], [0, 1]]",
            "mass: must be positive definite: a coordinate or combination without mass has no "
            "independent motion; found negative mass for a combination of q1, q2"},
        InputError{"mass: [[1.0e-200]], stiffness: [[1.0e+200]]",
                   "mass: must give accelerations within the range of doubles; those of this "
                   "stiffness, damping or force exceed it"}));

INSTANTIATE_TEST_SUITE_P(
    NamesAndForces, RefusedLinearSystem,
    testing::Values(
        InputError{"mass: [[1]], stiffness: [[1]], names: [a, b]",
                   "names: must be one name per coordinate, 1 in total, found 2"},
        InputError{
            "mass: [[1]], stiffness: [[1]], names: ['2nd floor']",
            "names[0]: must have at most 48 letters, digits and _, a letter first, found '2nd "
            "floor'"},
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], names: [x, x]",
            "names[1]: must differ from the names of other coordinates and their rates, found 'x'"},
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], names: [x, x_rate]",
            "names[1]: must differ from the names of other coordinates and their rates, found "
            "'x_rate'"},
        InputError{
            "mass: [[1]], stiffness: [[1]], names: [floor], force: [{coordinate: flor, "
            "amplitude: 1}]",
            "force[0].coordinate: must be a coordinate of the system, found 'flor'; did you mean "
            "'floor'?"},
        InputError{
            "mass: [[1]], stiffness: [[1]], force: [{coordinate: floor, amplitude: 1}]",
            "force[0].coordinate: must be a coordinate of the system, found 'floor'; there are: "
            "q1"},
        InputError{
            "mass: [[1]], stiffness: [[1]], force: [{coordinate: q1, amplitude: 1, frequency: "
            "-2}]",
            "force[0].frequency: must be >= 0 rad/s, found -2"}));

INSTANTIATE_TEST_SUITE_P(
    AssumedModes, RefusedLinearSystem,
    testing::Values(
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], assumed_modes: [[1]]",
            "assumed_modes: must have 2 rows, one per coordinate, and at most 2 columns, one "
            "per shape, found 1 x 1"},
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], assumed_modes: [[1, 2], [2, "
            "4]]",
            "assumed_modes: must be linearly independent shapes, found 2 of which one is zero "
            "or a combination of the others"},
        InputError{
            "mass: [[1, 0], [0, 1]], stiffness: [[1, 0], [0, 1]], assumed_modes: [[0], [0]]",
            "assumed_modes: must be linearly independent shapes, found 1 of which one is zero "
            "or a combination of the others"}));

TEST(LinearSystemScene, NeedsAMassAndAStiffness) {
  try {
    sceneOf(sceneText("damping: [[1]]"));
    FAIL() << "was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 2u) << error.what();
    EXPECT_NE(error.errors()[0].find("systems.s.parameters.mass: missing"), std::string::npos);
    EXPECT_NE(error.errors()[1].find("systems.s.parameters.stiffness: missing"), std::string::npos);
  }
}

TEST(LinearSystemScene, HasTheMatricesAndNamesOfTheScene) {
  const Scene scene =
      sceneOf(sceneText(std::string(kTwo) + ", names: [lower, upper], gyroscopic: [[0, 3], [-3, "
                                            "0]], damping: [[1, 0], [0, 2]]",
                        "initial: {upper: 0.2, lower_rate: -1}"));
  const Twin twin(scene);
  const Dynamics& dynamics = *twin.systems()[0]->dynamics;
  const auto names = dynamics.coordinates();
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(names[0].name, "lower");
  EXPECT_EQ(names[1].name, "upper");
  EXPECT_EQ(names[1].unit, "m");
  EXPECT_EQ(twin.systems()[0]->integrator, "exponential") << "auto is the exact step";
  EXPECT_EQ(scene.systems[0].q, (std::vector<double>{0.0, 0.2}));
  EXPECT_EQ(scene.systems[0].v, (std::vector<double>{-1.0, 0.0}));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  const Linearization l = dynamics.linearization(zero, zero, zero, {});
  EXPECT_EQ(l.stiffness(0, 1), -10.0);
  EXPECT_EQ(l.gyroscopic(0, 1), 3.0);
  EXPECT_EQ(l.damping(1, 1), 2.0);
}

TEST(LinearSystemScene, ForgivesTheRoundingOfWhoMadeTheMatrix) {
  EXPECT_NO_THROW(sceneOf(
      sceneText("mass: [[1, 0], [0, 1]], stiffness: [[3, 0.1], [0.10000000000000002, 3]]")));
}

TEST(LinearSystemScene, MovesByItsForceInEveryMethod) {
  // x'' + 4 x = 3 cos(t + 0.5) from rest, by its closed form.
  const auto closed_form = [](double t) {
    const double c = std::cos(0.5);
    const double s = std::sin(0.5);
    return std::cos(t + 0.5) - c * std::cos(2.0 * t) + 0.5 * s * std::sin(2.0 * t);
  };
  for (const std::string& method : linearMethodNames()) {
    Twin twin(
        sceneOf(sceneText("mass: [[1]], stiffness: [[4]], force: [{coordinate: q1, "
                          "amplitude: 3, frequency: 1, phase: 0.5}]",
                          "substeps: 10, integrator: " + method)));
    std::vector<double> record(twin.layout().size);
    for (int i = 0; i < 1000; ++i) {
      twin.step();
    }
    twin.write(record.data());
    // Substeps of 1 ms, p h = 0.002: errors of p h / 2 and, over 20 rad, of 20 (p h)^2 / 24.
    const double tolerance = method == "semi_implicit_euler"                                ? 3e-3
                             : method == "velocity_verlet" || method == "implicit_midpoint" ? 1e-5
                                                                                            : 1e-11;
    EXPECT_NEAR(twin.layout().system(record.data(), 0).q()[0], closed_form(10.0), tolerance)
        << method;
  }
}

TEST(LinearSystemScene, IsReducedToItsAssumedModes) {
  // The notes' lever with three masses in two shapes (errata E19): p1 = 0.327130, p2 = 1.018963.
  const Scene scene = sceneOf(sceneText(
      "mass: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], stiffness: [[1, 0.33333333333333333, 0], "
      "[0.33333333333333333, 1.2222222222222222, -1], [0, -1, 1]], force: [{coordinate: q3, "
      "amplitude: 2}], assumed_modes: [[1, 1], [-1, -2], [-1.5, -3]]"));
  const Twin twin(scene);
  const Dynamics& dynamics = *twin.systems()[0]->dynamics;
  ASSERT_EQ(dynamics.dof(), 2);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  const Linearization l = dynamics.linearization(zero, zero, zero, {});
  EXPECT_NEAR(l.mass(0, 0), 17.0 / 4.0, 1e-14);
  EXPECT_NEAR(l.mass(0, 1), 15.0 / 2.0, 1e-14);
  EXPECT_NEAR(l.stiffness(1, 1), 14.0 / 9.0, 1e-14);
  EXPECT_NEAR(l.stiffness(0, 1), 17.0 / 18.0, 1e-14);
  const Eigen::VectorXd force = dynamics.residualForce(zero, zero, {});
  EXPECT_NEAR(force[0], -3.0, 1e-15);
  EXPECT_NEAR(force[1], -6.0, 1e-15);
}

TEST(LinearSystemScene, DriftsWhereNothingHoldsIt) {
  // The notes' submarine: a free-free beam of three masses, heaving and pitching for ever.
  Twin twin(sceneOf(sceneText(
      "mass: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], stiffness: [[100, -200, 100], [-200, 400, -200], "
      "[100, -200, 100]]",
      "initial: {q1_rate: 1, q2_rate: 2, q3_rate: 3}")));
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 10000; ++i) {
    twin.step();
  }
  twin.write(record.data());
  for (std::size_t i = 0; i < 3; ++i) {
    // 100 s at p = 24.5 rad/s: stiffness rounded to 1e-16 times (p t)^2 / 2.
    EXPECT_NEAR(twin.layout().system(record.data(), 0).q()[i],
                100.0 * (1.0 + static_cast<double>(i)), 1e-7);
  }
}

TEST(LinearSystemScene, KeepsItsLastGoodStateWhenItBreaksDown) {
  Twin twin(sceneOf(sceneText("mass: [[1]], stiffness: [[1.0e+10]]",
                              "integrator: runge_kutta_4, initial: {q1: 1}")));
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 1000; ++i) {
    twin.step();
  }
  EXPECT_EQ(twin.status(0), StepStatus::kNotFinite);
  twin.write(record.data());
  EXPECT_TRUE(std::isfinite(twin.layout().system(record.data(), 0).q()[0]));
}

}  // namespace linear_system_scene_test
}  // namespace whirl_twin
