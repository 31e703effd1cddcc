#include "reports/system_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "plots/chart.h"
#include "reports/ensemble_figure.h"
#include "reports/motion_picture.h"

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kPanelHeight = 270;     // px, of one chart above others
constexpr int kPortraitHeight = 400;  // px
constexpr double kComparable = 8.0;   // ratio of ranges that one axis can show
constexpr int kOrbits = 6;            // of a rotor that changes its speed

/// Largest less smallest of the finite values.
double spread(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return low < high ? high - low : 0.0;
}

Chart historyChart(const PlotHistory& history, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = fmt::format("{} ({})", name, unit);
  chart.series.push_back({name, history.time, values});
  return chart;
}

/// A chart for each coordinate; those of one unit share one if its axis can show them all.
std::vector<Chart> coordinateCharts(const BuiltSystem& system, const PlotHistory& history) {
  struct Panel {
    std::string unit;
    double spread;
    Chart chart;
  };
  std::vector<Panel> panels;
  const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const CoordinateInfo& c = coordinates[k];
    const double range = spread(history.coordinates[k]);
    const auto panel = std::find_if(panels.begin(), panels.end(), [&](const Panel& p) {
      return p.unit == c.unit && range <= kComparable * p.spread && p.spread <= kComparable * range;
    });
    const Chart chart = historyChart(history, c.name, c.unit, history.coordinates[k]);
    if (panel == panels.end()) {
      panels.push_back({c.unit, range, chart});
    } else {
      panel->chart.y.label = c.isAngle() ? "angle (rad)" : fmt::format("position ({})", c.unit);
      panel->chart.series.push_back(chart.series.front());
    }
  }
  std::vector<Chart> charts;
  for (const Panel& panel : panels) {
    charts.push_back(panel.chart);
  }
  return charts;
}

/// A chart for the outputs of each controller that have one unit, under the limit that they reach.
std::vector<Chart> commandCharts(const PlotHistory& history) {
  std::vector<Chart> charts;
  const CommandHistory* before = nullptr;
  for (const CommandHistory& command : history.commands) {
    if (before == nullptr || before->controller != command.controller ||
        before->unit != command.unit) {
      charts.push_back(historyChart(history, command.name, command.unit, command.values));
    } else {
      charts.back().y.label = fmt::format("command ({})", command.unit);
      charts.back().series.push_back({command.name, history.time, command.values});
    }
    const bool reached =
        std::any_of(command.values.begin(), command.values.end(), [&](double value) {
          return command.limit > 0.0 && std::fabs(value) >= command.limit * (1.0 - 1.0e-9);
        });
    if (reached && charts.back().horizontal.empty()) {
      charts.back().horizontal = {{command.limit, "limit"}, {-command.limit, "limit"}};
    }
    before = &command;
  }
  return charts;
}

/// The phase lag [deg] within half a turn of 90: broken where it passes from one end to the
/// other, and where the shaft hardly turns, so that no unbalance leads the whirl.
std::vector<double> phaseLag(const PlotHistory& history) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kSlow = 0.02;  // of the largest speed
  double fastest = 0.0;
  for (const double speed : history.speed) {
    fastest = std::max(fastest, std::fabs(speed));
  }
  std::vector<double> lag = history.whirl_phase;
  double before = kNaN;
  for (std::size_t i = 0; i < lag.size(); ++i) {
    const double now = 0.5 * kPi + std::remainder(lag[i] - 0.5 * kPi, 2.0 * kPi);
    const bool leaps = std::fabs(now - before) > kPi;
    lag[i] = leaps || std::fabs(history.speed[i]) < kSlow * fastest ? kNaN : now * 180.0 / kPi;
    before = now;
  }
  return lag;
}

Figure timeFigure(const BuiltSystem& system, const PlotHistory& history) {
  Figure figure;
  if (system.dynamics->isRotor()) {
    figure.charts = {historyChart(history, "whirl radius", "m", history.whirl_radius),
                     historyChart(history, "whirl phase lag", "deg", phaseLag(history))};
    figure.charts[1].horizontal = {{90.0, ""}, {180.0, ""}};
  } else {
    figure.charts = coordinateCharts(system, history);
  }
  if (system.dynamics->hasShaft() && (system.dynamics->isRotor() || spread(history.speed) > 0.0)) {
    figure.charts.push_back(historyChart(history, "shaft speed", "rad/s", history.speed));
  }
  for (const Chart& chart : commandCharts(history)) {
    figure.charts.push_back(chart);
  }
  for (std::size_t i = 0; i + 1 < figure.charts.size(); ++i) {
    figure.charts[i].x.label.clear();  // they share the lowest one's
  }
  if (figure.charts.size() > 1) {
    figure.chart_height = kPanelHeight;
  }
  return figure;
}

