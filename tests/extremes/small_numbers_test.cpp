// Whirls that decay to zero: radii down to the smallest representable numbers, and through the
// centre, where a whirl has no angle.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "../integration/whirl_closed_form.h"
#include "../scene/scenes.h"
#include "measured.h"
#include "realtime/denormals.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace small_numbers_test {

using Complex = ClosedFormWhirl::Complex;

constexpr double kP = 100.0;  // [rad/s]
constexpr double kZeta = 0.1;
constexpr double kSmallest = 4.9406564584124654e-324;

RunningSystem::Setup ringingDown(double radius) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0}, {"stiffness", kP * kP}, {"damping", 2.0 * kZeta * kP}};
  s.q = {radius, 0.0};
  s.v = {0.0, radius * kP};
  return s;
}

class EveryMethodWithSmallNumbers : public testing::TestWithParam<std::string> {};

// From 1e-295 m into the denormals, 29 decades in 6.7 s. There the rounding error is absolute: each
// step may err by a few of the smallest numbers in q, and of p times them by way of q'. In sums an
// increment of the increment, (p h)^2 q, is lost where it is less than half the smallest number,
// and the motion stops.
TEST_P(EveryMethodWithSmallNumbers, RingsDownIntoDenormalsAndEndsThere) {
  constexpr double kStart = 1e-295;
  RunningSystem rotor(ringingDown(kStart), GetParam(), kMillisecond / 5);
  const ClosedFormWhirl exact(2.0L * kZeta * kP, kP * kP, 0.0L, 0.0L, Complex(kStart, 0.0L),
                              Complex(0.0L, static_cast<long double>(kStart) * kP));
  // p h = 0.02, over p t = 670: effect of the method's numerical damping and frequency. Errors of
  // the radius itself are relative, so they shrink with it.
  const double z = kP * 2e-4;
  const double truncation =
      GetParam() == "exponential" ? 1e-12 : std::pow(z, orderOf(GetParam())) * 670.0 + 1e-12;
  const double lost = hasPast(GetParam()) ? 4.0 / (z * z) : 1000.0;
  bool denormal = false;
  for (int i = 1; i <= 67; ++i) {
    ASSERT_EQ(rotor.run(500), StepStatus::kOk);
    const Complex z_exact = exact(0.1L * i);
    const double error = static_cast<double>(std::abs(Complex(rotor.q(0), rotor.q(1)) - z_exact));
    EXPECT_LE(error, std::fmin(truncation, 1.1) * static_cast<double>(std::abs(z_exact)) +
                         lost * kSmallest)
        << "at " << rotor.time() << " s";
    denormal = denormal || std::fpclassify(rotor.q(0)) == FP_SUBNORMAL;
  }
  EXPECT_TRUE(denormal) << "it went through them";
  // The residual is within a few roundings of zero, or zero. It does not grow again.
  ASSERT_EQ(rotor.run(20000), StepStatus::kOk);
  expectWithin(lost, std::hypot(rotor.q(0), rotor.q(1)) / kSmallest,
               "left of a ring-down by " + GetParam() + ", in smallest numbers");
  EXPECT_LE(std::hypot(rotor.v(0), rotor.v(1)), lost * kP * kSmallest);
}

