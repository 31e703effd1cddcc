#include "reports/critical_map_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "reports/report_values.h"
#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

constexpr double kMinShare = 0.1;  // of the stiffest: less is a seal
constexpr int kSpeeds = 41;
constexpr double kUsual = 1.0e8;  // N/m, where all bearings are rigid

/// At a speed [rad/s], of all bearings of a node: kxx, kyy.
std::pair<double, double> stiffnessOf(const FlexibleShaft& shaft, int node, double speed) {
  double kxx = 0.0, kyy = 0.0;
  const auto add = [&](const BearingCoefficients& c) {
    kxx += c.kxx;
    kyy += c.kyy;
  };
  for (const RotorBearing& bearing : shaft.bearings) {
    if (bearing.node == node) {
      add(bearing.coefficients);
    }
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    if (bearing.node == node) {
      add(bearing.coefficients(speed));
    }
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    if (support.node == node) {
      kxx = kyy = kInfinity;
    }
  }
  return {kxx, kyy};
}

void chooseBearings(const FlexibleShaft& shaft, const std::vector<int>& asked, double speed,
                    CriticalMapReport& r) {
  const std::vector<int> all = bearingNodes(shaft);
  double stiffest = 0.0;
  const auto direct = [&](int node) {
    const auto [kxx, kyy] = stiffnessOf(shaft, node, speed);
    return 0.5 * (kxx + kyy);
  };
  for (const int node : all) {
    if (std::isfinite(direct(node))) {
      stiffest = std::max(stiffest, direct(node));
    }
  }
  for (const int node : asked) {
    if (std::find(all.begin(), all.end(), node) == all.end()) {
      throw InputError(fmt::format("--bearing: expected nodes with bearings, {}; found {}",
                                   fmt::join(all, ", "), node));
    }
  }
  for (const int node : all) {
    const bool varied = asked.empty() ? direct(node) > kMinShare * stiffest
                                      : std::find(asked.begin(), asked.end(), node) != asked.end();
    if (varied) {
      r.bearings.push_back({node, {}, {}});
    } else {
      r.left_out.push_back(node);
    }
  }
}

/// [N/m], that the map goes over.
std::pair<double, double> rangeOf(const CriticalMapRequest& request, const CriticalMapReport& r) {
  double least = kMaxMapStiffness, most = 0.0;
  for (const BearingOnMap& bearing : r.bearings) {
    for (const std::vector<double>* list : {&bearing.kxx, &bearing.kyy}) {
      for (const double k : *list) {
        if (std::isfinite(k)) {
          least = k > 0.0 ? std::min(least, k) : least;
          most = std::max(most, k);
        }
      }
    }
  }
  if (std::all_of(r.bearings.begin(), r.bearings.end(),
                  [](const BearingOnMap& bearing) { return bearing.rigid(); })) {
    least = most = kUsual;
  }
  if (!(most > 0.0)) {
    throw InputError(
        "critical speed map: the bearings must support the rotor (kxx or kyy > 0), found none");
  }
  const double to = request.to.value_or(
      std::min(std::pow(10.0, std::ceil(std::log10(most)) + 2), kMaxMapStiffness));
  const double from = request.from.value_or(std::pow(
      10.0,
      std::floor(std::log10(std::min(std::max(least, 1e-3 * most), 1e-3 * kMaxMapStiffness))) - 1));
  if (!(from > 0.0 && from < to && to <= kMaxMapStiffness)) {
    throw InputError(fmt::format(
        "--from, --to: must be stiffnesses > 0 with --from < --to, found {:g} and {:g} N/m", from,
        to));
  }
  return {from, to};
}

/// Of a curve over the speeds the part that the tables cover, or the other part.
Series partOf(const CriticalMapReport& r, bool within_tables, Series curve) {
  for (double& speed : curve.y) {
    speed = r.system->tables().covers(speed) == within_tables ? speed : kNaN;
  }
  return curve;
}

}  // namespace

