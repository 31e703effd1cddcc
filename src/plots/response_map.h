// Contour map of a quantity over two others, known on a grid: a colour for each value, and contour
// lines at the requested values.
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
  /// Grid coordinates, increasing, at least two of each.
  std::vector<double> x_levels, y_levels;
  /// [y][x]; a value that is not finite is a hole, in grey.
  std::vector<std::vector<double>> values;
  /// Contour lines, linear between the grid points, and their labels.
  std::vector<ReferenceLine> contours;
};

/// The contents of the file. An SVG shows at most 100 of the levels of each axis. Throws
/// RunFailure.
std::string mapImage(const ResponseMap& map, ImageFormat format);

/// The contour line of a quantity given at four corners: segments of two points, x and y from 0 to
/// 1; none where a corner is not finite. Corners: [y][x].
std::vector<std::vector<Spot>> contourIn(double c00, double c01, double c10, double c11,
                                         double value);

}  // namespace whirl_twin
