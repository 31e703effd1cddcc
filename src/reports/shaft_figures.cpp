#include "reports/shaft_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

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
    ticks.y.push_back(std::numeric_limits<double>::quiet_NaN());
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
