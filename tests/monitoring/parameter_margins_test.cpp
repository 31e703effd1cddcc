// How far numbers of a system are from the loss of stability, beside closed forms.
#include "monitoring/parameter_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../scene/scenes.h"
#include "analysis/equilibria.h"
#include "analysis/instability_speed.h"
#include "scene/built_scene.h"

namespace whirl_twin {
namespace parameter_margins_test {

/// The first system of a scene about its operating point.
struct Operating {
  explicit Operating(const std::string& yaml) : scene(build(sceneOf(yaml))) {
    speed = scene.driveOf(*system()).at(0.0).speed;
    const auto& q = system()->spec.q;
    const auto& v = system()->spec.v;
    const auto point = operatingPoint(
        *system()->dynamics,
        Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())),
        Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())), speed);
    motion = {point.value().q, point.value().v};
    margins = parameterMargins(*system(), motion, speed);
  }
  const SharedSystem& system() const { return scene.systems[0]; }
  const ParameterMargin* find(const std::string& parameter) const {
    const auto found = std::find_if(margins.begin(), margins.end(), [&](const ParameterMargin& m) {
      return m.parameter == parameter;
    });
    return found == margins.end() ? nullptr : &*found;
  }
  void expectLost(const std::string& parameter, double at, LossKind kind,
                  double frequency = 0.0) const {
    const ParameterMargin* const margin = find(parameter);
    ASSERT_NE(margin, nullptr) << parameter;
    EXPECT_NEAR(margin->loss.value, at, 1.0e-8 * std::fabs(at)) << parameter;
    EXPECT_EQ(static_cast<int>(margin->loss.kind), static_cast<int>(kind)) << parameter;
    EXPECT_NEAR(margin->loss.frequency, frequency, 1.0e-6 * frequency) << parameter;
    if (margin->value != 0.0) {
      EXPECT_NEAR(margin->change, (at - margin->value) / margin->value, 1.0e-7) << parameter;
    }
  }

  BuiltScene scene;
  double speed = 0.0;
  SteadyMotion motion;
  std::vector<ParameterMargin> margins;
};

std::string rotorScene(const std::string& parameters, double speed,
                       const std::string& initial = "x: 0.0") {
  return "step: 0.001\ndrives: {shaft: {speed: " + std::to_string(speed) +
         "}}\nsystems:\n  rotor:\n    model: jeffcott_rotor\n    drive: shaft\n    parameters: {" +
         parameters + "}\n    initial: {" + initial + "}\n";
}

// Unstable above w = p (1 + De/Di), p = sqrt(k/m); whirl at p. With De along x and y apart it is
// at (De_x + Di) (De_y + Di) = (Di w / p)^2.
TEST(ParameterMargins, ofInternalDampingAreThoseOfItsThreshold) {
  const Operating rotor(rotorScene(
      "mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0, eccentricity: 1.0e-4",
      150.0));
  rotor.expectLost("speed", 200.0, LossKind::kFlutter, 100.0);
  rotor.expectLost("stiffness", 75.0 * 75.0, LossKind::kFlutter, 75.0);
  rotor.expectLost("damping", 5.0, LossKind::kFlutter, 100.0);
  rotor.expectLost("mass", 1.0e4 / (75.0 * 75.0), LossKind::kFlutter, 75.0);
  rotor.expectLost("damping_y", 1.25, LossKind::kFlutter, 100.0);
  rotor.expectLost("internal_damping", 20.0, LossKind::kFlutter, 100.0);
  // q + Di w = (De + Di) p.
  rotor.expectLost("cross_coupling", 500.0, LossKind::kFlutter, 100.0);
  EXPECT_EQ(rotor.find("eccentricity"), nullptr);
  EXPECT_EQ(rotor.find("stiffness_y"), nullptr) << "apart from kx it only stabilizes";
  ASSERT_EQ(rotor.margins.size(), 7u);
  EXPECT_EQ(rotor.margins.front().parameter, "speed");
  EXPECT_EQ(rotor.margins.back().parameter, "cross_coupling") << "from zero: no relative change";
  EXPECT_TRUE(std::isnan(rotor.margins.back().change));
  for (std::size_t i = 2; i + 1 < rotor.margins.size(); ++i) {
    EXPECT_GE(std::fabs(rotor.margins[i].change), std::fabs(rotor.margins[i - 1].change));
  }
  EXPECT_STREQ(lossName(rotor.margins.front().loss.kind, *rotor.system()->dynamics), "whirl");

  const auto nearest = nearestInstability(*rotor.system(), rotor.motion, rotor.speed);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->parameter, "speed");
  EXPECT_NEAR(nearest->change, 1.0 / 3.0, 1.0e-8);
  EXPECT_FALSE(nearestInstability(*rotor.system(), rotor.motion, rotor.speed, [] { return true; }));
}

