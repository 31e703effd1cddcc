// The scene of a drawn rotor; elements of a shaft from a table of comma-separated values.
#include "reports/rotor_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "reports/output.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"
#include "scene/table_cells.h"

namespace whirl_twin {

namespace {

/// A table of the parameters; nothing of one without rows.
std::string tableText(const std::string& name, const std::vector<DrawnRow>& rows) {
  const auto cell = [](const DrawnRow::value_type& of) { return of.first + ": " + of.second; };
  return (rows.empty() ? "" : fmt::format("      {}:\n", name)) +
         joined(rows, [&](const DrawnRow& row) {
           return "        - {" + joined(row, cell, ", ") + "}\n";
         });
}

std::vector<DrawnRow> counted(const std::vector<DrawnRow>& elements) {
  std::vector<DrawnRow> rows;
  for (auto first = elements.begin(); first != elements.end();) {
    const auto tapers = [](const auto& entry) {
      return entry.first == "outer_diameter_end" || entry.first == "inner_diameter_end";
    };
    const bool alone = std::any_of(first->begin(), first->end(), tapers);
    const auto next = alone ? first + 1
                            : std::find_if(first, elements.end(),
                                           [&](const DrawnRow& row) { return row != *first; });
    rows.push_back(*first);
    if (next - first > 1) {
      rows.back().emplace_back("count", std::to_string(next - first));
    }
    first = next;
  }
  return rows;
}

constexpr double kSteelModulus = 2.1e11;  // Pa
constexpr double kSteelDensity = 7850.0;  // kg/m^3
const std::vector<std::string> kLengths = {"length", "outer_diameter", "outer_diameter_end",
                                           "inner_diameter", "inner_diameter_end"};

struct Column {
  std::string name;
  double scale = 1.0;  ///< of the unit, in SI
};

/// "outer_diameter (mm)", "length [in]", "count".
Column columnOf(const std::string& heading, Diagnostics& diagnostics) {
  const std::size_t bracket = heading.find_first_of("([");
  const std::string bare = heading.substr(0, bracket);
  Column column{bare.substr(0, bare.find_last_not_of(' ') + 1)};
  std::vector<std::string> known = kLengths;
  known.insert(known.end(), {"axial_force", "count"});
  if (std::find(known.begin(), known.end(), column.name) == known.end()) {
    diagnostics.add(fmt::format("column '{}'", printable(heading)),
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
      diagnostics.add(fmt::format("column '{}'", printable(heading)),
                      fmt::format("must be in {} or a convertible unit", wanted));
    }
  }
  return column;
}

}  // namespace

std::string drawn(double value) {
  return fmt::format("{}", value);
}

std::string nameOf(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  const auto odd = [](unsigned char c) { return std::isalnum(c) == 0; };
  std::replace_if(name.begin(), name.end(), odd, '_');
  const bool sound = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  return sound ? name : "rotor_" + name;
}

std::string sceneText(const RotorDrawing& drawing) {
  std::string out = fmt::format("# {}\n", drawing.origin);
  if (!drawing.left_out.empty()) {
    out += "#\n# Not carried over:\n" +
           joined(drawing.left_out, [](const auto& line) { return "# - " + line + "\n"; });
  }
  out += fmt::format(
      "name: {}\nstep: 0.001                   # s\nsystems:\n  rotor:\n    model: flexible_rotor\n"
      "    parameters:\n      speed: {}                # rad/s\n",
      drawing.name, drawn(drawing.speed));
  const auto number = [&](const char* key, double value, const char* unit) {
    if (value != 0.0) {
      out += fmt::format("      {}: {}   # {}\n", key, drawn(value), unit);
    }
  };
  number("youngs_modulus", drawing.youngs_modulus, "Pa");
  number("shear_modulus", drawing.shear_modulus, "Pa");
  number("density", drawing.density, "kg/m^3");
  number("mass_damping", drawing.mass_damping, "1/s");
  number("stiffness_damping", drawing.stiffness_damping, "s");
  number("highest_speed", drawing.highest_speed.value_or(0.0), "rad/s");
  if (!drawing.shear_deformation) {
    out += "      shear_deformation: false\n";
  }
  for (const auto& [name, rows] :
       {std::pair("materials", drawing.materials), std::pair("elements", counted(drawing.elements)),
        std::pair("couplings", drawing.couplings), std::pair("sleeves", drawing.sleeves),
        std::pair("discs", drawing.discs), std::pair("bearings", drawing.bearings),
        std::pair("bearing_tables", drawing.bearing_tables),
        std::pair("pedestals", drawing.pedestals),
        std::pair("pedestal_tables", drawing.pedestal_tables)}) {
    out += tableText(name, rows);
  }
  return out;
}

RotorDrawing drawingOfElements(const std::string& path) {
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw InputError(path + ": cannot be read; must be a table of elements");
  }
  Diagnostics diagnostics(path);
  std::string line;
  std::getline(in, line);
  std::vector<Column> columns;
  std::vector<std::string_view> cells;
  if (line.rfind("\xef\xbb\xbf", 0) == 0) {
    line.erase(0, 3);
  }
  splitCells(line, ',', cells);
  for (const std::string_view heading : cells) {
    columns.push_back(columnOf(std::string(heading), diagnostics));
  }
  for (const char* needed : {"length", "outer_diameter"}) {
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const Column& column) { return column.name == needed; })) {
      diagnostics.add("", fmt::format("the first line must name a column '{}'", needed));
    }
  }
  RotorDrawing drawing;
  drawing.name = nameOf(path);
  drawing.origin = fmt::format("Elements of {}, of steel; its discs and bearings are to be added.",
                               std::filesystem::path(path).filename().string());
  drawing.youngs_modulus = kSteelModulus;
  drawing.density = kSteelDensity;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    splitCells(line, ',', cells);
    if (cells.size() == 1 && cells[0].empty()) {
      continue;
    }
    DrawnRow row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string text(i < cells.size() ? cells[i] : std::string_view());
      const std::optional<double> value = parseNumber(text);
      if (value) {
        row.emplace_back(columns[i].name, drawn(*value * columns[i].scale));
      } else if (!text.empty() || columns[i].name == "length" ||
                 columns[i].name == "outer_diameter") {
        diagnostics.add(fmt::format("line {}: {}", number, columns[i].name),
                        fmt::format("must be a number, found {}", inQuotes(text)));
      }
    }
    drawing.elements.push_back(row);
  }
  if (drawing.elements.empty()) {
    diagnostics.add("", "has no elements");
  }
  if (!diagnostics.all().empty()) {
    throw SceneError(diagnostics.all());
  }
  return drawing;
}

}  // namespace whirl_twin
