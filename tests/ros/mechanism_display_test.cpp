// Display of mechanisms: the model's sketch at its scale, the trail, and bars where there is no
// sketch.
#include "display/mechanism_display.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "display/scene_dynamics.h"
#include "display/sketch_drawing.h"
#include "drawn_markers.h"
#include "models/model_registry.h"
#include "scene/built_scene.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace mechanism_display_test {

// Geometry is a handful of products and sines of numbers about 1.
constexpr double kRounding = 1e-12;

using Marker = visualization_msgs::Marker;

PendulumState stateOf(const Dynamics& dynamics, const Eigen::VectorXd& q, double time = 0.0) {
  PendulumState state;
  state.time = time;
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    state.name.push_back(c.name);
  }
  state.angle.assign(q.data(), q.data() + q.size());
  state.rate.assign(state.angle.size(), 0.0);
  return state;
}

std::shared_ptr<const Dynamics> spinningPendulum(double length) {
  const ParameterValues values{{"mass", 1.0}, {"length", length}, {"damping", 0.0}};
  return findModel("spinning_pendulum")->setUp(values, {}, 9.81).dynamics;
}

PendulumState swungOut(double theta, double time = 0.0) {
  PendulumState state;
  state.time = time;
  state.name = {"theta"};
  state.angle = {theta};
  state.rate = {0.0};
  return state;
}

/// A marker's pose in the axes of a system at the origin.
Eigen::Isometry3d inSystem(const MechanismDisplay& display, const Marker& marker) {
  const auto& p = marker.pose.position;
  const auto& o = marker.pose.orientation;
  const Eigen::Isometry3d world =
      Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(o.w, o.x, o.y, o.z);
  return display.placedAt(Eigen::Vector3d::Zero()).inverse() * world;
}

std::vector<Marker> frame(const MechanismDisplay& display, const SystemStatus& status = {}) {
  return drawn(display, status, Eigen::Vector3d::Zero());
}

TEST(MechanismDisplay, RodReachesFromThePivotToTheBobInTheTurnedPlane) {
  for (const double length : {0.1, 0.45, 3.0}) {
    MechanismDisplay display("arm", spinningPendulum(length));
    display.update(swungOut(0.4), {0.0, 1.1, 0.0, 0.0});
    const auto markers = frame(display);
    const Marker& rod = part(markers, "rod");
    const Eigen::Isometry3d pose = inSystem(display, rod);
    const Eigen::Vector3d half = 0.5 * rod.scale.z * pose.linear().col(2);
    const double drawn_length = display.pictureScale() * length;
    const Eigen::Vector3d bob(drawn_length * std::sin(0.4) * std::cos(1.1),
                              drawn_length * std::sin(0.4) * std::sin(1.1),
                              -drawn_length * std::cos(0.4));
    EXPECT_LT((pose.translation() - half).norm(), 1e-9);
    EXPECT_LT((pose.translation() + half - bob).norm(), 1e-9);
    EXPECT_LT((display.bodyPose().translation() - bob).norm(), 1e-9);
    // The body's z axis points back along the rod.
    EXPECT_LT((display.bodyPose().linear().col(2) + bob.normalized()).norm(), 1e-9);
  }
}

TEST(MechanismDisplay, IsTrueToLengthAsLongAsItFits) {
  for (const auto& [length, text] : {std::pair{0.45, ""}, {0.1, "lengths x 4"}}) {
    MechanismDisplay display("arm", spinningPendulum(length));
    display.update(swungOut(0.1), {});
    std::string scale;
    for (const Marker& marker : frame(display)) {
      scale += marker.ns == "system/scale" ? marker.text : "";
    }
    EXPECT_EQ(scale, text);
  }
}

TEST(MechanismDisplay, TrailFollowsTheBobBackItsTimeAndNoFurther) {
  MechanismDisplay display("arm", spinningPendulum(0.5));
  for (int step = 0; step <= 5000; ++step) {
    display.update(swungOut(0.2e-3 * step, 1e-3 * step), {});
  }
  const Marker trail = part(frame(display), "trail");
  const Eigen::Isometry3d pose = inSystem(display, trail);
  const auto angle = [&](const geometry_msgs::Point& p) {
    const Eigen::Vector3d point = pose * Eigen::Vector3d(p.x, p.y, p.z);
    EXPECT_NEAR(point.norm(), display.pictureScale() * 0.5, 1e-9);
    return std::atan2(point.x(), -point.z());
  };
  // The oldest point is the bob at 3 s, or up to a trail step and a state later.
  const double oldest = angle(trail.points.front());
  EXPECT_GE(oldest, 0.2 * 3.0 - kRounding);
  EXPECT_LE(oldest, 0.2 * (3.0 + MechanismDisplay::kTrailStep + 1e-3) + kRounding);
  EXPECT_NEAR(angle(trail.points.back()), 0.2 * 5.0, kRounding);
  // A reset restarts it.
  display.update(swungOut(0.0, 0.0), {});
  EXPECT_LE(part(frame(display), "trail").points.size(), 2U);
}

