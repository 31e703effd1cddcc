#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "algebra/constants.h"
#include "analysis/critical_speeds.h"
#include "reports/system_plots.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kOrbits = 6;  // of a rotor that changes its speed
constexpr double kSlow = 0.02;      // of its highest speed: it hardly turns

/// [rad], that the shaft has turned through since the start, without its direction.
std::vector<double> turned(const PlotHistory& history) {
  std::vector<double> angle{0.0};
  for (std::size_t i = 0; i + 1 < history.time.size(); ++i) {
    angle.push_back(angle.back() +
                    std::fabs(history.speed[i]) * (history.time[i + 1] - history.time[i]));
  }
  return angle;
}

double fastestOf(const PlotHistory& history) {
  double fastest = 0.0;
  for (const double speed : history.speed) {
    fastest = std::max(fastest, std::fabs(speed));
  }
  return fastest;
}

/// The lag, unwrapped from sample to sample; NaN where it slips by more than a quarter in a turn
/// of the shaft, so that the whirl does not go along with it, and where that hardly turns.
std::vector<double> heldLag(const PlotHistory& history) {
  std::vector<double> lag = history.whirl_phase;
  double before = 0.0;
  for (double& value : lag) {
    if (std::isfinite(value)) {
      value = before + std::remainder(value - before, kTwoPi);
      before = value;
    }
  }
  const std::vector<double> angle = turned(history);
  const double slow = kSlow * fastestOf(history);
  std::vector<double> held(lag.size(), kNaN);
  for (std::size_t i = 0; i < lag.size(); ++i) {
    const double start = std::clamp(angle[i] - kPi, 0.0, std::max(0.0, angle.back() - kTwoPi));
    const auto at = [&](double turn) {
      const auto next = std::lower_bound(angle.begin(), angle.end() - 1, turn);
      return lag[static_cast<std::size_t>(next - angle.begin())];
    };
    if (std::fabs(at(start + kTwoPi) - at(start)) <= 0.5 * kPi &&
        std::fabs(history.speed[i]) >= slow) {
      held[i] = lag[i];
    }
  }
  return held;
}

/// Without the stretches that last for a small part of the run only: there a lag passes for held.
void leaveOutShort(std::vector<double>& values) {
  constexpr std::size_t kParts = 50;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i;
    while (end < values.size() && std::isfinite(values[end])) {
      ++end;
    }
    if (end - i < values.size() / kParts) {
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(i),
                values.begin() + static_cast<std::ptrdiff_t>(end), kNaN);
    }
    i = end + 1;
  }
}

/// In degrees within half a turn of 90, broken where it passes from one end to the other.
std::vector<double> phaseLagHistory(const PlotHistory& history) {
  std::vector<double> lag = heldLag(history);
  leaveOutShort(lag);
  double before = kNaN;
  for (double& value : lag) {
    const double now = 0.5 * kPi + std::remainder(value - 0.5 * kPi, kTwoPi);
    value = std::fabs(now - before) > kPi ? kNaN : now * 180.0 / kPi;
    before = now;
  }
  return lag;
}

bool anyFinite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// [s], when the shaft passes a speed.
std::vector<double> passages(const PlotHistory& history, double speed) {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < history.time.size(); ++i) {
    const double before = std::fabs(history.speed[i]) - speed;
    const double after = std::fabs(history.speed[i + 1]) - speed;
    if ((before < 0.0) != (after < 0.0)) {
      const double part = before / (before - after);
      times.push_back(history.time[i] + part * (history.time[i + 1] - history.time[i]));
    }
  }
  return times;
}

/// The path during one turn of the shaft that starts at a sample.
Series turn(const PlotHistory& history, const std::vector<double>& angle, std::size_t start) {
  Series series;
  series.name = fmt::format("{:.3g} s, {:.4g} rad/s", history.time[start], history.speed[start]);
  for (std::size_t i = start; i < angle.size(); ++i) {
    series.x.push_back(history.whirl_x[i]);
    series.y.push_back(history.whirl_y[i]);
    if (angle[i] >= angle[start] + kTwoPi) {
      break;
    }
  }
  return series;
}

/// Samples that a whole turn of the shaft follows on, which does not hardly turn.
std::vector<std::size_t> startsOfTurns(const PlotHistory& history,
                                       const std::vector<double>& angle) {
  const double slow = kSlow * fastestOf(history);
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < angle.size() && angle[i] + kTwoPi <= angle.back(); ++i) {
    if (std::fabs(history.speed[i]) >= slow && std::isfinite(history.whirl_radius[i])) {
      starts.push_back(i);
    }
  }
  return starts;
}

/// The whirl about its mean, as the sag of a shaft or the load of its bearings moves that aside:
/// there radius and lag of the position would be bands. Of each sample the mean over eight turns.
struct CentredWhirl {
  PlotHistory about;          // as the history, radius and lag from the middle
  std::vector<double> aside;  // [m], of the middle from the axis; empty: it is on the axis
};

