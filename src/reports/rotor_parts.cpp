#include "reports/rotor_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string partNumber(double value) {
  return fmt::format("{:.5g}", value + 0.0);
}

/// Both ends of what tapers.
std::string diameter(double at_first, double growth) {
  return growth == 0.0 ? partNumber(at_first)
                       : fmt::format("{:.5g} to {:.5g}", at_first, at_first + growth);
}

bool alike(const ShaftSection& a, const ShaftSection& b) {
  const auto density = [](const ShaftSection& s) { return s.material ? s.material->density : 0.0; };
  return !a.tapers() && !b.tapers() && a.length == b.length &&
         a.outer_diameter == b.outer_diameter && a.inner_diameter == b.inner_diameter &&
         a.axial_force == b.axial_force && a.torque == b.torque && !a.coupling && !b.coupling &&
         density(a) == density(b);
}

/// The same sleeve over the next element.
bool continues(const ShaftSleeve& a, const ShaftSleeve& b) {
  const ShaftSection& first = a.layer.section;
  const ShaftSection& second = b.layer.section;
  return b.element == a.element + 1 && !first.tapers() && !second.tapers() &&
         first.outer_diameter == second.outer_diameter &&
         first.inner_diameter == second.inner_diameter &&
         a.layer.material.density == b.layer.material.density &&
         a.layer.stiffness == b.layer.stiffness;
}

Rows elementRows(const FlexibleShaft& shaft) {
  Rows rows;
  for (std::size_t first = 0; first < shaft.elements.size();) {
    std::size_t end = first + 1;
    while (end < shaft.elements.size() && alike(shaft.elements[first], shaft.elements[end])) {
      ++end;
    }
    const ShaftSection& e = shaft.elements[first];
    const ShaftMaterial& material = e.material ? *e.material : shaft.material;
    rows.push_back({fmt::format("{} to {}", first, end), partNumber(e.length),
                    diameter(e.outer_diameter, e.outer_growth),
                    diameter(e.inner_diameter, e.inner_growth), partNumber(material.youngs_modulus),
                    partNumber(material.density), partNumber(e.axial_force), partNumber(e.torque)});
    first = end;
  }
  return rows;
}

Rows bearingRows(const FlexibleShaft& shaft, double speed) {
  Rows rows;
  const auto add = [&](int node, const BearingCoefficients& c, const char* kind) {
    rows.push_back({std::to_string(node), partNumber(c.kxx), partNumber(c.kxy), partNumber(c.kyx),
                    partNumber(c.kyy), partNumber(c.cxx), partNumber(c.cxy), partNumber(c.cyx),
                    partNumber(c.cyy), kind});
  };
  for (const RotorBearing& bearing : shaft.bearings) {
    add(bearing.node, bearing.coefficients, "constant");
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    add(bearing.node, bearing.coefficients(speed), "over speed");
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    const std::string none = "-";
    rows.push_back({std::to_string(support.node), none, none, none, none, none, none, none, none,
                    support.clamps ? "clamp" : "pin"});
  }
  return rows;
}

constexpr int kWidth = 1000;          // px
constexpr double kMargins = 80.0;     // px, beside the chart
constexpr double kAround = 90.0;      // px, above and below it
constexpr double kMarkedLoad = 0.05;  // of the weight: a bearing that is marked
constexpr double kNamed = 14.0;       // node numbers along the shaft, at most

Chart chartAlongShaft(const char* label) {
  Chart chart;
  chart.x = {"along the shaft (m)", false, true};
  chart.y.label = label;
  return chart;
}

Series lineAtZero(const RotorSheet& sheet) {
  const std::vector<SagAtNode>& nodes = sheet.statics->nodes;
  return {"",
          {nodes.front().position, nodes.back().position},
          {0.0, 0.0},
          Pen{ink::kGrey, 1.2, {8.0, 4.0}}};
}

}  // namespace

