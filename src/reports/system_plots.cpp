#include "reports/system_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "reports/figure.h"
#include "twin/ensemble_observer.h"

namespace whirl_twin {

namespace {

std::vector<CommandHistory> commandsOn(const Twin& twin, std::size_t system) {
  std::vector<CommandHistory> commands;
  const std::vector<ControllerSpec>& controllers = twin.scene().controllers;
  const std::vector<InputInfo> inputs = twin.systems()[system]->dynamics->inputs();
  for (std::size_t c = 0; c < controllers.size(); ++c) {
    for (std::size_t k = 0; k < controllers[c].acts_on.size(); ++k) {
      const ActedInput& acted = controllers[c].acts_on[k];
      if (acted.system == system) {
        const InputInfo& input = inputs[acted.input];
        commands.push_back({c, k, input.name, input.unit, controllers[c].actuator.limit, {}});
      }
    }
  }
  return commands;
}

constexpr int kPercentilesHeight = 330;  // px
constexpr double kWide = 0.8;            // share of white in the outer percentiles
constexpr double kNarrow = 0.55;         // and in the inner ones

using Percentile = std::vector<double> state::EnsembleState::*;

Series curve(const std::string& name, const PlotHistory& history, Percentile percentile,
             std::size_t quantity) {
  Series series;
  series.name = name;
  for (const state::EnsembleState& s : history.ensemble) {
    series.x.push_back(s.at.time);
    series.y.push_back((s.*percentile)[quantity]);
  }
  return series;
}

/// Out along the lower percentile and back along the upper one.
Series area(const std::string& name, const PlotHistory& history, Percentile low, Percentile high,
            std::size_t quantity, double white) {
  Series series = curve(name, history, low, quantity);
  const Series back = curve("", history, high, quantity);
  series.x.insert(series.x.end(), back.x.rbegin(), back.x.rend());
  series.y.insert(series.y.end(), back.y.rbegin(), back.y.rend());
  series.fill = paler(ink::kBlue, white);
  series.line = false;
  return series;
}

/// [m]
std::vector<double> whirlAbout(const Eigen::Vector2d& rest, const PlotHistory& history) {
  std::vector<double> radius;
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    radius.push_back(std::hypot(history.whirl_x[i] - rest.x(), history.whirl_y[i] - rest.y()));
  }
  return radius;
}

Chart courseChart(const Ensemble& ensemble, const PlotHistory& history, std::size_t quantity) {
  using State = state::EnsembleState;
  const EnsembleQuantity& q = ensemble.quantities()[quantity];
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = fmt::format("{} ({})", q.name == "radius" ? "whirl radius" : q.name, q.unit);
  chart.series = {
      area("5 to 95 %", history, &State::percentile_5, &State::percentile_95, quantity, kWide),
      area("25 to 75 %", history, &State::percentile_25, &State::percentile_75, quantity, kNarrow),
      curve("median", history, &State::median, quantity),
      curve("largest", history, &State::largest, quantity)};
  chart.series[2].pen = Pen{ink::kBlue, 1.8};
  chart.series[3].pen = Pen{ink::kGrey, 1.0, {4.0, 3.0}};
  Series given{
      "nominal", history.time,
      q.name == "radius" ? whirlAbout(ensemble.rest(), history) : history.coordinates[quantity]};
  given.pen = Pen{ink::kVermilion, 1.4};
  chart.series.push_back(given);
  return chart;
}

/// Members over the peak they reached, in about the square root of their number of classes.
Chart peakChart(const Ensemble& ensemble, std::size_t quantity) {
  const std::size_t quantities = ensemble.quantities().size();
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(0, record.data());
  std::vector<double> peaks;
  for (std::size_t i = 0; i < ensemble.count(); ++i) {
    const double peak = ensemble.peaks(record.data())[i * quantities + quantity];
    if (std::fabs(peak) <= kMaxOnAxis) {
      peaks.push_back(peak);
    }
  }
  const EnsembleQuantity& q = ensemble.quantities()[quantity];
  Chart chart;
  chart.x = {fmt::format("largest {} of a sample ({})", q.name, q.unit), false, true};
  chart.y.label = "samples";
  if (peaks.empty()) {
    return chart;
  }
  const auto [low, high] = std::minmax_element(peaks.begin(), peaks.end());
  const double from = *low;
  const double range = *high > *low ? *high - *low : std::max(1.0e-12 * std::fabs(*high), 1.0e-300);
  const std::size_t classes = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(peaks.size())))));
  std::vector<int> members(classes);
  for (const double peak : peaks) {
    const auto place =
        static_cast<std::size_t>((peak - from) / range * static_cast<double>(classes));
    ++members[std::min(place, classes - 1)];
  }
  Series bars;
  bars.fill = paler(ink::kBlue, kNarrow);
  bars.line = false;
  bars.x.push_back(from);
  bars.y.push_back(0.0);
  for (std::size_t k = 0; k < classes; ++k) {
    for (const std::size_t edge : {k, k + 1}) {
      bars.x.push_back(from + range * static_cast<double>(edge) / static_cast<double>(classes));
      bars.y.push_back(members[k]);
    }
  }
  bars.x.push_back(from + range);
  bars.y.push_back(0.0);
  chart.series = {bars};
  return chart;
}

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

