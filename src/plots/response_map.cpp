#include "plots/response_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plots/label_places.h"
#include "plots/marked_axis.h"

namespace whirl_twin {
namespace {

constexpr int kMapWidth = 800, kMapHeight = 560;  // px
constexpr std::size_t kMaxLevels = 100;           // of an axis, in an SVG
constexpr int kShades = 128;
const Ink kHole{0.8, 0.8, 0.8};

const Pen kUnderContour{ink::kBlack, 4.0};
const Pen kContour{{1.0, 1.0, 1.0}, 2.2};

/// viridis (S. van der Walt, N. Smith, public domain): perceptually uniform with every kind of
/// colour vision, and in greyscale.
Ink shade(double part) {
  static constexpr std::array<Ink, 9> kAnchors{{{0.267, 0.005, 0.329},
                                                {0.278, 0.175, 0.483},
                                                {0.230, 0.322, 0.546},
                                                {0.173, 0.449, 0.558},
                                                {0.128, 0.567, 0.551},
                                                {0.158, 0.684, 0.502},
                                                {0.369, 0.789, 0.383},
                                                {0.678, 0.864, 0.190},
                                                {0.993, 0.906, 0.144}}};
  const double at = std::clamp(part, 0.0, 1.0) * static_cast<double>(kAnchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
  const double more = at - static_cast<double>(below);
  const Ink& low = kAnchors[below];
  const Ink& high = kAnchors[below + 1];
  return {low.red + more * (high.red - low.red), low.green + more * (high.green - low.green),
          low.blue + more * (high.blue - low.blue)};
}

/// Every n-th of them, so that no more than `most` remain.
std::vector<std::size_t> thinnedPlaces(std::size_t count, std::size_t most) {
  const std::size_t stride = (count + most - 1) / most;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; i += stride) {
    places.push_back(i);
  }
  return places;
}

class MapDrawing {
 public:
  MapDrawing(const ResponseMap& map, std::size_t most, Canvas& canvas)
      : map_(map),
        canvas_(canvas),
        columns_(thinnedPlaces(map.x_levels.size(), most)),
        rows_(thinnedPlaces(map.y_levels.size(), most)),
        x_{dataRange({&map.x_levels}, map.x.logarithmic), map.x.logarithmic, {}, {}},
        y_{dataRange({&map.y_levels}, map.y.logarithmic), map.y.logarithmic, {}, {}} {
    std::vector<const std::vector<double>*> all;
    for (const std::vector<double>& row : map.values) {
      all.push_back(&row);
      holes_ =
          holes_ || !std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
    }
    z_ = {dataRange(all, false), false, {}, {}};
    z_.mark(true, 9);
    y_.mark(true, 10);
    double widest = 0.0;
    for (const std::string& label : y_.labels.text) {
      widest = std::max(widest, canvas.textWidth(label, kTickLettering));
    }
    plot_.left = 42.0 + widest;
    plot_.width = kMapWidth - 130.0 - plot_.left;
    plot_.top = map.contours.empty() && !holes_ ? 44.0 : 82.0;
    plot_.height = kMapHeight - 58.0 - plot_.top;
    x_.mark(true, static_cast<int>(plot_.width / 70.0));
    across_ = edges(map.x_levels, columns_, x_);
    down_ = edges(map.y_levels, rows_, y_);
  }

  void draw() {
    canvas_.text({0.5 * kMapWidth, 19.0}, map_.title, kTitleLettering);
    drawCells();
    drawContours();
    drawAxes();
    drawScale();
  }

 private:
  /// Boundaries of the cells along an axis, from 0 to 1: half-way between the levels.
  static std::vector<double> edges(const std::vector<double>& levels,
                                   const std::vector<std::size_t>& places, const MarkedAxis& axis) {
    std::vector<double> at{0.0};
    for (std::size_t i = 1; i < places.size(); ++i) {
      at.push_back(0.5 * (axis.place(levels[places[i - 1]]) + axis.place(levels[places[i]])));
    }
    at.push_back(1.0);
    return at;
  }
  double across(double part) const { return plot_.left + part * plot_.width; }
  double down(double part) const { return plot_.bottom() - part * plot_.height; }

