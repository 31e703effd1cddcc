// Bars and maps: well-formed SVG, a bar for each value, contours at the right positions.
#include "plots/bar_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "plots/response_map.h"
#include "svg_text.h"

namespace whirl_twin {
namespace bar_chart_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kFirstColour = "rgb(0%,44.7%,69.8%)";

BarChart chartOf(const std::vector<Bar>& bars) {
  BarChart chart;
  chart.title = "indices <of> k & c";
  chart.x.label = "part of the variance";
  chart.names = {"total"};
  for (std::size_t i = 0; i < bars.size(); ++i) {
    chart.groups.push_back({"number_" + std::to_string(i), {bars[i]}});
  }
  return chart;
}

TEST(BarChart, HasABarForEveryFiniteValueAndSaysWhatItShows) {
  const std::string text =
      barImage(chartOf({{0.8, 0.7, 0.9}, {-0.1, kNaN, kNaN}, {kNaN, 0.0, 1.0}}), ImageFormat::kSvg);
  EXPECT_TRUE(wellFormed(text));
  EXPECT_EQ(countOf(text, kFirstColour), 2U);
  EXPECT_NE(text.find("indices &lt;of&gt; k &amp; c"), std::string::npos);
  EXPECT_NE(text.find("part of the variance of number_0, number_1, number_2"), std::string::npos);
  EXPECT_TRUE(wellFormed(barImage(chartOf({}), ImageFormat::kSvg)));
  EXPECT_TRUE(wellFormed(barImage(chartOf({{kNaN, kNaN, kNaN}}), ImageFormat::kSvg)));
  EXPECT_EQ(barImage(chartOf({{1.0, 1.0, 1.0}}), ImageFormat::kPng).substr(0, 4), "\x89PNG");
}

// f = x + y over the unit square: the line f = 1/2 goes from (1/2, 0) to (0, 1/2).
TEST(ResponseMap, AContourIsWhereTheValueIs) {
  const auto pieces = contourIn(0.0, 1.0, 1.0, 2.0, 0.5);
  ASSERT_EQ(pieces.size(), 1U);
  ASSERT_EQ(pieces[0].size(), 2U);
  for (const Spot& spot : pieces[0]) {
    EXPECT_NEAR(spot.x + spot.y, 0.5, 1e-15);
  }
  EXPECT_TRUE(contourIn(0.0, 1.0, 1.0, 2.0, 3.0).empty());
  EXPECT_TRUE(contourIn(0.0, 1.0, kNaN, 2.0, 0.5).empty());
}

// x y about its saddle: above the middle's value the line keeps to the corners where x y is large.
TEST(ResponseMap, ASaddleHasTwoLinesThatDoNotCross) {
  for (const double value : {0.2, -0.2}) {
    const auto pieces = contourIn(1.0, -1.0, -1.0, 1.0, value);
    ASSERT_EQ(pieces.size(), 2U);
    for (const auto& piece : pieces) {
      ASSERT_EQ(piece.size(), 2U);
      const double x = 0.5 * (piece[0].x + piece[1].x) - 0.5;
      const double y = 0.5 * (piece[0].y + piece[1].y) - 0.5;
      EXPECT_GT(value * x * y, 0.0);
    }
  }
}

TEST(ResponseMap, ShowsHolesAndThinsWhatIsFine) {
  ResponseMap map;
  map.title = "peak";
  map.x.label = "k (N/m)";
  map.y.label = "c (N s/m)";
  map.label = "peak (m)";
  for (int i = 0; i < 300; ++i) {
    map.x_levels.push_back(i);
    map.y_levels.push_back(2.0 * i);
  }
  map.values.assign(300, std::vector<double>(300, 1.0));
  map.values[7][9] = 2.0;
  const std::string whole = mapImage(map, ImageFormat::kSvg);
  EXPECT_TRUE(wellFormed(whole));
  EXPECT_LT(whole.size(), 3'000'000U);
  EXPECT_NE(whole.find("peak (m) over k (N/m) and c (N s/m)"), std::string::npos);
  map.x_levels = {1.0, 2.0};
  map.y_levels = {1.0, 2.0};
  map.values = {{1.0, kNaN}, {2.0, 3.0}};
  map.contours = {{2.5, "limit"}};
  EXPECT_EQ(countOf(mapImage(map, ImageFormat::kSvg), "rgb(80%,80%,80%)"),
            3U);  // cell with its edge, legend
  map.values = {{kNaN, kNaN}, {kNaN, kNaN}};
  EXPECT_TRUE(wellFormed(mapImage(map, ImageFormat::kSvg)));
}

}  // namespace bar_chart_test
}  // namespace whirl_twin
