// Thinning: fewer points, the same line.
#include "plots/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whirl_twin {
namespace thinning_test {

std::vector<Spot> wave(int points, double cycles, double width, double amplitude) {
  std::vector<Spot> line;
  for (int i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / (points - 1);
    line.push_back({width * s, amplitude * std::sin(2.0 * M_PI * cycles * s)});
  }
  return line;
}

double heightAt(const std::vector<Spot>& line, double x) {
  const auto right =
      std::lower_bound(line.begin() + 1, line.end() - 1, x,
                       [](const Spot& spot, double value) { return spot.x < value; });
  const Spot& a = *(right - 1);
  return a.y + (right->y - a.y) * (x - a.x) / (right->x - a.x);
}

TEST(Thinning, OfAStraightLineLeavesItsEnds) {
  const std::vector<Spot> kept = thinned(wave(1000, 0.0, 700.0, 0.0));
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept.front().x, 0.0);
  EXPECT_EQ(kept.back().x, 700.0);
}

TEST(Thinning, KeepsACurveToAFractionOfAPixel) {
  const std::vector<Spot> line = wave(20001, 5.0, 700.0, 100.0);
  const std::vector<Spot> kept = thinned(line);
  EXPECT_LT(kept.size(), line.size() / 20);
  for (const Spot& spot : line) {
    // 0.12 px from the line; in height by the slope, at most 100 px * 2 pi * 5 / 700 px = 4.5.
    ASSERT_NEAR(heightAt(kept, spot.x), spot.y, 0.12 * std::hypot(1.0, 4.5) + 1e-9);
  }
}

TEST(Thinning, KeepsThePeaksOfAFastOscillation) {
  // Ten cycles a pixel: no screen resolves them, but their extent is visible.
  const std::vector<Spot> kept = thinned(wave(200001, 7000.0, 700.0, 100.0));
  EXPECT_LT(kept.size(), 6000u);  // four points each half pixel at most
  const auto [low, high] = std::minmax_element(
      kept.begin(), kept.end(), [](const Spot& a, const Spot& b) { return a.y < b.y; });
  EXPECT_NEAR(low->y, -100.0, 0.5);
  EXPECT_NEAR(high->y, 100.0, 0.5);
}

TEST(Thinning, StaysBelowTheMost) {
  std::vector<Spot> tangle;  // an orbit that does not close
  for (int i = 0; i < 50000; ++i) {
    tangle.push_back({200.0 * std::cos(0.1 * i), 200.0 * std::sin(0.17320508 * i)});
  }
  std::size_t kept = 0;
  for (const std::vector<Spot>& piece : withoutRepeats(tangle, 2000)) {
    kept += piece.size();
  }
  EXPECT_LE(kept, 2000u);
  EXPECT_GT(kept, 1000u);
}

TEST(Thinning, DropsTheRepeatsOfALoop) {
  std::vector<Spot> loops;
  for (int i = 0; i < 6000; ++i) {
    loops.push_back({200.0 * std::cos(2.0 * M_PI * i / 60), 200.0 * std::sin(2.0 * M_PI * i / 60)});
  }
  std::size_t kept = 0;
  for (const std::vector<Spot>& piece : withoutRepeats(loops, 1000)) {
    kept += piece.size();
  }
  EXPECT_GE(kept, 60u);
  EXPECT_LE(kept, 70u);  // one of a hundred rounds, and what rounding makes of its ends
}

TEST(Thinning, KeepsALineThatOnlyCrossesItself) {
  const std::vector<Spot> eight{{0, 0}, {100, 100}, {100, 0}, {0, 100}, {0, 0}};
  const std::vector<std::vector<Spot>> pieces = withoutRepeats(eight, 100);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].size(), eight.size());
}

TEST(Thinning, LeavesPointsAndPairsAlone) {
  EXPECT_TRUE(thinned({}).empty());
  EXPECT_EQ(thinned({{1.0, 2.0}}).size(), 1u);
  EXPECT_EQ(thinned({{1.0, 2.0}, {1.0, 2.0}}).size(), 2u);
}

}  // namespace thinning_test
}  // namespace whirl_twin
