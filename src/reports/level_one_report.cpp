#include "reports/level_one_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/critical_map_report.h"
#include "reports/report_values.h"
#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

constexpr int kRows = 25;
constexpr double kBeyondMargins = 1.25;  // of Q_0 or Q_A, the larger
constexpr double kMinRatio = 2.0;        // Q_0 / Q_A
constexpr double kSureRatio = 10.0;      // likewise: beyond it the gas does not matter
constexpr double kMinDecrement = 0.1;    // at Q_A

/// [m], the middle between the outermost bearings, or of all stations.
double middleBetweenBearings(const RotorSystem& system) {
  std::vector<double> places;
  if (system.shaft) {
    const std::vector<double> z = system.shaft->positions();
    for (const int node : bearingNodes(*system.shaft)) {
      places.push_back(z[static_cast<std::size_t>(node)]);
    }
  }
  if (places.empty()) {
    for (const Station& station : system.stations) {
      places.push_back(station.position);
    }
  }
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  return 0.5 * (*first + *last);
}

std::size_t stationOrMiddle(const RotorSystem& system, const std::optional<std::string>& name) {
  if (name) {
    return system.stationNamed("--at", *name);
  }
  const double middle = middleBetweenBearings(system);
  const auto away = [&](const Station& station) { return std::fabs(station.position - middle); };
  const auto nearest =
      std::min_element(system.stations.begin(), system.stations.end(),
                       [&](const Station& a, const Station& b) { return away(a) < away(b); });
  return static_cast<std::size_t>(nearest - system.stations.begin());
}

void requireNumbers(const LevelOneReport& r) {
  if (!(r.speed > 0.0 && r.speed <= 1.0e6)) {
    throw InputError(fmt::format(
        "--speed: expected a shaft speed above 0 and up to 1e+06 rad/s, found {:g}", r.speed));
  }
  for (const Stage& stage : r.request.stages) {
    if (!(stage.power > 0.0 && stage.diameter > 0.0 && stage.width > 0.0 &&
          stage.density_ratio > 0.0 && std::isfinite(alfordCrossCoupling(stage, r.speed)))) {
      throw InputError(
          "--stage: must be a power (W), a diameter (m), a width (m) and, for a centrifugal stage, "
          "a density ratio, each > 0");
    }
  }
}

CsvTable rowsTable(const LevelOneReport& r) {
  return {"",
          {"cross_coupling", "log_decrement", "frequency"},
          listJson(r.rows, [](const CrossCouplingRow& row) -> Json {
            return {{"cross_coupling", row.cross_coupling},
                    {"log_decrement", row.mode.logDecrement() + 0.0},
                    {"frequency", row.mode.dampedFrequency()}};
          })};
}

}  // namespace

std::vector<std::string> LevelOneReport::reasons() const {
  std::vector<std::string> all;
  if (!applied) {
    return all;
  }
  if (margin && *margin < kMinRatio * *applied) {
    all.push_back(fmt::format("Q_0/Q_A = {:.3g} is below {:g}", *margin / *applied, kMinRatio));
  }
  if (at_applied && at_applied->mode.logDecrement() < kMinDecrement) {
    all.push_back(fmt::format("the log. decrement at Q_A, {:.3g}, is below {:g}",
                              at_applied->mode.logDecrement(), kMinDecrement));
  }
  return all;
}

bool LevelOneReport::whirlsUncoupled() const {
  return rows.front().cross_coupling == 0.0;
}

