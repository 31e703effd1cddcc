// Dry friction with sticking, in the commands of the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "twin_program.h"

namespace whirl_twin {
namespace held_by_friction_test {

using testing::HasSubstr;

/// An arm of m g l = 0.480526 N m in a joint with dry friction.
std::string arm(double friction, double angle, const std::string& more = "") {
  return "name: stuck\nstep: 0.001\nsystems:\n  p: {model: pendulum, parameters: {mass: 0.49, "
         "length: 0.1, damping: 0.01, coulomb: " +
         std::to_string(friction) + more + "}, initial: {theta: " + std::to_string(angle) + "}}\n";
}

double finalAngle(const std::string& scene, const std::string& duration) {
  const TemporaryDirectory directory;
  const Ending end =
      twin({"simulate", directory.write("scene.yaml", scene), "--duration", duration, "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.json()["systems"]["p"]["state"]["theta"];
}

TEST(HeldByFriction, AnArmStaysWhereItsFrictionHoldsIt) {
  EXPECT_NEAR(finalAngle(arm(0.3, 0.3), "60"), 0.3, 1e-12);
  // Held at rest up to sin(theta) = 0.3 / 0.480526: 0.6743 rad.
  EXPECT_NEAR(finalAngle(arm(0.3, 0.67), "60"), 0.67, 1e-12);
  const double fallen = finalAngle(arm(0.3, 0.68), "60");
  EXPECT_LT(std::fabs(fallen), 0.6743);
  EXPECT_GT(std::fabs(fallen - 0.68), 0.001);
  EXPECT_NEAR(finalAngle(arm(0.3, 0.68), "120"), fallen, 1e-12) << "it has come to rest";
}

TEST(HeldByFriction, AWidthRoundsItOffAndTheArmCreeps) {
  EXPECT_NEAR(finalAngle(arm(0.3, 0.3, ", coulomb_rate: 0.01"), "10"), 0.2517, 1e-3);
}

TEST(HeldByFriction, AnalyzeSaysWhatHolds) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.yaml", arm(0.3, 0.3));
  const Ending end = twin({"analyze", "--json", scene});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto held = end.json()["systems"]["p"]["dry_friction"];
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(held[0]["held"], true);
  EXPECT_NEAR(std::fabs(held[0]["share"].get<double>()), 0.480526 * std::sin(0.3) / 0.3, 1e-6);
  EXPECT_EQ(end.json()["systems"]["p"]["acceleration"]["theta"], 0.0);
  EXPECT_THAT(twin({"analyze", scene}).out,
              HasSubstr("dry friction at the pivot: 0.3 N m, sticks"));
  const std::string loose = directory.write("loose.yaml", arm(0.1, 0.3));
  EXPECT_EQ(twin({"analyze", "--json", loose}).json()["systems"]["p"]["dry_friction"][0]["held"],
            false);
}

}  // namespace held_by_friction_test
}  // namespace whirl_twin