CentredWhirl centred(const PlotHistory& history) {
  constexpr double kTurns = 8.0, kAside = 0.2, kLeast = 1.0e-3;
  constexpr std::size_t kFewest = 64;  // samples
  CentredWhirl whirl{history, {}};
  const std::vector<double> angle = turned(history);
  const std::size_t count = angle.size();
  const double wide = std::min(kTurns * kTwoPi, angle.back());
  if (count < kFewest || angle.back() < kTwoPi || !std::isfinite(history.whirl_radius.back())) {
    return whirl;
  }
  std::vector<double> x{0.0}, y{0.0};  // sums of the samples before
  for (std::size_t i = 0; i < count; ++i) {
    x.push_back(x.back() + history.whirl_x[i]);
    y.push_back(y.back() + history.whirl_y[i]);
  }
  double most_aside = 0.0, widest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double start = std::clamp(angle[i] - 0.5 * wide, 0.0, angle.back() - wide);
    const auto from = std::lower_bound(angle.begin(), angle.end(), start) - angle.begin();
    const auto to = std::upper_bound(angle.begin(), angle.end(), start + wide) - angle.begin();
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    const double samples = static_cast<double>(b - a);
    const double middle_x = (x[b] - x[a]) / samples, middle_y = (y[b] - y[a]) / samples;
    const double now_x = history.whirl_x[i], now_y = history.whirl_y[i];
    const double own_x = now_x - middle_x, own_y = now_y - middle_y;
    whirl.about.whirl_radius[i] = std::hypot(own_x, own_y);
    whirl.about.whirl_phase[i] += std::atan2(now_y, now_x) - std::atan2(own_y, own_x);
    whirl.aside.push_back(std::hypot(middle_x, middle_y));
    if (i >= count / 2) {
      most_aside = std::max(most_aside, whirl.aside.back());
      widest = std::max(widest, whirl.about.whirl_radius[i]);
    }
  }
  if (!(most_aside > kAside * widest)) {
    return {history, {}};
  }
  // What is left of a motion that has died out has a lag, too, and no meaning.
  const std::vector<double>& radius = whirl.about.whirl_radius;
  const double least = kLeast * *std::max_element(radius.begin(), radius.end());
  for (std::size_t i = 0; i < count; ++i) {
    whirl.about.whirl_phase[i] = radius[i] > least ? whirl.about.whirl_phase[i] : kNaN;
  }
  return whirl;
}

}  // namespace

std::vector<Chart> rotorCharts(const PlotHistory& history) {
  const CentredWhirl whirl = centred(history);
  std::vector<Chart> charts{historyChart(history, "whirl radius", "m", whirl.about.whirl_radius)};
  if (!whirl.aside.empty()) {
    charts.front().y.label = "whirl radius about its mean (m)";
    // In a separate chart: a sag is often a thousand times the whirl.
    charts.push_back(historyChart(history, "orbit's mean from the axis", "m", whirl.aside));
  }
  const std::vector<double> lag = phaseLagHistory(whirl.about);
  if (anyFinite(lag)) {
    charts.push_back(historyChart(history, "whirl phase lag", "deg", lag));
    charts.back().y.degrees = true;
    charts.back().y.inverted = true;  // as machinists draw it
    charts.back().horizontal = {{90.0, ""}, {180.0, ""}};
  }
  charts.push_back(speedChart(history, "shaft speed", history.speed));
  return charts;
}

void markCriticalSpeeds(const BuiltSystem& system, const PlotHistory& history,
                        std::vector<Chart>& charts) {
  constexpr std::size_t kMaxPassages = 6;
  constexpr double kApart = 0.15;  // of the run: nearer ones are one to name
  const bool held_by_control =
      std::any_of(history.commands.begin(), history.commands.end(),
                  [](const CommandHistory& command) { return command.name != "torque"; });
  if (held_by_control || spread(history.speed) <= kSlow * fastestOf(history)) {
    return;
  }
  for (const CriticalSpeed& critical : criticalSpeeds(*heldDynamics(system))) {
    const std::vector<double> times = passages(history, critical.speed);
    if (times.size() > kMaxPassages) {
      continue;
    }
    double named = -kInfinity;
    for (const double time : times) {
      for (Chart& chart : charts) {
        chart.vertical.push_back({time, ""});
      }
      if (time - named > kApart * history.time.back()) {
        charts.front().vertical.back().label =
            fmt::format("critical, {:.4g} rad/s", critical.speed);
        named = time;
      }
    }
  }
}

Figure orbitFigure(const PlotHistory& history) {
  Chart chart;
  chart.x.label = "x (m)";
  chart.y.label = "y (m)";
  chart.equal_aspect = true;
  const std::vector<double> angle = turned(history);
  const std::vector<std::size_t> possible = startsOfTurns(history, angle);
  if (spread(history.speed) == 0.0 || possible.empty()) {
    chart.series = {{"orbit", history.whirl_x, history.whirl_y}};
  } else {
    std::vector<std::size_t> starts;
    for (std::size_t i = 1; i <= kOrbits; ++i) {
      starts.push_back(possible[i * (possible.size() - 1) / (kOrbits + 1)]);
    }
    const std::size_t widest =
        *std::max_element(possible.begin(), possible.end(), [&](std::size_t a, std::size_t b) {
          return history.whirl_radius[a] < history.whirl_radius[b];
        });
    const auto distance = [widest](std::size_t i) {
      return std::max(i, widest) - std::min(i, widest);
    };
    *std::min_element(starts.begin(), starts.end(), [&distance](std::size_t a, std::size_t b) {
      return distance(a) < distance(b);
    }) = widest;
    for (const std::size_t start : starts) {
      chart.series.push_back(turn(history, angle, start));
    }
  }
  Figure figure;
  figure.charts = {chart};
  figure.width = 640;
  figure.chart_height = 640;
  return figure;
}

}  // namespace whirl_twin