TEST(MechanismDisplay, StaysWhereItWasWhenTheStateIsNotFinite) {
  MechanismDisplay display("arm", spinningPendulum(0.5));
  display.update(swungOut(0.3, 1.0), {});
  const Eigen::Isometry3d before = display.bodyPose();
  display.update(swungOut(std::numeric_limits<double>::quiet_NaN(), 1.1), {});
  EXPECT_TRUE(display.bodyPose().isApprox(before));
}

TEST(MechanismDisplay, ShowsTheHighestSeverity) {
  MechanismDisplay display("arm", spinningPendulum(0.5));
  display.update(swungOut(0.3), {});
  SystemStatus status;
  status.alerts.resize(1);
  status.alerts[0].severity = Alert::DANGER;
  const auto bob = part(frame(display, status), "ball").color;
  EXPECT_GT(bob.r, 2.0F * bob.g);  // red
}

TEST(MechanismDisplay, DrawsAPaleHullWhereItIsMeasured) {
  MechanismDisplay display("arm", spinningPendulum(0.5));
  display.update(swungOut(0.3), {});
  const auto hulls = [&display] {
    std::vector<Marker> found;
    for (const Marker& marker : frame(display)) {
      if (marker.ns.rfind("system/measured/", 0) == 0) {
        found.push_back(marker);
      }
    }
    return found;
  };
  EXPECT_TRUE(hulls().empty());
  display.measure({0.4});
  bool ball = false;
  for (const Marker& hull : hulls()) {
    EXPECT_LT(hull.color.a, 0.6F) << hull.ns;
    EXPECT_GT(hull.lifetime, ros::Duration(0.0)) << hull.ns;
    if (hull.ns == "system/measured/ball") {
      ball = true;
      const Eigen::Vector3d at = inSystem(display, hull).translation();
      EXPECT_NEAR(std::atan2(at.x(), -at.z()), 0.4, 1e-9);
      EXPECT_GT(hull.scale.x, part(frame(display), "ball").scale.x);
    }
  }
  EXPECT_TRUE(ball);
  EXPECT_EQ(part(frame(display), "ball").color.a, 1.0F);
  for (const std::vector<double>& nowhere :
       {std::vector<double>{}, {0.1, 0.2}, {std::numeric_limits<double>::quiet_NaN()}}) {
    display.measure({0.4});
    display.measure(nowhere);
    EXPECT_TRUE(hulls().empty());
  }
  display.measure({0.4});
  display.measuredGone();
  EXPECT_TRUE(hulls().empty());
}

TEST(MeasuredPlace, IsTheNewestSampleOfWhichAllIsValid) {
  const auto scene = [](const std::string& channels) {
    return build(readScene(YAML::Load(R"(
name: rig
step: 0.001
drives: {shaft: {speed: 45.0}}
systems:
  pendulum:
    model: double_pendulum
    integrator: runge_kutta_4
    parameters: {mass1: 1.0, mass2: 1.0, length1: 0.5, length2: 0.5}
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
sensors:
  probes: {rate: 1000.0, channels: {x: {measures: rotor.x}, y: {measures: rotor.y}}}
  encoders: {rate: 500.0, channels: )" +
                                      channels + "}"),
                           "a test"));
  };
  EXPECT_FALSE(MeasuredPlace::of(scene("{a: {measures: pendulum.theta1}}"), "pendulum"));
  const BuiltScene both = scene("{b: {measures: pendulum.theta2}, a: {measures: pendulum.theta1}}");
  EXPECT_FALSE(MeasuredPlace::of(both, "rotor"));
  const auto place = MeasuredPlace::of(both, "pendulum");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->source(), "encoders");
  Measurement block;
  block.channel = {"b", "other", "a"};
  block.unit = {"rad", "m", "mrad"};
  block.value = {0.2, 9.0, 100.0, 0.4, 9.0, 300.0, 0.6, 9.0, 500.0};
  block.valid.assign(9, 1);
  EXPECT_EQ(place->newest(block), (std::vector<double>{0.5, 0.6}));
  block.valid[6] = 0;
  block.value[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(place->newest(block), (std::vector<double>{0.1, 0.2}));
  block.valid[0] = 0;
  EXPECT_TRUE(place->newest(block).empty());
  block.valid[0] = 1;
  block.unit[2] = "m";
  EXPECT_TRUE(place->newest(block).empty());
  block.unit[2] = "mrad";
  block.channel = {"b", "other", "c"};
  EXPECT_TRUE(place->newest(block).empty());
}

