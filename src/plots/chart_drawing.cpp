#include "plots/chart_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kLegendRow = 20.0;  // px
constexpr double kSample = 24.0;     // px, of a line in the legend
constexpr int kTicksAcross = 9;
constexpr double kPixelsPerTick = 30.0;  // minimum, of a vertical axis

const Lettering kChartTitle{14.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};
constexpr double kSecondScale = 34.0;  // px, of the horizontal axis above the chart
constexpr double kRightMargin = 22.0;  // px
constexpr double kPixelsOfRpm = 90.0;  // minimum distance of ticks of the upper scale

/// Its own pen, or one of seven colours, then the same dashed.
Pen penOf(const Chart& chart, std::size_t series) {
  if (chart.series[series].pen) {
    return *chart.series[series].pen;
  }
  static constexpr std::array kInks{ink::kBlue,    ink::kVermilion, ink::kGreen, ink::kPurple,
                                    ink::kSkyBlue, ink::kOrange,    ink::kBlack};
  Pen pen{kInks[series % kInks.size()], 1.8};
  if (series >= kInks.size()) {
    pen.dash = {7.0, 4.0};
  }
  return pen;
}

AxisRange rangeOf(const std::vector<Series>& series, std::vector<double> Series::*values,
                  bool logarithmic) {
  std::vector<const std::vector<double>*> all;
  for (const Series& s : series) {
    all.push_back(&(s.*values));
  }
  return dataRange(all, logarithmic);
}

/// The axis in its second unit.
MarkedAxis scaled(const MarkedAxis& axis, const SecondScale& second, int most) {
  MarkedAxis other{
      {second.factor * axis.range.low, second.factor * axis.range.high}, false, {}, {}};
  other.mark(true, most);
  return other;
}

/// "rpm", with the power of ten of its ticks.
std::string nameOf(const SecondScale& second, const MarkedAxis& axis) {
  return axis.labels.exponent == 0 ? second.label
                                   : second.label + " \u00d7" + powerOfTen(axis.labels.exponent);
}

}  // namespace

ChartDrawing::ChartDrawing(const Chart& chart, const Rectangle& place, std::size_t most_spots,
                           Canvas& canvas)
    : chart_(chart), place_(place), most_spots_(most_spots), canvas_(canvas) {
  x_ = {rangeOf(chart.series, &Series::x, chart.x.logarithmic),
        chart.x.logarithmic,
        {},
        {},
        chart.x.degrees};
  y_ = {rangeOf(chart.series, &Series::y, chart.y.logarithmic),
        chart.y.logarithmic,
        {},
        {},
        chart.y.degrees};
  placeLegend();
  plot_.top = place.top + (chart.title.empty() ? 8.0 : 28.0) + kLegendRow * legend_rows_ +
              (legend_rows_ > 0 ? 6.0 : 4.0);
  plot_.height = place.bottom() - 50.0 - plot_.top;
  const int most = std::max(4, static_cast<int>(plot_.height / kPixelsPerTick));
  y_.mark(chart.y.tight, most);
  if (chart.y.second) {
    right_ = scaled(y_, *chart.y.second, most);
  }
  // The exponent and the second scale are above the axes.
  const double above = chart.x.second ? kSecondScale : y_.labels.exponent != 0 ? 14.0 : 0.0;
  plot_.top += above;
  plot_.height -= above;
}

double ChartDrawing::widestLabel(const MarkedAxis& axis) const {
  double widest = 0.0;
  for (const std::string& label : axis.labels.text) {
    widest = std::max(widest, canvas_.textWidth(label, kTickLettering));
  }
  return widest;
}

double ChartDrawing::leftMargin() const {
  return widestLabel(y_) + 40.0;
}

double ChartDrawing::rightMargin() const {
  return right_ ? widestLabel(*right_) + 40.0 : kRightMargin;
}

void ChartDrawing::draw(double left_margin, double right_margin) {
  plot_.left = place_.left + left_margin;
  plot_.width = place_.right() - right_margin - plot_.left;
  x_.mark(chart_.x.tight, std::min(kTicksAcross, static_cast<int>(plot_.width / 60.0)));
  if (chart_.equal_aspect) {
    markEqually(x_, plot_.width, y_, plot_.height, kTicksAcross);
  }
  drawBands();
  drawGrid();
  drawReferences();
  canvas_.clip({plot_.left - 1.0, plot_.top - 1.0}, plot_.width + 2.0, plot_.height + 2.0);
  for (const Series& series : chart_.series) {
    if (series.fill) {
      drawArea(series);
    }
  }
  for (std::size_t i = 0; i < chart_.series.size(); ++i) {
    if (chart_.series[i].line && !chart_.series[i].fill) {
      drawSeries(chart_.series[i], penOf(chart_, i));
    }
  }
  for (std::size_t i = 0; i < chart_.series.size(); ++i) {
    drawMarks(chart_.series[i], penOf(chart_, i));
  }
  canvas_.unclip();
  drawFrame();
  drawScaleAbove();
  drawScaleOnTheRight();
  drawWords();
  drawLegend();
}

