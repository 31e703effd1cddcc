// Two axes of one quantity: equal scales, steps and powers of ten.
#include "plots/marked_axis.h"

#include <gtest/gtest.h>

namespace whirl_twin {
namespace marked_axis_test {

MarkedAxis axis(double low, double high) {
  return {{low, high}, false, {}, {}};
}

double step(const MarkedAxis& axis) {
  return axis.ticks[1] - axis.ticks[0];
}

class EqualAxes : public testing::TestWithParam<std::pair<AxisRange, AxisRange>> {};

TEST_P(EqualAxes, HaveOneUnitOneStepAndOneExponent) {
  const auto& [along, up] = GetParam();
  MarkedAxis x = axis(along.low, along.high);
  MarkedAxis y = axis(up.low, up.high);
  markEqually(x, 700.0, y, 300.0, 9);
  const double unit = (x.range.high - x.range.low) / 700.0;
  EXPECT_NEAR((y.range.high - y.range.low) / 300.0, unit, 1e-9 * unit);
  EXPECT_NEAR(step(x), step(y), 1e-9 * step(x));
  EXPECT_EQ(x.labels.exponent, y.labels.exponent);
  EXPECT_LE(x.ticks.size(), 9u);
  for (const auto& [before, now] : {std::pair{along, x.range}, std::pair{up, y.range}}) {
    EXPECT_LE(now.low, before.low + 1e-9 * unit);
    EXPECT_GE(now.high, before.high - 1e-9 * unit);
  }
}

INSTANTIATE_TEST_SUITE_P(MarkedAxis, EqualAxes,
                         testing::Values(std::pair{AxisRange{-6e-4, 6e-4},
                                                   AxisRange{-1.2e-3, 0.0}},  // of fluid_whirl
                                         std::pair{AxisRange{-0.04, 0.04}, AxisRange{-0.06, 0.06}},
                                         std::pair{AxisRange{-1.0, 1.0}, AxisRange{-1.0, 1.0}},
                                         std::pair{AxisRange{0.0, 5.0}, AxisRange{1e-7, 3e-7}}));

}  // namespace marked_axis_test
}  // namespace whirl_twin
