#include "studies/design.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace whirl_twin {
namespace design_test {

Design of(Design::Kind kind, std::uint64_t points, std::size_t dimensions) {
  Design design;
  design.kind = kind;
  design.points = points;
  design.dimensions = dimensions;
  return design;
}

// McKay, Beckman & Conover: the definition.
TEST(LatinHypercube, EachNumberIsOnceInEachStratum) {
  for (const std::uint64_t points : {1U, 2U, 7U, 64U, 1000U}) {
    const Design design = of(Design::Kind::kLatinHypercube, points, 3);
    for (std::size_t j = 0; j < 3; ++j) {
      std::set<std::uint64_t> strata;
      for (std::uint64_t i = 0; i < points; ++i) {
        const double u = quantilesAt(design, 7, i)[j];
        ASSERT_GT(u, 0.0);
        ASSERT_LT(u, 1.0);
        strata.insert(static_cast<std::uint64_t>(u * static_cast<double>(points)));
      }
      EXPECT_EQ(strata.size(), points);
      EXPECT_EQ(*strata.rbegin(), points - 1);
    }
  }
}

// A permutation of 0..n-1 has mean rank correlation 0 and variance 1 / (n - 1) with another one.
TEST(LatinHypercube, NumbersAreNotTiedToOneAnother) {
  constexpr std::uint64_t kPoints = 4096;
  const Design design = of(Design::Kind::kLatinHypercube, kPoints, 4);
  std::array<std::array<double, 4>, 4> sums{};
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const std::vector<double> u = quantilesAt(design, 3, i);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        sums[j][k] += 12.0 * (u[j] - 0.5) * (u[k] - 0.5) / kPoints;
      }
    }
  }
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      EXPECT_LT(std::fabs(sums[j][k]), 4.0 / std::sqrt(static_cast<double>(kPoints)));
    }
  }
}

TEST(LatinHypercube, AMillionthPointNeedsNoOthers) {
  const Design design = of(Design::Kind::kLatinHypercube, 1000000000000U, 2);
  EXPECT_EQ(quantilesAt(design, 1, 999999999999U), quantilesAt(design, 1, 999999999999U));
  EXPECT_NE(quantilesAt(design, 1, 999999999999U), quantilesAt(design, 2, 999999999999U));
  EXPECT_NE(quantilesAt(design, 1, 0), quantilesAt(design, 1, std::uint64_t{1} << 32U));
}

TEST(Permutation, ComesEverywhereOnce) {
  for (const std::uint64_t count : {1U, 2U, 3U, 5U, 64U, 65U, 1000U}) {
    std::set<std::uint64_t> places;
    for (std::uint64_t i = 0; i < count; ++i) {
      places.insert(permuted(i, count, 0x123456789abcdefU));
    }
    EXPECT_EQ(places.size(), count);
    EXPECT_EQ(*places.rbegin(), count - 1);
  }
}

// Of 2^m points there is one in each of 2^m strata of every number, the first point among them, and
// scrambling keeps that (Owen 1995).
TEST(Sobol, FillsDyadicStrataEvenly) {
  for (const std::uint64_t points : {8U, 256U}) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      for (std::size_t j = 0; j < 8; ++j) {
        std::set<std::uint64_t> strata;
        for (std::uint64_t i = 0; i < points; ++i) {
          const double u = sobolPoint(8, i, seed)[j];
          ASSERT_GT(u, 0.0);
          ASSERT_LT(u, 1.0);
          strata.insert(static_cast<std::uint64_t>(u * static_cast<double>(points)));
        }
        EXPECT_EQ(strata.size(), points) << "number " << j << ", seed " << seed;
      }
    }
  }
}

// In two dimensions the first 2^m points are a (0, m, 2)-net: one in every elementary rectangle.
TEST(Sobol, ScramblingKeepsTheNet) {
  constexpr std::uint64_t kPoints = 64;
  for (unsigned k = 0; k <= 6; ++k) {
    std::set<std::pair<std::uint64_t, std::uint64_t>> boxes;
    for (std::uint64_t i = 0; i < kPoints; ++i) {
      const std::vector<double> u = sobolPoint(2, i, 5);
      boxes.emplace(static_cast<std::uint64_t>(u[0] * static_cast<double>(1U << k)),
                    static_cast<std::uint64_t>(u[1] * static_cast<double>(1U << (6 - k))));
    }
    EXPECT_EQ(boxes.size(), kPoints) << "2^" << k << " columns";
  }
}

