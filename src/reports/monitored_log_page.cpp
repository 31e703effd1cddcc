#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "reports/monitored_log.h"
#include "reports/report_page.h"
#include "reports/report_values.h"
#include "reports/spectrum_figures.h"

namespace whirl_twin {

namespace {

std::string numberOnPage(double x) {
  return std::isfinite(x) ? fmt::format("{:.6g}", x) : "–";
}

const char* className(state::Severity severity) {
  return severity == state::Severity::kDanger    ? "danger"
         : severity == state::Severity::kWarning ? "warning"
                                                 : "info";
}

/// The ground behind the curves while an alert is active, paler while it is only latched; each
/// kind named once.
std::vector<Band> bandsOf(const MonitoredLog& run, const SystemCourse& system) {
  std::vector<Band> bands;
  std::vector<std::string> named;
  const auto add = [&](const std::string& name, double from, double to, const Ink& ink) {
    if (to > from) {  // else simulated time was set back
      const bool known = std::find(named.begin(), named.end(), name) != named.end();
      bands.push_back({known ? "" : name, from, to, ink});
      named.push_back(name);
    }
  };
  for (const bool latched : {true, false}) {  // what is active is in front
    for (const bool danger : {false, true}) {
      for (const AlertCourse& alert : run.alerts) {
        if (alert.worst.system != system.name ||
            (alert.worst.severity == state::Severity::kDanger) != danger) {
          continue;
        }
        const double cleared = std::isnan(alert.cleared) ? run.end : alert.cleared;
        const double gone = std::isnan(alert.latched) ? cleared : alert.latched;
        if (latched) {
          add("latched, cause gone", gone, cleared, paler(ink::kGrey, 0.85));
        } else {
          add(danger ? "danger" : "warning", alert.raised, gone,
              paler(danger ? ink::kVermilion : ink::kOrange, danger ? 0.6 : 0.75));
        }
      }
    }
  }
  return bands;
}

std::vector<double> inDegrees(std::vector<double> angles) {
  for (double& angle : angles) {
    angle /= kDegree;
  }
  return angles;
}

bool any(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// Where each type of alert was first raised: the bands have the colour of the severity alone.
std::vector<ReferenceLine> namesOfAlerts(const MonitoredLog& run, const SystemCourse& system) {
  constexpr std::size_t kMost = 8;
  std::vector<ReferenceLine> lines;
  for (const AlertCourse& alert : run.alerts) {
    const bool known = std::any_of(lines.begin(), lines.end(), [&](const ReferenceLine& line) {
      return line.label == alert.worst.type;
    });
    if (alert.worst.system == system.name && !known && lines.size() < kMost &&
        alert.worst.severity != state::Severity::kInfo) {
      lines.push_back({alert.raised, alert.worst.type});
    }
  }
  return lines;
}

/// Its levels of alert and danger, at the speed that the shaft has.
void addLevels(const SystemCourse& system, Chart& chart) {
  for (const bool danger : {false, true}) {
    if ((danger ? system.levels.danger : system.levels.alert).empty()) {
      continue;
    }
    Series level{danger ? "danger level" : "alert level", system.time, {}};
    level.pen = Pen{danger ? ink::kVermilion : ink::kOrange, 1.6, {6.0, 3.0}};
    for (const double speed : system.speed) {
      const double at = std::fabs(speed);
      level.y.push_back(danger ? system.levels.dangerAt(at) : system.levels.alertAt(at));
    }
    chart.series.push_back(level);
  }
}

void addResonances(const SystemCourse& system, ReportPage& page) {
  if (system.resonances.empty()) {
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const PassedResonance& resonance : system.resonances) {
    const ResponsePeak& peak = resonance.peak;
    const std::string factor =
        !peak.amplification_factor ? "– (half power not reached on both sides)"
        : peak.slow
            ? numberOnPage(*peak.amplification_factor)
            : numberOnPage(*peak.amplification_factor) + " (passed too fast: underestimated)";
    rows.push_back({fmt::format("{:.3f}", peak.time), numberOnPage(peak.speed),
                    numberOnPage(peak.amplitude), factor, numberOnPage(resonance.model_speed),
                    numberOnPage(resonance.model_factor)});
  }
  page.part("Resonances passed");
  page.table({"at, s", "speed, rad/s", "1X, m", "amplification factor", "model: speed, rad/s",
              "model: factor"},
             rows);
}

/// The time of the run, and the date where the log has one.
std::string withDate(const std::string& time, const std::string& date) {
  return date.empty() ? time : time + "\n" + date;
}

/// The last turns, with a dot wherever the phase mark of the shaft passes the x axis.
Chart orbitOfLastTurns(const SystemCourse& system) {
  Chart chart;
  chart.title =
      fmt::format("orbit, last revolutions before t = {:.4g} s", system.orbit.back().at.time);
  chart.x.label = "x (m), without its mean";
  chart.y.label = "y (m), without its mean";
  chart.equal_aspect = true;
  Series path{"orbit", {}, {}, Pen{ink::kBlue, 1.2}};
  Series marks{"phase mark passes x", {}, {}, Pen{ink::kBlack, 1.2}, false, Marks::kDots};
  double before = system.orbit.front().shaft_angle;
  for (const state::WhirlState& whirl : system.orbit) {
    path.x.push_back(whirl.x);
    path.y.push_back(whirl.y);
    if (std::floor(whirl.shaft_angle / kTwoPi) > std::floor(before / kTwoPi)) {
      marks.x.push_back(whirl.x);
      marks.y.push_back(whirl.y);
    }
    before = whirl.shaft_angle;
  }
  chart.series = {path, marks};
  return chart;
}

/// Cascade, full spectrum and orbit, and their lines; nothing where the states are too few.
void addSpectra(const SystemCourse& system, ReportPage& page) {
  Figure figure;
  figure.width = 940;
  figure.chart_height = 460;
  if (system.spectra.size() > 1) {
    figure.charts.push_back(cascadeChart(system.spectra));
  }
  if (system.spectrum) {
    figure.charts.push_back(spectrumChart(*system.spectrum));
  }
  if (!system.orbit.empty()) {
    figure.charts.push_back(orbitOfLastTurns(system));
  }
  if (figure.charts.empty()) {
    return;
  }
  page.picture(figure);
  const std::string remark = subsynchronousText(system.spectra);
  if (system.spectrum && !system.spectrum->lines.empty()) {
    page.text("Components of the full spectrum: " + joined(system.spectrum->lines, lineText, "; ") +
              "." + (remark.empty() ? "" : " Remark: " + remark + "."));
  } else if (!remark.empty()) {
    page.text("Note: " + remark + ".");
  }
}

Figure bode(const OrderCourse& orders) {
  Figure figure;
  figure.title = "synchronous component (1X)";
  figure.width = 940;
  figure.chart_height = 300;
  figure.columns = 2;
  Chart amplitude, lag, polar;
  amplitude.x = lag.x = tightAxis("speed of the shaft", {"rad/s"}, {"rpm", kRpm});
  amplitude.y = {"amplitude (m)", false, false};
  lag.y = lagAxis("lag behind the phase mark", ShownUnits{}.angle);
  amplitude.series = {{"", orders.speed, orders.amplitude}};
  lag.series = {{"", orders.speed, inDegrees(orders.lag)}};
  Series turned;
  for (std::size_t i = 0; i < orders.lag.size(); ++i) {
    turned.x.push_back(orders.amplitude[i] * std::cos(orders.lag[i]));
    turned.y.push_back(-orders.amplitude[i] * std::sin(orders.lag[i]));
  }
  polar.title = "polar";
  polar.x = {"along the phase mark (m)", false, false};
  polar.y = {"ahead of the phase mark (m)", false, false};
  polar.equal_aspect = true;
  polar.series = {turned};
  figure.charts = {amplitude, lag, polar};
  return figure;
}

}  // namespace

Figure figure(const MonitoredLog& run, const SystemCourse& system) {
  Figure figure;
  figure.title = system.name;
  figure.width = 940;
  figure.chart_height = 260;
  const auto add = [&](const char* label, const std::vector<double>& time,
                       const std::vector<double>& values) {
    if (!any(values)) {
      return;
    }
    Chart chart;
    chart.x = {"time (s)", false, true};
    chart.y = {label, false, false};
    chart.series = {{"", time, values},
                    {"", {run.begin, run.end}, {kNaN, kNaN}}};  // one time axis for all
    chart.bands = bandsOf(run, system);
    figure.charts.push_back(chart);
  };
  add("speed of the shaft (rad/s)", system.time, system.speed);
  if (!figure.charts.empty()) {
    figure.charts.front().vertical = namesOfAlerts(run, system);
    figure.charts.front().y.second = SecondScale{"rpm", 1.0 / kRpm};
  }
  if (any(system.vibration)) {
    add("vibration about the mean (m, 0-peak)", system.time, system.vibration);
    addLevels(system, figure.charts.back());
  }
  add("1X amplitude (m)", system.orders.time, system.orders.amplitude);
  if (!system.orders.line_time.empty()) {
    add("largest non-synchronous component (rad/s)", system.orders.line_time,
        system.orders.line_frequency);
    figure.charts.back().series.front().line = false;
    figure.charts.back().series.front().marks = Marks::kDots;
  }
  add("decay rate of the slowest mode (1/s)", system.margin_time, system.decay_rate);
  if (!figure.charts.empty() && any(system.decay_rate)) {
    Series edge{"", {run.begin, run.end}, {0.0, 0.0}};  // a curve, so that it is always seen
    edge.pen = Pen{ink::kVermilion, 1.5, {6.0, 4.0}};
    figure.charts.back().series.push_back(edge);
    figure.charts.back().horizontal = {{0.0, "stability boundary"}};
  }
  return figure;
}

namespace {

void addAlerts(const MonitoredLog& run, ReportPage& page) {
  page.section("Alerts");
  if (run.alerts.empty()) {
    page.text("None.");
    return;
  }
  std::vector<std::vector<Json>> rows;
  for (const AlertCourse& alert : run.alerts) {
    const char* severity = className(alert.worst.severity);
    const std::string cleared =
        std::isnan(alert.cleared) ? "–" : fmt::format("{:.3f}", alert.cleared);
    rows.push_back({withDate(fmt::format("{:.3f}", alert.raised), alert.raised_at),
                    withDate(cleared, alert.cleared_at),
                    Json{{"text", severity}, {"class", severity}}, alert.worst.type,
                    alert.worst.system, alert.worst.text});
  }
  page.cells({"raised, s", "cleared, s", "severity", "alert", "system", "message"}, rows);
}

void addGaps(const MonitoredLog& run, ReportPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const SystemCourse& system : run.systems) {
    for (const NotOkCourse& course : system.not_ok) {
      rows.push_back(
          {numberOnPage(course.begin), numberOnPage(course.end), system.name, course.why});
    }
  }
  if (!rows.empty()) {
    page.section("Monitoring gaps");
    page.table({"from, s", "to, s", "system", "why"}, rows);
  }
}

void addMargins(const MonitoredLog& run, ReportPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const SystemCourse& system : run.systems) {
    rows.push_back({system.name, numberOnPage(system.least_decay_rate),
                    numberOnPage(system.least_at), numberOnPage(system.least_at_speed),
                    system.least_verdict.empty() ? "not evaluated" : system.least_verdict});
  }
  page.section("Margins");
  page.table({"system", "least decay rate, 1/s", "at, s", "at speed, rad/s", "verdict there"},
             rows);
}

}  // namespace

ReportPage page(const MonitoredLog& run) {
  ReportPage page(run.scene);
  page.text(fmt::format(
      "{}: t = {:g} to {:g} s of simulated time, {} messages replayed, {} rejected, {} corrupt "
      "places, {} resets.",
      run.log, run.begin, run.end, run.watched, run.rejected, run.damaged, run.resets));
  addAlerts(run, page);
  addGaps(run, page);
  addMargins(run, page);
  for (const SystemCourse& system : run.systems) {
    const Figure courses = figure(run, system);
    if (courses.charts.empty()) {
      continue;
    }
    page.section(system.name);
    page.picture(courses);
    if (!system.orders.speed.empty()) {
      page.picture(bode(system.orders));
    }
    addResonances(system, page);
    addSpectra(system, page);
  }
  return page;
}

}  // namespace whirl_twin
