// The pictures of models agree with their mechanics: the drawn motion is consistent with the
// energies.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/dynamics.h"
#include "random_state.h"

namespace whirl_twin {
namespace sketch_test {

/// The model with everything massless but the traced mass.
ParameterValues onlyTheTracedMass(ParameterValues parameters) {
  for (const char* name : {"hub_inertia", "rod_mass", "disc_inertia"}) {
    if (parameters.count(name) != 0) {
      parameters[name] = 0.0;
    }
  }
  return parameters;
}

Eigen::Vector3d tracer(const Dynamics& dynamics, const RandomState& s, double dt) {
  const EvaluationPoint<double> at{s.at.time + dt, s.at.angle + s.at.speed * dt, s.at.speed, 0.0};
  const SketchPoint p = dynamics.sketch(s.q + dt * s.v, at).tracer;
  return {p.x, p.y, p.z};
}

class OneMassSketch : public testing::TestWithParam<const char*> {};

TEST_P(OneMassSketch, TracedMassMovesWithTheModelsKineticEnergy) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20; ++i) {
    const RandomState s = randomState(GetParam(), random);
    const ParameterValues parameters = onlyTheTracedMass(s.parameters);
    const auto dynamics = findModel(GetParam())->setUp(parameters, {}, s.gravity).dynamics;
    const char* mass = parameters.count("slider_mass") != 0 ? "slider_mass" : "mass";
    constexpr double kStep = 1e-5;  // s
    const double speed =
        (tracer(*dynamics, s, kStep) - tracer(*dynamics, s, -kStep)).norm() / (2.0 * kStep);
    const double kinetic = dynamics->energies(s.q, s.v, s.at).kinetic;
    // The central difference errs by (rate x step)^2 / 6 of the speed, rates below 15 rad/s; where
    // the velocity all but vanishes, by that of lengths of 10 m at such rates.
    EXPECT_NEAR(0.5 * parameters.at(mass) * speed * speed, kinetic, 1e-7 * (1.0 + kinetic));
  }
}

INSTANTIATE_TEST_SUITE_P(Models, OneMassSketch,
                         testing::Values("spinning_pendulum", "rotating_pendulum", "rod_slider",
                                         "sprung_inverted_pendulum"),
                         [](const auto& model) { return std::string(model.param); });

TEST(RollingDiscSketch, RollsWithoutSlip) {
  // With a mark on the rim: at rest for a moment where it touches the ground, and back there one
  // circumference on.
  std::mt19937_64 random(7);
  RandomState s = randomState("rolling_disc", random);
  s.parameters["offset_mass"] = 0.0;
  const double radius = s.parameters.at("radius");
  const auto dynamics = findModel("rolling_disc")->setUp(s.parameters, {}, s.gravity).dynamics;
  const auto mark = [&](double x) {
    const SketchPoint p = dynamics->sketch(Eigen::VectorXd::Constant(1, x), {}).tracer;
    return Eigen::Vector2d(p.x, p.z);
  };
  const double step = 1e-6 * radius;
  // Cycloid: z leaves the ground with x^2 / (2 r), x with x^3 / (6 r^2).
  EXPECT_LT((mark(step) - mark(0.0)).norm(), 1e-6 * step);
  EXPECT_NEAR(mark(0.0).y(), -radius, 1e-12 * radius);
  const double around = 2.0 * M_PI * radius;
  EXPECT_LT((mark(around) - mark(0.0) - Eigen::Vector2d(around, 0.0)).norm(), 1e-12 * around);
}

TEST(TwoBarLinkageSketch, BarsKeepTheirLengthAndTheRollerItsLevel) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20; ++i) {
    const RandomState s = randomState("two_bar_linkage", random);
    const Sketch sketch = s.dynamics->sketch(s.q, s.at);
    const double length = s.parameters.at("bar_length");
    for (std::size_t bar : {0, 1}) {
      const SketchPoint& from = sketch.rods[bar].from;
      const SketchPoint& to = sketch.rods[bar].to;
      EXPECT_NEAR(std::hypot(to.x - from.x, to.z - from.z), length, 1e-12 * length);
    }
    EXPECT_EQ(sketch.rods[1].to.z, sketch.rods[0].from.z);
  }
}

TEST(CartPendulumSketch, ArrowsFollowForceAndSupport) {
  std::mt19937_64 random(7);
  RandomState s = randomState("cart_pendulum", random);
  s.parameters["stiffness"] = 10.0;  // without a spring neither it nor its wall is drawn
  s.parameters["force_amplitude"] = 1.0;
  s.parameters["force_frequency"] = 2.0;
  s.parameters["support_amplitude"] = 0.1;
  s.parameters["support_frequency"] = 3.0;
  const auto dynamics = findModel("cart_pendulum")->setUp(s.parameters, {}, s.gravity).dynamics;
  const Sketch rest = dynamics->sketch(s.q, {});
  ASSERT_EQ(rest.springs.size(), 1u);
  for (const double time : {0.3, 0.9, 2.0}) {
    const Sketch sketch = dynamics->sketch(s.q, {time, 0.0, 0.0, 0.0});
    const double force = sketch.arrows[0].to.x - sketch.arrows[0].from.x;
    EXPECT_GT(force * std::cos(2.0 * time), 0.0);
    // The wall end of the spring is where V has it.
    EXPECT_NEAR(sketch.springs[0].from.x - rest.springs[0].from.x, 0.1 * std::sin(3.0 * time),
                1e-12);
  }
}

}  // namespace sketch_test
}  // namespace whirl_twin
