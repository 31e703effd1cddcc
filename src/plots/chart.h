// Line charts: time histories, phase portraits, orbits, response curves. One figure holds one chart
// or several in rows and columns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plots/canvas.h"

namespace whirl_twin {

enum class Marks { kNone, kDots, kRings };

/// A curve; x and y of equal length. A point outside the range of the axes, because it is not
/// finite or beyond 1e300 (on a logarithmic axis: not positive, or below 1e-300), interrupts the
/// line.
struct Series {
  std::string name;  ///< in the legend, which is drawn for several names; "": not in it
  std::vector<double> x, y;
  std::optional<Pen> pen = std::nullopt;  ///< none: the next colour of the palette
  bool line = true;                       ///< a line through the points
  Marks marks = Marks::kNone;             ///< at every point
  /// The points bound an area of this colour, behind the curves, without an outline.
  std::optional<Ink> fill = std::nullopt;
};

/// A range of x with a background colour, behind everything.
struct Band {
  std::string name;  ///< in the legend; "": not in it
  double low = 0.0, high = 0.0;
  Ink ink;
};

/// A second unit of the axis, with its conversion factor: rad/s as rpm.
struct SecondScale {
  std::string label;
  double factor = 1.0;
};

struct ChartAxis {
  std::string label;  ///< with its unit: "time (s)"
  bool logarithmic = false;
  bool tight = false;  ///< ends where the data end, not at the next tick
  /// Above the chart, for y right of it; of a linear axis.
  std::optional<SecondScale> second = std::nullopt;
  bool degrees = false;  ///< with ticks at fractions of a turn
};

/// A line across the whole chart: a critical speed, a limit. Drawn within the range of the data.
struct ReferenceLine {
  double at = 0.0;
  std::string label;
};

/// A label beside a point, placed where it covers no curve.
struct Note {
  double x = 0.0, y = 0.0;
  std::string text;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<Series> series;
  std::vector<ReferenceLine> vertical;    ///< at an x
  std::vector<ReferenceLine> horizontal;  ///< at a y
  std::vector<Band> bands;
  std::vector<Note> notes;
  bool equal_aspect = false;  ///< equal scales along x and y; linear axes
};

struct Figure {
  std::string title;
  std::vector<Chart> charts;
  int columns = 1;
  int width = 800;         ///< [px]
  int chart_height = 460;  ///< [px], of each row
};

/// The contents of the file. Long series are thinned to the visible resolution: an SVG stays below
/// about 200 kB. Throws RunFailure.
std::string figureImage(const Figure& figure, ImageFormat format);

}  // namespace whirl_twin