// Cross-coupling kxy = +q, kyx = -q: unstable above q = c p, in either sense.
TEST(ParameterMargins, ofCrossCoupling) {
  const Operating rotor(
      rotorScene("mass: 1.0, stiffness: 1.0e4, damping: 10.0, cross_coupling: 500.0", 30.0));
  rotor.expectLost("damping", 5.0, LossKind::kFlutter, 100.0);
  rotor.expectLost("stiffness", 2500.0, LossKind::kFlutter, 50.0);
  rotor.expectLost("cross_coupling", 1000.0, LossKind::kFlutter, 100.0);
  rotor.expectLost("mass", 4.0, LossKind::kFlutter, 50.0);
  EXPECT_EQ(rotor.find("speed"), nullptr) << "the speed does not matter";
  EXPECT_EQ(rotor.margins.front().parameter, "damping");
}

// A negative number goes through zero to the other sign; the nearer one is reported.
TEST(ParameterMargins, ofANumberWithASign) {
  const Operating rotor(rotorScene(
      "mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0, cross_coupling: -500.0",
      150.0));
  // 1500 + q = 2000 through zero, 1500 + q = -2000 away from it.
  rotor.expectLost("cross_coupling", 500.0, LossKind::kFlutter, 100.0);
  EXPECT_NEAR(rotor.find("cross_coupling")->change, -2.0, 1.0e-8);
}

TEST(ParameterMargins, keepToTheRangeOfANumber) {
  const Operating rotor(rotorScene("mass: 1.0, stiffness: 1.0e4, damping: 10.0", 150.0));
  EXPECT_EQ(rotor.find("damping"), nullptr) << "negative damping is none";
  EXPECT_EQ(rotor.find("stiffness"), nullptr);
  EXPECT_EQ(rotor.find("mass"), nullptr);
}

// Upright while k L > m g: then it falls, without a whirl.
TEST(ParameterMargins, ofASprungInvertedPendulumAreThoseOfDivergence) {
  const Operating pendulum(R"(
step: 0.001
systems:
  pendulum:
    model: sprung_inverted_pendulum
    parameters: {mass: 1.0, length: 1.0, stiffness: 20.0, damping: 0.1}
    initial: {theta: 0.01}
)");
  const double g = pendulum.scene.scene.gravity;
  pendulum.expectLost("stiffness", g, LossKind::kDivergence);
  pendulum.expectLost("length", g / 20.0, LossKind::kDivergence);
  pendulum.expectLost("mass", 20.0 / g, LossKind::kDivergence);
  EXPECT_EQ(pendulum.find("damping"), nullptr);
}

// It hangs down until w^2 = g / l, where it swings out.
TEST(ParameterMargins, ofASpinningPendulum) {
  const Operating pendulum(R"(
step: 0.001
drives: {shaft: {speed: 5.0}}
systems:
  pendulum:
    model: spinning_pendulum
    drive: shaft
    parameters: {mass: 0.5, length: 0.2, damping: 0.01}
    initial: {theta: 0.1}
)");
  const double g = pendulum.scene.scene.gravity;
  pendulum.expectLost("speed", std::sqrt(g / 0.2), LossKind::kDivergence);
  pendulum.expectLost("length", g / 25.0, LossKind::kDivergence);
  EXPECT_EQ(pendulum.find("mass"), nullptr);
}

// The motion is followed: where a whipping rotor in its oil film hangs moves with every number, and
// the speed it loses its stability at is the threshold that is found by speed alone.
TEST(ParameterMargins, followWhereItHangs) {
  const Operating rotor(
      rotorScene("mass: 2.0, stiffness: 2.0e4, gravity_on_shaft: true, bearing_length: 0.01, "
                 "bearing_diameter: 0.025, bearing_clearance: 1.0e-4, bearing_viscosity: 0.1, "
                 "journal_mass: 0.2",
                 60.0, "y: -1.0e-3, journal_y: -2.0e-5"));
  const auto threshold = instabilitySpeed(*rotor.system()->dynamics, rotor.motion.q, 60.0);
  ASSERT_TRUE(threshold);
  const ParameterMargin* const speed = rotor.find("speed");
  ASSERT_NE(speed, nullptr);
  EXPECT_NEAR(speed->loss.value, *threshold, 1.0e-6 * *threshold);
  EXPECT_EQ(static_cast<int>(speed->loss.kind), static_cast<int>(LossKind::kFlutter));
  // A softer shaft whips earlier: of the stiffness it is lost at, 60 rad/s is the threshold.
  const ParameterMargin* const stiffness = rotor.find("stiffness");
  ASSERT_NE(stiffness, nullptr);
  EXPECT_EQ(static_cast<int>(stiffness->loss.kind), static_cast<int>(LossKind::kFlutter));
  const double softer = stiffness->loss.value;
  const SharedSystem soft =
      rotor.system()->with({"stiffness", "stiffness_y"}, {softer, softer}, "test");
  Eigen::VectorXd sagged = rotor.motion.q;  // the journals bear the same weight
  sagged[1] = sagged[3] - 2.0 * rotor.scene.scene.gravity / softer;
  const auto rest = equilibriumNear(*soft->dynamics, sagged, 55.0);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(instabilitySpeed(*soft->dynamics, *rest, 55.0).value_or(0.0), 60.0, 1.0e-5);
}

}  // namespace parameter_margins_test
}  // namespace whirl_twin
