#include "plots/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plots/marked_axis.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kMostSpots = 10000;  // of a whole SVG
constexpr double kLegendRow = 20.0;        // px
constexpr double kSample = 24.0;           // px, of a line in the legend
constexpr int kTicksAcross = 9;
constexpr double kPixelsPerTick = 30.0;  // of a vertical axis, at least

const Lettering kFigureTitle{17.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};
const Lettering kChartTitle{14.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};
const Lettering kAxisLabel{14.0, ink::kBlack, Align::kMiddle, Align::kMiddle};
const Lettering kTickLabel{13.0, ink::kBlack, Align::kMiddle, Align::kMiddle};
const Lettering kLegend{13.0, ink::kBlack, Align::kStart, Align::kMiddle};
const Lettering kReference{12.0, ink::kGrey, Align::kEnd, Align::kEnd};

/// Seven colours, then the same dashed.
Pen penOf(std::size_t series) {
  static constexpr std::array kInks{ink::kBlue,    ink::kVermilion, ink::kGreen, ink::kPurple,
                                    ink::kSkyBlue, ink::kOrange,    ink::kBlack};
  Pen pen{kInks[series % kInks.size()], 1.8};
  if (series >= kInks.size()) {
    pen.dash = {7.0, 4.0};
  }
  return pen;
}

struct Rectangle {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

AxisRange rangeOf(const std::vector<Series>& series, std::vector<double> Series::*values,
                  bool logarithmic) {
  std::vector<const std::vector<double>*> all;
  for (const Series& s : series) {
    all.push_back(&(s.*values));
  }
  return dataRange(all, logarithmic);
}

class ChartDrawing {
 public:
  ChartDrawing(const Chart& chart, const Rectangle& place, std::size_t most_spots, Canvas& canvas)
      : chart_(chart), place_(place), most_spots_(most_spots), canvas_(canvas) {
    x_ = {rangeOf(chart.series, &Series::x, chart.x.logarithmic), chart.x.logarithmic, {}, {}};
    y_ = {rangeOf(chart.series, &Series::y, chart.y.logarithmic), chart.y.logarithmic, {}, {}};
    placeLegend();
    plot_.top = place.top + (chart.title.empty() ? 8.0 : 28.0) + kLegendRow * legend_rows_ +
                (legend_rows_ > 0 ? 6.0 : 4.0);
    plot_.height = place.bottom() - 50.0 - plot_.top;
    y_.mark(chart.y.tight, std::max(4, static_cast<int>(plot_.height / kPixelsPerTick)));
    if (y_.labels.exponent != 0) {  // it stands above the axis
      plot_.top += 14.0;
      plot_.height -= 14.0;
    }
  }

  /// [px] that the labels of the vertical axis need.
  double leftMargin() const {
    double widest = 0.0;
    for (const std::string& label : y_.labels.text) {
      widest = std::max(widest, canvas_.textWidth(label, kTickLabel));
    }
    return widest + 40.0;
  }

  void draw(double left_margin) {
    plot_.left = place_.left + left_margin;
    plot_.width = place_.right() - 22.0 - plot_.left;
    x_.mark(chart_.x.tight, std::min(kTicksAcross, static_cast<int>(plot_.width / 60.0)));
    if (chart_.equal_aspect) {
      makeAspectEqual();
    }
    drawGrid();
    drawReferences();
    canvas_.clip({plot_.left - 1.0, plot_.top - 1.0}, plot_.width + 2.0, plot_.height + 2.0);
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      drawSeries(chart_.series[i], penOf(i));
    }
    canvas_.unclip();
    drawFrame();
    drawLegend();
  }

 private:
  /// The names in as many rows as they need: they cover no curve.
  void placeLegend() {
    if (chart_.series.size() < 2) {
      return;
    }
    const double start = place_.left + 60.0;
    double x = start;
    legend_rows_ = 1;
    for (const Series& series : chart_.series) {
      const double width = kSample + 8.0 + canvas_.textWidth(series.name, kLegend);
      if (x > start && x + width > place_.right()) {
        x = start;
        ++legend_rows_;
      }
      legend_.push_back({x, kLegendRow * (legend_rows_ - 0.5)});
      x += width + 22.0;
    }
  }