CriticalMapReport criticalMapReport(const RotorSystem& system, const CriticalMapRequest& request) {
  if (!system.shaft) {
    throw InputError(fmt::format(
        "{}: must be a flexible_rotor, the only model with bearings to vary", system.title()));
  }
  if (request.points < 2 || request.points > 1000) {
    throw InputError(fmt::format("--points: expected from 2 to 1000, found {}", request.points));
  }
  if (request.modes < 1 || request.modes > 50) {
    throw InputError(fmt::format("--modes: expected from 1 to 50, found {}", request.modes));
  }
  CriticalMapReport r;
  r.system = &system;
  r.pedestals = !system.shaft->pedestals.empty();
  const SpeedRange range = SpeedRangeOptions{std::nullopt, std::nullopt, kSpeeds}.of(system);
  chooseBearings(*system.shaft, request.nodes,
                 system.highest_speed > 0.0 ? system.highest_speed : range.to, r);
  for (int i = 1; i <= kSpeeds; ++i) {  // none of a film is defined at rest
    r.speeds.push_back(range.to * i / kSpeeds);
  }
  for (BearingOnMap& bearing : r.bearings) {
    for (const double speed : r.speeds) {
      const auto [kxx, kyy] = stiffnessOf(*system.shaft, bearing.node, speed);
      bearing.kxx.push_back(kxx);
      bearing.kyy.push_back(kyy);
    }
  }
  std::vector<int> nodes;
  for (const BearingOnMap& bearing : r.bearings) {
    nodes.push_back(bearing.node);
  }
  const auto [from, to] = rangeOf(request, r);
  r.map = criticalSpeedMap(*system.shaft, nodes, from, to, request.points,
                           static_cast<std::size_t>(request.modes));
  return r;
}

Json json(const CriticalMapReport& r) {
  return {{"model", r.system->model},
          {"running_speeds", {r.system->lowest_speed, r.system->highest_speed}},
          {"stiffness", arrayJson(r.map.stiffness)},
          {"critical_speeds",
           listJson(r.map.speeds, [](const std::vector<double>& mode) { return arrayJson(mode); })},
          {"on_rigid_bearings", arrayJson(r.map.rigid)},
          {"speeds", arrayJson(r.speeds)},
          {"table_speeds", tableSpeedsJson(r.system->tables())},  // null: every speed
          {"beyond_tables", beyondJson(r.system->tables(), r.speeds)},
          {"bearings", listJson(r.bearings,
                                [](const BearingOnMap& bearing) -> Json {
                                  return {{"node", bearing.node},
                                          {"kxx", arrayJson(bearing.kxx)},
                                          {"kyy", arrayJson(bearing.kyy)}};
                                })},
          {"left_out", r.left_out},
          {"pedestals_left_out", r.pedestals}};
}

CsvTables tables(const CriticalMapReport& r) {
  CsvTable map{"", {"mode", "stiffness", "critical_speed"}};
  for (std::size_t mode = 0; mode < r.map.speeds.size(); ++mode) {
    for (std::size_t i = 0; i < r.map.stiffness.size(); ++i) {
      map.rows.push_back({{"mode", mode + 1},
                          {"stiffness", r.map.stiffness[i]},
                          {"critical_speed", r.map.speeds[mode][i]}});
    }
  }
  CsvTable bearings{"bearings", {"node", "speed", "kxx", "kyy", "beyond_tables"}};
  for (const BearingOnMap& bearing : r.bearings) {
    for (std::size_t i = 0; i < r.speeds.size(); ++i) {
      bearings.rows.push_back({{"node", bearing.node},
                               {"speed", r.speeds[i]},
                               {"kxx", bearing.kxx[i]},
                               {"kyy", bearing.kyy[i]},
                               {"beyond_tables", !r.system->tables().covers(r.speeds[i])}});
    }
  }
  return {map, bearings};
}

