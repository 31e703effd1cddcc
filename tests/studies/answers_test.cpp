#include "studies/answers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace whirl_twin {
namespace answers_test {

TEST(Distributed, HasItsMomentsAndPercentiles) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) {
    values.push_back(i);
  }
  const Distributed d = distributed(values, std::vector<bool>(values.size()));
  EXPECT_DOUBLE_EQ(d.mean, 50.0);
  EXPECT_NEAR(d.deviation, std::sqrt(101.0 * 102.0 / 12.0), 1e-12);
  EXPECT_EQ(d.smallest, 0.0);
  EXPECT_EQ(d.largest, 100.0);
  for (std::size_t k = 0; k < kPercentiles.size(); ++k) {
    EXPECT_DOUBLE_EQ(d.percentiles[k], kPercentiles[k]);
  }
}

TEST(Distributed, CountsWhatIsNoNumberAndPoisonsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Distributed d = distributed({1.0, nan, 3.0, nan, std::numeric_limits<double>::infinity()},
                                    {false, false, false, true, false});
  EXPECT_EQ(d.count, 2U);
  EXPECT_EQ(d.undefined, 2U);
  EXPECT_EQ(d.mean, 2.0);
  EXPECT_EQ(d.largest, 3.0);
  const Distributed none = distributed({nan, nan}, {true, true});
  EXPECT_EQ(none.count, 0U);
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_TRUE(std::isnan(distributed({1.0}, {false}).deviation));
}

// Wilson's interval of 10 of 100, as tabulated (Newcombe, Stat. Med. 17, 1998, gives the formula).
TEST(Yield, HasWilsonsInterval) {
  const Yield y = yieldOf(10, 100);
  EXPECT_NEAR(y.low, 0.0552, 5e-5);
  EXPECT_NEAR(y.high, 0.1744, 5e-5);
  EXPECT_EQ(yieldOf(0, 50).low, 0.0);
  EXPECT_EQ(yieldOf(50, 50).high, 1.0);
  EXPECT_LT(yieldOf(50, 50).low, 1.0);
}

}  // namespace answers_test
}  // namespace whirl_twin
