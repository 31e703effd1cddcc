// The value of an input between the samples of its sensor.
#include <gtest/gtest.h>

#include "estimation/estimator_sources.h"

namespace whirl_twin {
namespace followed_input_test {

constexpr std::int64_t kStep = 10'000'000;  // ns

TEST(EstimatorInput, IsTheLineBetweenSamples) {
  EstimatorInput input(false, 0.0);
  EXPECT_FALSE(input.known());
  input.take({0, 1.0});
  ASSERT_TRUE(input.known());
  EXPECT_EQ(input.at(0, 0.004), 1.0);  // the next value is not yet known
  input.take({kStep, 3.0});
  input.take({2 * kStep, 2.0});
  EXPECT_EQ(input.at(-kStep, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(input.at(0, 0.005), 2.0);
  EXPECT_DOUBLE_EQ(input.at(5'000'000, 0.0025), 2.5);
  EXPECT_DOUBLE_EQ(input.at(5'000'000, 0.01), 2.5);
  EXPECT_DOUBLE_EQ(input.at(kStep, 0.1), 2.0);  // beyond
  input.take({102 * kStep, 9.0});
  EXPECT_DOUBLE_EQ(input.at(50 * kStep, 0.0), 2.0);  // no known value for a second
  input.forgetBefore(kStep + 1);
  EXPECT_DOUBLE_EQ(input.at(kStep, 0.005), 2.5);
}

TEST(EstimatorInput, IsHeldWhereThatIsHowItActs) {
  EstimatorInput input(true, 0.0);
  input.take({0, 1.0});
  input.take({kStep, 3.0});
  EXPECT_EQ(input.at(0, 0.009), 1.0);
  EXPECT_EQ(input.at(kStep, 0.0), 3.0);
}

TEST(EstimatorInput, HasACornerAtEachSample) {
  EstimatorInput input(true, 0.0);
  for (std::int64_t k = 0; k < 4; ++k) {
    input.take({k * kStep, 1.0});
  }
  std::vector<std::int64_t> corners;
  input.addCorners(0, 3 * kStep, corners);
  EXPECT_EQ(corners, (std::vector<std::int64_t>{kStep, 2 * kStep}));
}

/// N samples with noise s, each lasting for a time h, push as white noise of density s^2 h does.
TEST(EstimatorInput, HasTheNoiseOfItsSamples) {
  EstimatorInput input(true, 0.2);
  input.take({0, 1.0});
  EXPECT_EQ(input.noiseDensity(), 0.0);
  input.take({kStep, 1.0});
  input.take({kStep, 5.0});  // duplicate: ignored
  EXPECT_EQ(input.at(kStep, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(input.noiseDensity(), 0.04 * 0.01);
}

}  // namespace followed_input_test
}  // namespace whirl_twin
