// Figures as data: what Python draws.
#include "reports/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace whirl_twin {
namespace figure_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Figure figureOf(const Series& series) {
  Figure figure;
  figure.title = "decay & growth";
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = "radius (m)";
  chart.series = {series};
  figure.charts = {chart};
  return figure;
}

TEST(Figure, KeepsEveryValueAndMarksWhatNoAxisReaches) {
  const double third = 1.0 / 3.0;
  const Json json =
      figureJson(figureOf({"a", {0, 1, 2, 3, 4}, {third, -0.0, kNaN, kInfinity, -1.7e308}}));
  const Json& series = json["charts"][0]["series"][0];
  EXPECT_EQ(series["y"][0].get<double>(), third);
  EXPECT_FALSE(std::signbit(series["y"][1].get<double>()));
  for (const std::size_t k : {2U, 3U, 4U}) {
    EXPECT_TRUE(series["y"][k].is_null()) << k;
  }
  EXPECT_EQ(series["x"].size(), series["y"].size());
  EXPECT_EQ(json["title"], "decay & growth");
  EXPECT_EQ(json["charts"][0]["x"]["label"], "time (s)");
  EXPECT_TRUE(json["charts"][0]["x"]["tight"].get<bool>());
  // And once more from its text: nothing is lost on the way to Python.
  EXPECT_EQ(Json::parse(json.dump())["charts"][0]["series"][0]["y"][0].get<double>(), third);
}

TEST(Figure, HasColoursAsHtmlHasThem) {
  Series series{"a", {0.0}, {1.0}, Pen{ink::kVermilion, 2.5, {3.0, 1.0}}};
  series.marks = Marks::kRings;
  series.fill = paler(ink::kBlack, 1.0);
  const Json json = figureJson(figureOf(series))["charts"][0]["series"][0];
  EXPECT_EQ(json["pen"]["color"], "#d55e00");
  EXPECT_EQ(json["pen"]["width"], 2.5);
  EXPECT_EQ(json["pen"]["dash"], (Json{3.0, 1.0}));
  EXPECT_EQ(json["fill"], "#ffffff");
  EXPECT_EQ(json["marks"], "rings");
  EXPECT_TRUE(figureJson(figureOf({"a", {}, {}}))["charts"][0]["series"][0]["pen"].is_null());
}

TEST(Figure, OfBarsAndMapsHasHolesWhereNothingIsKnown) {
  BarChart bars;
  bars.names = {"first order", "total"};
  bars.groups = {{"stiffness", {{0.5, 0.4, 0.6}, {kNaN, kNaN, kNaN}}}};
  const Json group = figureJson(bars)["groups"][0];
  EXPECT_EQ(group["bars"][0]["high"], 0.6);
  EXPECT_TRUE(group["bars"][1]["value"].is_null());

  ResponseMap map;
  map.x_levels = {1.0, 2.0};
  map.y_levels = {5.0, 6.0};
  map.values = {{1.0, kNaN}, {3.0, 4.0}};
  map.contours = {{2.5, "limit of peak < 2.5"}};
  const Json json = figureJson(map);
  EXPECT_EQ(json["values"][1], (Json{3.0, 4.0}));
  EXPECT_TRUE(json["values"][0][1].is_null());
  EXPECT_EQ(json["contours"][0]["label"], "limit of peak < 2.5");
}

SketchPicture everyPart() {
  SketchPicture picture;
  picture.title = "rig";
  Sketch& sketch = picture.sketch;
  sketch.rods = {{{}, {0.5, 0.0, 0.5}, 0.02, SketchRole::kBody}};
  sketch.balls = {{{}, 0.1, SketchRole::kMass}};
  sketch.discs = {{{}, {0.0, 1.0, 0.0}, 0.3, 0.05, 0.4, SketchRole::kBody}};
  sketch.boxes = {{{}, {0.3, 0.2, 0.1}, 0.2, SketchRole::kSupport}};
  sketch.springs = {{{}, {0.5, 0.0, 0.0}, 0.05}};
  sketch.dampers = {{{}, {0.5, 0.0, 0.0}, 0.02}};
  sketch.arrows = {{{}, {0.0, 0.0, 1.0}}};
  sketch.lines = {{{{-1.0, 0.0, -1.0}, {1.0, 0.0, 1.0}}, SketchRole::kMark}};
  picture.ghosts = {sketch};
  picture.trace = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.2}};
  return picture;
}

TEST(Figure, OfASketchHasEveryPartWithItsRole) {
  const Json json = figureJson(everyPart());
  const Json& sketch = json["sketch"];
  for (const char* kind :
       {"rods", "balls", "discs", "boxes", "springs", "dampers", "arrows", "lines"}) {
    ASSERT_EQ(sketch[kind].size(), 1U) << kind;
  }
  EXPECT_EQ(sketch["rods"][0]["to"], (Json{0.5, 0.0, 0.5}));
  EXPECT_EQ(sketch["balls"][0]["role"], "mass");
  EXPECT_EQ(sketch["boxes"][0]["role"], "support");
  EXPECT_EQ(sketch["lines"][0]["role"], "mark");
  EXPECT_EQ(json["ghosts"][0], sketch);
  EXPECT_EQ(json["trace"].size(), 2U);
}

TEST(Figure, OfASketchFitsASheetUnlessAPartIsEndlesslyFar) {
  EXPECT_TRUE(fitsASheet(everyPart()));
  for (const double far : {1.1e100, -1.0e200, kInfinity, kNaN}) {
    SketchPicture picture = everyPart();
    picture.sketch.rods[0].to.x = far;
    EXPECT_FALSE(fitsASheet(picture)) << far;
    picture = everyPart();
    picture.trace.push_back({0.0, 0.0, far});
    EXPECT_FALSE(fitsASheet(picture)) << far;
  }
}

}  // namespace figure_test
}  // namespace whirl_twin