std::vector<PartsTable> partsTables(const FlexibleShaft& shaft, double speed) {
  std::vector<PartsTable> all;
  all.push_back({"Elements",
                 {"nodes", "length each, m", "outer diameter, m", "inner diameter, m", "E, Pa",
                  "density, kg/m³", "axial force, N", "torque, N m"},
                 elementRows(shaft)});
  PartsTable couplings{
      "Couplings, replacing their elements",
      {"nodes", "lateral, N/m", "bending, N m/rad", "lateral, N s/m", "bending, N m s/rad"},
      {}};
  for (std::size_t i = 0; i < shaft.elements.size(); ++i) {
    if (const std::optional<ShaftCoupling>& c = shaft.elements[i].coupling) {
      couplings.rows.push_back({fmt::format("{} to {}", i, i + 1), partNumber(c->lateral_stiffness),
                                partNumber(c->bending_stiffness), partNumber(c->lateral_damping),
                                partNumber(c->bending_damping)});
    }
  }
  PartsTable sleeves{
      "Sleeves",
      {"nodes", "outer diameter, m", "inner diameter, m", "density, kg/m³", "stiffness fraction"},
      {}};
  for (std::size_t first = 0; first < shaft.sleeves.size();) {
    std::size_t end = first + 1;
    while (end < shaft.sleeves.size() && continues(shaft.sleeves[end - 1], shaft.sleeves[end])) {
      ++end;
    }
    const ShaftSleeve& sleeve = shaft.sleeves[first];
    const ShaftSection& section = sleeve.layer.section;
    sleeves.rows.push_back(
        {fmt::format("{} to {}", sleeve.element, shaft.sleeves[end - 1].element + 1),
         diameter(section.outer_diameter, section.outer_growth),
         diameter(section.inner_diameter, section.inner_growth),
         partNumber(sleeve.layer.material.density), partNumber(sleeve.layer.stiffness)});
    first = end;
  }
  PartsTable discs{
      "Discs",
      {"", "node", "mass, kg", "polar inertia, kg m²", "transverse inertia, kg m²", "skew, rad"},
      {}};
  for (std::size_t i = 0; i < shaft.discs.size(); ++i) {
    const RotorDisc& disc = shaft.discs[i];
    discs.rows.push_back({fmt::format("D{}", i + 1), std::to_string(disc.node),
                          partNumber(disc.mass), partNumber(disc.polar_inertia),
                          partNumber(disc.transverse_inertia), partNumber(disc.skew)});
  }
  PartsTable bearings{fmt::format("Bearings and seals at {:.5g} rad/s, N/m and N s/m", speed),
                      {"node", "kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy", ""},
                      bearingRows(shaft, speed)};
  PartsTable pedestals{"Pedestals",
                       {"node", "mass along x, kg", "along y, kg", "kxx, N/m", "kyy, N/m",
                        "cxx, N s/m", "cyy, N s/m"},
                       {}};
  for (const RotorPedestal& pedestal : shaft.pedestals) {
    BearingCoefficients c = pedestal.coefficients;
    if (pedestal.over_speed) {
      c = pedestal.over_speed(speed);
    }
    pedestals.rows.push_back({std::to_string(pedestal.node), partNumber(pedestal.mass_x),
                              partNumber(pedestal.mass_y), partNumber(c.kxx), partNumber(c.kyy),
                              partNumber(c.cxx), partNumber(c.cyy)});
  }
  PartsTable unbalances{"Unbalances", {"node", "kg m", "angle, rad"}, {}};
  for (const NodeUnbalance& unbalance : shaft.unbalances) {
    unbalances.rows.push_back({std::to_string(unbalance.node), partNumber(unbalance.magnitude),
                               partNumber(unbalance.angle)});
  }
  PartsTable ratios{"Modal damping, external", {"frequency, rad/s", "damping ratio"}, {}};
  for (const DampingRatio& at : shaft.modal_damping) {
    ratios.rows.push_back({partNumber(at.frequency), partNumber(at.ratio)});
  }
  for (PartsTable* table :
       {&couplings, &sleeves, &discs, &bearings, &pedestals, &ratios, &unbalances}) {
    if (!table->rows.empty()) {
      all.push_back(*table);
    }
  }
  return all;
}

