// Positions of the systems, and that the camera of the shipped rviz configuration sees all of them.
#include "display/layout.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>

#include "display/rotor_display.h"
#include "drawn_markers.h"

namespace whirl_twin {
namespace layout_test {

/// Where a point is seen: right and up from the middle, by the tangents of the half angles of the
/// view; within -1..1 it is in the picture.
Eigen::Vector2d seen(const Eigen::Vector3d& point, const Layout& layout) {
  const Eigen::Vector3d back = towardsViewer();
  const Eigen::Vector3d camera = layout.view + ViewedFrom::kDistance * back;
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(back).normalized();
  const Eigen::Vector3d up = back.cross(right);
  const double depth = (camera - point).dot(back);
  const double tangent = std::tan(0.5 * ViewedFrom::kAngle);
  return {(point - camera).dot(right) / (depth * tangent * ViewedFrom::kAspect),
          (point - camera).dot(up) / (depth * tangent)};
}

TEST(Layout, TheCameraIsThatOfTheShippedConfiguration) {
  const YAML::Node view =
      YAML::LoadFile(WHIRL_TWIN_RVIZ_CONFIG)["Visualization Manager"]["Views"]["Current"];
  EXPECT_EQ(view["Class"].as<std::string>(), "rviz/Orbit");
  EXPECT_EQ(view["Target Frame"].as<std::string>(), ViewedFrom::kFrame);
  EXPECT_EQ(view["Distance"].as<double>(), ViewedFrom::kDistance);
  EXPECT_EQ(view["Yaw"].as<double>(), ViewedFrom::kYaw);
  EXPECT_EQ(view["Pitch"].as<double>(), ViewedFrom::kPitch);
  EXPECT_NEAR(view["Field of View"].as<double>(), ViewedFrom::kAngle, 1e-6);
  for (const char* axis : {"X", "Y", "Z"}) {
    EXPECT_EQ(view["Focal Point"][axis].as<double>(), 0.0);
  }
}

TEST(Layout, EverythingIsInThePictureAndFillsIt) {
  for (std::size_t systems = 0; systems <= 20; ++systems) {
    const Layout layout = layoutOf(systems);
    ASSERT_EQ(layout.places.size(), systems);
    const Eigen::Vector3d right = boardAxes().col(0);
    const Eigen::Vector3d up = layout.cell_height * Eigen::Vector3d::UnitZ();
    double widest = 0.0;
    const auto see = [&](const Eigen::Vector3d& corner) {
      const Eigen::Vector2d at = seen(corner, layout);
      widest = std::max(widest, at.cwiseAbs().maxCoeff());
      EXPECT_LE(at.cwiseAbs().maxCoeff(), 1.0 + 1e-9) << systems;
    };
    for (const Eigen::Vector3d& place : layout.places) {
      for (const double side : {-0.5, 0.5}) {
        see(place + side * layout.cell_width * right);
        see(place + side * layout.cell_width * right + up);
      }
    }
    see(layout.column + 0.5 * layout.column_width * right);
    EXPECT_TRUE(systems == 0 || widest > 0.8) << systems << " systems are too small: " << widest;
  }
}

TEST(Layout, NoPlaceOverlapsAnotherOrTheColumn) {
  for (std::size_t systems = 1; systems <= 20; ++systems) {
    const Layout layout = layoutOf(systems);
    const Eigen::Matrix3d board = boardAxes();
    for (std::size_t i = 0; i < systems; ++i) {
      const Eigen::Vector3d at = board.transpose() * layout.places[i];
      EXPECT_NEAR(at.z(), 0.0, 1e-9) << "one plane faces the viewer";
      const Eigen::Vector3d column = board.transpose() * layout.column;
      EXPECT_GE(column.x() - at.x(), 0.5 * (layout.column_width + layout.cell_width) - 1e-9);
      for (std::size_t k = 0; k < i; ++k) {
        const Eigen::Vector3d off = at - board.transpose() * layout.places[k];
        EXPECT_TRUE(std::fabs(off.x()) > layout.cell_width - 1e-9 ||
                    std::fabs(off.y()) > layout.cell_height - 1e-9)
            << systems << ": " << i << " and " << k;
      }
    }
  }
}

/// A rotor with three critical speeds, limits and three alerts has more text than most.
TEST(Layout, ARotorStaysWithinItsPlace) {
  RotorDisplay rotor("pump", 0.0, 3.0);
  WhirlState state;
  state.speed = 123.4;
  state.radius = state.x = 3e-4;
  rotor.update(state);
  auto margin = boost::make_shared<StabilityMargin>();
  margin->speed = state.speed;
  margin->verdict_name = "asymptotically_stable";
  margin->decay_rate = 3.0;
  margin->log_decrement = 0.3;
  margin->critical_speed = {60.0, 200.0, 300.0};
  margin->direction = {"forward", "forward", "backward"};
  margin->separation_margin = {50.0, 40.0, 60.0};
  margin->required_separation_margin = {16.0, 16.0, 16.0};
  margin->band_low = {48.0, 180.0, 280.0};
  margin->band_high = {70.0, 220.0, 330.0};
  SystemStatus status;
  status.live.margin = margin;
  status.limits = {{1e-4, Alert::WARNING, "zone B"}, {2e-4, Alert::DANGER, "zone C"}};
  status.alerts.resize(3);
  for (Alert& alert : status.alerts) {
    alert.type = "CRITICAL_SPEED_APPROACH";
    alert.text = "pump: critical speed 200.0 rad/s ahead: its band begins in 1.3 s";
  }
  for (const std::size_t systems : {1U, 20U}) {
    const Layout layout = layoutOf(systems);
    status.compact = layout.compact;
    double top = 0.0;
    for (const auto& marker : drawn(rotor, status, Eigen::Vector3d::Zero())) {
      if (marker.action == visualization_msgs::Marker::DELETE) {
        continue;
      }
      const Eigen::Vector3d at =
          boardAxes().transpose() *
          Eigen::Vector3d(marker.pose.position.x, marker.pose.position.y, marker.pose.position.z);
      EXPECT_LT(std::fabs(at.x()), 0.5 * layout.cell_width) << marker.ns;
      const auto lines = 1 + std::count(marker.text.begin(), marker.text.end(), '\n');
      const double half = 0.5 * static_cast<double>(lines) * (marker.scale.z + 0.01);
      top = std::max(top, marker.text.empty() ? at.y() : at.y() + half);
    }
    EXPECT_LT(top, layout.cell_height) << systems;
    EXPECT_GT(top, 0.7 * layout.cell_height) << systems << ": room is left unused";
  }
}

}  // namespace layout_test
}  // namespace whirl_twin