std::string text(const CriticalMapReport& r, const ShownUnits& u) {
  constexpr std::size_t kRows = 13;
  std::string out = fmt::format(
      "{}: undamped forward critical speeds, {}, over the stiffness of each bearing\n"
      "    {:>14}",
      r.system->title(), u.speed.name, "stiffness, " + u.stiffness.name);
  for (std::size_t mode = 0; mode < r.map.speeds.size(); ++mode) {
    out += fmt::format(" {:>11}", fmt::format("mode {}", mode + 1));
  }
  const auto cell = [&](double speed) { return fmt::format(" {:>11.6g}", u.speed.in(speed)); };
  const std::size_t stride = std::max<std::size_t>(1, (r.map.stiffness.size() - 1) / (kRows - 1));
  for (std::size_t i = 0; i < r.map.stiffness.size(); i += stride) {
    out += fmt::format("\n    {:>14.5g}", u.stiffness.in(r.map.stiffness[i]));
    out += joined(r.map.speeds, [&](const std::vector<double>& mode) { return cell(mode[i]); });
  }
  out += "\n             rigid" + joined(r.map.rigid, cell) + "\n";
  for (const BearingOnMap& bearing : r.bearings) {
    if (bearing.rigid()) {
      out += fmt::format("    bearing at node {:<4} rigid\n", bearing.node);
      continue;
    }
    out += fmt::format(
        "    bearing at node {:<4} kxx {:.5g}, kyy {:.5g} {} at {:.5g} {}{}\n", bearing.node,
        u.stiffness.in(bearing.kxx.back()), u.stiffness.in(bearing.kyy.back()), u.stiffness.name,
        u.speed.in(r.speeds.back()), u.speed.name, beyondMark(r.system->tables(), r.speeds.back()));
  }
  if (!r.left_out.empty()) {
    out += fmt::format(
        "    left out: the bearings at {} {}, too soft to carry the rotor (--bearing)\n",
        r.left_out.size() == 1 ? "node" : "nodes", fmt::join(r.left_out, ", "));
  }
  out += beyondLine(r.system->tables(), r.speeds.front(), r.speeds.back());
  return r.pedestals ? out +
                           "    left out: pedestals; the stiffness is that of bearing and pedestal "
                           "in series\n"
                     : out;
}

Figure figure(const CriticalMapReport& r, const ShownUnits& u) {
  Chart chart;
  chart.x = tightAxis("stiffness of each bearing", u.stiffness);
  chart.y = tightAxis("undamped critical speed", u.speed);
  chart.y.tight = false;
  chart.x.logarithmic = chart.y.logarithmic = true;
  for (std::size_t mode = 0; mode < r.map.speeds.size(); ++mode) {
    Series curve{"", r.map.stiffness, r.map.speeds[mode], Pen{ink::kBlue, 2.2}};
    curve.name = mode == 0 ? "critical speed" : "";
    const std::size_t at = curve.x.size() / 6;
    chart.notes.push_back({curve.x[at], curve.y[at], fmt::format("mode {}", mode + 1)});
    chart.series.push_back(curve);
  }
  bool first = true;
  for (const BearingOnMap& bearing : r.bearings) {
    if (bearing.rigid()) {
      continue;
    }
    chart.series.push_back(partOf(r, true,
                                  {first ? "kxx of the bearings over the speed" : "", bearing.kxx,
                                   r.speeds, Pen{ink::kVermilion, 1.8}}));
    chart.series.push_back(partOf(
        r, true, {first ? "kyy" : "", bearing.kyy, r.speeds, Pen{ink::kGreen, 1.8, {6.0, 3.0}}}));
    chart.series.push_back(
        partOf(r, false,
               {first && !beyondLine(r.system->tables(), r.speeds.front(), r.speeds.back()).empty()
                    ? beyondName(r.system->tables())
                    : "",
                bearing.kxx, r.speeds, Pen{ink::kBlack, 1.2, {2.0, 4.0}}}));
    chart.notes.push_back(
        {bearing.kxx.back(), r.speeds.back(), fmt::format("node {}", bearing.node)});
    first = false;
  }
  if (r.system->highest_speed > 0.0) {
    chart.horizontal.push_back(
        {r.system->highest_speed, "highest speed " + u.speedText(r.system->highest_speed)});
  }
  Figure figure;
  figure.title = r.system->title() + ": undamped critical speed map";
  figure.charts = {chart};
  figure.width = 900;
  figure.chart_height = 520;
  return figure;
}

}  // namespace whirl_twin