LevelOneReport levelOneReport(const RotorSystem& system, const LevelOneRequest& request) {
  LevelOneReport r;
  r.system = &system;
  r.request = request;
  r.speed = request.speed.value_or(system.highest_speed);
  requireNumbers(r);
  const std::size_t station = stationOrMiddle(system, request.at);
  r.station = system.stations[station].name;
  const FullOrderModel full = fullOrderModel(system, station);
  r.margin = crossCouplingMargin(full.rotor, full.stations, station, r.speed);
  for (const Stage& stage : request.stages) {
    r.expected.push_back(alfordCrossCoupling(stage, r.speed));
    r.applied = r.applied.value_or(0.0) + r.expected.back();
  }
  const double widest = std::max(r.margin.value_or(0.0), r.applied.value_or(0.0));
  const double last = widest > 0.0
                          ? kBeyondMargins * widest
                          : 0.1 * full.rotor.matrices(r.speed).stiffness.cwiseAbs().maxCoeff();
  std::vector<double> couplings;
  for (int i = 0; i < kRows; ++i) {
    couplings.push_back(last * i / (kRows - 1));
  }
  r.rows = slowestForwardMode(full.rotor, full.stations, station, r.speed, couplings);
  if (r.rows.empty()) {
    throw InputError(fmt::format(
        "{}: expected a rotor with a forward whirl (damping ratio up to 0.7) at {:g} rad/s, found "
        "none with cross-coupled stiffnesses up to {:.4g} N/m",
        system.title(), r.speed, last));
  }
  if (r.applied) {
    const auto rows = slowestForwardMode(full.rotor, full.stations, station, r.speed, {*r.applied});
    r.at_applied = rows.empty() ? std::nullopt : std::optional(rows.front());
  }
  if (system.shaft) {
    try {
      const CriticalMapReport map = criticalMapReport(system, {});
      r.critical_speed_ratio = r.speed / map.map.rigid.front();
    } catch (const InputError&) {
      r.critical_speed_ratio.reset();  // one bearing, or none: there are no rigid ones either
    }
  }
  return r;
}

Json json(const LevelOneReport& r) {
  Json json{{"model", r.system->model},
            {"speed", r.speed},
            {"station", r.station},
            {"beyond_tables", !r.system->tables().covers(r.speed)},
            {"stages", Json::array()}};
  for (std::size_t i = 0; i < r.expected.size(); ++i) {
    const Stage& stage = r.request.stages[i];
    json["stages"].push_back({{"kind", stage.axial ? "axial" : "centrifugal"},
                              {"power", stage.power},
                              {"diameter", stage.diameter},
                              {"width", stage.width},
                              {"density_ratio", stage.density_ratio},
                              {"cross_coupling", r.expected[i]}});
  }
  json["expected_cross_coupling"] = r.applied;
  json["threshold_cross_coupling"] = r.margin;
  const CsvTable rows = rowsTable(r);
  for (const std::string& key : rows.columns) {
    json[key] = listJson(rows.rows, [&](const Json& row) { return row[key]; });
  }
  json["forward_whirl_without_cross_coupling"] = r.whirlsUncoupled();
  json["log_decrement_expected"] =
      r.at_applied ? Json(r.at_applied->mode.logDecrement() + 0.0) : Json();
  json["critical_speed_ratio"] = r.critical_speed_ratio;
  json["level_two"] = r.reasons();
  return json;
}

CsvTables tables(const LevelOneReport& r) {
  return {rowsTable(r),
          {"stages",
           {"kind", "power", "diameter", "width", "density_ratio", "cross_coupling"},
           json(r)["stages"]}};
}