PlotHistoryWriter::PlotHistoryWriter(const Twin& twin, std::vector<std::size_t> systems,
                                     std::int64_t ensemble_stride)
    : twin_(twin),
      systems_(std::move(systems)),
      histories_(systems_.size()),
      ensemble_stride_(ensemble_stride) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const std::size_t n = twin_.systems()[systems_[i]]->spec.q.size();
    histories_[i].coordinates.resize(n);
    histories_[i].rates.resize(n);
    histories_[i].commands = commandsOn(twin_, systems_[i]);
  }
}

void PlotHistoryWriter::write(const Observer& observer) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const std::size_t system = systems_[i];
    const bool running = observer.status(system) == StepStatus::kOk;
    PlotHistory& history = histories_[i];
    history.time.push_back(twin_.seconds(observer.step()));
    for (std::size_t k = 0; k < history.coordinates.size(); ++k) {
      history.coordinates[k].push_back(running ? observer.coordinates(system)[k] : kNaN);
      history.rates[k].push_back(running ? observer.rates(system)[k] : kNaN);
    }
    const Energies e = running ? observer.energies(system) : Energies{kNaN, kNaN, kNaN, kNaN, kNaN};
    history.kinetic.push_back(e.kinetic);
    history.potential.push_back(e.potential);
    history.jacobi.push_back(e.jacobi);
    history.moments.push_back(observer.moment(system));
    history.speed.push_back(history.moments.back().speed);
    if (observer.isRotor(system)) {
      history.whirl_x.push_back(running ? observer.whirlOf(system).x : kNaN);
      history.whirl_y.push_back(running ? observer.whirlOf(system).y : kNaN);
      history.whirl_radius.push_back(running ? observer.whirlRadius(system) : kNaN);
      history.whirl_phase.push_back(running ? observer.whirlPhase(system) : kNaN);
    }
    for (CommandHistory& command : history.commands) {
      command.values.push_back(
          running ? observer.controller(command.controller).output[command.output] : kNaN);
    }
    if (twin_.ensemble(system) != nullptr && samples_ % ensemble_stride_ == 0) {
      writeEnsemble(system, history);
    }
  }
  ++samples_;
}

void PlotHistoryWriter::writeEnsemble(std::size_t system, PlotHistory& history) {
  const Ensemble& ensemble = *twin_.ensemble(system);
  record_.resize(ensemble.recordSize());
  ensemble.write(twin_.stepCount(), record_.data());
  history.ensemble.push_back(ensembleStatistics(ensemble, record_.data()));
  history.ensemble.back().at.time = twin_.time();
}

Chart historyChart(const PlotHistory& history, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = fmt::format("{} ({})", name, unit);
  chart.series.push_back({name, history.time, values});
  return chart;
}

Chart speedChart(const PlotHistory& history, const std::string& name,
                 const std::vector<double>& values) {
  Chart chart = historyChart(history, name, "rad/s", values);
  chart.y.second = SecondScale{"rpm", 1.0 / kRpm};
  return chart;
}

double spread(const std::vector<double>& values) {
  double low = kInfinity;
  double high = -low;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return low < high ? high - low : 0.0;
}

Figure ensembleFigure(const Ensemble& ensemble, const PlotHistory& history) {
  Figure figure;
  figure.chart_height = kPercentilesHeight;
  for (std::size_t k = 0; k < ensemble.quantities().size(); ++k) {
    figure.charts.push_back(courseChart(ensemble, history, k));
    figure.charts.push_back(peakChart(ensemble, k));
  }
  return figure;
}

std::vector<SystemPlot> systemPlots(const BuiltSystem& system, const Ensemble* ensemble,
                                    const PlotHistory& history) {
  const std::string title = fmt::format("{} ({})", system.spec.name, system.spec.model);
  std::vector<SystemPlot> plots;
  const auto picture = motionPicture(title, *system.dynamics, history);
  if (picture && fitsASheet(*picture)) {
    plots.push_back({"picture", figureJson(*picture)});
  }
  const auto add = [&](const std::string& kind, const std::string& what, Figure figure) {
    figure.title = fmt::format("{}: {}", title, what);
    plots.push_back({kind, figureJson(figure)});
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
