#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "studies/answers.h"

namespace whirl_twin {
namespace sensitivity_test {

constexpr double kPi = 3.14159265358979323846;

template <class Function>
std::vector<double> measured(const Design& design, const Function& f, std::uint32_t seed = 1) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < design.points; ++i) {
    values.push_back(f(quantilesAt(design, seed, i)));
  }
  return values;
}

Design indices(std::uint64_t base, std::size_t dimensions) {
  Design design;
  design.kind = Design::Kind::kSobolIndices;
  design.base = base;
  design.dimensions = dimensions;
  design.points = base * (dimensions + 2);
  return design;
}

Design trajectories(std::uint64_t count, std::size_t dimensions) {
  Design design;
  design.kind = Design::Kind::kMorris;
  design.base = count;
  design.dimensions = dimensions;
  design.levels = {4};
  design.points = count * (dimensions + 1);
  return design;
}

// Ishigami & Homma 1990, a = 7, b = 0.1, on -pi..pi: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2,
// V1 = (1 + b pi^4/5)^2 / 2, V2 = a^2/8, V13 = 8 b^2 pi^8 / 225.
TEST(SobolIndices, OfIshigamiWithinAPercentAt2To14) {
  constexpr double kA = 7.0;
  constexpr double kB = 0.1;
  const double pi4 = std::pow(kPi, 4);
  const double v1 = 0.5 * std::pow(1.0 + kB * pi4 / 5.0, 2);
  const double v2 = kA * kA / 8.0;
  const double v13 = 8.0 * kB * kB * pi4 * pi4 / 225.0;
  const double v = v1 + v2 + v13;
  ASSERT_NEAR(v1 / v, 0.3139, 5e-5);
  ASSERT_NEAR(v2 / v, 0.4424, 5e-5);
  ASSERT_NEAR(v13 / v, 0.2437, 5e-5);
  const Design design = indices(1U << 14U, 3);
  const SobolIndices found =
      sobolIndices(design, measured(design, [&](const auto& u) {
                     const auto x = [&](std::size_t j) { return kPi * (2.0 * u[j] - 1.0); };
                     return std::sin(x(0)) + kA * std::pow(std::sin(x(1)), 2) +
                            kB * std::pow(x(2), 4) * std::sin(x(0));
                   }));
  const double first[] = {v1 / v, v2 / v, 0.0};
  const double total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(found.first[j].value, first[j], 0.01 * std::max(first[j], 0.3));
    EXPECT_NEAR(found.total[j].value, total[j], 0.01 * total[j]);
    EXPECT_LT(found.first[j].low, first[j]);
    EXPECT_GT(found.first[j].high, first[j]);
    EXPECT_LT(found.total[j].low, total[j]);
    EXPECT_GT(found.total[j].high, total[j]);
    EXPECT_LT(found.total[j].high - found.total[j].low, 0.05);
  }
  EXPECT_EQ(found.rows, design.base);
}

// Of Ishigami's function and of a product of two numbers in another scale, over 200 seeds and two
// sizes: 93 to 97 % of the intervals hold the index, and they are not much wider than the errors.
TEST(SobolIndices, IntervalsHoldTheIndexIn95Of100) {
  const double pi4 = std::pow(kPi, 4);
  const double v1 = 0.5 * std::pow(1.0 + 0.1 * pi4 / 5.0, 2), v2 = 49.0 / 8.0;
  const double v13 = 8.0 * 0.01 * pi4 * pi4 / 225.0, v = v1 + v2 + v13;
  const double truth[] = {v1 / v, v2 / v, 0.0, (v1 + v13) / v, v2 / v, v13 / v};
  const auto ishigami = [](const std::vector<double>& u) {
    const auto x = [&](std::size_t j) { return kPi * (2.0 * u[j] - 1.0); };
    return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
           0.1 * std::pow(x(2), 4) * std::sin(x(0));
  };
  for (const std::uint64_t base : {128U, 500U}) {
    int held = 0, all = 0;
    double widths = 0.0, errors = 0.0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
      const Design design = indices(base, 3);
      const SobolIndices found = sobolIndices(design, measured(design, ishigami, seed));
      for (std::size_t j = 0; j < 6; ++j) {
        const Estimate& one = j < 3 ? found.first[j] : found.total[j - 3];
        held += one.low <= truth[j] && truth[j] <= one.high ? 1 : 0;
        ++all;
        widths += std::pow(0.5 * (one.high - one.low), 2);
        errors += std::pow(one.value - truth[j], 2);
      }
    }
    EXPECT_GT(held, 0.93 * all) << base;
    EXPECT_LT(held, 0.975 * all) << base;
    EXPECT_LT(std::sqrt(widths), 2.6 * std::sqrt(errors)) << base;
  }
}

