#include "reports/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

Json numberOf(double value) {
  return std::fabs(value) <= kMaxOnAxis ? Json(value + 0.0) : Json();
}

/// In a unit.
Json numbersOf(const std::vector<double>& values, double unit = 1.0) {
  return listJson(values, [unit](double value) { return numberOf(value / unit); });
}

std::string colorOf(const Ink& ink) {
  const auto part = [](double share) {
    return static_cast<int>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(ink.red), part(ink.green), part(ink.blue));
}

Json axisJson(const ChartAxis& axis) {
  Json second;
  if (axis.second) {
    second = {{"label", axis.second->label}, {"factor", axis.second->factor}};
  }
  return {{"label", axis.label}, {"logarithmic", axis.logarithmic}, {"tight", axis.tight},
          {"second", second},    {"degrees", axis.degrees},         {"inverted", axis.inverted}};
}

Json seriesJson(const Series& series, double x_unit, double y_unit) {
  Json pen;
  if (series.pen) {
    pen = {{"color", colorOf(series.pen->ink)},
           {"width", series.pen->width},
           {"dash", series.pen->dash}};
  }
  return {{"name", series.name},
          {"x", numbersOf(series.x, x_unit)},
          {"y", numbersOf(series.y, y_unit)},
          {"pen", pen},
          {"line", series.line},
          {"marks", series.marks == Marks::kDots    ? "dots"
                    : series.marks == Marks::kRings ? "rings"
                                                    : "none"},
          {"fill", series.fill ? Json(colorOf(*series.fill)) : Json()}};
}

Json linesJson(const std::vector<ReferenceLine>& lines, double unit = 1.0) {
  return listJson(lines, [unit](const ReferenceLine& line) -> Json {
    return {{"at", numberOf(line.at / unit)}, {"label", line.label}};
  });
}

Json chartJson(const Chart& chart) {
  const double x_unit = chart.x.unit, y_unit = chart.y.unit;
  return {{"title", chart.title},
          {"x", axisJson(chart.x)},
          {"y", axisJson(chart.y)},
          {"series", listJson(chart.series,
                              [&](const Series& one) { return seriesJson(one, x_unit, y_unit); })},
          {"vertical", linesJson(chart.vertical, x_unit)},
          {"horizontal", linesJson(chart.horizontal, y_unit)},
          {"bands", listJson(chart.bands,
                             [&](const Band& band) -> Json {
                               return {{"name", band.name},
                                       {"low", numberOf(band.low / x_unit)},
                                       {"high", numberOf(band.high / x_unit)},
                                       {"color", colorOf(band.ink)}};
                             })},
          {"notes", listJson(chart.notes,
                             [&](const Note& note) -> Json {
                               return {{"x", numberOf(note.x / x_unit)},
                                       {"y", numberOf(note.y / y_unit)},
                                       {"text", note.text}};
                             })},
          {"equal_aspect", chart.equal_aspect}};
}

std::string axisLabels(const ChartAxis& axis) {
  return axis.second ? fmt::format("{}, {}", axis.label, axis.second->label) : axis.label;
}

std::string descriptionOf(const Figure& figure) {
  std::string text;
  for (const Chart& chart : figure.charts) {
    text += fmt::format("{}{}{} over {}:", text.empty() ? "" : "; ",
                        chart.title.empty() ? "" : chart.title + ": ", axisLabels(chart.y),
                        axisLabels(chart.x));
    const char* separator = " ";
    for (const Series& series : chart.series) {
      if (!series.name.empty()) {
        text += separator + series.name;
        separator = ", ";
      }
    }
    const auto add = [&](const std::vector<ReferenceLine>& lines, double unit) {
      for (const ReferenceLine& line : lines) {
        if (!line.label.empty()) {
          text += fmt::format(" [{} at {:.4g}]", line.label, line.at / unit);
        }
      }
    };
    add(chart.vertical, chart.x.unit);
    add(chart.horizontal, chart.y.unit);
  }
  return text;
}

Json spotJson(const SketchPoint& point) {
  return {numberOf(point.x), numberOf(point.y), numberOf(point.z)};
}

Json pathJson(const std::vector<SketchPoint>& path) {
  return listJson(path, spotJson);
}

const char* roleName(SketchRole role) {
  switch (role) {
    case SketchRole::kBody:
      return "body";
    case SketchRole::kMass:
      return "mass";
    case SketchRole::kSupport:
      return "support";
    case SketchRole::kSpring:
      return "spring";
    case SketchRole::kMark:
      break;
  }
  return "mark";
}

/// Of parts from one point to another with a radius.
template <class Part>
Json barJson(const Part& part) {
  return {
      {"from", spotJson(part.from)}, {"to", spotJson(part.to)}, {"radius", numberOf(part.radius)}};
}