  void makeAspectEqual() {
    const double units = std::max((x_.range.high - x_.range.low) / plot_.width,
                                  (y_.range.high - y_.range.low) / plot_.height);
    const auto stretch = [units](MarkedAxis& axis, double pixels, int most) {
      const double middle = 0.5 * (axis.range.low + axis.range.high);
      axis.range = {middle - 0.5 * units * pixels, middle + 0.5 * units * pixels};
      axis.mark(true, most);
    };
    stretch(x_, plot_.width, kTicksAcross);
    stretch(y_, plot_.height, kTicksAcross);
  }

  Spot at(double x, double y) const {
    return {plot_.left + x_.place(x) * plot_.width, plot_.bottom() - y_.place(y) * plot_.height};
  }
  static bool seen(double place) { return place > -1.0e-6 && place < 1.0 + 1.0e-6; }

  void drawGrid() {
    const Pen grid{ink::kGrid, 1.0};
    for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
      const double x = plot_.left + x_.place(x_.ticks[i]) * plot_.width;
      if (seen(x_.place(x_.ticks[i]))) {
        canvas_.line({{x, plot_.top}, {x, plot_.bottom()}}, grid);
        canvas_.text({x, plot_.bottom() + 13.0}, x_.labels.text[i], kTickLabel);
      }
    }
    Lettering tick_label = kTickLabel;
    tick_label.across = Align::kEnd;
    for (std::size_t i = 0; i < y_.ticks.size(); ++i) {
      const double y = plot_.bottom() - y_.place(y_.ticks[i]) * plot_.height;
      if (seen(y_.place(y_.ticks[i]))) {
        canvas_.line({{plot_.left, y}, {plot_.right(), y}}, grid);
        canvas_.text({plot_.left - 7.0, y}, y_.labels.text[i], tick_label);
      }
    }
  }

  void drawReferences() {
    const Pen pen{ink::kGrey, 1.2, {6.0, 4.0}};
    for (const ReferenceLine& line : chart_.horizontal) {
      if (seen(y_.place(line.at))) {
        const double y = plot_.bottom() - y_.place(line.at) * plot_.height;
        canvas_.line({{plot_.left, y}, {plot_.right(), y}}, pen);
        canvas_.text({plot_.right() - 5.0, y - 4.0}, line.label, kReference);
      }
    }
    Lettering upright = kReference;
    upright.upwards = true;
    for (const ReferenceLine& line : chart_.vertical) {
      if (seen(x_.place(line.at))) {
        const double x = plot_.left + x_.place(line.at) * plot_.width;
        canvas_.line({{x, plot_.top}, {x, plot_.bottom()}}, pen);
        canvas_.text({x - 4.0, plot_.top + 5.0}, line.label, upright);
      }
    }
  }

  void drawSeries(const Series& series, const Pen& pen) {
    std::vector<Spot> line;
    const auto finish = [&] {
      drawLine(thinned(line), pen);
      line.clear();
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const Spot spot = at(series.x[i], series.y[i]);
      if (std::isfinite(spot.x) && std::isfinite(spot.y)) {
        line.push_back(spot);
      } else {
        finish();
      }
    }
    finish();
  }

  void drawLine(const std::vector<Spot>& line, const Pen& pen) {
    if (line.size() <= most_spots_) {
      canvas_.line(line, pen);
    } else {
      canvas_.lines(withoutRepeats(line, most_spots_), pen);
    }
  }

  void drawFrame() {
    const Pen frame{ink::kGrey, 1.2};
    canvas_.line({{plot_.left, plot_.top},
                  {plot_.right(), plot_.top},
                  {plot_.right(), plot_.bottom()},
                  {plot_.left, plot_.bottom()},
                  {plot_.left, plot_.top}},
                 frame);
    const double middle = plot_.left + 0.5 * plot_.width;
    canvas_.text({middle, place_.top + 14.0}, chart_.title, kChartTitle);
    canvas_.text({middle, plot_.bottom() + 34.0}, chart_.x.label, kAxisLabel);
    Lettering upwards = kAxisLabel;
    upwards.upwards = true;
    canvas_.text({place_.left + 14.0, plot_.top + 0.5 * plot_.height}, chart_.y.label, upwards);
    drawExponent(y_, {plot_.left - 4.0, plot_.top - 11.0}, Align::kStart);
    drawExponent(x_, {plot_.right(), plot_.bottom() + 34.0}, Align::kEnd);
  }
  void drawExponent(const MarkedAxis& axis, const Spot& spot, Align across) {
    if (axis.labels.exponent != 0) {
      Lettering lettering = kTickLabel;
      lettering.across = across;
      canvas_.text(spot, "\u00d7" + powerOfTen(axis.labels.exponent), lettering);
    }
  }

  void drawLegend() {
    const double top = place_.top + (chart_.title.empty() ? 4.0 : 28.0);
    for (std::size_t i = 0; i < legend_.size(); ++i) {
      const Spot start{legend_[i].x, top + legend_[i].y};
      canvas_.line({start, {start.x + kSample, start.y}}, penOf(i));
      canvas_.text({start.x + kSample + 8.0, start.y}, chart_.series[i].name, kLegend);
    }
  }

  const Chart& chart_;
  Rectangle place_, plot_;
  std::size_t most_spots_;  // of each series
  Canvas& canvas_;
  MarkedAxis x_, y_;
  std::vector<Spot> legend_;
  int legend_rows_ = 0;
};

