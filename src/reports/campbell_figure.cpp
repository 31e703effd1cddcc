// The Campbell diagram, and the logarithmic decrements of its branches below it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "analysis/separation_margin.h"
#include "reports/campbell_report.h"
#include "reports/table_speeds.h"

namespace whirl_twin {

namespace {

constexpr double kHighestDecrement = 1.5;  // a mode that is damped more does not matter

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
    // A piece goes on to the first point of the next, so that the line has no gap.
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
  double lowest = std::numeric_limits<double>::infinity();
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

Chart frequencyChart(const CampbellReport& r) {
  Chart chart;
  chart.x = {"", false, true, SecondScale{"rpm", 1.0 / kRpm}};
  chart.y.label = "damped whirl frequency (rad/s)";
  chart.y.tight = true;  // where a branch leaves the chart it goes to its edge
  const double most = highestFrequency(r);
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
      chart.vertical.push_back(
          {c.speed, fmt::format("{:.4g} rad/s, {:.0f} rpm", c.speed, c.speed / kRpm)});
    }
  }
  return chart;
}

Chart decrementChart(const CampbellReport& r) {
  Chart chart;
  chart.x = {"shaft speed (rad/s)", false, true};
  chart.y.label = "logarithmic decrement";
  addBands(r, false, chart);
  addBranches(r, {&CampbellPoint::log_decrement, kHighestDecrement}, false, chart);
  numberBranches(r, {&CampbellPoint::log_decrement, kHighestDecrement}, chart);
  chart.series.push_back(
      {"", {r.range.from, r.range.to}, {0.0, 0.0}, Pen{ink::kBlack, 1.2, {8.0, 4.0}}});
  return chart;
}

}  // namespace

Figure figure(const CampbellReport& r) {
  Figure figure;
  figure.title = r.system->title() + ": Campbell diagram";
  figure.charts = {frequencyChart(r), decrementChart(r)};
  figure.width = 900;
  figure.chart_height = 430;
  return figure;
}

}  // namespace whirl_twin