  void drawCells() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        const double part = z_.place(map_.values[rows_[i]][columns_[k]]);
        const Ink ink = std::isfinite(part) ? shade(part) : kHole;
        const double left = across(across_[k]);
        const double right = across(across_[k + 1]);
        const double low = down(down_[i]);
        const double high = down(down_[i + 1]);
        canvas_.polygon({{left, low}, {right, low}, {right, high}, {left, high}}, ink, {ink, 0.6});
      }
    }
  }

  void drawContours() {
    double x = plot_.left;
    for (const ReferenceLine& contour : map_.contours) {
      std::vector<std::vector<Spot>> pieces;
      for (std::size_t i = 0; i + 1 < map_.y_levels.size(); ++i) {
        for (std::size_t k = 0; k + 1 < map_.x_levels.size(); ++k) {
          addPieces(i, k, contour.at, pieces);
        }
      }
      for (const Pen& pen : {kUnderContour, kContour}) {
        canvas_.lines(pieces, pen);
        canvas_.line({{x, 64.0}, {x + 24.0, 64.0}}, pen);
      }
      canvas_.text({x + 34.0, 64.0}, contour.label, kLegendLettering);
      x += 56.0 + canvas_.textWidth(contour.label, kLegendLettering);
    }
    if (holes_) {
      canvas_.polygon({{x, 58.0}, {x + 24.0, 58.0}, {x + 24.0, 70.0}, {x, 70.0}}, kHole,
                      {ink::kGrey, 0.6});
      canvas_.text({x + 34.0, 64.0}, "failed or undefined", kLegendLettering);
    }
  }

  void addPieces(std::size_t i, std::size_t k, double value,
                 std::vector<std::vector<Spot>>& pieces) const {
    const auto placed = [](const MarkedAxis& axis, const std::vector<double>& levels, std::size_t n,
                           double part) {
      const double from = axis.place(levels[n]);
      return from + part * (axis.place(levels[n + 1]) - from);
    };
    for (std::vector<Spot>& piece :
         contourIn(map_.values[i][k], map_.values[i][k + 1], map_.values[i + 1][k],
                   map_.values[i + 1][k + 1], value)) {
      for (Spot& spot : piece) {
        spot = {across(placed(x_, map_.x_levels, k, spot.x)),
                down(placed(y_, map_.y_levels, i, spot.y))};
      }
      pieces.push_back(piece);
    }
  }

  void drawAxes() {
    Lettering tick = kTickLettering;
    for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
      const double part = x_.place(x_.ticks[i]);
      if (isOn(part)) {
        canvas_.line({{across(part), plot_.bottom()}, {across(part), plot_.bottom() + 5.0}},
                     {ink::kGrey, 1.2});
        canvas_.text({across(part), plot_.bottom() + 15.0}, x_.labels.text[i], tick);
      }
    }
    tick.across = Align::kEnd;
    for (std::size_t i = 0; i < y_.ticks.size(); ++i) {
      const double part = y_.place(y_.ticks[i]);
      if (isOn(part)) {
        canvas_.line({{plot_.left - 5.0, down(part)}, {plot_.left, down(part)}}, {ink::kGrey, 1.2});
        canvas_.text({plot_.left - 8.0, down(part)}, y_.labels.text[i], tick);
      }
    }
    frame(plot_);
    canvas_.text({plot_.left + 0.5 * plot_.width, plot_.bottom() + 38.0},
                 map_.x.label + powerOf(x_), kAxisLettering);
    Lettering upwards = kAxisLettering;
    upwards.upwards = true;
    canvas_.text({14.0, plot_.top + 0.5 * plot_.height}, map_.y.label + powerOf(y_), upwards);
  }

  void drawScale() {
    const Rectangle bar{plot_.right() + 22.0, plot_.top, 20.0, plot_.height};
    for (int i = 0; i < kShades; ++i) {
      const double low = bar.bottom() - bar.height * i / kShades;
      const double high = bar.bottom() - bar.height * (i + 1) / kShades;
      const Ink ink = shade((i + 0.5) / kShades);
      canvas_.polygon({{bar.left, low}, {bar.right(), low}, {bar.right(), high}, {bar.left, high}},
                      ink, {ink, 0.6});
    }
    frame(bar);
    for (std::size_t i = 0; i < z_.ticks.size(); ++i) {
      const double part = z_.place(z_.ticks[i]);
      if (isOn(part)) {
        Lettering tick = kTickLettering;
        tick.across = Align::kStart;
        const double y = bar.bottom() - part * bar.height;
        canvas_.line({{bar.right(), y}, {bar.right() + 5.0, y}}, {ink::kGrey, 1.2});
        canvas_.text({bar.right() + 8.0, y}, z_.labels.text[i], tick);
      }
    }
    Lettering upwards = kAxisLettering;
    upwards.upwards = true;
    canvas_.text({kMapWidth - 16.0, plot_.top + 0.5 * plot_.height}, map_.label + powerOf(z_),
                 upwards);
  }

  void frame(const Rectangle& place) {
    canvas_.line({{place.left, place.top},
                  {place.right(), place.top},
                  {place.right(), place.bottom()},
                  {place.left, place.bottom()},
                  {place.left, place.top}},
                 {ink::kGrey, 1.2});
  }
  static bool isOn(double part) { return part > -1.0e-6 && part < 1.0 + 1.0e-6; }
  static std::string powerOf(const MarkedAxis& axis) {
    return axis.labels.exponent == 0 ? "" : "  \u00d7" + powerOfTen(axis.labels.exponent);
  }

  const ResponseMap& map_;
  Canvas& canvas_;
  std::vector<std::size_t> columns_, rows_;  // of the levels that are shown
  MarkedAxis x_, y_, z_;
  Rectangle plot_;
  std::vector<double> across_, down_;  // edges of the cells
  bool holes_ = false;
};

}  // namespace

