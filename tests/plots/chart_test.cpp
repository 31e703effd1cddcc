// Charts: well-formed SVG, PNG of the requested size, lines interrupted at missing data.
#include "plots/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "messages/input_error.h"
#include "svg_text.h"

namespace whirl_twin {
namespace chart_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// As Cairo writes the first two colours of the palette.
constexpr const char* kFirstColour = "rgb(0%,44.7%,69.8%)";
constexpr const char* kSecondColour = "rgb(83.5%,36.9%,0%)";

Figure figureOf(const std::vector<Series>& series) {
  Figure figure;
  figure.title = "decay & growth";
  Chart chart;
  chart.x.label = "time (s)";
  chart.y.label = "radius (m)";
  chart.series = series;
  figure.charts = {chart};
  return figure;
}

Series line(const std::string& name, const std::vector<double>& y) {
  Series series{name, {}, y};
  for (std::size_t i = 0; i < y.size(); ++i) {
    series.x.push_back(static_cast<double>(i));
  }
  return series;
}

std::string svg(const Figure& figure) {
  return figureImage(figure, ImageFormat::kSvg);
}

TEST(Chart, IsWellFormedAndNamesWhatItShows) {
  const std::string text =
      svg(figureOf({line("falls", {3.0, 2.0, 1.5}), line("rises < 5", {1.0, 2.0, 4.0})}));
  EXPECT_TRUE(wellFormed(text)) << text;
  for (const char* label :
       {"decay &amp; growth", "time (s)", "radius (m)", "falls", "rises &lt; 5"}) {
    EXPECT_NE(text.find(label), std::string::npos) << label;
  }
}

TEST(Chart, LeavesOutWhatNoAxisReaches) {
  const std::string with = svg(figureOf({line("a", {3.0, 2.0, 1.5, -1.7e308, 1.7e308})}));
  const std::string without = svg(figureOf({line("a", {3.0, 2.0, 1.5, kNaN, kNaN})}));
  // Cairo numbers the surfaces of a process.
  const std::regex surface("surface[0-9]+");
  EXPECT_EQ(std::regex_replace(with, surface, ""), std::regex_replace(without, surface, ""));
  EXPECT_TRUE(wellFormed(svg(figureOf({line("a", {-1.7e308, 1.7e308})}))));
  EXPECT_TRUE(wellFormed(svg(figureOf({line("a", {0.0, 4e-324, 8e-324})}))));
}

TEST(Chart, DrawsEverySeriesInItsColour) {
  const std::string one = svg(figureOf({line("a", {3.0, 2.0, 1.5})}));
  EXPECT_EQ(countOf(one, kFirstColour), 1u);  // no legend for one
  EXPECT_EQ(countOf(one, kSecondColour), 0u);
  const std::string two = svg(figureOf({line("a", {3.0, 2.0, 1.5}), line("b", {1.0, 2.0, 4.0})}));
  EXPECT_EQ(countOf(two, kFirstColour), 2u);  // the curve and its sample in the legend
  EXPECT_EQ(countOf(two, kSecondColour), 2u);
}

TEST(Chart, BreaksALineWhereThereIsNoValue) {
  EXPECT_EQ(countOf(svg(figureOf({line("a", {1.0, 2.0, kNaN, 2.0, 1.0})})), kFirstColour), 2u);
  EXPECT_EQ(countOf(svg(figureOf({line("a", {1.0, kNaN, 2.0, INFINITY, 1.0})})), kFirstColour), 3u);
  EXPECT_EQ(countOf(svg(figureOf({line("a", {kNaN, kNaN})})), kFirstColour), 0u);
}

TEST(Chart, OfALogarithmicAxisBreaksWhereNothingIsPositive) {
  Figure figure = figureOf({line("a", {1.0, 0.1, 0.0, 0.01, -1.0, 10.0})});
  figure.charts[0].y.logarithmic = true;
  const std::string text = svg(figure);
  EXPECT_TRUE(wellFormed(text));
  EXPECT_EQ(countOf(text, kFirstColour), 3u);
}

TEST(Chart, ShowsAReferenceLineOnlyWhereTheDataReachIt) {
  Figure figure = figureOf({line("a", {0.0, 1.0, 2.0})});
  const std::size_t without = countOf(svg(figure), "stroke-dasharray");
  figure.charts[0].horizontal = {{1.0, "limit"}, {50.0, "far away"}};
  figure.charts[0].vertical = {{1.5, "critical"}};
  EXPECT_EQ(countOf(svg(figure), "stroke-dasharray"), without + 2u);
}

TEST(Chart, HasASecondScaleBesideEitherAxis) {
  Figure figure = figureOf({line("a", {0.0, 1.0, 2.0})});
  const std::size_t without = countOf(svg(figure), "<use");
  figure.charts[0].y.second = SecondScale{"rpm", 9.549};
  const std::string text = svg(figure);
  EXPECT_TRUE(wellFormed(text));
  EXPECT_NE(text.find("radius (m), rpm over time (s)"), std::string::npos);
  EXPECT_GT(countOf(text, "<use"), without + 3u);  // letters: its name and marks
}

TEST(Chart, SaysWhatItMarks) {
  Figure figure = figureOf({line("a", {0.0, 1.0, 2.0})});
  figure.charts[0].vertical = {{1.5, "critical"}, {1.7, ""}};
  EXPECT_NE(svg(figure).find("[critical at 1.5]"), std::string::npos);
}

TEST(Chart, ThinsALongSeries) {
  Series wave{"wave", {}, {}};
  Series tangle{"tangle", {}, {}};
  for (int i = 0; i < 200000; ++i) {
    const double t = 1e-3 * i;
    wave.x.push_back(t);
    wave.y.push_back(std::sin(40.0 * t));
    tangle.x.push_back(std::cos(7.0 * t));
    tangle.y.push_back(std::sin(7.31 * t));
  }
  EXPECT_LT(svg(figureOf({wave})).size(), 200'000u);
  EXPECT_LT(svg(figureOf({tangle})).size(), 200'000u);
  EXPECT_LT(svg(figureOf({wave, wave, wave, wave})).size(), 200'000u);
}

TEST(Chart, WithoutDataIsAnEmptyFrame) {
  EXPECT_TRUE(wellFormed(svg(figureOf({}))));
  EXPECT_TRUE(wellFormed(svg(figureOf({line("a", {})}))));
}

TEST(Chart, OfManyNamesGrowsALegendAboveTheCurves) {
  std::vector<Series> many;
  for (int i = 0; i < 20; ++i) {
    many.push_back(line("a rather long name, number " + std::to_string(i), {0.0, 1.0 * i}));
  }
  const std::string text = svg(figureOf(many));
  EXPECT_TRUE(wellFormed(text));
  // Seven colours, then the same dashed: the first is that of 0, 7 and 14, curve and sample.
  EXPECT_EQ(countOf(text, kFirstColour), 6u);
}

/// A number of four bytes, the highest first, as in a PNG's header.
unsigned numberAt(const std::string& png, std::size_t at) {
  unsigned number = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    number = 256 * number + static_cast<unsigned char>(png[i]);
  }
  return number;
}

TEST(Chart, AsPngHasTheSizeAsked) {
  Figure figure = figureOf({line("a", {1.0, 2.0})});
  figure.title.clear();
  figure.width = 640;
  figure.chart_height = 300;
  figure.charts.resize(3, figure.charts[0]);
  figure.columns = 2;
  const std::string png = figureImage(figure, ImageFormat::kPng);
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(numberAt(png, 16), 640u);
  EXPECT_EQ(numberAt(png, 20), 606u);  // two rows and a narrow margin
}

TEST(ImageFormat, IsByExtension) {
  EXPECT_EQ(imageFormat("a/b.svg"), ImageFormat::kSvg);
  EXPECT_EQ(imageFormat("b.png"), ImageFormat::kPng);
  EXPECT_THROW(imageFormat("b.pdf"), InputError);
  EXPECT_THROW(imageFormat("png"), InputError);
}

}  // namespace chart_test
}  // namespace whirl_twin
