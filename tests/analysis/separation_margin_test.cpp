// API 617/684 separation margins: reference numbers, caps, and bands that follow from them.
#include "analysis/separation_margin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace whirl_twin {
namespace separation_margin_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(SeparationMargin, RequiredMarginsAgreeWithTheReferenceTable) {
  std::ifstream file(std::string(WHIRL_TWIN_REFERENCE) + "/rotor_cases.json");
  const nlohmann::json cases = nlohmann::json::parse(file);
  int rows = 0;
  for (const auto& entry : cases) {
    if (entry.at("id") != "A05_api_amplification_factor") {
      continue;
    }
    for (const auto& row : entry.at("expected").at(0).at("value")) {
      const double amplification_factor = row.at("AF");
      // The table is without the caps of the standard.
      const double below = std::min(16.0, row.at("SM_below_percent").get<double>());
      const double above = std::min(26.0, row.at("SM_above_percent").get<double>());
      // The same formula in the same precision: only rounding differs.
      EXPECT_NEAR(requiredMarginBelow(amplification_factor), below, 1e-12);
      EXPECT_NEAR(requiredMarginAbove(amplification_factor), above, 1e-12);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 4);
}

TEST(SeparationMargin, CapsAreReachedAtAmplificationEighteenAndAHalf) {
  EXPECT_LT(requiredMarginBelow(18.4), 16.0);
  EXPECT_LT(requiredMarginAbove(18.4), 26.0);
  // 17 (1 - 1/17) = 16 up to rounding.
  EXPECT_NEAR(requiredMarginBelow(18.5), 16.0, 1e-12);
  EXPECT_NEAR(requiredMarginAbove(18.5), 26.0, 1e-12);
  EXPECT_EQ(requiredMarginBelow(50.0), 16.0);
  EXPECT_EQ(requiredMarginAbove(50.0), 26.0);
  EXPECT_EQ(requiredMarginBelow(std::numeric_limits<double>::infinity()), 16.0);
}

TEST(SeparationMargin, CriticallyDampedModesNeedNone) {
  for (const double amplification_factor : {kNaN, 0.0, 1.0, 2.4999}) {
    EXPECT_EQ(requiredMarginBelow(amplification_factor), 0.0);
    EXPECT_EQ(requiredMarginAbove(amplification_factor), 0.0);
    const SpeedBand band = criticalBand(100.0, amplification_factor);
    EXPECT_TRUE(band.empty());
    EXPECT_EQ(band.from, 100.0);
    EXPECT_EQ(band.to, 100.0);
  }
  EXPECT_EQ(requiredMarginBelow(2.5), 0.0);
  EXPECT_EQ(requiredMarginAbove(2.5), 10.0);
}

TEST(SeparationMargin, AtTheEdgesOfTheBandTheActualMarginIsTheRequiredOne) {
  for (const double amplification_factor : {2.6, 4.0, 9.9, 50.0}) {
    const SpeedBand band = criticalBand(100.0, amplification_factor);
    ASSERT_LT(band.from, 100.0);
    ASSERT_GT(band.to, 100.0);
    EXPECT_NEAR(separationMargin(band.from, 100.0), requiredMarginAbove(amplification_factor),
                1e-11);
    EXPECT_NEAR(separationMargin(band.to, 100.0), requiredMarginBelow(amplification_factor), 1e-11);
    EXPECT_LT(separationMargin(1.001 * band.from, 100.0),
              requiredMarginAbove(amplification_factor));
    EXPECT_LT(separationMargin(0.999 * band.to, 100.0), requiredMarginBelow(amplification_factor));
  }
}

TEST(SeparationMargin, IsAPercentageOfTheRunningSpeedInEitherSenseOfRotation) {
  EXPECT_DOUBLE_EQ(separationMargin(125.0, 100.0), 20.0);
  EXPECT_DOUBLE_EQ(separationMargin(80.0, 100.0), 25.0);
  EXPECT_DOUBLE_EQ(separationMargin(-80.0, 100.0), 25.0);
  EXPECT_TRUE(std::isnan(separationMargin(0.0, 100.0)));
  EXPECT_TRUE(std::isnan(separationMargin(kNaN, 100.0)));
}

TEST(SeparationMargin, ACriticalSpeedIsSeenFromTheSideTheRotorRunsOn) {
  const state::CriticalSpeedMargin subcritical = criticalSpeedMargin(-80.0, 100.0, "forward", 50.0);
  EXPECT_EQ(subcritical.required_separation_margin, 26.0);
  EXPECT_DOUBLE_EQ(subcritical.separation_margin, 25.0);
  const state::CriticalSpeedMargin supercritical =
      criticalSpeedMargin(125.0, 100.0, "backward", 50.0);
  EXPECT_EQ(supercritical.required_separation_margin, 16.0);
  EXPECT_DOUBLE_EQ(supercritical.separation_margin, 20.0);
  EXPECT_EQ(supercritical.direction, "backward");
  EXPECT_DOUBLE_EQ(supercritical.band_low, 100.0 / 1.26);
  EXPECT_DOUBLE_EQ(supercritical.band_high, 100.0 / 0.84);
}

}  // namespace separation_margin_test
}  // namespace whirl_twin