// As the real-time thread runs: no number smaller than 2.2e-308 is ever seen.
TEST_P(EveryMethodWithSmallNumbers, NeverMeetsADenormalWhereTheyAreRoundedToZero) {
  const auto denormals = [&] {
    RunningSystem rotor(ringingDown(1e-300), GetParam(), kMillisecond);
    int count = 0;
    for (int i = 0; i < 5000; ++i) {
      EXPECT_EQ(rotor.run(1), StepStatus::kOk);
      for (const double x : rotor.state()) {
        count += std::fpclassify(x) == FP_SUBNORMAL ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_GT(denormals(), 0);
  int flushed = 0;
  {
    const DenormalsToZero denormals_to_zero;
    flushed = denormals();
  }
  EXPECT_EQ(flushed == 0, DenormalsToZero::kSupported) << flushed;
  EXPECT_GT(denormals(), 0) << "no longer than it lives";
}

// A plane motion through the centre: x = (v/p) sin(p t), y = 0. At the start the radius is 0; it is
// again at every half period, after 50 steps.
TEST_P(EveryMethodWithSmallNumbers, PassesThroughTheCentreWithoutAJump) {
  const double h = 1e-3;
  const double p = M_PI / (50.0 * h);
  const std::string rotor = fmt::format(
      "{{step: 0.001, systems: {{rotor: {{model: jeffcott_rotor, integrator: {}, parameters: "
      "{{mass: 1, stiffness: {:.17g}, speed: 10}}, initial: {{x_rate: {:.17g}}}}}}}}}",
      GetParam(), p * p, 1e-3 * p);
  Twin twin(sceneOf(rotor));
  Observer observer(twin);
  EXPECT_FALSE(observer.whirl(0).phase_valid) << "at rest in the centre there is no angle";
  EXPECT_TRUE(std::isnan(observer.whirl(0).phase));
  std::vector<double> record(twin.layout().size);
  double before = 0.0;
  double now = 0.0;
  int undefined = 0;
  int crossings = 0;
  double phase = std::nan("");
  for (int i = 1; i <= 1000; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    const state::WhirlState s = observer.whirl(0);
    ASSERT_EQ(twin.status(0), StepStatus::kOk);
    EXPECT_EQ(s.y, 0.0);
    EXPECT_EQ(s.radius, std::fabs(s.x));
    // x'' = -p^2 x: the bend of the path within a step is (p h)^2 of the amplitude at most, and at
    // the centre it is (p h)^2 of what x is there.
    if (i > 1) {
      EXPECT_LE(std::fabs(s.x - 2.0 * now + before), 1.1 * p * p * h * h * std::fabs(now) + 1e-12)
          << "step " << i;
    }
    crossings += now * s.x < 0.0 ? 1 : 0;
    before = now;
    now = s.x;
    EXPECT_EQ(s.phase_valid, std::fabs(s.x) > 1e-12) << "step " << i << ", x = " << s.x;
    EXPECT_EQ(std::isfinite(s.phase), s.phase_valid);
    EXPECT_EQ(std::isfinite(s.whirl_rate), s.phase_valid);
    undefined += s.phase_valid ? 0 : 1;
    if (s.phase_valid) {
      // The lag grows with the shaft, 0.01 rad a step; through the centre it turns by pi.
      if (std::isfinite(phase)) {
        const double step = std::remainder(s.phase - phase - 0.01, M_PI);
        EXPECT_NEAR(step, 0.0, 1e-9) << "step " << i;
      }
      phase = s.phase;
    } else {
      phase = std::nan("");
    }
  }
  if (GetParam() == "exponential") {
    // On the grid of its half periods to the roundings, 1e-14 of the amplitude: 20 times.
    EXPECT_EQ(undefined, 20);
  } else {
    EXPECT_GE(undefined + crossings, 19);
  }
}

INSTANTIATE_TEST_SUITE_P(NextToNothing, EveryMethodWithSmallNumbers,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

// A hysteretic shaft has no slope at r = 0, a rub no contact: a start at rest there, and a plane
// motion through it.
TEST(NonlinearRotorAtTheCentre, StartsAndPasses) {
  for (const bool rubs : {false, true}) {
    for (const double rate : {0.0, 0.1}) {
      RunningSystem::Setup s;
      s.model = "jeffcott_rotor";
      s.parameters = {{"mass", 1.0}, {"stiffness", 1e4}, {"loss_factor", 0.05}};
      if (rubs) {
        s.parameters["rub_stiffness"] = 1e5;
        s.parameters["rub_clearance"] = 5e-4;
      }
      s.gravity = 0.0;
      s.speed = 50.0;
      s.v = {rate, 0.0};
      for (const std::string& method : integratorsOf(findModel(s.model)->variants[1])) {
        RunningSystem rotor(s, method, kMillisecond / 10);
        double largest = 0.0;
        double latest = 0.0;
        for (int i = 0; i < 5000; ++i) {
          ASSERT_EQ(rotor.run(1), StepStatus::kOk) << method << " " << rubs << " " << rate;
          const double radius = std::hypot(rotor.q(0), rotor.q(1));
          largest = std::fmax(largest, radius);
          latest = i < 4000 ? 0.0 : std::fmax(latest, radius);
        }
        // Below p the hysteresis damps, a circle as zeta = 0.025 does and a flat ellipse less: no
        // further than the start throws it, v/p, and after p t = 40 half as far.
        EXPECT_LE(largest, 1.02 * rate / 100.0) << method << " " << rubs;
        EXPECT_GE(largest, (rubs ? 0.5 : 0.9) * rate / 100.0) << method << " " << rubs;
        EXPECT_LE(latest, 0.6 * rate / 100.0) << method << " " << rubs;
      }
    }
  }
}

}  // namespace small_numbers_test
}  // namespace whirl_twin
