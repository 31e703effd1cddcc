// Drawing of one chart on a canvas: axes, bands, lines, markers and legend.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plots/chart.h"
#include "plots/label_places.h"
#include "plots/marked_axis.h"

namespace whirl_twin {

class ChartDrawing {
 public:
  /// `most_spots` of each series in the file.
  ChartDrawing(const Chart& chart, const Rectangle& place, std::size_t most_spots, Canvas& canvas);

  /// [px] that the labels of the vertical axis need.
  double leftMargin() const;
  /// And those of a second scale on the right.
  double rightMargin() const;
  void draw(double left_margin, double right_margin);

 private:
  static constexpr double kMark = 4.5;  ///< [px], radius

  /// Is a position along an axis, as a fraction of it, within the chart?
  static bool seen(double place) { return place > -1.0e-6 && place < 1.0 + 1.0e-6; }

  struct LegendEntry {
    std::string name;
    Spot spot;
    const Series* series = nullptr;
    const Band* band = nullptr;
    Pen pen;
  };

  void placeLegend();
  double widestLabel(const MarkedAxis& axis) const;
  Spot at(double x, double y) const;
  void drawBands();
  void drawGrid();
  void drawReferences();
  void drawScaleAbove();
  void drawScaleOnTheRight();
  void drawWords();
  void nameReferences(LabelPlaces& places);
  void drawArea(const Series& series);
  void drawSeries(const Series& series, const Pen& pen);
  void drawLine(const std::vector<Spot>& line, const Pen& pen);
  void drawMarks(const Series& series, const Pen& pen);
  void drawMark(const Spot& spot, Marks marks, const Ink& ink);
  void drawFrame();
  void drawExponent(const MarkedAxis& axis, const Spot& spot, Align across);
  void drawLegend();

  const Chart& chart_;
  Rectangle place_, plot_;
  std::size_t most_spots_;
  Canvas& canvas_;
  MarkedAxis x_, y_;
  std::optional<MarkedAxis> right_;  // the second scale of y
  std::vector<LegendEntry> legend_;
  int legend_rows_ = 0;
};

}  // namespace whirl_twin
