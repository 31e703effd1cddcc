// The steps' own sine and cosine against the C library's in extended precision.
#include "mechanics/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mechanics/elementary.h"

namespace whirl_twin {
namespace sine_cosine_test {

constexpr long double kQuarter = 1.5707963267948966192313216916397514L;

/// Distance from the exact value in units of its last place.
double ulps(double found, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(static_cast<long double>(found) - exact)) / ulp;
}

/// A table's value, a product and two sums are rounded; where the table's value and the rest of the
/// angle are of one size, each of them by half an ulp of a value that may be half as large.
void expectExact(double x) {
  const SineCosine found = sineCosine(x);
  const long double sine = std::sin(static_cast<long double>(x));
  const long double cosine = std::cos(static_cast<long double>(x));
  const auto allowed = [](long double value) { return std::fabs(value) > 0.125L ? 0.75 : 1.7; };
  ASSERT_LT(ulps(found.sine, sine), allowed(sine)) << "sin " << x;
  ASSERT_LT(ulps(found.cosine, cosine), allowed(cosine)) << "cos " << x;
}

TEST(SineCosine, AreExactToAnUlpUpToWhereTheLibraryTakesOver) {
  std::mt19937_64 random(1);
  for (const double largest : {0.03, 0.8, 3.0, 10.0, 1.0e3, 1.0e5, 1.0e9}) {
    std::uniform_real_distribution<double> angle(-largest, largest);
    for (int i = 0; i < 100000; ++i) {
      expectExact(angle(random));
    }
  }
}

TEST(SineCosine, AreExactBesideMultiplesOfAQuarterTurnAndBetweenTheTablesAngles) {
  for (int eighths = -130000; eighths <= 130000; ++eighths) {  // of a turn: up to 1.02e5 rad
    const auto multiple = static_cast<double>(0.5L * eighths * kQuarter);
    expectExact(multiple);
    expectExact(std::nextafter(multiple, 1.0e9));
    expectExact(std::nextafter(multiple, -1.0e9));
  }
  for (int half_parts = -1000; half_parts <= 1000; ++half_parts) {  // of 1/128 of a turn
    const auto between = static_cast<double>(half_parts * kQuarter / 64.0L);
    expectExact(between);
    expectExact(std::nextafter(between, 1.0e9));
  }
}

TEST(SineCosine, OfASmallAngleAreTheAngleAndOne) {
  for (int power = -1074; power < -30; ++power) {
    const double x = std::ldexp(1.0, power);
    EXPECT_EQ(sineCosine(x).sine, x);
    EXPECT_EQ(sineCosine(-x).sine, -x);
    EXPECT_EQ(sineCosine(x).cosine, 1.0);
  }
  EXPECT_EQ(sineCosine(0.0).sine, 0.0);
  EXPECT_EQ(sineCosine(-0.0).sine, 0.0);
  EXPECT_EQ(sineCosine(-0.0).cosine, 1.0);
}

TEST(SineCosine, OfWhatIsNoAngleAreNotNumbers) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sineCosine(x).sine)) << x;
    EXPECT_TRUE(std::isnan(sineCosine(x).cosine)) << x;
  }
}

TEST(CosOfDifference, IsThatOfTheDifferenceToTheRoundingOfOne) {
  // Two products of numbers up to 1, each with an error below 1.5e-16, and a sum.
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-10.0, 10.0);
  for (int i = 0; i < 10000; ++i) {
    const double a = angle(random);
    const double b = i % 2 == 0 ? angle(random) : a + 1.0e-9 * angle(random);
    const long double difference = static_cast<long double>(a) - b;
    const Jet<double> found = cosOfDifferenceJet(a, b);
    ASSERT_NEAR(found.value, static_cast<double>(std::cos(difference)), 5.0e-16);
    ASSERT_NEAR(found.slope, static_cast<double>(-std::sin(difference)), 5.0e-16);
    ASSERT_EQ(found.curvature, -found.value);
  }
}

}  // namespace sine_cosine_test
}  // namespace whirl_twin