/// The path during one turn of the shaft that starts at a sample.
Series turn(const PlotHistory& history, std::size_t start) {
  Series series;
  series.name = fmt::format("{:.3g} s, {:.3g} rad/s", history.time[start], history.speed[start]);
  double angle = 0.0;
  for (std::size_t i = start; i < history.time.size() && angle < 2.0 * kPi; ++i) {
    series.x.push_back(history.whirl_x[i]);
    series.y.push_back(history.whirl_y[i]);
    if (i + 1 < history.time.size()) {
      angle += std::fabs(history.speed[i]) * (history.time[i + 1] - history.time[i]);
    }
  }
  return series;
}

/// At constant speed the whole path; else single turns, the widest one among them.
Figure orbitFigure(const PlotHistory& history) {
  Chart chart;
  chart.x.label = "x (m)";
  chart.y.label = "y (m)";
  chart.equal_aspect = true;
  if (spread(history.speed) == 0.0) {
    chart.series = {{"orbit", history.whirl_x, history.whirl_y}};
  } else {
    std::vector<std::size_t> starts;
    for (int i = 1; i <= kOrbits; ++i) {
      starts.push_back(i * (history.time.size() - 1) / (kOrbits + 1));
    }
    const auto widest = static_cast<std::size_t>(
        std::max_element(history.whirl_radius.begin(), history.whirl_radius.end(),
                         [](double a, double b) { return a < b || std::isnan(a); }) -
        history.whirl_radius.begin());
    const auto distance = [widest](std::size_t i) {
      return std::max(i, widest) - std::min(i, widest);
    };
    *std::min_element(starts.begin(), starts.end(), [&distance](std::size_t a, std::size_t b) {
      return distance(a) < distance(b);
    }) = widest;
    for (const std::size_t start : starts) {
      chart.series.push_back(turn(history, start));
    }
  }
  Figure figure;
  figure.charts = {chart};
  figure.width = 640;
  figure.chart_height = 640;
  return figure;
}

Figure phaseFigure(const BuiltSystem& system, const PlotHistory& history) {
  if (system.dynamics->isRotor()) {
    return orbitFigure(history);
  }
  Figure figure;
  const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const auto& [name, unit] = coordinates[k];
    Chart chart;
    chart.x.label = fmt::format("{} ({})", name, unit);
    chart.y.label = fmt::format("{}_rate ({}/s)", name, unit);
    chart.series = {{name, history.coordinates[k], history.rates[k]}};
    figure.charts.push_back(chart);
  }
  figure.columns = figure.charts.size() > 1 ? 2 : 1;
  figure.width = figure.columns > 1 ? 960 : 640;
  figure.chart_height = kPortraitHeight;
  return figure;
}

Figure energyFigure(const PlotHistory& history) {
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = "energy (J)";
  chart.series = {{"kinetic, T", history.time, history.kinetic},
                  {"potential, V", history.time, history.potential},
                  {"h = \u03a3 v \u2202L/\u2202v \u2212 L", history.time, history.jacobi}};
  Figure figure;
  figure.charts = {chart};
  return figure;
}

}  // namespace

std::vector<SystemPlot> systemPlots(const BuiltSystem& system, const Ensemble* ensemble,
                                    const PlotHistory& history, ImageFormat format) {
  const std::string title = fmt::format("{} ({})", system.spec.name, system.spec.model);
  std::vector<SystemPlot> plots;
  const auto picture = motionPicture(title, *system.dynamics, history);
  if (picture && fitsASheet(*picture)) {
    plots.push_back({"picture", sketchImage(*picture, format)});
  }
  const auto add = [&](const std::string& kind, const std::string& what, Figure figure) {
    figure.title = fmt::format("{}: {}", title, what);
    plots.push_back({kind, figureImage(figure, format)});
  };
  add("time", "time history", timeFigure(system, history));
  add("phase", system.dynamics->isRotor() ? "orbit" : "phase portrait",
      phaseFigure(system, history));
  add("energy", "energies", energyFigure(history));
  if (ensemble != nullptr) {
    add("ensemble", fmt::format("{} members", ensemble->count()),
        ensembleFigure(*ensemble, history));
  }
  return plots;
}

}  // namespace whirl_twin
