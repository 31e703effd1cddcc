// What the pendulum display draws: joints, the turning plane, the trail, and which systems it
// knows.
#include "nodes/pendulum_display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "drawn_markers.h"

namespace whirl_twin {
namespace {

// Geometry is a handful of products and sines of numbers about 1.
constexpr double kRounding = 1e-12;

PendulumState pendulum(std::vector<std::string> name, std::vector<double> angle, double time = 0) {
  PendulumState state;
  state.time = time;
  state.name = std::move(name);
  state.angle = std::move(angle);
  state.rate.assign(state.angle.size(), 0.0);
  return state;
}

TEST(PendulumGeometry, HangsDownAndSwingsTowardsX) {
  PendulumGeometry geometry;
  geometry.length1 = 0.4;
  const auto hanging = pendulumJoints(pendulum({"theta"}, {0.0}), geometry, 1.0);
  ASSERT_EQ(hanging.size(), 2U);
  EXPECT_TRUE(hanging[1].isApprox(Eigen::Vector3d(0, 0, -0.4), kRounding));
  const auto level = pendulumJoints(pendulum({"theta"}, {M_PI / 2}), geometry, 0.0);
  EXPECT_LT((level[1] - Eigen::Vector3d(0.4, 0, 0)).norm(), kRounding);
}

TEST(PendulumGeometry, PlaneTurnsWithTheShaft) {
  const PendulumGeometry geometry;
  const auto level = pendulumJoints(pendulum({"theta"}, {M_PI / 2}), geometry, M_PI / 2);
  EXPECT_LT((level[1] - Eigen::Vector3d(0, 0.5, 0)).norm(), kRounding);
  // A free spin phi is the plane's angle itself.
  EXPECT_EQ(planeAngle(pendulum({"theta", "phi"}, {0.1, 0.7}), geometry, nullptr), 0.7);
  // A drive's message of another step is carried to the pendulum's time.
  PendulumGeometry driven;
  driven.drive = "shaft";
  DriveState drive;
  drive.time = 1.0;
  drive.shaft_angle = 10.0;
  drive.speed = 5.0;
  EXPECT_NEAR(planeAngle(pendulum({"theta"}, {0.1}, 1.1), driven, &drive), 10.5, kRounding);
  PendulumGeometry constant;
  constant.speed = 3.0;
  EXPECT_NEAR(planeAngle(pendulum({"theta"}, {0.1}, 2.0), constant, nullptr), 6.0, kRounding);
}

TEST(PendulumGeometry, DoublePendulumAbsoluteAndRelativeAnglesAgree) {
  PendulumGeometry geometry;
  geometry.length1 = 0.3;
  geometry.length2 = 0.2;
  const auto absolute = pendulumJoints(pendulum({"theta1", "theta2"}, {0.5, 1.2}), geometry, 0.0);
  const auto relative = pendulumJoints(pendulum({"theta1", "theta3"}, {0.5, 0.7}), geometry, 0.0);
  ASSERT_EQ(absolute.size(), 3U);
  EXPECT_TRUE(absolute[2].isApprox(relative[2], kRounding));
  EXPECT_NEAR((absolute[2] - absolute[1]).norm(), 0.2, kRounding);
}

TEST(PendulumGeometry, IsReadFromTheSceneWhateverTheNumbersType) {
  XmlRpc::XmlRpcValue system;
  system["model"] = "double_pendulum";
  system["drive"] = "shaft";
  system["parameters"]["length1"] = 1;
  system["parameters"]["length2"] = "25e-2";
  const PendulumGeometry geometry = pendulumGeometry(system);
  EXPECT_EQ(geometry.model, "double_pendulum");
  EXPECT_EQ(geometry.drive, "shaft");
  EXPECT_EQ(geometry.length1, 1.0);
  EXPECT_EQ(geometry.length2, 0.25);
  EXPECT_EQ(pendulumGeometry(XmlRpc::XmlRpcValue()).length1, 0.5);
}

TEST(PendulumDisplay, DescribesWhatItCannotDraw) {
  PendulumDisplay display("cart");
  display.update(pendulum({"x", "theta"}, {0.1, 0.2}), nullptr);
  for (const auto& marker : drawn(display, {}, Eigen::Vector3d::Zero())) {
    EXPECT_EQ(marker.type, visualization_msgs::Marker::TEXT_VIEW_FACING);
  }
  EXPECT_EQ(part(drawn(display, {}, Eigen::Vector3d::Zero()), "text").text,
            "x 0.1 m, theta 11.5 deg");
}

TEST(PendulumDisplay, TrailReachesBackItsTimeAndNoFurther) {
  PendulumDisplay display("arm");
  for (int step = 0; step <= 5000; ++step) {
    display.update(pendulum({"theta"}, {0.2e-3 * step}, 1e-3 * step), nullptr);
  }
  const auto points = part(drawn(display, {}, Eigen::Vector3d::Zero()), "trail").points;
  // The oldest point is the bob at 3 s, or up to a trail step and a state later.
  const double oldest = std::atan2(points.front().x, -points.front().z);
  const double latest = 0.2 * (3.0 + PendulumDisplay::kTrailStep + 1e-3);
  EXPECT_GE(oldest, 0.2 * 3.0 - kRounding);
  EXPECT_LE(oldest, latest + kRounding);
  EXPECT_NEAR(std::atan2(points.back().x, -points.back().z), 0.2 * 5.0, kRounding);
}

TEST(SideBySide, PlacesAreEvenAndCentred) {
  EXPECT_TRUE(sideBySide(1)[0].isZero());
  const auto row = sideBySide(3);
  EXPECT_LT((row[0] + row[2]).norm(), kRounding);
  EXPECT_NEAR(row[1].y() - row[0].y(), kPlaceWidth, kRounding);
}

}  // namespace
}  // namespace whirl_twin