/// The names in as many rows as needed, without overlap with curves.
void ChartDrawing::placeLegend() {
  for (std::size_t i = 0; i < chart_.series.size(); ++i) {
    if (!chart_.series[i].name.empty()) {
      legend_.push_back({chart_.series[i].name, {}, &chart_.series[i], nullptr, penOf(chart_, i)});
    }
  }
  for (const Band& band : chart_.bands) {
    if (!band.name.empty()) {
      legend_.push_back({band.name, {}, nullptr, &band, {}});
    }
  }
  if (legend_.size() < 2) {
    legend_.clear();
    return;
  }
  const double start = place_.left + 60.0;
  double x = start;
  legend_rows_ = 1;
  for (LegendEntry& entry : legend_) {
    const double width = kSample + 8.0 + canvas_.textWidth(entry.name, kLegendLettering);
    if (x > start && x + width > place_.right()) {
      x = start;
      ++legend_rows_;
    }
    entry.spot = {x, kLegendRow * (legend_rows_ - 0.5)};
    x += width + 22.0;
  }
}

Spot ChartDrawing::at(double x, double y) const {
  return {plot_.left + x_.place(x) * plot_.width, plot_.bottom() - y_.place(y) * plot_.height};
}

void ChartDrawing::drawGrid() {
  const Pen grid{ink::kGrid, 1.0};
  for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
    const double x = plot_.left + x_.place(x_.ticks[i]) * plot_.width;
    if (seen(x_.place(x_.ticks[i]))) {
      canvas_.line({{x, plot_.top}, {x, plot_.bottom()}}, grid);
      canvas_.text({x, plot_.bottom() + 13.0}, x_.labels.text[i], kTickLettering);
    }
  }
  Lettering tick_label = kTickLettering;
  tick_label.across = Align::kEnd;
  for (std::size_t i = 0; i < y_.ticks.size(); ++i) {
    const double y = plot_.bottom() - y_.place(y_.ticks[i]) * plot_.height;
    if (seen(y_.place(y_.ticks[i]))) {
      canvas_.line({{plot_.left, y}, {plot_.right(), y}}, grid);
      canvas_.text({plot_.left - 7.0, y}, y_.labels.text[i], tick_label);
    }
  }
}

void ChartDrawing::drawReferences() {
  const Pen pen{ink::kGrey, 1.2, {6.0, 4.0}};
  for (const ReferenceLine& line : chart_.horizontal) {
    if (seen(y_.place(line.at))) {
      const double y = plot_.bottom() - y_.place(line.at) * plot_.height;
      canvas_.line({{plot_.left, y}, {plot_.right(), y}}, pen);
    }
  }
  for (const ReferenceLine& line : chart_.vertical) {
    if (seen(x_.place(line.at))) {
      const double x = plot_.left + x_.place(line.at) * plot_.width;
      canvas_.line({{x, plot_.top}, {x, plot_.bottom()}}, pen);
    }
  }
}

void ChartDrawing::drawScaleAbove() {
  if (!chart_.x.second) {
    return;
  }
  const MarkedAxis axis =
      scaled(x_, *chart_.x.second, static_cast<int>(plot_.width / kPixelsOfRpm));
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    const double x = plot_.left + axis.place(axis.ticks[i]) * plot_.width;
    if (seen(axis.place(axis.ticks[i])) && x < plot_.right() - 60.0) {
      canvas_.line({{x, plot_.top}, {x, plot_.top - 4.0}}, {ink::kGrey, 1.2});
      canvas_.text({x, plot_.top - 12.0}, axis.labels.text[i], kTickLettering);
    }
  }
  Lettering lettering = kTickLettering;
  lettering.across = Align::kEnd;
  canvas_.text({plot_.right(), plot_.top - 12.0}, nameOf(*chart_.x.second, axis), lettering);
}

void ChartDrawing::drawScaleOnTheRight() {
  if (!right_) {
    return;
  }
  Lettering beside = kTickLettering;
  beside.across = Align::kStart;
  for (std::size_t i = 0; i < right_->ticks.size(); ++i) {
    const double y = plot_.bottom() - right_->place(right_->ticks[i]) * plot_.height;
    if (seen(right_->place(right_->ticks[i]))) {
      canvas_.line({{plot_.right(), y}, {plot_.right() + 4.0, y}}, {ink::kGrey, 1.2});
      canvas_.text({plot_.right() + 7.0, y}, right_->labels.text[i], beside);
    }
  }
  Lettering upwards = kAxisLettering;
  upwards.upwards = true;
  canvas_.text({place_.right() - 14.0, plot_.top + 0.5 * plot_.height},
               nameOf(*chart_.y.second, *right_), upwards);
}

