// A quantity over two others, known at the points of a grid: a filled map with a colour for each
// value, and a line where it has one that is asked for.
#pragma once

#include <string>
#include <vector>

#include "plots/canvas.h"
#include "plots/chart.h"

namespace whirl_twin {

struct ResponseMap {
  std::string title;
  ChartAxis x, y;
  std::string label;  ///< of the quantity, with its unit
  /// Where it is known, each rising, at least two of each.
  std::vector<double> x_levels, y_levels;
  /// [y][x]; what is not finite is a hole, in grey.
  std::vector<std::vector<double>> values;
  /// Lines of one value each, linear between the points, and what they say.
  std::vector<ReferenceLine> contours;
};

/// The file. An SVG shows at most 100 of the levels of each axis. Throws RunFailure.
std::string mapImage(const ResponseMap& map, ImageFormat format);

/// The line where a quantity known at four corners has a value: pieces of two points, x and y from
/// 0 to 1; none where a corner is not finite. Corners: [y][x].
std::vector<std::vector<Spot>> contourIn(double c00, double c01, double c10, double c11,
                                         double value);

}  // namespace whirl_twin
