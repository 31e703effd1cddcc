// Shaped commands: the residual vibration at the design frequency, near it, and of the load of a
// crane.
#include "control/input_shaper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/inputs.h"

namespace whirl_twin {
namespace input_shaper_test {

double whole(const std::vector<ShapedPart>& shaper) {
  double sum = 0.0;
  for (const ShapedPart& part : shaper) {
    sum += part.share;
  }
  return sum;
}

TEST(InputShaper, GivesAllOfTheCommand) {
  for (const double damping : {0.0, 0.05, 0.4}) {
    EXPECT_NEAR(whole(zeroVibration(3.0, damping)), 1.0, 1e-15);
    EXPECT_NEAR(whole(zeroVibrationDerivative(3.0, damping)), 1.0, 1e-15);
  }
}

TEST(InputShaper, LeavesNothingOfWhatItKnows) {
  for (const double damping : {0.0, 0.05, 0.4}) {
    EXPECT_LT(residualVibration(zeroVibration(3.0, damping), 3.0, damping), 1e-14);
    EXPECT_LT(residualVibration(zeroVibrationDerivative(3.0, damping), 3.0, damping), 1e-14);
  }
}

// Undamped, of a frequency wrong by d: sin(pi d / 2), and its square.
TEST(InputShaper, LeavesLittleOfWhatIsNearIt) {
  const double wrong[] = {0.05, 0.1, 0.2};
  const double zv[] = {0.0784591, 0.1564345, 0.3090170};
  const double zvd[] = {0.0061558, 0.0244717, 0.0954915};
  for (int i = 0; i < 3; ++i) {
    const double frequency = 3.0 * (1.0 + wrong[i]);
    EXPECT_NEAR(residualVibration(zeroVibration(3.0, 0.0), frequency, 0.0), zv[i], 5e-8);
    EXPECT_NEAR(residualVibration(zeroVibrationDerivative(3.0, 0.0), frequency, 0.0), zvd[i], 5e-8);
  }
}

/// Largest swing, from 0.2 s after the last instant on, of x'' + 2 zeta w x' + w^2 (x - s(t)) = 0.
double swingAfter(const InputSignal& support, double frequency, double damping) {
  constexpr std::int64_t kStep = 200000;
  const double h = 1e-9 * kStep;
  Inputs inputs({support});
  double x = 0.0;
  double v = 0.0;
  double largest = 0.0;
  const std::int64_t last = support.instants.back();
  for (std::int64_t time = 0; time < last + 8000000000; time += kStep) {
    inputs.begin(time);
    const double s = inputs.value(0, 0.5 * h);
    v += h * (-2.0 * damping * frequency * v - frequency * frequency * (x - s));
    x += h * v;
    if (time > last + kStep) {
      largest = std::max(largest, std::hypot(x - s, v / frequency));
    }
  }
  return largest;
}

// A support that goes 2 m in 0.7 s under what swings at 3 rad/s.
TEST(InputShaper, BringsALoadWithoutASwing) {
  const InputSignal ramp = InputSignal::table({500000000, 1200000000}, {0.0, 2.0}, false);
  const double rough = swingAfter(ramp, 3.0, 0.02);
  EXPECT_GT(rough, 1.0);
  EXPECT_LT(swingAfter(shaped(ramp, zeroVibration(3.0, 0.02)), 3.0, 0.02), 2e-3 * rough);
  EXPECT_LT(swingAfter(shaped(ramp, zeroVibrationDerivative(3.0, 0.02)), 3.0, 0.02), 2e-3 * rough);
  EXPECT_LT(swingAfter(shaped(ramp, zeroVibrationDerivative(2.7, 0.02)), 3.0, 0.02), 0.04 * rough);
}

TEST(InputShaper, ShapesATableByItsInstants) {
  const InputSignal ramp = InputSignal::table({1000, 3000}, {0.0, 4.0}, false);
  const InputSignal parts = shaped(ramp, {{0.75, 0.0}, {0.25, 1e-6}});
  EXPECT_EQ(parts.instants, (std::vector<std::int64_t>{1000, 2000, 3000, 4000}));
  EXPECT_EQ(parts.values, (std::vector<double>{0.0, 1.5, 3.5, 4.0}));
  const InputSignal held =
      shaped(InputSignal::table({1000, 3000}, {0.0, 4.0}, true), {{0.75, 0.0}, {0.25, 1e-6}});
  EXPECT_TRUE(held.hold);
  EXPECT_EQ(held.values, (std::vector<double>{0.0, 0.0, 3.0, 4.0}));
}

}  // namespace input_shaper_test
}  // namespace whirl_twin
