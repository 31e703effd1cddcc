// Display of a shaft: each of its elements, bent according to its whirl, orbits at its stations.
#include "display/shaft_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "drawn_markers.h"
#include "scene/built_scene.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace shaft_display_test {

using Marker = visualization_msgs::Marker;

/// Two discs between bearings, seen at node 2 and at node 4.
std::shared_ptr<const Dynamics> twoDiscs() {
  const BuiltScene scene = build(readScene(YAML::Load(R"(
step: 0.001
systems:
  rotor:
    model: flexible_rotor
    parameters:
      speed: 50.0
      youngs_modulus: 2.11e+11
      density: 7810.0
      elements: [{length: 0.25, outer_diameter: 0.05, count: 6}]
      discs: [{node: 2, mass: 32.6, polar_inertia: 0.33, transverse_inertia: 0.178},
              {node: 4, mass: 51.5, polar_inertia: 0.805, transverse_inertia: 0.424}]
      bearings: [{node: 0, kxx: 1.0e+6, kyy: 1.0e+6}, {node: 6, kxx: 1.0e+6, kyy: 1.0e+6}]
      unbalances: [{node: 2, magnitude: 1.0e-3}]
      stations: [{node: 4}]
)"),
                                           "test.yaml"));
  return scene.systems[0]->dynamics;
}

WhirlState stateOf(std::int64_t step, double x, double y) {
  WhirlState state;
  state.step = step;
  state.time = 1.0e-3 * static_cast<double>(step);
  state.speed = 50.0;
  state.shaft_angle = 50.0 * state.time;
  state.x = x;
  state.y = y;
  state.radius = std::hypot(x, y);
  return state;
}

std::vector<Marker> partsOf(const std::vector<Marker>& markers, const std::string& name) {
  std::vector<Marker> found;
  for (const Marker& marker : markers) {
    if (marker.ns == "system/" + name) {
      found.push_back(marker);
    }
  }
  return found;
}

/// Up from the line of the bearings, which is level.
double above(const Marker& marker, const ShaftDisplay& display) {
  return marker.pose.position.z - display.placedAt(Eigen::Vector3d::Zero()).translation().z();
}

TEST(ShaftDisplay, ShowsWhatHasPlacesAlongAShaft) {
  EXPECT_TRUE(ShaftDisplay::shows(twoDiscs().get()));
  EXPECT_FALSE(ShaftDisplay::shows(nullptr));
}

TEST(ShaftDisplay, BendsTheShaftThroughThePlacesThatAreSeen) {
  ShaftDisplay display("rotor", twoDiscs(), 200.0, 3.0);
  ASSERT_EQ(display.published(), (std::vector<std::string>{"rotor", "rotor_node_4"}));
  display.update("rotor", stateOf(1, 0.0, 5.0e-4));
  display.update("rotor_node_4", stateOf(1, 0.0, 4.0e-4));
  const std::vector<Marker> markers = drawn(display, {}, Eigen::Vector3d::Zero());
  const std::vector<Marker> rods = partsOf(markers, "rod");
  ASSERT_EQ(rods.size(), 6u) << "an element each";
  const std::vector<Marker> discs = partsOf(markers, "disc");
  ASSERT_EQ(discs.size(), 2u);
  EXPECT_NEAR(above(discs[0], display), 0.10, 1e-9);
  EXPECT_NEAR(above(discs[1], display), 0.08, 1e-9);
  // One arch: highest between the discs, low at the bearings.
  EXPECT_GT(above(rods[2], display), 0.09);
  EXPECT_GT(above(rods[1], display), above(rods[0], display));
  EXPECT_LT(above(rods[0], display), 0.07);
  EXPECT_EQ(part(markers, "scale").text.find("whirl x 200"),
            part(markers, "scale").text.size() - 11);
  // The shaft's thickness is to the same scale as its length.
  EXPECT_NEAR(rods[0].scale.x / discs[0].scale.x, 0.025 / std::sqrt(2.0 * 0.33 / 32.6), 1e-9);
}

TEST(ShaftDisplay, IsThatOfAStepOfWhichAllPlacesHaveTold) {
  ShaftDisplay display("rotor", twoDiscs(), 200.0, 3.0);
  const auto heightOf = [&](std::size_t disc) {
    return above(partsOf(drawn(display, {}, Eigen::Vector3d::Zero()), "disc")[disc], display);
  };
  EXPECT_NEAR(heightOf(0), 0.0, 1e-12);
  display.update("rotor", stateOf(1, 0.0, 5.0e-4));
  EXPECT_NEAR(heightOf(0), 0.0, 1e-12);
  display.update("rotor_node_4", stateOf(1, 0.0, 4.0e-4));
  EXPECT_NEAR(heightOf(0), 0.10, 1e-9);
  display.update("rotor", stateOf(2, 0.0, -5.0e-4));
  EXPECT_NEAR(heightOf(0), 0.10, 1e-9);
  display.update("rotor_node_4", stateOf(2, 0.0, -4.0e-4));
  EXPECT_NEAR(heightOf(0), -0.10, 1e-9);
  EXPECT_NEAR(heightOf(1), -0.08, 1e-9);
}

TEST(ShaftDisplay, DrawsAnOrbitAtEveryPlaceAndKeepsItsMarkers) {
  ShaftDisplay display("rotor", twoDiscs(), 0.0, 3.0);
  const auto identities = [&] {
    std::set<std::pair<std::string, int>> found;
    for (const auto& marker : drawn(display, {}, Eigen::Vector3d::Zero())) {
      EXPECT_TRUE(found.emplace(marker.ns, marker.id).second) << marker.ns << marker.id;
    }
    return found;
  };
  const auto first = identities();
  for (std::int64_t step = 1; step < 300; ++step) {
    const double angle = 0.05 * static_cast<double>(step);
    display.update("rotor", stateOf(step, 5.0e-4 * std::cos(angle), 5.0e-4 * std::sin(angle)));
    display.update("rotor_node_4",
                   stateOf(step, 2.0e-4 * std::cos(angle), 2.0e-4 * std::sin(angle)));
  }
  EXPECT_EQ(identities(), first);
  const auto markers = drawn(display, {}, Eigen::Vector3d::Zero());
  double widest = 0.0;
  for (const char* orbit : {"node_2/orbit", "node_4/orbit"}) {
    const Marker& marker = part(markers, orbit);
    EXPECT_EQ(marker.action, Marker::ADD);
    ASSERT_GT(marker.points.size(), 20u) << orbit;
    double radius = 0.0;
    for (const auto& point : marker.points) {
      radius = std::max(radius, std::hypot(point.x, point.y));
    }
    EXPECT_TRUE(widest == 0.0 || std::fabs(radius / widest - 0.4) < 1e-3) << radius;
    widest = std::max(widest, radius);
  }
}

}  // namespace shaft_display_test
}  // namespace whirl_twin
