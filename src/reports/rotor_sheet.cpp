#include "reports/rotor_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/rotor_systems.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxTableRows = 30;  // of a table in the text

Json pair(const Across& a) {
  return {a.x + 0.0, a.y + 0.0};
}

double size(const Across& a) {
  return std::hypot(a.x, a.y);
}

std::string bearingsText(const RotorSheet& sheet) {
  std::string out =
      fmt::format("  at rest under its weight, {:.6g} N\n", sheet.body.mass * sheet.gravity);
  for (const BearingLoad& bearing : sheet.statics->bearings) {
    out += fmt::format("    bearing at node {:<4} carries {:.6g} N along y, {:.6g} N along x\n",
                       bearing.node, bearing.force.y + 0.0, bearing.force.x + 0.0);
  }
  return out;
}

std::string nodesText(const std::vector<SagAtNode>& nodes) {
  if (nodes.size() > kMaxTableRows) {
    const auto largest = [&](const auto& of) {
      const auto at = std::max_element(
          nodes.begin(), nodes.end(),
          [&](const SagAtNode& a, const SagAtNode& b) { return size(of(a)) < size(of(b)); });
      return fmt::format("{:.6g}, at node {}", size(of(*at)), at - nodes.begin());
    };
    return fmt::format(
        "    largest sag     {0} m\n    shear force     {1} N\n    bending moment  {2} N m\n"
        "    of every node   --json, --csv\n",
        largest([](const SagAtNode& n) { return n.deflection; }), largest([](const SagAtNode& n) {
          return size(n.shear_before) > size(n.shear_after) ? n.shear_before : n.shear_after;
        }),
        largest([](const SagAtNode& n) { return n.moment; }));
  }
  std::string out =
      "    node           z, m         y, m         x, m   shear y, N    beyond, N  moment, N m\n";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SagAtNode& n = nodes[i];
    out += fmt::format("    {:<4} {:>14.6g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g}\n", i,
                       n.position, n.deflection.y, n.deflection.x + 0.0, n.shear_before.y,
                       n.shear_after.y, n.moment.y);
  }
  return out;
}

}  // namespace

std::optional<LargestSag> largestSag(const Dynamics& dynamics, const Eigen::VectorXd& q) {
  std::optional<LargestSag> largest;
  for (const Station& station : dynamics.stations()) {
    const LargestSag here{station.name, station.along_x.dot(q), station.along_y.dot(q)};
    const double size = std::hypot(here.x, here.y);
    if (size > (largest ? std::hypot(largest->x, largest->y) : 0.0)) {
      largest = here;
    }
  }
  return largest;
}

std::string text(const LargestSag& sag, const ShownUnits& units) {
  const ShownUnit& m = units.length;
  return fmt::format("{:.6g} {} at {} (x {:.6g} {}, y {:.6g} {})", m.in(std::hypot(sag.x, sag.y)),
                     m.name, sag.station, m.in(sag.x) + 0.0, m.name, m.in(sag.y) + 0.0, m.name);
}

Json json(const std::optional<LargestSag>& sag) {
  return sag ? Json{{"station", sag->station},
                    {"deflection", std::hypot(sag->x, sag->y)},
                    {"x", sag->x + 0.0},
                    {"y", sag->y + 0.0}}
             : Json();
}

std::optional<RotorSheet> rotorSheet(const BuiltSystem& system, double speed) {
  const std::optional<FlexibleShaft> shaft = shaftOf(system);
  if (!shaft) {
    return std::nullopt;
  }
  const double gravity = system.spec.setup->around.gravity;
  return RotorSheet{rotorBody(*shaft), gravity, rotorStatics(*shaft, gravity, speed)};
}

Json json(const RotorSheet& sheet) {
  Json json{{"mass", sheet.body.mass},
            {"centre_of_gravity", sheet.body.centre},
            {"polar_inertia", sheet.body.polar_inertia},
            {"transverse_inertia", sheet.body.transverse_inertia},
            {"static", Json()}};
  if (!sheet.statics) {
    return json;
  }
  json["static"] = {
      {"gravity", sheet.gravity},
      {"bearings", listJson(sheet.statics->bearings,
                            [](const BearingLoad& bearing) -> Json {
                              return {{"node", bearing.node}, {"force", pair(bearing.force)}};
                            })},
      {"nodes", listJson(sheet.statics->nodes, [](const SagAtNode& n) -> Json {
         return {{"position", n.position},
                 {"deflection", pair(n.deflection)},
                 {"shear_before", pair(n.shear_before)},
                 {"shear_after", pair(n.shear_after)},
                 {"moment", pair(n.moment)}};
       })}};
  return json;
}

std::string text(const RotorSheet& sheet) {
  std::string out = fmt::format(
      "  rotor           {:.6g} kg, balanced at {:.6g} m from node 0\n"
      "    inertia         {:.6g} kg m^2 about the shaft, {:.6g} kg m^2 across it\n",
      sheet.body.mass, sheet.body.centre, sheet.body.polar_inertia, sheet.body.transverse_inertia);
  return sheet.statics ? out + bearingsText(sheet) + nodesText(sheet.statics->nodes) : out;
}

CsvTable table(const RotorSheet& sheet) {
  CsvTable nodes{"static",
                 {"node", "position", "deflection_x", "deflection_y", "shear_before_x",
                  "shear_before_y", "shear_after_x", "shear_after_y", "moment_x", "moment_y"}};
  if (!sheet.statics) {
    return nodes;
  }
  for (std::size_t i = 0; i < sheet.statics->nodes.size(); ++i) {
    const SagAtNode& n = sheet.statics->nodes[i];
    Json row{{"node", i}, {"position", n.position}};
    for (const auto& [name, value] :
         {std::pair("deflection", n.deflection), std::pair("shear_before", n.shear_before),
          std::pair("shear_after", n.shear_after), std::pair("moment", n.moment)}) {
      row[std::string(name) + "_x"] = value.x;
      row[std::string(name) + "_y"] = value.y;
    }
    nodes.rows.push_back(row);
  }
  return nodes;
}

}  // namespace whirl_twin
