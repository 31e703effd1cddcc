// Drawings of the rviz displays: positions, senses of rotation, magnification.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "display/rotor_display.h"
#include "drawn_markers.h"
#include "mechanics/round_number.h"

namespace whirl_twin {
namespace display_test {

// Geometry is a handful of products and sines of numbers about 1.
constexpr double kRounding = 1e-12;

/// A synchronous circular whirl of the given radius [m] that lags the unbalance by `lag` [rad].
WhirlState circularWhirl(double radius, double speed, double lag, double time) {
  WhirlState state;
  state.time = time;
  state.speed = speed;
  state.shaft_angle = speed * time;
  const double whirl = state.shaft_angle - lag;
  state.radius = radius;
  state.phase = lag;
  state.phase_valid = true;
  state.forward = true;
  state.whirl_angle = std::remainder(whirl, 2.0 * M_PI);
  state.whirl_rate = speed;
  state.x = radius * std::cos(whirl);
  state.y = radius * std::sin(whirl);
  state.x_rate = -speed * state.y;
  state.y_rate = speed * state.x;
  return state;
}

TEST(WhirlScale, IsARoundNumber) {
  EXPECT_DOUBLE_EQ(roundDown125(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundDown125(1.99), 1.0);
  EXPECT_DOUBLE_EQ(roundDown125(2.0), 2.0);
  EXPECT_DOUBLE_EQ(roundDown125(499.0), 200.0);
  EXPECT_DOUBLE_EQ(roundDown125(500.0), 500.0);
  EXPECT_DOUBLE_EQ(roundDown125(0.5), 0.5);
  EXPECT_DOUBLE_EQ(roundDown125(0.0499), 0.02);
}

TEST(WhirlScale, FitsTheOrbitIntoThePicture) {
  for (const double radius : {1e-7, 3e-6, 1e-4, 2.4e-3, 0.7, 40.0}) {
    WhirlScale scale;
    scale.observe(radius, 0.0);
    EXPECT_LE(radius * scale.value(), WhirlScale::kTargetRadius * (1 + 1e-9)) << radius;
    EXPECT_GE(radius * scale.value(), 0.4 * WhirlScale::kTargetRadius * (1 - 1e-9)) << radius;
  }
}

TEST(WhirlScale, DoesNotFlickerWhileTheWhirlBeats) {
  // A radius that swings a fifth about each place of the picture changes the scale once at most.
  for (double drawn_radius = 0.05; drawn_radius < 0.25; drawn_radius += 0.01) {
    WhirlScale scale;
    scale.observe(1e-4 * drawn_radius / 0.25, 0.0);
    std::set<double> values;
    for (int i = 1; i < 20000; ++i) {
      const double time = 1e-3 * i;
      scale.observe(1e-4 * drawn_radius / 0.25 * (1.0 + 0.2 * std::sin(7.0 * time)), time);
      values.insert(scale.value());
    }
    EXPECT_LE(values.size(), 2U) << drawn_radius;
  }
}

TEST(WhirlScale, FallsAtOnceAndRisesOnlyAfterTheWhirlHasStayedSmall) {
  WhirlScale scale;
  scale.observe(1e-5, 0.0);
  const double before = scale.value();
  scale.observe(1e-3, 0.001);
  const double at_resonance = scale.value();
  EXPECT_LT(at_resonance, before);
  scale.observe(1e-5, 0.002);
  EXPECT_EQ(scale.value(), at_resonance);
  scale.observe(1e-5, 0.002 + 10.0 * WhirlScale::kPeakDecayTime);
  EXPECT_EQ(scale.value(), before);
}

TEST(WhirlScale, KeepsAFixedScaleAndPassesOverWhatIsNotANumber) {
  WhirlScale fixed(300.0);
  fixed.observe(10.0, 0.0);
  EXPECT_EQ(fixed.value(), 300.0);
  WhirlScale scale;
  scale.observe(1e-4, 0.0);
  const double before = scale.value();
  scale.observe(std::numeric_limits<double>::quiet_NaN(), 1.0);
  scale.observe(std::numeric_limits<double>::infinity(), 2.0);
  EXPECT_EQ(scale.value(), before);
}

TEST(OrbitTrail, OfACircularWhirlIsACircleOfSoManyTurns) {
  // From many states a degree to a third of a radian a state: the line through them stays round.
  for (const double speed : {5.0, 50.0, 300.0, 900.0}) {
    OrbitTrail trail(3.0);
    for (int step = 0; step * 1e-3 * speed < 10.0 * 2.0 * M_PI; ++step) {
      trail.add(circularWhirl(1e-4, speed, 0.3, step * 1e-3));
    }
    const auto points = trail.points();
    EXPECT_LE(points.size(), OrbitTrail::kMaxPoints);
    double length = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Hermite: advance^4 / 384, with 0.9 rad a state 1.7e-3 of the radius.
      EXPECT_NEAR(points[i].norm(), 1e-4, 2e-3 * 1e-4) << speed;
      length += i > 0 ? (points[i] - points[i - 1]).norm() : 0.0;
    }
    // The oldest point may be a state short of three turns; chords are shorter by advance^2 / 24.
    EXPECT_NEAR(length / (2.0 * M_PI * 1e-4), 3.0, 0.9 / (2.0 * M_PI) + 0.01) << speed;
  }
}

TEST(OrbitTrail, DrawsThePlaneSwingOfARotorAtStandstill) {
  OrbitTrail trail(3.0);
  for (int step = 0; step < 1000; ++step) {
    WhirlState state;
    state.time = 1e-3 * step;
    state.x = 1e-4 * std::cos(20.0 * state.time);
    state.x_rate = -20.0 * 1e-4 * std::sin(20.0 * state.time);
    trail.add(state);
  }
  double least = 0.0;
  double most = 0.0;
  for (const auto& point : trail.points()) {
    least = std::min(least, point.x());
    most = std::max(most, point.x());
  }
  // Points are kept every 3 turns / 600 of the way: the ends of the swing are met to that.
  EXPECT_NEAR(most, 1e-4, 1e-6);
  EXPECT_NEAR(least, -1e-4, 1e-6);
}

TEST(OrbitTrail, BeginsAnewWhenTimeRunsBackOrStatesAreMissing) {
  OrbitTrail trail(3.0);
  for (int step = 0; step < 100; ++step) {
    trail.add(circularWhirl(1e-4, 100.0, 0.0, step * 1e-3));
  }
  EXPECT_GT(trail.points().size(), 50U);
  trail.add(circularWhirl(1e-4, 100.0, 0.0, 0.01));
  EXPECT_LE(trail.points().size(), 2U);
  trail.add(circularWhirl(1e-4, 100.0, 0.0, 0.012));
  trail.add(circularWhirl(1e-4, 100.0, 0.0, 0.1));
  EXPECT_LE(trail.points().size(), 2U);
}

TEST(RotorDisplay, ShaftIsHeldInItsBearingsAndFollowsTheDiscAtMidspan) {
  const auto shaft = bentShaft(1.3, {0.1, -0.2}, 25);
  EXPECT_TRUE(shaft.front().isApprox(Eigen::Vector3d(0, 0, -0.65), kRounding));
  EXPECT_TRUE(shaft.back().isApprox(Eigen::Vector3d(0, 0, 0.65), kRounding));
  EXPECT_TRUE(shaft[12].isApprox(Eigen::Vector3d(0.1, -0.2, 0.0), kRounding));
  // The first bending mode is half a sine: at a sixth of the span half the midspan's deflection.
  EXPECT_NEAR(shaft[4].x(), 0.05, kRounding);
}

TEST(RotorDisplay, DiscStandsAtTheExaggeratedWhirlingCentre) {
  RotorDisplay display("rotor", 500.0, 3.0);
  display.update(circularWhirl(2e-4, 50.0, 0.0, 0.0));  // whirl along rotor x
  const Eigen::Isometry3d pose = display.placedAt({0.0, 3.0, 0.0}) * display.bodyPose();
  const Eigen::Vector3d bearing_line = display.placedAt({0.0, 3.0, 0.0}).translation();
  EXPECT_TRUE((pose.translation() - bearing_line).isApprox(Eigen::Vector3d(0.0, 0.1, 0.0), 1e-9));
  const auto markers = drawn(display, {}, {0.0, 3.0, 0.0});
  EXPECT_NEAR(part(markers, "disc").pose.position.y, 3.1, 1e-9);
  EXPECT_EQ(part(markers, "scale").text, "whirl x 500");
}

TEST(RotorDisplay, ForwardWhirlTurnsCounterClockwiseSeenFromTheFront) {
  RotorDisplay display("rotor", 500.0, 3.0);
  const auto position = [&](double time) {
    display.update(circularWhirl(2e-4, 50.0, 0.0, time));
    return Eigen::Vector3d(
        (display.placedAt(Eigen::Vector3d::Zero()) * display.bodyPose()).translation());
  };
  const Eigen::Vector3d axis = display.placedAt(Eigen::Vector3d::Zero()).translation();
  const Eigen::Vector3d first = position(0.0) - axis;
  const Eigen::Vector3d later = position(0.01) - axis;
  // REP 103: forward is world x; a positive rotation about it is counter-clockwise as seen from the
  // front.
  EXPECT_GT(first.cross(later).x(), 0.0);
  EXPECT_NEAR(display.placedAt(Eigen::Vector3d::Zero()).linear().determinant(), 1.0, kRounding);
}

TEST(RotorDisplay, UnbalanceMarkLeadsTheWhirlByThePhaseLag) {
  for (const double lag : {0.2, M_PI / 2, 3.0}) {
    RotorDisplay display("rotor", 1000.0, 3.0);
    display.update(circularWhirl(1e-4, 80.0, lag, 0.3));
    const Eigen::Isometry3d disc = display.bodyPose();
    const Eigen::Vector3d whirl = disc.translation();
    const Eigen::Vector3d mark = disc.linear() * Eigen::Vector3d::UnitX();
    const double lead = std::atan2(whirl.cross(mark).z(), whirl.dot(mark));
    EXPECT_NEAR(lead, lag, 1e-9);
  }
}

TEST(RotorDisplay, ShowsTheHighestSeverity) {
  RotorDisplay display("rotor", 0.0, 3.0);
  display.update(circularWhirl(1e-4, 80.0, 0.1, 0.3));
  SystemStatus status;
  status.alerts.resize(2);
  status.alerts[0].severity = Alert::DANGER;
  status.alerts[0].text = "unstable";
  status.alerts[1].severity = Alert::WARNING;
  const auto disc = part(drawn(display, status, Eigen::Vector3d::Zero()), "disc").color;
  EXPECT_GT(disc.r, 2.0F * disc.g);  // red
  const auto calm = part(drawn(display, {}, Eigen::Vector3d::Zero()), "disc").color;
  EXPECT_GT(calm.g, calm.r);
}

TEST(RotorDisplay, KeepsItsMarkersFromFrameToFrame) {
  RotorDisplay display("rotor", 0.0, 3.0);
  const auto identities = [&](const SystemStatus& status) {
    std::set<std::pair<std::string, int>> found;
    for (const auto& marker : drawn(display, status, Eigen::Vector3d::Zero())) {
      EXPECT_TRUE(found.emplace(marker.ns, marker.id).second) << marker.ns << marker.id;
      EXPECT_EQ(marker.header.frame_id, "world");
      EXPECT_TRUE(marker.header.stamp.isZero());
    }
    return found;
  };
  const auto first = identities({});
  for (int step = 0; step < 50; ++step) {
    display.update(circularWhirl(1e-4, 80.0, 0.1, step * 1e-3));
  }
  SystemStatus status;
  status.alerts.resize(1);
  status.alerts[0].text = "critical speed ahead";
  EXPECT_EQ(first, identities(status));
}

TEST(RotorDisplay, StaysWhereItWasWhenTheStateIsNotFinite) {
  RotorDisplay display("rotor", 0.0, 3.0);
  display.update(circularWhirl(1e-4, 80.0, 0.1, 0.1));
  const Eigen::Isometry3d before = display.bodyPose();
  auto broken = circularWhirl(1e-4, 80.0, 0.1, 0.2);
  broken.x = std::numeric_limits<double>::quiet_NaN();
  display.update(broken);
  EXPECT_TRUE(display.bodyPose().isApprox(before));
}

}  // namespace display_test
}  // namespace whirl_twin
