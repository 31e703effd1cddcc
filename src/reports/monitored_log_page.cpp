#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "reports/monitored_log.h"
#include "reports/report_page.h"
#include "reports/spectrum_figures.h"

namespace whirl_twin {

namespace {

constexpr const char* kLogPageStyle =
    "body{font:15px/1.5 sans-serif;color:#21212a;max-width:60em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:1em 0}"
    "th,td{text-align:left;padding:.25em .8em;border-bottom:1px solid #ddd;vertical-align:top}"
    "td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}"
    ".danger{color:#b5330a;font-weight:bold}.warning{color:#8a5a00;font-weight:bold}"
    "svg{max-width:100%;height:auto}h2{margin-top:2em}"
    "@media print{h2{break-before:page}table,svg{break-inside:avoid}}";

std::string numberOnPage(double x) {
  return std::isfinite(x) ? fmt::format("{:.6g}", x) : "–";
}

const char* className(state::Severity severity) {
  return severity == state::Severity::kDanger    ? "danger"
         : severity == state::Severity::kWarning ? "warning"
                                                 : "info";
}

/// The ground behind the curves while an alert stands; each severity named once.
std::vector<Band> bandsOf(const MonitoredLog& run, const SystemCourse& system) {
  std::vector<Band> bands;
  for (const bool danger : {false, true}) {
    bool named = false;
    for (const AlertCourse& alert : run.alerts) {
      if (alert.worst.system != system.name ||
          (alert.worst.severity == state::Severity::kDanger) != danger) {
        continue;
      }
      const double cleared = std::isnan(alert.cleared) ? run.end : alert.cleared;
      if (cleared > alert.raised) {  // else simulated time was set back
        bands.push_back({named    ? ""
                         : danger ? "danger"
                                  : "warning",
                         alert.raised, cleared,
                         paler(danger ? ink::kVermilion : ink::kOrange, danger ? 0.6 : 0.75)});
        named = true;
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

/// A table of what the run-ups have passed; "" without.
std::string resonancesPart(const SystemCourse& system) {
  if (system.resonances.empty()) {
    return "";
  }
  std::string out =
      "<h3>Resonances passed</h3>\n<table><tr><th>at, s</th><th>speed, rad/s</th><th>1X, m</th>"
      "<th>amplification factor</th><th>model: speed, rad/s</th><th>model: factor</th></tr>\n";
  for (const PassedResonance& resonance : system.resonances) {
    const ResponsePeak& peak = resonance.peak;
    const std::string factor =
        !peak.amplification_factor ? "– (half power not reached on both sides)"
        : peak.slow
            ? numberOnPage(*peak.amplification_factor)
            : numberOnPage(*peak.amplification_factor) + " (passed too fast: underestimated)";
    out += fmt::format(
        "<tr><td class=\"n\">{:.3f}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        peak.time, numberOnPage(peak.speed), numberOnPage(peak.amplitude), factor,
        numberOnPage(resonance.model_speed), numberOnPage(resonance.model_factor));
  }
  return out + "</table>\n";
}

std::string onNextLine(const std::string& text) {
  return text.empty() ? "" : "<br>" + text;
}

/// The last turns, with a dot wherever the phase mark of the shaft passes the x axis.
Chart orbitOfLastTurns(const SystemCourse& system) {
  Chart chart;
  chart.title =
      fmt::format("orbit, last revolutions before t = {:.4g} s", system.orbit.back().at.time);
  chart.x.label = "x (m), without its mean";
  chart.y.label = "y (m), without its mean";
  chart.equal_aspect = true;
  Series path{"", {}, {}, Pen{ink::kBlue, 1.2}};
  Series marks{"", {}, {}, Pen{ink::kBlack, 1.2}, false, Marks::kDots};
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

/// Cascade, full spectrum and orbit, and what their lines are; "" where the states are too few.
/// Counts the pictures of the page.
std::string spectraPart(const SystemCourse& system, int& pictures) {
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
    return "";
  }
  std::string out = inlinedPicture(figure, ++pictures) + "\n";
  std::string said = subsynchronousText(system.spectra);
  if (system.spectrum && !system.spectrum->lines.empty()) {
    std::string lines;
    for (const SpectrumLine& line : system.spectrum->lines) {
      lines += (lines.empty() ? "" : "; ") + lineText(line);
    }
    said = "Components of the full spectrum: " + lines + "." +
           (said.empty() ? "" : " Remark: " + said + ".");
  } else if (!said.empty()) {
    said = "Note: " + said + ".";
  }
  return out + (said.empty() ? "" : fmt::format("<p>{}</p>\n", escapedForHtml(said)));
}

Figure bode(const OrderCourse& orders) {
  Figure figure;
  figure.title = "synchronous component (1X)";
  figure.width = 940;
  figure.chart_height = 300;
  figure.columns = 2;
  Chart amplitude, lag, polar;
  amplitude.x = lag.x = {"speed of the shaft (rad/s)", false, true};
  amplitude.y = {"amplitude (m)", false, false};
  lag.y = {"lag behind the phase mark (deg)", false, false};
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
  add("vibration about the mean (m, 0-peak)", system.time, system.vibration);
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

std::string notOkPart(const MonitoredLog& run) {
  std::string rows;
  for (const SystemCourse& system : run.systems) {
    for (const NotOkCourse& course : system.not_ok) {
      rows += fmt::format(
          "<tr><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
          numberOnPage(course.begin), numberOnPage(course.end), escapedForHtml(system.name),
          escapedForHtml(course.why));
    }
  }
  return rows.empty() ? ""
                      : "<h2>Monitoring gaps</h2>\n<table><tr><th>from, s</th><th>to, s</th>"
                        "<th>system</th><th>why</th></tr>\n" +
                            rows + "</table>\n";
}

std::string page(const MonitoredLog& run) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<title>{0}: {1}</title>\n<style>{2}</style></head><body>\n<h1>{0}</h1>\n"
      "<p>{1}: t = {3:g} to {4:g} s of simulated time, {5} messages replayed, {6} rejected, {7} "
      "corrupt places, {8} resets.</p>\n",
      escapedForHtml(run.scene), escapedForHtml(run.log), kLogPageStyle, run.begin, run.end,
      run.watched, run.rejected, run.damaged, run.resets);
  out += "<h2>Alerts</h2>\n";
  if (run.alerts.empty()) {
    out += "<p>None.</p>\n";
  } else {
    out +=
        "<table><tr><th>raised, s</th><th>cleared, s</th><th>severity</th><th>alert</th>"
        "<th>system</th><th>message</th></tr>\n";
    for (const AlertCourse& alert : run.alerts) {
      out += fmt::format(
          "<tr><td class=\"n\">{:.3f}{}</td><td class=\"n\">{}{}</td><td class=\"{}\">{}</td>"
          "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
          alert.raised, onNextLine(alert.raised_at),
          std::isnan(alert.cleared) ? "–" : fmt::format("{:.3f}", alert.cleared),
          onNextLine(alert.cleared_at), className(alert.worst.severity),
          className(alert.worst.severity), escapedForHtml(alert.worst.type),
          escapedForHtml(alert.worst.system), escapedForHtml(alert.worst.text));
    }
    out += "</table>\n";
  }
  out += notOkPart(run);
  out +=
      "<h2>Margins</h2>\n<table><tr><th>system</th><th>least decay rate, 1/s</th><th>at, s</th>"
      "<th>at speed, rad/s</th><th>verdict there</th></tr>\n";
  for (const SystemCourse& system : run.systems) {
    out += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td>{}</td></tr>\n",
        escapedForHtml(system.name), numberOnPage(system.least_decay_rate),
        numberOnPage(system.least_at), numberOnPage(system.least_at_speed),
        system.least_verdict.empty() ? "not evaluated" : escapedForHtml(system.least_verdict));
  }
  out += "</table>\n";
  int pictures = 0;
  for (const SystemCourse& system : run.systems) {
    const Figure drawn = figure(run, system);
    if (!drawn.charts.empty()) {
      out += fmt::format("<h2>{}</h2>\n{}\n", escapedForHtml(system.name),
                         inlinedPicture(drawn, ++pictures));
      if (!system.orders.speed.empty()) {
        out += inlinedPicture(bode(system.orders), ++pictures) + "\n";
      }
      out += resonancesPart(system) + spectraPart(system, pictures);
    }
  }
  return out + "</body></html>\n";
}

}  // namespace whirl_twin
