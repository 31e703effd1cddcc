#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "studies/study.h"

namespace whirl_twin {
namespace distribution_test {

TEST(Distribution, UniformMeetsItsEndsExactly) {
  const Distribution d{Distribution::Kind::kUniform, 0.1, 0.7};
  EXPECT_EQ(d.value(0.0), 0.1);
  EXPECT_EQ(d.value(1.0), 0.7);
  EXPECT_DOUBLE_EQ(d.value(0.5), 0.4);
  EXPECT_EQ(d.level(0, 5), 0.1);
  EXPECT_EQ(d.level(4, 5), 0.7);
  EXPECT_DOUBLE_EQ(d.level(0, 1), 0.4);  // one level is in the middle
}

TEST(Distribution, LogUniformHasItsGeometricMeanInTheMiddle) {
  const Distribution d{Distribution::Kind::kLogUniform, 1.0e3, 1.0e7};
  EXPECT_NEAR(d.value(0.5), 1.0e5, 1.0e-8);
  EXPECT_EQ(d.level(0, 3), 1.0e3);
  EXPECT_EQ(d.level(2, 3), 1.0e7);
}

// Phi(1.959963984540054) = 0.975.
TEST(Distribution, NormalHasItsQuantiles) {
  const Distribution d{Distribution::Kind::kNormal, 0.0, 0.0, 10.0, 2.0};
  EXPECT_DOUBLE_EQ(d.value(0.5), 10.0);
  EXPECT_NEAR(d.value(0.975), 10.0 + 2.0 * 1.959963984540054, 1.0e-12);
  EXPECT_NEAR(d.value(0.025), 10.0 - 2.0 * 1.959963984540054, 1.0e-12);
  EXPECT_TRUE(std::isfinite(d.value(std::nextafter(0.0, 1.0))));
  EXPECT_TRUE(std::isfinite(d.value(std::nextafter(1.0, 0.0))));
  EXPECT_DOUBLE_EQ(d.level(0, 1), 10.0);
}

TEST(Distribution, ListHasItsEntriesAllAlikeLikely) {
  const Distribution d{Distribution::Kind::kList, 0.0, 0.0, 0.0, 0.0, {5.0, 10.0, 20.0, 40.0}};
  EXPECT_EQ(d.value(0.0), 5.0);
  EXPECT_EQ(d.value(0.26), 10.0);
  EXPECT_EQ(d.value(1.0), 40.0);
  EXPECT_EQ(d.levels(7), 4U);
  EXPECT_EQ(d.level(2, 4), 20.0);
  EXPECT_EQ(d.smallest(), 5.0);
  EXPECT_EQ(d.largest(), 40.0);
}

}  // namespace distribution_test
}  // namespace whirl_twin
