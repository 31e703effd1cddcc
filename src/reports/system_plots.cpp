#include "reports/system_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "plots/chart.h"
#include "reports/ensemble_figure.h"
#include "reports/history_chart.h"
#include "reports/motion_picture.h"
#include "reports/rotor_plots.h"

namespace whirl_twin {

namespace {

constexpr int kPanelHeight = 270;        // px, of one chart above others
constexpr int kPortraitHeight = 400;     // px
constexpr double kTurning = 10.0 * kPi;  // rad
constexpr double kComparable = 8.0;      // ratio of ranges that one axis can show

/// A chart for each coordinate; those of one unit share one if its axis can show them all. Of an
/// angle that goes round and round its rate.
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
    if (c.isAngle() && range > kTurning) {
      panels.push_back({"", 0.0, speedChart(history, c.name + "_rate", history.rates[k])});
      continue;
    }
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

Figure timeFigure(const BuiltSystem& system, const PlotHistory& history) {
  Figure figure;
  const bool rotor = system.dynamics->isRotor();
  figure.charts = rotor ? rotorCharts(history) : coordinateCharts(system, history);
  if (!rotor && system.dynamics->hasShaft() && spread(history.speed) > 0.0) {
    figure.charts.push_back(speedChart(history, "shaft speed", history.speed));
  }
  for (const Chart& chart : commandCharts(history)) {
    figure.charts.push_back(chart);
  }
  if (rotor) {
    markCriticalSpeeds(system, history, figure.charts);
  }
  for (std::size_t i = 0; i + 1 < figure.charts.size(); ++i) {
    figure.charts[i].x.label.clear();  // they share the lowest one's
  }
  if (figure.charts.size() > 1) {
    figure.chart_height = kPanelHeight;
  }
  return figure;
}

Figure phaseFigure(const BuiltSystem& system, const PlotHistory& history) {
  if (system.dynamics->isRotor()) {
    return orbitFigure(history);
  }
  Figure figure;
  const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const std::string& name = coordinates[k].name;
    const std::string& unit = coordinates[k].unit;
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
    add("ensemble", fmt::format("{} samples", ensemble->count()),
        ensembleFigure(*ensemble, history));
  }
  return plots;
}

}  // namespace whirl_twin
