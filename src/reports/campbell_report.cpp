#include "reports/campbell_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/separation_margin.h"
#include "messages/refusal.h"
#include "reports/matrix_json.h"
#include "reports/table_speeds.h"
#include "reports/verdict_text.h"

namespace whirl_twin {

namespace {

Json pointJson(const CampbellPoint& point) {
  return {{"frequency", point.frequency},         {"natural_frequency", point.natural_frequency},
          {"decay_rate", point.decay_rate},       {"damping_ratio", point.damping_ratio},
          {"log_decrement", point.log_decrement}, {"direction", name(point.whirl)}};
}

Json branchJson(const std::vector<CampbellPoint>& branch) {
  Json json;
  const auto list = [&](const char* key, double CampbellPoint::*value) {
    json[key] = Json::array();
    for (const CampbellPoint& point : branch) {
      json[key].push_back(point.*value + 0.0);
    }
  };
  list("frequency", &CampbellPoint::frequency);
  list("natural_frequency", &CampbellPoint::natural_frequency);
  list("decay_rate", &CampbellPoint::decay_rate);
  list("damping_ratio", &CampbellPoint::damping_ratio);
  list("log_decrement", &CampbellPoint::log_decrement);
  json["direction"] = Json::array();
  for (const CampbellPoint& point : branch) {
    json["direction"].push_back(std::isnan(point.frequency) ? Json() : Json(name(point.whirl)));
  }
  return json;
}

std::string crossingsText(const CampbellReport& r) {
  if (r.diagram.crossings.empty()) {
    return "  critical speeds, where a whirl (damping ratio up to 0.7) crosses the speed line: "
           "none in the range\n";
  }
  std::string out =
      "  critical speeds, where a whirl (damping ratio up to 0.7) crosses the speed line\n"
      "           rad/s         rpm  order  branch  direction   log decrement\n";
  for (const CampbellCrossing& c : r.diagram.crossings) {
    out += fmt::format("    {:>12.6g} {:>11.6g} {:>5g}X {:>7}  {:<9} {:>15}{}\n", c.speed,
                       c.speed / kRpm, c.harmonic, c.branch + 1, name(c.mode.whirl),
                       defined(c.mode.log_decrement, "-"), beyondMark(r.system->tables(), c.speed));
  }
  return out;
}

}  // namespace

CampbellReport campbellReport(const RotorSystem& system, const SpeedRange& range,
                              const std::vector<double>& harmonics, std::size_t branches,
                              const std::function<void(std::size_t)>& progress) {
  CampbellReport r{&system, range, {}, {}, {}, 0};
  r.diagram =
      campbell(system.rotor, system.stations, {range.speeds(), harmonics, branches, progress});
  try {
    r.undamped = undampedCriticalSpeeds(system.rotor, system.stations, range.to);
  } catch (const RunFailure&) {
    r.undamped.clear();  // springs that push: without damping it does not whirl, it falls
  }
  r.peaks = criticalSpeeds(*system.dynamics);
  const auto below = [&](const auto& one) { return one.speed < range.from; };
  const auto outside = [&](const auto& one) { return below(one) || one.speed > range.to; };
  r.undamped.erase(std::remove_if(r.undamped.begin(), r.undamped.end(), below), r.undamped.end());
  r.peaks.erase(std::remove_if(r.peaks.begin(), r.peaks.end(), outside), r.peaks.end());
  const auto leave_out_beyond = [&](auto& all) {
    const auto end = std::remove_if(all.begin(), all.end(), [&](const auto& one) {
      return one.speed > system.rotor.highest_speed;
    });
    r.beyond += static_cast<std::size_t>(all.end() - end);
    all.erase(end, all.end());
  };
  leave_out_beyond(r.diagram.crossings);
  leave_out_beyond(r.undamped);
  return r;
}

CsvTables tables(const CampbellReport& r) {
  const DataSpeeds data = r.system->tables();
  const std::vector<std::string> point{"frequency",     "natural_frequency", "decay_rate",
                                       "damping_ratio", "log_decrement",     "direction"};
  const auto with_point = [&](std::vector<std::string> columns) {
    columns.insert(columns.end(), point.begin(), point.end());
    columns.emplace_back("beyond_tables");
    return columns;
  };
  CsvTable branches{"", with_point({"branch", "speed"})};
  for (std::size_t i = 0; i < r.diagram.branches.size(); ++i) {
    for (std::size_t k = 0; k < r.diagram.speeds.size(); ++k) {
      Json row{{"branch", i + 1}, {"speed", r.diagram.speeds[k]}};
      row.update(pointJson(r.diagram.branches[i][k]));
      row["beyond_tables"] = !data.covers(r.diagram.speeds[k]);
      branches.rows.push_back(row);
    }
  }
  CsvTable crossings{"crossings", with_point({"branch", "harmonic", "speed"})};
  for (const CampbellCrossing& c : r.diagram.crossings) {
    Json row{{"branch", c.branch + 1}, {"harmonic", c.harmonic}, {"speed", c.speed}};
    row.update(pointJson(c.mode));
    row["beyond_tables"] = !data.covers(c.speed);
    crossings.rows.push_back(row);
  }
  return {branches,
          crossings,
          {"peaks",
           {"speed", "direction", "amplification_factor", "band_low", "band_high", "beyond_tables"},
           json(r)["response_peaks"]}};
}

Json json(const CampbellReport& r) {
  Json json;
  json["model"] = r.system->model;
  json["running_speeds"] = {r.system->lowest_speed, r.system->highest_speed};
  json["speeds"] = arrayJson(r.diagram.speeds);
  json["highest_speed"] = r.system->rotor.highest_speed;  // null: every speed
  json["beyond_reduction"] = r.beyond;
  const DataSpeeds data = r.system->tables();
  json["table_speeds"] = tableSpeedsJson(data);  // null: every speed
  json["beyond_tables"] = beyondJson(data, r.diagram.speeds);
  json["branches"] = Json::array();
  for (const auto& branch : r.diagram.branches) {
    json["branches"].push_back(branchJson(branch));
  }
  json["crossings"] = Json::array();
  for (const CampbellCrossing& c : r.diagram.crossings) {
    Json one{{"branch", c.branch}, {"harmonic", c.harmonic}, {"speed", c.speed}};
    one.update(pointJson(c.mode));
    one["beyond_tables"] = !data.covers(c.speed);
    json["crossings"].push_back(one);
  }
  json["undamped_critical_speeds"] = Json::array();
  for (const auto& one : r.undamped) {
    json["undamped_critical_speeds"].push_back({{"speed", one.speed},
                                                {"direction", name(one.whirl)},
                                                {"beyond_tables", !data.covers(one.speed)}});
  }
  json["response_peaks"] = Json::array();
  for (const CriticalSpeed& peak : r.peaks) {
    const SpeedBand band = criticalBand(peak.speed, peak.amplification_factor);
    json["response_peaks"].push_back({{"speed", peak.speed},
                                      {"direction", peak.forward ? "forward" : "backward"},
                                      {"amplification_factor", peak.amplification_factor},
                                      {"band_low", band.from},
                                      {"band_high", band.to},
                                      {"beyond_tables", !data.covers(peak.speed)}});
  }
  return json;
}

std::string text(const CampbellReport& r) {
  const DataSpeeds data = r.system->tables();
  std::string out =
      fmt::format("{}: from {:g} to {:g} rad/s ({:.4g} to {:.4g} rpm)\n", r.system->title(),
                  r.range.from, r.range.to, r.range.from / kRpm, r.range.to / kRpm);
  out +=
      "  branch       at the lowest speed              at the highest speed\n"
      "           rad/s   direction  log dec.      rad/s   direction  log dec.\n";
  for (std::size_t i = 0; i < r.diagram.branches.size(); ++i) {
    const CampbellPoint& first = r.diagram.branches[i].front();
    const CampbellPoint& last = r.diagram.branches[i].back();
    out +=
        fmt::format("  {:>3} {:>11}   {:<9} {:>9.4g} {:>10}   {:<9} {:>9.4g}\n", i + 1,
                    defined(first.frequency, "overdamped"), name(first.whirl), first.log_decrement,
                    defined(last.frequency, "overdamped"), name(last.whirl), last.log_decrement);
  }
  out += crossingsText(r);
  out += "  undamped critical speeds, rad/s\n   ";
  for (const auto& one : r.undamped) {
    out += fmt::format(" {:.6g} {}{},", one.speed, name(one.whirl), beyondMark(data, one.speed));
  }
  if (r.undamped.empty()) {
    out += " none,";
  }
  out.back() = '\n';
  out += "  peaks of the unbalance response, rad/s\n";
  for (const CriticalSpeed& peak : r.peaks) {
    const SpeedBand band = criticalBand(peak.speed, peak.amplification_factor);
    out += fmt::format(
        "    {:.6g}, amplification {}{}{}\n", peak.speed, defined(peak.amplification_factor, "-"),
        band.empty() ? std::string(": critically damped")
                     : fmt::format(": separation margin {:.5g} to {:.5g}", band.from, band.to),
        beyondMark(data, peak.speed));
  }
  if (r.peaks.empty()) {
    out += "    none\n";
  }
  out += beyondLine(data, r.range.from, r.range.to);
  return r.range.to <= r.system->rotor.highest_speed
             ? out
             : out + fmt::format(
                         "  the reduced-order rotor is valid up to {:g} rad/s: {} crossings and "
                         "undamped critical speeds\n  above are left out, and its branches are not "
                         "those of the machine there\n",
                         r.system->rotor.highest_speed, r.beyond);
}

}  // namespace whirl_twin