Figure drawingFigure(const FlexibleShaft& shaft) {
  const std::vector<double> z = shaft.positions();
  const double radius = largestRadius(shaft);
  Chart chart = chartAlongShaft("radius (m)");
  chart.equal_aspect = true;
  chart.series = rotorOutline(shaft, 1.0, 0.0);
  chart.series.push_back(
      {"", {z.front(), z.back()}, {0.0, 0.0}, Pen{ink::kBlack, 0.8, {12.0, 3.0, 2.0, 3.0}}});
  const double below = -1.35 * radius;
  const int stride = std::max(1, static_cast<int>(static_cast<double>(z.size()) / kNamed));
  Series ticks{"", {}, {}, Pen{ink::kGrey, 1.0}};
  for (std::size_t node = 0; node < z.size(); node += static_cast<std::size_t>(stride)) {
    for (const double y : {1.02 * below, 0.95 * below}) {
      ticks.x.push_back(z[node]);
      ticks.y.push_back(y);
    }
    ticks.x.push_back(z[node]);
    ticks.y.push_back(kNaN);
    chart.notes.push_back({z[node], below, fmt::format("{}", node)});
  }
  chart.series.push_back(ticks);
  for (std::size_t i = 0; i < shaft.discs.size(); ++i) {
    const DrawnDisc drawn = drawnDisc(shaft, shaft.discs[i]);
    chart.notes.push_back({z[static_cast<std::size_t>(shaft.discs[i].node)], drawn.radius,
                           fmt::format("D{}", i + 1)});
  }
  chart.x.label = "along the shaft (m); numbers of nodes below the rotor";
  Series room{"", {0.5 * (z.front() + z.back())}, {1.25 * radius}, Pen{ink::kGrey, 1.0}};
  room.line = false;
  chart.series.push_back(room);
  Figure figure;
  figure.charts = {chart};
  figure.width = kWidth;
  const double scale = (kWidth - kMargins) / (z.back() - z.front());
  figure.chart_height = static_cast<int>(std::clamp(kAround + 2.8 * radius * scale, 200.0, 640.0));
  return figure;
}

Figure staticsFigure(const RotorSheet& sheet) {
  Chart sag = chartAlongShaft("y (m)");
  Chart shear = chartAlongShaft("shear force (N)");
  Chart moment = chartAlongShaft("bending moment (N m)");
  Series down{"", {}, {}, Pen{ink::kBlue, 2.0}};
  Series jumps = down, bends = down;
  for (const SagAtNode& node : sheet.statics->nodes) {
    down.x.push_back(node.position);
    down.y.push_back(node.deflection.y);
    for (const double force : {node.shear_before.y, node.shear_after.y}) {
      jumps.x.push_back(node.position);
      jumps.y.push_back(force);
    }
    bends.x.push_back(node.position);
    bends.y.push_back(node.moment.y);
  }
  sag.series = {lineAtZero(sheet), down};
  shear.series = {lineAtZero(sheet), jumps};
  moment.series = {lineAtZero(sheet), bends};
  std::vector<int> named;
  for (const BearingLoad& bearing : sheet.statics->bearings) {
    const bool carries = std::fabs(bearing.force.y) > kMarkedLoad * sheet.body.mass * sheet.gravity;
    if (carries && std::find(named.begin(), named.end(), bearing.node) == named.end()) {
      named.push_back(bearing.node);
      const double at = sheet.statics->nodes[static_cast<std::size_t>(bearing.node)].position;
      sag.vertical.push_back({at, fmt::format("bearing at node {}", bearing.node)});
      shear.vertical.push_back({at, ""});
      moment.vertical.push_back({at, ""});
    }
  }
  Figure figure;
  figure.charts = {sag, shear, moment};
  figure.width = kWidth;
  figure.chart_height = 240;
  return figure;
}

}  // namespace whirl_twin