std::vector<std::vector<Spot>> contourIn(double c00, double c01, double c10, double c11,
                                         double value) {
  if (!std::isfinite(c00 + c01 + c10 + c11)) {
    return {};
  }
  std::vector<Spot> crossings;  // around the square: below, right, above, left
  const auto cross = [&](double from, double to, const Spot& a, const Spot& b) {
    if ((from < value) != (to < value)) {
      const double part = (value - from) / (to - from);
      crossings.push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    }
  };
  cross(c00, c01, {0.0, 0.0}, {1.0, 0.0});
  cross(c01, c11, {1.0, 0.0}, {1.0, 1.0});
  cross(c11, c10, {1.0, 1.0}, {0.0, 1.0});
  cross(c10, c00, {0.0, 1.0}, {0.0, 0.0});
  if (crossings.size() == 4) {  // a saddle: its middle decides which corners are connected
    const bool with_first = (0.25 * (c00 + c01 + c10 + c11) < value) == (c00 < value);
    return with_first ? std::vector<std::vector<Spot>>{{crossings[0], crossings[1]},
                                                       {crossings[2], crossings[3]}}
                      : std::vector<std::vector<Spot>>{{crossings[3], crossings[0]},
                                                       {crossings[1], crossings[2]}};
  }
  return crossings.empty() ? std::vector<std::vector<Spot>>{}
                           : std::vector<std::vector<Spot>>{crossings};
}

std::string mapImage(const ResponseMap& map, ImageFormat format) {
  const std::size_t most =
      format == ImageFormat::kSvg ? kMaxLevels : std::numeric_limits<std::size_t>::max() / 2;
  Canvas canvas(format, kMapWidth, kMapHeight, map.title,
                map.label + " over " + map.x.label + " and " + map.y.label);
  MapDrawing(map, most, canvas).draw();
  return canvas.finish();
}

}  // namespace whirl_twin
