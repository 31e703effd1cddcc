// Figures as data: what is drawn, with texts, units and colours. Python draws them
// (python/whirl_twin/ drawing); `--plot FILE.json` writes them as they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/sketch.h"
#include "reports/output.h"

namespace whirl_twin {

/// A colour, each part from 0 to 1.
struct Ink {
  double red = 0.0, green = 0.0, blue = 0.0;
};
/// Mixed with `share` of white: 0 leaves it unchanged, 1 is white.
Ink paler(const Ink& ink, double share);

namespace ink {
// Colours distinguishable with every kind of colour vision (M. Okabe, K. Ito: Color Universal
// Design, 2008).
inline constexpr Ink kBlue{0.0, 0.447, 0.698};
inline constexpr Ink kVermilion{0.835, 0.369, 0.0};
inline constexpr Ink kGreen{0.0, 0.620, 0.451};
inline constexpr Ink kPurple{0.8, 0.475, 0.655};
inline constexpr Ink kOrange{0.902, 0.624, 0.0};
inline constexpr Ink kSkyBlue{0.337, 0.706, 0.914};
// Additional colours.
inline constexpr Ink kOlive{0.55, 0.58, 0.10};
inline constexpr Ink kNavy{0.16, 0.16, 0.48};
inline constexpr Ink kPink{0.86, 0.15, 0.50};
inline constexpr Ink kBlack{0.13, 0.13, 0.15};
inline constexpr Ink kGrey{0.42, 0.44, 0.47};
}  // namespace ink

struct Pen {
  Ink ink;
  double width = 1.0;          ///< [px]
  std::vector<double> dash{};  ///< [px] on, off ...; empty: a full line
};

enum class Marks { kNone, kDots, kRings };

/// Maximum of an axis, and reciprocal of the smallest positive number on a logarithmic one.
inline constexpr double kMaxOnAxis = 1.0e300;

/// A curve; x and y of equal length. A point outside the range of the axes, because it is not
/// finite or beyond kMaxOnAxis (on a logarithmic axis: not positive), interrupts the line.
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

/// A second unit of the axis, with its conversion factor from the label's: rad/s as rpm.
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
  bool degrees = false;   ///< with ticks at fractions of a turn
  bool inverted = false;  ///< grows downwards or to the left
  double unit = 1.0;      ///< of the label, in that of the numbers: kRpm for rpm of rad/s
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

/// Line charts in rows and columns.
struct Figure {
  std::string title;
  std::vector<Chart> charts;
  int columns = 1;
  int width = 800;         ///< [px]
  int chart_height = 460;  ///< [px], of each row
};

/// From the base line to a value; one that is not finite is not drawn.
struct Bar {
  double value = 0.0;
  /// Ends of its confidence interval; not finite: not drawn.
  double low = 0.0, high = 0.0;
};

struct BarGroup {
  std::string name;
  std::vector<Bar> bars;  ///< one for each of BarChart::names
};

/// Horizontal bars from a base line, one group per name; with groups sorted by weight, largest on
/// top, a tornado chart.
struct BarChart {
  std::string title;
  std::string subtitle;            ///< smaller, below it; "": none
  ChartAxis x;                     ///< linear
  std::vector<std::string> names;  ///< of the bars of a group, in the legend
  std::vector<BarGroup> groups;    ///< from the top down
  double base = 0.0;               ///< base line of the bars
};

/// A quantity over two others, known on a grid: a colour for each value, and contour lines.
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

/// A Sketch (mechanics/sketch.h) to scale, with a scale bar: plane ones from the front, spatial
/// ones from slightly above and from the left.
struct SketchPicture {
  std::string title;
  Sketch sketch;
  std::vector<Sketch> ghosts;                         ///< later positions, drawn faintly behind it
  std::vector<SketchPoint> trace;                     ///< past path of the tracer; may be empty
  std::vector<std::vector<SketchPoint>> orbits = {};  ///< closed paths, drawn as the trace is
  std::string note = "";                              ///< at the foot
};

/// Of a sketch: must all its parts be at positions within 1e100 m?
bool fitsASheet(const SketchPicture& picture);

/// The figure for Python: the members above under their names, colours as "#rrggbb", points as
/// [x, y, z], numbers in the units of the axes, what is not finite as null; `kind`: charts, bars,
/// map or sketch; and `description`, a text for those who cannot see it.
Json figureJson(const Figure& figure);
Json figureJson(const BarChart& chart);
Json figureJson(const ResponseMap& map);
Json figureJson(const SketchPicture& picture);

/// The members of the sketch under their names, points as [x, y, z], roles by their names; what is
/// not finite is null.
Json sketchJson(const Sketch& sketch);

}  // namespace whirl_twin
