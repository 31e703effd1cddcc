#include "reports/rotor_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace whirl_twin {

namespace {

std::string drawnRowText(const DrawnRow& row) {
  std::string all;
  for (const auto& [key, value] : row) {
    all += fmt::format("{}{}: {}", all.empty() ? "" : ", ", key, value);
  }
  return all;
}

/// A table of the parameters; nothing of one without rows.
std::string tableText(const std::string& name, const std::vector<DrawnRow>& rows) {
  std::string out = rows.empty() ? "" : fmt::format("      {}:\n", name);
  for (const DrawnRow& row : rows) {
    out += fmt::format("        - {{{}}}\n", drawnRowText(row));
  }
  return out;
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
    out += "#\n# Not carried over:\n";
    for (const std::string& line : drawing.left_out) {
      out += fmt::format("# - {}\n", line);
    }
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
  out += tableText("materials", drawing.materials);
  out += tableText("elements", counted(drawing.elements));
  out += tableText("couplings", drawing.couplings);
  out += tableText("sleeves", drawing.sleeves);
  out += tableText("discs", drawing.discs);
  out += tableText("bearings", drawing.bearings);
  out += tableText("bearing_tables", drawing.bearing_tables);
  out += tableText("pedestals", drawing.pedestals);
  out += tableText("pedestal_tables", drawing.pedestal_tables);
  return out;
}

}  // namespace whirl_twin