/// Are all numbers of a sketch known, and small enough for lengths to be computed from them?
bool drawable(const Json& json) {
  constexpr double kFarthest = 1.0e100;  // m
  if (json.is_structured()) {
    return std::all_of(json.begin(), json.end(), drawable);
  }
  return !json.is_null() && !(json.is_number() && std::fabs(json.get<double>()) > kFarthest);
}

}  // namespace

Json sketchJson(const Sketch& sketch) {
  const auto rod = [](const Sketch::Rod& part) {
    Json json = barJson(part);
    json["role"] = roleName(part.role);
    return json;
  };
  const auto ball = [](const Sketch::Ball& part) -> Json {
    return {{"at", spotJson(part.at)},
            {"radius", numberOf(part.radius)},
            {"role", roleName(part.role)}};
  };
  const auto disc = [](const Sketch::Disc& part) -> Json {
    return {{"at", spotJson(part.at)},         {"axis", spotJson(part.axis)},
            {"radius", numberOf(part.radius)}, {"thickness", numberOf(part.thickness)},
            {"angle", numberOf(part.angle)},   {"role", roleName(part.role)}};
  };
  const auto box = [](const Sketch::Box& part) -> Json {
    return {{"at", spotJson(part.at)},
            {"size", spotJson(part.size)},
            {"pitch", numberOf(part.pitch)},
            {"role", roleName(part.role)}};
  };
  const auto arrow = [](const Sketch::Arrow& part) -> Json {
    return {{"from", spotJson(part.from)}, {"to", spotJson(part.to)}};
  };
  const auto line = [](const Sketch::Line& part) -> Json {
    return {{"points", pathJson(part.points)}, {"role", roleName(part.role)}};
  };
  return {{"rods", listJson(sketch.rods, rod)},
          {"balls", listJson(sketch.balls, ball)},
          {"discs", listJson(sketch.discs, disc)},
          {"boxes", listJson(sketch.boxes, box)},
          {"springs", listJson(sketch.springs, barJson<Sketch::Spring>)},
          {"dampers", listJson(sketch.dampers, barJson<Sketch::Damper>)},
          {"arrows", listJson(sketch.arrows, arrow)},
          {"lines", listJson(sketch.lines, line)},
          {"size", numberOf(sketch.size)},
          {"height", numberOf(sketch.height)},
          {"centre", spotJson(sketch.centre)},
          {"spatial", sketch.spatial}};
}

Ink paler(const Ink& ink, double share) {
  const auto mixed = [share](double part) { return part + share * (1.0 - part); };
  return {mixed(ink.red), mixed(ink.green), mixed(ink.blue)};
}

Json figureJson(const Figure& figure) {
  return {{"kind", "charts"},
          {"title", figure.title},
          {"description", descriptionOf(figure)},
          {"columns", figure.columns},
          {"width", figure.width},
          {"chart_height", figure.chart_height},
          {"charts", listJson(figure.charts, chartJson)}};
}

Json figureJson(const BarChart& chart) {
  const auto bar = [](const Bar& one) -> Json {
    return {
        {"value", numberOf(one.value)}, {"low", numberOf(one.low)}, {"high", numberOf(one.high)}};
  };
  return {{"kind", "bars"},
          {"title", chart.title},
          {"description",
           chart.x.label + " of " +
               joined(
                   chart.groups, [](const BarGroup& group) { return group.name; }, ", ")},
          {"subtitle", chart.subtitle},
          {"x", axisJson(chart.x)},
          {"names", chart.names},
          {"groups", listJson(chart.groups,
                              [&](const BarGroup& group) -> Json {
                                return {{"name", group.name}, {"bars", listJson(group.bars, bar)}};
                              })},
          {"base", numberOf(chart.base)}};
}

Json figureJson(const ResponseMap& map) {
  return {{"kind", "map"},
          {"title", map.title},
          {"description", map.label + " over " + map.x.label + " and " + map.y.label},
          {"x", axisJson(map.x)},
          {"y", axisJson(map.y)},
          {"label", map.label},
          {"x_levels", numbersOf(map.x_levels)},
          {"y_levels", numbersOf(map.y_levels)},
          {"values", listJson(map.values, [](const auto& row) { return numbersOf(row); })},
          {"contours", linesJson(map.contours)}};
}

Json figureJson(const SketchPicture& picture) {
  return {{"kind", "sketch"},
          {"title", picture.title},
          {"description", picture.note},
          {"sketch", sketchJson(picture.sketch)},
          {"ghosts", listJson(picture.ghosts, sketchJson)},
          {"trace", pathJson(picture.trace)},
          {"orbits", listJson(picture.orbits, pathJson)},
          {"note", picture.note}};
}

bool fitsASheet(const SketchPicture& picture) {
  return drawable(figureJson(picture));
}

}  // namespace whirl_twin