// Scrambled, each point alone is distributed evenly over the cube: its mean over seeds is 1/2, its
// variance 1/12, and seeds and replicates differ.
TEST(Sobol, TheSeedMovesEveryPoint) {
  constexpr int kSeeds = 2000;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const double u = sobolPoint(3, 0, seed)[2];
    sum += u;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / kSeeds, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kSeeds));
  EXPECT_NEAR(squares / kSeeds, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / kSeeds));
  EXPECT_NE(sobolPoint(2, 7, 1), sobolPoint(2, 7, 2));
  EXPECT_NE(sobolPoint(2, 7, 1, 0), sobolPoint(2, 7, 1, 1));
}

TEST(Sobol, AnyOrderGivesTheSamePoints) {
  const std::vector<double> late = sobolPoint(5, 12345, 9);
  static_cast<void>(sobolPoint(5, 0, 9));
  static_cast<void>(sobolPoint(3, 12345, 9));
  EXPECT_EQ(sobolPoint(5, 12345, 9), late);
  for (std::uint64_t i = 12340; i < 12345; ++i) {
    static_cast<void>(sobolPoint(5, i, 9));
  }
  EXPECT_EQ(sobolPoint(5, 12345, 9), late);
}

TEST(SobolIndices, RowsDifferInTheOneNumber) {
  Design design = of(Design::Kind::kSobolIndices, 50, 3);
  design.base = 10;
  for (std::uint64_t row = 0; row < 10; ++row) {
    const std::vector<double> a = quantilesAt(design, 1, row * 5);
    const std::vector<double> b = quantilesAt(design, 1, row * 5 + 1);
    for (std::size_t j = 0; j < 3; ++j) {
      std::vector<double> changed = a;
      changed[j] = b[j];
      EXPECT_EQ(quantilesAt(design, 1, row * 5 + 2 + j), changed);
    }
  }
}

TEST(Morris, EachStepChangesOneNumberByHalfItsRange) {
  Design design = of(Design::Kind::kMorris, 20 * 5, 4);
  design.base = 20;
  design.levels = {6};
  for (std::uint64_t t = 0; t < design.base; ++t) {
    const std::vector<MorrisStep> steps = morrisSteps(design, 5, t);
    std::set<std::size_t> changed;
    std::vector<double> before = quantilesAt(design, 5, t * 5);
    for (std::uint64_t k = 0; k < 4; ++k) {
      const std::vector<double> after = quantilesAt(design, 5, t * 5 + k + 1);
      for (std::size_t j = 0; j < 4; ++j) {
        const double moved = j == steps[k].number ? (steps[k].up ? 0.5 : -0.5) : 0.0;
        EXPECT_NEAR(after[j] - before[j], moved, 1e-15);
        EXPECT_GT(after[j], 0.0);
        EXPECT_LT(after[j], 1.0);
      }
      changed.insert(steps[k].number);
      before = after;
    }
    EXPECT_EQ(changed.size(), 4U);
  }
}

TEST(Grid, TheLastNumberVariesFastest) {
  Design design = of(Design::Kind::kGrid, 6, 2);
  design.levels = {2, 3};
  EXPECT_EQ(levelsAt(design, 0), (std::vector<std::optional<std::size_t>>{0, 0}));
  EXPECT_EQ(levelsAt(design, 1), (std::vector<std::optional<std::size_t>>{0, 1}));
  EXPECT_EQ(levelsAt(design, 5), (std::vector<std::optional<std::size_t>>{1, 2}));
}

TEST(OneAtATime, BeginsWithTheSceneAsItIs) {
  Design design = of(Design::Kind::kOneAtATime, 6, 2);
  design.levels = {2, 3};
  EXPECT_EQ(levelsAt(design, 0), (std::vector<std::optional<std::size_t>>{{}, {}}));
  EXPECT_EQ(levelsAt(design, 2), (std::vector<std::optional<std::size_t>>{1, {}}));
  EXPECT_EQ(levelsAt(design, 3), (std::vector<std::optional<std::size_t>>{{}, 0}));
  EXPECT_EQ(levelsAt(design, 5), (std::vector<std::optional<std::size_t>>{{}, 2}));
}

}  // namespace design_test
}  // namespace whirl_twin
