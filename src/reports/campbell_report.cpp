#include "reports/campbell_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/separation_margin.h"
#include "messages/input_error.h"
#include "reports/report_values.h"

namespace whirl_twin {

namespace {

Json pointJson(const CampbellPoint& point) {
  return {{"frequency", point.frequency},         {"natural_frequency", point.natural_frequency},
          {"decay_rate", point.decay_rate},       {"damping_ratio", point.damping_ratio},
          {"log_decrement", point.log_decrement}, {"direction", name(point.whirl)}};
}

Json branchJson(const std::vector<CampbellPoint>& branch) {
  Json json;
  for (const char* key :
       {"frequency", "natural_frequency", "decay_rate", "damping_ratio", "log_decrement"}) {
    json[key] = listJson(branch, [&](const CampbellPoint& point) {
      return pointJson(point)[key].get<double>() + 0.0;
    });
  }
  json["direction"] = listJson(branch, [](const CampbellPoint& point) {
    return std::isnan(point.frequency) ? Json() : Json(name(point.whirl));
  });
  return json;
}

/// `first`: the branch, counted from this number.
Json crossingsJson(const CampbellReport& r, std::size_t first) {
  return listJson(r.diagram.crossings, [&](const CampbellCrossing& c) {
    Json one{{"branch", c.branch + first}, {"harmonic", c.harmonic}, {"speed", c.speed}};
    one.update(pointJson(c.mode));
    one["beyond_tables"] = !r.system->tables().covers(c.speed);
    return one;
  });
}

std::string crossingsText(const CampbellReport& r, const ShownUnits& u) {
  if (r.diagram.crossings.empty()) {
    return "  critical speeds, where a whirl (damping ratio up to 0.7) crosses the speed line: "
           "none in the range\n";
  }
  const ShownUnit beside = u.besideSpeed();
  std::string out = fmt::format(
      "  critical speeds, where a whirl (damping ratio up to 0.7) crosses the speed line\n"
      "{:>16} {:>11}  order  branch  direction   log decrement\n",
      u.speed.name, beside.name);
  for (const CampbellCrossing& c : r.diagram.crossings) {
    out +=
        fmt::format("    {:>12.6g} {:>11.6g} {:>5g}X {:>7}  {:<9} {:>15}{}\n", u.speed.in(c.speed),
                    beside.in(c.speed), c.harmonic, c.branch + 1, name(c.mode.whirl),
                    defined(c.mode.log_decrement, "-"), beyondMark(r.system->tables(), c.speed));
  }
  return out;
}

constexpr double kMaxDecrement = 1.5;  // a mode that is damped more does not matter

constexpr std::array kDirections{Whirl::kForward, Whirl::kBackward, Whirl::kMixed,
                                 Whirl::kStraight};

Ink inkOf(Whirl whirl) {
  switch (whirl) {
    case Whirl::kForward:
      return ink::kBlue;
    case Whirl::kBackward:
      return ink::kVermilion;
    case Whirl::kMixed:
      return ink::kGreen;
    case Whirl::kStraight:
      break;
  }
  return ink::kPurple;
}

struct Value {
  double CampbellPoint::*of;
  double most;
};

/// The parts of a branch in one direction that are stable, or that are not.
Series piecesOf(const CampbellReport& r, const std::vector<CampbellPoint>& branch, Whirl whirl,
                bool stable, const Value& value) {
  Series pieces;
  // Of an isotropic rotor at rest the backward whirl lies on the forward one: both are seen.
  pieces.pen = Pen{inkOf(whirl), whirl == Whirl::kForward ? 4.0 : 1.8, {}};
  if (!stable) {
    pieces.pen = Pen{inkOf(whirl), whirl == Whirl::kForward ? 4.0 : 2.5, {3.0, 3.0}};
  }
  bool drawn = false;
  for (std::size_t k = 0; k < branch.size(); ++k) {
    const CampbellPoint& point = branch[k];
    const bool fits = point.whirl == whirl && (point.decay_rate >= 0.0) == stable &&
                      point.*value.of <= value.most;
    // A piece extends to the first point of the next, so that the line has no gap.
    const bool joins = drawn && !std::isnan(point.*value.of) && point.*value.of <= value.most;
    pieces.x.push_back(r.diagram.speeds[k]);
    pieces.y.push_back(fits || joins ? point.*value.of : kNaN);
    if (joins && !fits) {
      pieces.x.push_back(r.diagram.speeds[k]);
      pieces.y.push_back(kNaN);
    }
    drawn = fits;
  }
  return pieces;
}

/// The highest frequency shown: what a shaft in the range can excite, with the next mode if near.
double highestFrequency(const CampbellReport& r) {
  double lowest = kInfinity;
  for (const auto& branch : r.diagram.branches) {
    for (const CampbellPoint& point : branch) {
      lowest = std::fmin(lowest, point.frequency);
    }
  }
  return std::max(1.3 * r.range.to, std::isfinite(lowest) ? 1.5 * lowest : 0.0);
}

/// Is a part of the branch below the highest frequency that is drawn?
bool isDrawn(const std::vector<CampbellPoint>& branch, double most) {
  return std::any_of(branch.begin(), branch.end(),
                     [&](const CampbellPoint& p) { return p.frequency <= most; });
}

void addBranches(const CampbellReport& r, const Value& value, bool named, Chart& chart) {
  const double most = highestFrequency(r);
  bool any_unstable = false;
  for (const Whirl whirl : kDirections) {
    bool name_it = named;
    for (const auto& branch : r.diagram.branches) {
      if (!isDrawn(branch, most)) {
        continue;
      }
      for (const bool stable : {true, false}) {
        Series pieces = piecesOf(r, branch, whirl, stable, value);
        if (std::none_of(pieces.y.begin(), pieces.y.end(),
                         [](double y) { return std::isfinite(y); })) {
          continue;
        }
        any_unstable = any_unstable || !stable;
        if (name_it && stable) {
          pieces.name = name(whirl);
          name_it = false;
        }
        chart.series.push_back(pieces);
      }
    }
  }
  if (named && any_unstable) {
    chart.series.push_back({"unstable", {}, {}, Pen{ink::kBlack, 3.0, {3.0, 3.0}}});
  }
}

void addBands(const CampbellReport& r, bool named, Chart& chart) {
  if (r.system->highest_speed > r.system->lowest_speed) {
    chart.bands.push_back({named ? "running speeds" : "", r.system->lowest_speed,
                           r.system->highest_speed, paler(ink::kGreen, 0.88)});
  }
  bool first = named;
  for (const CriticalSpeed& peak : r.peaks) {
    const SpeedBand band = criticalBand(peak.speed, peak.amplification_factor);
    if (!band.empty()) {
      chart.bands.push_back(
          {first ? "separation margin" : "", band.from, band.to, paler(ink::kOrange, 0.65)});
      first = false;
    }
  }
  // On top: nothing else drawn there is known.
  shadeBeyond(r.system->tables(), r.range.from, r.range.to, named, chart);
}

/// The number of each branch that is drawn, beside its last point: the highest first, so that of
/// two near ones the upper has its number above and the lower below.
void numberBranches(const CampbellReport& r, const Value& value, Chart& chart) {
  const double most = highestFrequency(r);
  std::vector<Note> numbers;
  for (std::size_t b = 0; b < r.diagram.branches.size(); ++b) {
    const std::vector<CampbellPoint>& branch = r.diagram.branches[b];
    for (std::size_t k = branch.size(); k-- > 0;) {
      if (isDrawn(branch, most) && branch[k].*value.of <= value.most) {
        numbers.push_back({r.diagram.speeds[k], branch[k].*value.of, fmt::format("{}", b + 1)});
        break;
      }
    }
  }
  std::stable_sort(numbers.begin(), numbers.end(),
                   [](const Note& a, const Note& b) { return a.y > b.y; });
  chart.notes.insert(chart.notes.end(), numbers.begin(), numbers.end());
}

Chart frequencyChart(const CampbellReport& r, const ShownUnits& u) {
  Chart chart;
  chart.x = tightAxis("", u.speed, u.besideSpeed());
  chart.x.label.clear();  // that of the chart below
  // Where a branch leaves the chart it goes to its edge.
  chart.y = tightAxis("damped whirl frequency", u.frequency);
  const double most = highestFrequency(r);
  Series range{"", {r.range.from, r.range.from}, {0.0, most}};  // branches at the top are seen
  range.line = false;
  chart.series.push_back(range);
  addBands(r, true, chart);
  addBranches(r, {&CampbellPoint::frequency, most}, true, chart);
  numberBranches(r, {&CampbellPoint::frequency, most}, chart);
  std::vector<double> harmonics{1.0};
  for (const CampbellCrossing& c : r.diagram.crossings) {
    if (std::find(harmonics.begin(), harmonics.end(), c.harmonic) == harmonics.end()) {
      harmonics.push_back(c.harmonic);
    }
  }
  for (const double harmonic : harmonics) {
    const double end = std::min(r.range.to, most / harmonic);
    chart.series.push_back({fmt::format("{:g}X", harmonic),
                            {r.range.from, end},
                            {harmonic * r.range.from, harmonic * end},
                            Pen{ink::kBlack, 1.2, {8.0, 4.0}}});
  }
  bool name_it = true;
  for (const CampbellCrossing& c : r.diagram.crossings) {
    if (c.mode.frequency > most) {
      continue;
    }
    Series mark{name_it ? "critical speed" : "",
                {c.speed},
                {c.mode.frequency},
                Pen{inkOf(c.mode.whirl), 2.0}};
    mark.line = false;
    mark.marks = Marks::kRings;
    name_it = false;
    chart.series.push_back(mark);
    if (c.harmonic == 1.0 && c.mode.whirl != Whirl::kBackward) {
      chart.vertical.push_back({c.speed, u.speedText(c.speed)});
    }
  }
  return chart;
}

Chart decrementChart(const CampbellReport& r, const ShownUnits& u) {
  Chart chart;
  chart.x = tightAxis("shaft speed", u.speed);
  chart.y.label = "logarithmic decrement";
  addBands(r, false, chart);
  addBranches(r, {&CampbellPoint::log_decrement, kMaxDecrement}, false, chart);
  numberBranches(r, {&CampbellPoint::log_decrement, kMaxDecrement}, chart);
  chart.series.push_back(
      {"", {r.range.from, r.range.to}, {0.0, 0.0}, Pen{ink::kBlack, 1.2, {8.0, 4.0}}});
  return chart;
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
  const auto with_point = [&](std::vector<std::string> columns) {
    for (const char* column : {"frequency", "natural_frequency", "decay_rate", "damping_ratio",
                               "log_decrement", "direction", "beyond_tables"}) {
      columns.emplace_back(column);
    }
    return columns;
  };
  CsvTable branches{"", with_point({"branch", "speed"})};
  for (std::size_t i = 0; i < r.diagram.branches.size(); ++i) {
    for (std::size_t k = 0; k < r.diagram.speeds.size(); ++k) {
      Json row{{"branch", i + 1}, {"speed", r.diagram.speeds[k]}};
      row.update(pointJson(r.diagram.branches[i][k]));
      row["beyond_tables"] = !r.system->tables().covers(r.diagram.speeds[k]);
      branches.rows.push_back(row);
    }
  }
  return {branches,
          {"crossings", with_point({"branch", "harmonic", "speed"}), crossingsJson(r, 1)},
          {"peaks",
           {"speed", "direction", "amplification_factor", "band_low", "band_high", "beyond_tables"},
           json(r)["response_peaks"]}};
}

Json json(const CampbellReport& r) {
  const DataSpeeds data = r.system->tables();
  return {{"model", r.system->model},
          {"running_speeds", {r.system->lowest_speed, r.system->highest_speed}},
          {"speeds", arrayJson(r.diagram.speeds)},
          {"highest_speed", r.system->rotor.highest_speed},  // null: every speed
          {"beyond_reduction", r.beyond},
          {"table_speeds", tableSpeedsJson(data)},  // null: every speed
          {"beyond_tables", beyondJson(data, r.diagram.speeds)},
          {"branches", listJson(r.diagram.branches, branchJson)},
          {"crossings", crossingsJson(r, 0)},
          {"undamped_critical_speeds", listJson(r.undamped,
                                                [&](const UndampedCriticalSpeed& one) -> Json {
                                                  return {
                                                      {"speed", one.speed},
                                                      {"direction", name(one.whirl)},
                                                      {"beyond_tables", !data.covers(one.speed)}};
                                                })},
          {"response_peaks", listJson(r.peaks, [&](const CriticalSpeed& peak) -> Json {
             const SpeedBand band = criticalBand(peak.speed, peak.amplification_factor);
             return {{"speed", peak.speed},
                     {"direction", peak.forward ? "forward" : "backward"},
                     {"amplification_factor", peak.amplification_factor},
                     {"band_low", band.from},
                     {"band_high", band.to},
                     {"beyond_tables", !data.covers(peak.speed)}};
           })}};
}

std::string text(const CampbellReport& r, const ShownUnits& u) {
  const DataSpeeds data = r.system->tables();
  std::string out = fmt::format("{}: from {:g} to {:g} {} ({:.4g} to {:.4g} {})\n",
                                r.system->title(), u.speed.in(r.range.from), u.speed.in(r.range.to),
                                u.speed.name, u.besideSpeed().in(r.range.from),
                                u.besideSpeed().in(r.range.to), u.besideSpeed().name);
  out += fmt::format(
      "  branch       at the lowest speed              at the highest speed\n"
      "{:>16}   direction  log dec. {:>10}   direction  log dec.\n",
      u.frequency.name, u.frequency.name);
  for (std::size_t i = 0; i < r.diagram.branches.size(); ++i) {
    const CampbellPoint& first = r.diagram.branches[i].front();
    const CampbellPoint& last = r.diagram.branches[i].back();
    out += fmt::format("  {:>3} {:>11}   {:<9} {:>9.4g} {:>10}   {:<9} {:>9.4g}\n", i + 1,
                       defined(u.frequency.in(first.frequency), "overdamped"), name(first.whirl),
                       first.log_decrement, defined(u.frequency.in(last.frequency), "overdamped"),
                       name(last.whirl), last.log_decrement);
  }
  out += crossingsText(r, u);
  out += fmt::format("  undamped critical speeds, {}\n   ", u.speed.name);
  for (const auto& one : r.undamped) {
    out += fmt::format(" {:.6g} {}{},", u.speed.in(one.speed), name(one.whirl),
                       beyondMark(data, one.speed));
  }
  if (r.undamped.empty()) {
    out += " none,";
  }
  out.back() = '\n';
  out += fmt::format("  peaks of the unbalance response, {}\n", u.speed.name);
  for (const CriticalSpeed& peak : r.peaks) {
    const SpeedBand band = criticalBand(peak.speed, peak.amplification_factor);
    out += fmt::format("    {:.6g}, amplification {}{}{}\n", u.speed.in(peak.speed),
                       defined(peak.amplification_factor, "-"),
                       band.empty() ? std::string(": critically damped")
                                    : fmt::format(": separation margin {:.5g} to {:.5g}",
                                                  u.speed.in(band.from), u.speed.in(band.to)),
                       beyondMark(data, peak.speed));
  }
  if (r.peaks.empty()) {
    out += "    none\n";
  }
  out += beyondLine(data, r.range.from, r.range.to);
  return r.range.to <= r.system->rotor.highest_speed
             ? out
             : out + fmt::format(
                         "  the reduced-order rotor is valid up to {:g} {}: {} crossings and "
                         "undamped critical speeds\n  above are left out, and its branches are not "
                         "those of the machine there\n",
                         u.speed.in(r.system->rotor.highest_speed), u.speed.name, r.beyond);
}

Figure figure(const CampbellReport& r, const ShownUnits& u) {
  Figure figure;
  figure.title = r.system->title() + ": Campbell diagram";
  figure.charts = {frequencyChart(r, u), decrementChart(r, u)};
  figure.width = 900;
  figure.chart_height = 430;
  return figure;
}

}  // namespace whirl_twin