void ChartDrawing::drawArea(const Series& series) {
  std::vector<Spot> border;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Spot spot = at(series.x[i], series.y[i]);
    if (std::isfinite(spot.x) && std::isfinite(spot.y)) {
      border.push_back(spot);
    }
  }
  canvas_.polygon(border, *series.fill, {*series.fill, 0.0});
}

void ChartDrawing::drawSeries(const Series& series, const Pen& pen) {
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

void ChartDrawing::drawLine(const std::vector<Spot>& line, const Pen& pen) {
  if (line.size() <= most_spots_) {
    canvas_.line(line, pen);
  } else {
    canvas_.lines(withoutRepeats(line, most_spots_), pen);
  }
}

void ChartDrawing::drawFrame() {
  const Pen frame{ink::kGrey, 1.2};
  canvas_.line({{plot_.left, plot_.top},
                {plot_.right(), plot_.top},
                {plot_.right(), plot_.bottom()},
                {plot_.left, plot_.bottom()},
                {plot_.left, plot_.top}},
               frame);
  const double middle = plot_.left + 0.5 * plot_.width;
  canvas_.text({middle, place_.top + 14.0}, chart_.title, kChartTitle);
  canvas_.text({middle, plot_.bottom() + 34.0}, chart_.x.label, kAxisLettering);
  Lettering upwards = kAxisLettering;
  upwards.upwards = true;
  canvas_.text({place_.left + 14.0, plot_.top + 0.5 * plot_.height}, chart_.y.label, upwards);
  drawExponent(y_, {plot_.left - (chart_.x.second ? 18.0 : 4.0), plot_.top - 11.0},
               chart_.x.second ? Align::kEnd : Align::kStart);
  drawExponent(x_, {plot_.right(), plot_.bottom() + 34.0}, Align::kEnd);
}
void ChartDrawing::drawExponent(const MarkedAxis& axis, const Spot& spot, Align across) {
  if (axis.labels.exponent != 0) {
    Lettering lettering = kTickLettering;
    lettering.across = across;
    canvas_.text(spot, "\u00d7" + powerOfTen(axis.labels.exponent), lettering);
  }
}

void ChartDrawing::drawLegend() {
  const double top = place_.top + (chart_.title.empty() ? 4.0 : 28.0);
  for (const LegendEntry& entry : legend_) {
    const Spot start{entry.spot.x, top + entry.spot.y};
    const Spot end{start.x + kSample, start.y};
    if (entry.band != nullptr || entry.series->fill) {
      canvas_.polygon({{start.x, start.y - 6.0},
                       {end.x, start.y - 6.0},
                       {end.x, start.y + 6.0},
                       {start.x, start.y + 6.0}},
                      entry.band != nullptr ? entry.band->ink : *entry.series->fill,
                      {ink::kGrey, 0.6});
    } else {
      if (entry.series->line) {
        canvas_.line({start, end}, entry.pen);
      }
      drawMark({start.x + 0.5 * kSample, start.y}, entry.series->marks, entry.pen.ink);
    }
    canvas_.text({end.x + 8.0, start.y}, entry.name, kLegendLettering);
  }
}

void ChartDrawing::drawBands() {
  for (const Band& band : chart_.bands) {
    const auto across = [&](double value) {
      const double seen = std::clamp(value, x_.range.low, x_.range.high);
      return plot_.left + x_.place(seen) * plot_.width;
    };
    const double left = across(band.low);
    const double right = across(band.high);
    if (right > left) {
      canvas_.polygon(
          {{left, plot_.top}, {right, plot_.top}, {right, plot_.bottom()}, {left, plot_.bottom()}},
          band.ink, {band.ink, 0.0});
    }
  }
}

void ChartDrawing::drawMarks(const Series& series, const Pen& pen) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Spot spot = at(series.x[i], series.y[i]);
    if (std::isfinite(spot.x) && std::isfinite(spot.y)) {
      drawMark(spot, series.marks, pen.ink);
    }
  }
}

void ChartDrawing::drawMark(const Spot& spot, Marks marks, const Ink& ink) {
  if (marks == Marks::kDots) {
    canvas_.circle(spot, kMark, ink, {ink::kBlack, 1.0});
  } else if (marks == Marks::kRings) {
    canvas_.circle(spot, kMark, {1.0, 1.0, 1.0}, {ink, 2.0});
  }
}

}  // namespace whirl_twin