// The indices of a sum are those of its terms; a large mean does not affect them.
TEST(SobolIndices, OfASumAreThePartsOfItsVariance) {
  const Design design = indices(4096, 2);
  const SobolIndices found = sobolIndices(
      design, measured(design, [](const auto& u) { return 1.0e6 + 3.0 * u[0] + u[1]; }));
  EXPECT_NEAR(found.first[0].value, 0.9, 0.005);
  EXPECT_NEAR(found.first[1].value, 0.1, 0.005);
  EXPECT_NEAR(found.total[0].value, 0.9, 0.005);
  EXPECT_NEAR(found.total[1].value, 0.1, 0.005);
}

TEST(SobolIndices, OfWhatDoesNotVaryThereAreNone) {
  const Design design = indices(64, 2);
  const SobolIndices found =
      sobolIndices(design, measured(design, [](const auto&) { return 0.1; }));
  EXPECT_TRUE(std::isnan(found.first[0].value));
  EXPECT_TRUE(std::isnan(found.total[1].value));
  EXPECT_TRUE(std::isnan(found.total[1].low));
}

TEST(SobolIndices, RowsWithAPointThatFailedAreLeftOut) {
  const Design design = indices(4096, 2);
  const SobolIndices found = sobolIndices(
      design, measured(design, [](const auto& u) {
        return u[0] > 0.99 ? std::numeric_limits<double>::quiet_NaN() : 2.0 * u[0] + u[1];
      }));
  EXPECT_GT(found.left_out, 40U);
  EXPECT_EQ(found.rows + found.left_out, 4096U);
  EXPECT_NEAR(found.first[0].value, 0.8, 0.02);
  const std::vector<double> none(design.points, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(sobolIndices(design, none).first[0].value));
}

// Elementary effects of a plane are its slopes, all alike.
TEST(MorrisEffects, OfAPlaneAreItsSlopes) {
  const Design design = trajectories(20, 3);
  const MorrisEffects found = morrisEffects(
      design, 1, measured(design, [](const auto& u) { return 5.0 * u[0] - 2.0 * u[1]; }));
  const double slopes[] = {5.0, -2.0, 0.0};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(found.mean[j].value, slopes[j], 1e-12);
    EXPECT_NEAR(found.mean_magnitude[j].value, std::fabs(slopes[j]), 1e-12);
    EXPECT_NEAR(found.deviation[j].value, 0.0, 1e-12);
    EXPECT_NEAR(found.mean[j].low, slopes[j], 1e-12);
  }
}

// Of a product each effect is the other number, 1/8 … 7/8 alike likely: mean 1/2, variance 5/64.
TEST(MorrisEffects, OfAProductDeviate) {
  const Design design = trajectories(4000, 2);
  const MorrisEffects found =
      morrisEffects(design, 1, measured(design, [](const auto& u) { return u[0] * u[1]; }));
  EXPECT_NEAR(found.mean[0].value, 0.5, 0.02);
  EXPECT_NEAR(found.deviation[0].value, std::sqrt(5.0 / 64.0), 0.01);
  EXPECT_LT(found.mean[0].low, 0.5);
  EXPECT_GT(found.mean[0].high, 0.5);
}

}  // namespace sensitivity_test
}  // namespace whirl_twin
