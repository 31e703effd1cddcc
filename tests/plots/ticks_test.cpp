// Ticks: multiples of 1, 2 or 5 times a power of ten that cover the range.
#include "plots/ticks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace ticks_test {

class Ranges : public testing::TestWithParam<AxisRange> {};

TEST_P(Ranges, AreCoveredByTicksOneTwoOrFiveApart) {
  const AxisRange range = GetParam();
  for (const int most : {4, 6, 9}) {
    const std::vector<double> ticks = linearTicks(range, most);
    ASSERT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
    const double step = ticks[1] - ticks[0];
    // A tick may miss an end by rounding only: 1e-9 of a step, as ticks.cpp allows.
    EXPECT_LE(ticks.front(), range.low + 1e-9 * step);
    EXPECT_GE(ticks.back(), range.high - 1e-9 * step);
    // No tick is idle: without the outer ones the range would not be covered.
    EXPECT_GT(ticks[1], range.low);
    EXPECT_LT(ticks[ticks.size() - 2], range.high);
    const double factor = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    const double nearest = std::abs(factor - 2.0) < 0.5 ? 2.0 : factor < 1.5 ? 1.0 : 5.0;
    // The difference of two rounded ticks carries their rounding, 1e-16 of their size, by step.
    EXPECT_NEAR(factor, nearest, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Ticks, Ranges,
                         testing::Values(AxisRange{0.0, 1.0}, AxisRange{-1.0, 1.0},
                                         AxisRange{0.0, 30.5}, AxisRange{-0.37, 0.29},
                                         AxisRange{1.1e-7, 9.7e-7}, AxisRange{-3e8, 2.5e9},
                                         AxisRange{99.99, 100.01}, AxisRange{5.0, 7.0}));

TEST(Ticks, AreTheNumbersTheySay) {
  EXPECT_EQ(linearTicks({0.0, 0.5}, 6), (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTen) {
  EXPECT_EQ(logarithmicTicks({2e-3, 30.0}, 8),
            (std::vector<double>{1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0}));
}

TEST(Ticks, OfAShortLogarithmicAxisStandBetweenPowersToo) {
  EXPECT_EQ(logarithmicTicks({1.5, 9.0}, 8), (std::vector<double>{1.0, 2.0, 5.0, 10.0}));
}

TEST(Ticks, OfALongLogarithmicAxisSkipPowers) {
  const std::vector<double> ticks = logarithmicTicks({1e-16, 1.0}, 6);
  EXPECT_LE(ticks.size(), 6u);
  EXPECT_LE(ticks.front(), 1e-16);
  EXPECT_GE(ticks.back(), 1.0);
}

TEST(Ticks, OfOneValueHaveRoomAroundIt) {
  for (const double value : {0.0, 5.5, -1e-12}) {
    const AxisRange range = widened({value, value});
    EXPECT_LT(range.low, value);
    EXPECT_GT(range.high, value);
    EXPECT_GE(linearTicks(range, 5).size(), 2u);
  }
}

// Nothing that turns at 50 rad/s is marked from 49.99995 to 50.00005.
TEST(Ticks, OfAConstantHaveShortLabels) {
  for (const double value : {50.0, -50.0, 1799.0, 2.5e-4, 1.0e300}) {
    const std::vector<double> ticks = linearTicks(widened({value, value}), 9);
    for (const std::string& label : linearLabels(ticks).text) {
      EXPECT_LE(label.size(), 7u) << label << " of " << value;  // a minus sign takes three
    }
    EXPECT_TRUE(std::isfinite(ticks.back() - ticks.front())) << value;
  }
}

TEST(Ticks, OfDegreesStandAtPartsOfATurn) {
  EXPECT_EQ(degreeTicks({-80.0, 250.0}, 9),
            (std::vector<double>{-90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0}));
  EXPECT_EQ(degreeTicks({0.0, 180.0}, 5), (std::vector<double>{0.0, 45.0, 90.0, 135.0, 180.0}));
  EXPECT_EQ(degreeTicks({-170.0, 175.0}, 6),
            (std::vector<double>{-180.0, -90.0, 0.0, 90.0, 180.0}));
  // A degree or two are no fraction of a turn with a tick.
  EXPECT_EQ(degreeTicks({1.0, 3.0}, 6), linearTicks({1.0, 3.0}, 6));
}

// Powers of ten beyond 1e308 are infinite: marks there would all be 0, or one place.
TEST(Ticks, AreApartHoweverSmallOrLargeTheValues) {
  for (const AxisRange range : {AxisRange{0.0, 1e-308}, AxisRange{-4e-324, 4e-324},
                                AxisRange{1e-302, 3e-302}, AxisRange{-1e300, 1e300}}) {
    const std::vector<double> ticks = linearTicks(widened(range), 5);
    ASSERT_GE(ticks.size(), 2u);
    for (std::size_t i = 1; i < ticks.size(); ++i) {
      EXPECT_LT(ticks[i - 1], ticks[i]) << range.high;
    }
    EXPECT_TRUE(std::isfinite(ticks.back() - ticks.front()));
    EXPECT_EQ(linearLabels(ticks).text.size(), ticks.size());
  }
}

TEST(Labels, HaveTheDigitsOfTheStep) {
  EXPECT_EQ(linearLabels({-0.5, 0.0, 0.5}).text,
            (std::vector<std::string>{"\u22120.5", "0.0", "0.5"}));
  EXPECT_EQ(linearLabels({0.0, 20.0, 40.0}).text, (std::vector<std::string>{"0", "20", "40"}));
}

TEST(Labels, OfSmallNumbersShareAPowerOfTen) {
  const TickLabels labels = linearLabels({0.0, 2e-4, 4e-4});
  EXPECT_EQ(labels.exponent, -6);
  EXPECT_EQ(labels.text, (std::vector<std::string>{"0", "200", "400"}));
  EXPECT_EQ(powerOfTen(labels.exponent), "10\u207b\u2076");
}

TEST(Labels, OfPowersOfTenAreShort) {
  EXPECT_EQ(logarithmicLabels({1e-12, 2e-12}).text,
            (std::vector<std::string>{"10\u207b\u00b9\u00b2", "2\u00b710\u207b\u00b9\u00b2"}));
  EXPECT_EQ(logarithmicLabels({0.1, 1.0, 10.0}).text, (std::vector<std::string>{"0.1", "1", "10"}));
}

}  // namespace ticks_test
}  // namespace whirl_twin