/// The figure in words.
std::string description(const Figure& figure) {
  std::string text;
  for (const Chart& chart : figure.charts) {
    text +=
        fmt::format("{}{}{} over {}:", text.empty() ? "" : "; ",
                    chart.title.empty() ? "" : chart.title + ": ", chart.y.label, chart.x.label);
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
      text += fmt::format("{}{}", i == 0 ? " " : ", ", chart.series[i].name);
    }
  }
  return text;
}

}  // namespace

std::string figureImage(const Figure& figure, ImageFormat format) {
  const int count = static_cast<int>(figure.charts.size());
  const int rows = (count + figure.columns - 1) / figure.columns;
  const double top = figure.title.empty() ? 6.0 : 36.0;
  Canvas canvas(format, figure.width, static_cast<int>(top) + rows * figure.chart_height,
                figure.title, description(figure));
  canvas.text({0.5 * figure.width, 19.0}, figure.title, kFigureTitle);

  const std::size_t most_spots =
      format == ImageFormat::kSvg ? kMostSpots : std::numeric_limits<std::size_t>::max();
  std::size_t all_series = 0;
  for (const Chart& chart : figure.charts) {
    all_series += chart.series.size();
  }
  std::vector<ChartDrawing> drawings;
  drawings.reserve(figure.charts.size());
  std::vector<double> margins(static_cast<std::size_t>(figure.columns), 0.0);
  const double width = static_cast<double>(figure.width) / figure.columns;
  for (int i = 0; i < count; ++i) {
    const int column = i % figure.columns;
    const Rectangle place{column * width, top + i / figure.columns * figure.chart_height, width,
                          static_cast<double>(figure.chart_height)};
    drawings.emplace_back(figure.charts[static_cast<std::size_t>(i)], place,
                          most_spots / std::max<std::size_t>(all_series, 1), canvas);
    double& margin = margins[static_cast<std::size_t>(column)];
    margin = std::max(margin, drawings.back().leftMargin());
  }
  for (int i = 0; i < count; ++i) {
    drawings[static_cast<std::size_t>(i)].draw(
        margins[static_cast<std::size_t>(i % figure.columns)]);
  }
  return canvas.finish();
}

}  // namespace whirl_twin