std::string text(const LevelOneReport& r, const ShownUnits& u) {
  const std::string& stiffness = u.stiffness.name;
  std::string out = fmt::format(
      "{}: slowest decaying forward whirl at {:g} {} ({:.0f} {}), cross-coupling at {}\n"
      "    {:<16}log. decrement {:>11}\n",
      r.system->title(), u.speed.in(r.speed), u.speed.name, u.besideSpeed().in(r.speed),
      u.besideSpeed().name, r.station, "Q, " + stiffness, u.frequency.name);
  const std::string beyond = beyondLine(r.system->tables(), r.speed, r.speed);
  for (std::size_t i = 0; i < r.rows.size(); i += 2) {
    const CrossCouplingRow& row = r.rows[i];
    out += fmt::format("    {:<15.5g} {:>14.4g} {:>11.5g}\n", u.stiffness.in(row.cross_coupling),
                       row.mode.logDecrement() + 0.0, u.frequency.in(row.mode.dampedFrequency()));
  }
  if (!r.whirlsUncoupled()) {
    out +=
        "  without cross-coupling all forward modes have a damping ratio above 0.7, which is no "
        "whirl:\n  the table begins at the first whirl\n";
  }
  out += r.margin ? fmt::format("  Q_0, where it ceases to decay: {:.5g} {}\n",
                                u.stiffness.in(*r.margin), stiffness)
                  : std::string("  Q_0, where it ceases to decay: none found\n");
  if (!r.applied) {
    return out + "  Q_A, expected of the stages: not known (--stage POWER DIAMETER WIDTH RATIO)\n" +
           beyond;
  }
  for (std::size_t i = 0; i < r.expected.size(); ++i) {
    const Stage& stage = r.request.stages[i];
    out +=
        fmt::format("    stage {:<3} {} {:.5g} W, {:.4g} {}, {:.4g} {}{}: {:.5g} {}\n", i + 1,
                    stage.axial ? "axial" : "centrifugal", stage.power, u.length.in(stage.diameter),
                    u.length.name, u.length.in(stage.width), u.length.name,
                    stage.axial ? "" : fmt::format(", density ratio {:.4g}", stage.density_ratio),
                    u.stiffness.in(r.expected[i]), stiffness);
  }
  out += fmt::format("  Q_A, all stages by Alford's formula as modified by API 617: {:.5g} {}\n",
                     u.stiffness.in(*r.applied), stiffness);
  if (r.at_applied) {
    out += fmt::format("    log. decrement there  {:.4g}\n", r.at_applied->mode.logDecrement());
  } else {
    out += "    log. decrement there  none: no forward whirl (damping ratio up to 0.7)\n";
  }
  if (r.margin) {
    out += fmt::format("    Q_0 / Q_A             {:.4g}\n", *r.margin / *r.applied);
  }
  out += fmt::format(
      "  API 617 requires level II where Q_0/Q_A < {:g} or the log. decrement at Q_A < {:g}\n",
      kMinRatio, kMinDecrement);
  const std::vector<std::string> reasons = r.reasons();
  out += reasons.empty() ? std::string("    neither applies\n")
                         : fmt::format("    it applies: {}\n", fmt::join(reasons, "; "));
  if (reasons.empty() && r.margin && *r.margin < kSureRatio * *r.applied) {
    out += fmt::format(
        "  and also, below Q_0/Q_A = {:g}, in region B of its chart over the gas density and the "
        "ratio "
        "of "
        "the\n  speed to the first critical speed on rigid bearings{}: not evaluated here\n",
        kSureRatio,
        r.critical_speed_ratio ? fmt::format(", which is {:.3g}", *r.critical_speed_ratio) : "");
  }
  return out + beyond + "  check the clause against the edition in force\n";
}

Figure figure(const LevelOneReport& r, const ShownUnits& u) {
  Chart chart;
  chart.x = tightAxis("cross-coupled stiffness at " + r.station, u.stiffness);
  chart.y.label = "log. decrement, slowest decaying forward whirl";
  Series curve{"", {}, {}, Pen{ink::kBlue, 2.2}};
  for (const CrossCouplingRow& row : r.rows) {
    curve.x.push_back(row.cross_coupling);
    curve.y.push_back(row.mode.logDecrement());
  }
  chart.series.push_back(curve);
  chart.horizontal.push_back({0.0, ""});
  if (r.applied) {
    chart.vertical.push_back({*r.applied, "Q_A"});
    chart.horizontal.push_back({kMinDecrement, "0.1"});
  }
  if (r.margin) {
    chart.vertical.push_back({*r.margin, "Q_0"});
  }
  Figure figure;
  figure.title = fmt::format("{}: stability level I at {}{}", r.system->title(),
                             u.speedText(r.speed), beyondMark(r.system->tables(), r.speed));
  figure.charts = {chart};
  figure.width = 860;
  figure.chart_height = 420;
  return figure;
}

}  // namespace whirl_twin
