// Batched sine and cosine, against extended precision.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "integration/batch_real.h"

namespace whirl_twin {
namespace member_number_test {

/// The largest error of either over angles of this size.
double worst(double size) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-size, size);
  double error = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = angle(random);
    const auto exact = static_cast<long double>(x);
    error = std::fmax(error, std::fabs(static_cast<double>(sin(BatchReal(x)).x - std::sin(exact))));
    error = std::fmax(error, std::fabs(static_cast<double>(cos(BatchReal(x)).x - std::cos(exact))));
  }
  return error;
}

TEST(BatchReal, SineAndCosineAreGoodToAFewUnitsOfTheLastDigit) {
  for (const double size : {1e-3, 1.0, 4.0, 100.0, 1e4, 1e5, 1e6, 3e6}) {
    EXPECT_LT(worst(size), 3.5e-16) << size;
  }
}

// There the angle nearly cancels, and the split of pi shows.
TEST(BatchReal, SinesNextToWholeHalfTurnsAreGoodToTheAngle) {
  constexpr long double kPi = 3.14159265358979323846264338327950288L;
  double error = 0.0;
  for (int halves = 1; halves < 950000; halves += 7) {
    const auto x = static_cast<double>(halves * kPi);
    const auto exact = static_cast<double>(std::sin(static_cast<long double>(x)));
    error = std::fmax(error, std::fabs(sin(BatchReal(x)).x - exact));
  }
  EXPECT_LT(error, 2e-20);
}

TEST(BatchReal, FarOutTheyAreThoseOfAnAngleOffByItsRounding) {
  for (const double size : {1e8, 1e10, 1e12}) {
    EXPECT_LT(worst(size), 2.0 * 2.3e-16 * size) << size;
  }
}

TEST(BatchReal, SmallSinesKeepTheirDigits) {
  for (double x = 1.0; x > 1e-300; x *= 0.37) {
    EXPECT_NEAR(sin(BatchReal(x)).x, std::sin(x), 3e-16 * x);
    EXPECT_NEAR(sin(BatchReal(-x)).x, -std::sin(x), 3e-16 * x);
  }
}

}  // namespace member_number_test
}  // namespace whirl_twin
