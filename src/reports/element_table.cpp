// Elements of a shaft from a table of comma-separated values.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "messages/names.h"
#include "messages/refusal.h"
#include "messages/units.h"
#include "reports/rotor_drawing.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"

namespace whirl_twin {

namespace {

constexpr double kSteelModulus = 2.1e11;  // Pa
constexpr double kSteelDensity = 7850.0;  // kg/m^3
const std::vector<std::string> kLengths = {"length", "outer_diameter", "outer_diameter_end",
                                           "inner_diameter", "inner_diameter_end"};

struct Column {
  std::string name;
  double scale = 1.0;  ///< of the unit, in SI
};

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) {
    const std::size_t first = cell.find_first_not_of(" \t\r\"");
    const std::size_t last = cell.find_last_not_of(" \t\r\"");
    all.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return all;
}

/// "outer_diameter (mm)", "length [in]", "count".
Column columnOf(const std::string& heading, Complaints& complaints) {
  const std::size_t bracket = heading.find_first_of("([");
  const std::string bare = heading.substr(0, bracket);
  Column column{bare.substr(0, bare.find_last_not_of(' ') + 1)};
  std::vector<std::string> known = kLengths;
  known.insert(known.end(), {"axial_force", "count"});
  if (std::find(known.begin(), known.end(), column.name) == known.end()) {
    complaints.add(fmt::format("column '{}'", printable(heading)),
                   "is not a column of shaft elements" + hint(column.name, known));
    return column;
  }
  if (bracket != std::string::npos) {
    const std::string unit =
        heading.substr(bracket + 1, heading.find_first_of(")]", bracket) - bracket - 1);
    const std::string wanted = column.name == "axial_force" ? "N"
                               : column.name == "count"     ? "-"
                                                            : "m";
    column.scale = unitScale(unit, wanted);
    if (column.scale == 0.0) {
      complaints.add(fmt::format("column '{}'", printable(heading)),
                     fmt::format("must be in {} or a convertible unit", wanted));
    }
  }
  return column;
}

}  // namespace

RotorDrawing drawingOfElements(const std::string& path) {
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw Refusal(path + ": cannot be read; must be a table of elements");
  }
  Complaints complaints(path);
  std::string line;
  std::getline(in, line);
  std::vector<Column> columns;
  for (const std::string& heading : cells(line)) {
    columns.push_back(columnOf(heading, complaints));
  }
  for (const char* needed : {"length", "outer_diameter"}) {
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const Column& column) { return column.name == needed; })) {
      complaints.add("", fmt::format("the first line must name a column '{}'", needed));
    }
  }
  RotorDrawing drawing;
  drawing.name = nameOf(path);
  drawing.origin = fmt::format("Elements of {}, of steel; its discs and bearings are to be added.",
                               std::filesystem::path(path).filename().string());
  drawing.youngs_modulus = kSteelModulus;
  drawing.density = kSteelDensity;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> values = cells(line);
    if (values.size() == 1 && values[0].empty()) {
      continue;
    }
    DrawnRow row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string text = i < values.size() ? values[i] : "";
      const std::optional<double> value = parseNumber(text);
      if (value) {
        row.emplace_back(columns[i].name, drawn(*value * columns[i].scale));
      } else if (!text.empty() || columns[i].name == "length" ||
                 columns[i].name == "outer_diameter") {
        complaints.add(fmt::format("line {}: {}", number, columns[i].name),
                       fmt::format("must be a number, found {}", quoted(text)));
      }
    }
    drawing.elements.push_back(row);
  }
  if (drawing.elements.empty()) {
    complaints.add("", "has no elements");
  }
  if (!complaints.all().empty()) {
    throw SceneError(complaints.all());
  }
  return drawing;
}

}  // namespace whirl_twin