TEST(MechanismDisplay, ShowsBarsWhereItKnowsNoModel) {
  PendulumState state;
  state.name = {"x", "theta"};
  state.angle = {0.1, -0.2};
  for (const auto& dynamics : {std::shared_ptr<const Dynamics>(), spinningPendulum(0.5)}) {
    MechanismDisplay display("cart", dynamics);
    display.update(state, {});
    std::vector<Marker> bars;
    for (const Marker& marker : frame(display)) {
      if (marker.ns == "system/bar") {
        bars.push_back(marker);
      }
    }
    ASSERT_EQ(bars.size(), 2U);
    // Each on its own side of the line, with the length of its scale: x 2 for 0.1 m, x 1 for 0.2
    // rad.
    EXPECT_NEAR(inSystem(display, bars[0]).translation().z(), 0.5 * 0.2, kRounding);
    EXPECT_NEAR(inSystem(display, bars[1]).translation().z(), -0.5 * 0.2, kRounding);
    EXPECT_EQ(part(frame(display), "coordinate").text, "x");
    EXPECT_EQ(part(frame(display), "scale").text, "angles x 1, lengths x 2");
    EXPECT_EQ(part(frame(display), "text").text.substr(0, 23), "x 0.1 m, theta -11.5 de");
  }
}

TEST(Coil, ReachesFromEndToEndAtItsRadius) {
  const Eigen::Vector3d from(1, 2, 3);
  const Eigen::Vector3d to(1.5, 2, 2.5);
  const auto line = coil(from, to, 0.1);
  EXPECT_EQ(line.front(), from);
  EXPECT_EQ(line.back(), to);
  double farthest = 0.0;
  for (const auto& point : line) {
    const double off = (point - from).cross((to - from).normalized()).norm();
    farthest = std::max(farthest, off);
  }
  EXPECT_NEAR(farthest, 0.1, 1e-9);
}

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    names.push_back(file.path().stem());
  }
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsDrawnWithinItsPlaceByMarkersThatStay) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> between(-1.0, 1.0);
  const BuiltScene scene =
      build(readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/" + GetParam() + ".yaml"));
  for (const SharedSystem& system : scene.systems) {
    const Dynamics& dynamics = *system->dynamics;
    if (dynamics.isRotor()) {
      continue;  // RotorDisplay shows it
    }
    MechanismDisplay display(system->spec.name, system->dynamics);
    std::set<std::pair<std::string, int>> first;
    for (int k = 0; k < 50; ++k) {
      Eigen::VectorXd q(dynamics.dof());
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        const bool angle = dynamics.coordinates()[static_cast<std::size_t>(j)].isAngle();
        q[j] = between(random) * (angle ? M_PI : dynamics.naturalLength());
      }
      display.update(stateOf(dynamics, q, 0.1 * k), {0.1 * k, 3.0 * between(random), 0.0, 0.0});
      std::set<std::pair<std::string, int>> found;
      for (const Marker& m : frame(display)) {
        EXPECT_TRUE(found.emplace(m.ns, m.id).second) << m.ns << m.id;
        const auto& p = m.pose.position;
        const auto& o = m.pose.orientation;
        EXPECT_NEAR(std::hypot(std::hypot(o.x, o.y), std::hypot(o.z, o.w)), 1.0, 1e-9) << m.ns;
        // Places are 1.9 m apart along the row; text is above, a rod may swing out.
        EXPECT_LT(Eigen::Vector3d(p.x, p.y, p.z).norm(), 2.5) << m.ns << m.id;
        EXPECT_TRUE(m.scale.x >= 0.0 && m.scale.y >= 0.0 && m.scale.z >= 0.0) << m.ns;
        EXPECT_LT(std::hypot(m.scale.x, std::hypot(m.scale.y, m.scale.z)), 2.5) << m.ns;
        for (const auto& point : m.points) {
          EXPECT_LT(Eigen::Vector3d(point.x, point.y, point.z).norm(), 2.5) << m.ns;
        }
      }
      EXPECT_GT(found.size(), 5U);
      first = k == 0 ? found : first;
      EXPECT_EQ(found, first);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace mechanism_display_test
}  // namespace whirl_twin
