#include <fmt/format.h>

#include <cmath>

#include "reports/monitored_log.h"
#include "reports/report_values.h"
#include "reports/spectrum_figures.h"

namespace whirl_twin {

namespace {

std::string numberWithUnit(double x, const char* unit) {
  return std::isfinite(x) ? fmt::format("{:.6g} {}", x, unit) : "-";
}

std::string plural(std::uint64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// What its run-ups have passed, and what its motion consisted of.
std::string motionText(const SystemCourse& system) {
  std::string out;
  for (const PassedResonance& resonance : system.resonances) {
    const ResponsePeak& peak = resonance.peak;
    out += fmt::format("  {}: resonance passed at {:.6g} rad/s, t = {:.4g} s, 1X {:.4g} um, {}",
                       system.name, peak.speed, peak.time, 1.0e6 * peak.amplitude,
                       peak.amplification_factor
                           ? fmt::format("amplification factor {:.4g}", *peak.amplification_factor)
                           : "no amplification factor: half power not reached on both sides");
    if (peak.amplification_factor && !peak.slow) {
      out += " (passed too fast: underestimated)";
    }
    if (std::isfinite(resonance.model_speed)) {
      out += fmt::format("; model {:.6g} rad/s", resonance.model_speed);
      out += std::isfinite(resonance.model_factor) ? fmt::format(", {:.4g}", resonance.model_factor)
                                                   : "";
    }
    out += "\n";
  }
  if (system.slow_roll) {
    out += fmt::format(
        "  {}: slow-roll compensation of the measurement, {:.4g} um forward, {:.4g} um "
        "backward\n",
        system.name, 1.0e6 * std::abs(system.slow_roll->forward),
        1.0e6 * std::abs(system.slow_roll->backward));
  }
  if (system.spectrum && !system.spectrum->lines.empty()) {
    out += fmt::format("  {}: full spectrum, t = {:.4g} to {:.4g} s, {:.4g} rad/s:", system.name,
                       system.spectrum->begin, system.spectrum->end, system.spectrum->speed);
    for (const SpectrumLine& line : system.spectrum->lines) {
      out += fmt::format("\n    {}", lineText(line));
    }
    out += "\n";
  }
  if (const std::string what = subsynchronousText(system.spectra); !what.empty()) {
    out += fmt::format("  {}: {}\n", system.name, what);
  }
  return out;
}

std::string notOkText(const SystemCourse& system) {
  std::string out;
  for (const NotOkCourse& course : system.not_ok) {
    out += fmt::format("  {}: data quality not good, t = {:.4g} to {}: {}\n", system.name,
                       course.begin, numberWithUnit(course.end, "s"), course.why);
  }
  return out;
}

Json notOkJson(const SystemCourse& system) {
  return listJson(system.not_ok, [](const NotOkCourse& course) -> Json {
    return {{"why", course.why}, {"begin", course.begin}, {"end", course.end}};
  });
}

Json resonanceJson(const PassedResonance& resonance) {
  const ResponsePeak& peak = resonance.peak;
  return {{"time", peak.time},
          {"speed", peak.speed},
          {"amplitude", peak.amplitude},
          {"half_power_below", peak.lower},
          {"half_power_above", peak.upper},
          {"amplification_factor", peak.amplification_factor},
          {"acceleration", peak.acceleration},
          {"slow", peak.slow},
          {"model_critical_speed", resonance.model_speed},
          {"model_amplification_factor", resonance.model_factor}};
}

Json spectrumJson(const WindowSpectrum& spectrum) {
  Json json = {{"begin", spectrum.begin},
               {"end", spectrum.end},
               {"speed", spectrum.speed},
               {"resolution", spectrum.resolution}};
  json["lines"] = Json::array();
  for (const SpectrumLine& line : spectrum.lines) {
    json["lines"].push_back({{"name", lineName(line)},
                             {"frequency", line.frequency},
                             {"amplitude", line.amplitude},
                             {"ratio", line.ratio},
                             {"subsynchronous", line.subsynchronous()}});
  }
  return json;
}

const char* severityName(state::Severity severity) {
  switch (severity) {
    case state::Severity::kDanger:
      return "danger";
    case state::Severity::kWarning:
      return "warning";
    default:
      return "info";
  }
}

}  // namespace

std::string text(const MonitoredLog& run) {
  std::string out =
      fmt::format("{}: {} of '{}', t = {:g} .. {:g} s\n", run.log,
                  plural(run.watched, "message", "messages"), run.scene, run.begin, run.end);
  if (run.damaged + run.rejected > 0) {
    out += fmt::format("  left out: {} with invalid content, {} of the file\n",
                       plural(run.rejected, "message", "messages"),
                       plural(run.damaged, "corrupt place", "corrupt places"));
    out +=
        run.first_damage.empty() ? "" : fmt::format("  first corruption: {}\n", run.first_damage);
  }
  out += joined(run.remarks, [](const auto& remark) { return "  " + remark + "\n"; });
  if (run.resets > 0) {
    out += fmt::format("  the simulation was reset {}\n", plural(run.resets, "time", "times"));
  }
  out += fmt::format("\n  {:<20} {:>14} {:>12} {:>14}  {}\n", "system", "least decay", "at",
                     "at speed", "verdict there");
  for (const SystemCourse& system : run.systems) {
    out += fmt::format("  {:<20} {:>14} {:>12} {:>14}  {}\n", system.name,
                       numberWithUnit(system.least_decay_rate, "1/s"),
                       numberWithUnit(system.least_at, "s"),
                       numberWithUnit(system.least_at_speed, "rad/s"),
                       system.least_verdict.empty() ? "not evaluated" : system.least_verdict);
  }
  std::string motion;
  for (const SystemCourse& system : run.systems) {
    motion += notOkText(system) + motionText(system);
  }
  out += motion.empty() ? "" : "\n" + motion;
  if (run.alerts.empty()) {
    return out + "\n  no alerts\n";
  }
  out += fmt::format("\n  {:>10} {:>10}  {:<8} {:<26} {}\n", "raised, s", "cleared, s", "severity",
                     "alert", "system");
  for (const AlertCourse& alert : run.alerts) {
    const std::string when = alert.raised_at.empty() ? "" : alert.raised_at + "  ";
    out += fmt::format("  {:>10.3f} {:>10}  {:<8} {:<26} {}\n    {}{}\n", alert.raised,
                       std::isnan(alert.cleared) ? "-" : fmt::format("{:.3f}", alert.cleared),
                       severityName(alert.worst.severity), alert.worst.type, alert.worst.system,
                       when, alert.worst.text);
  }
  return out;
}

Json json(const MonitoredLog& run) {
  Json json{
      {"log", run.log},           {"scene", run.scene},       {"begin", run.begin},
      {"end", run.end},           {"duration", run.duration}, {"messages", run.watched},
      {"rejected", run.rejected}, {"damaged", run.damaged},   {"first_damage", run.first_damage},
      {"resets", run.resets},     {"remarks", run.remarks},   {"systems", Json::object()}};
  for (const SystemCourse& system : run.systems) {
    json["systems"][system.name] = {{"states", system.states},
                                    {"verdicts", system.margin_time.size()},
                                    {"least_decay_rate", system.least_decay_rate},
                                    {"time", system.least_at},
                                    {"speed", system.least_at_speed},
                                    {"verdict", system.least_verdict},
                                    {"not_ok", notOkJson(system)}};
    Json& of_it = json["systems"][system.name];
    if (system.rotor) {
      of_it["resonances"] = listJson(system.resonances, resonanceJson);
      if (system.slow_roll) {
        of_it["slow_roll"] = {{"forward", std::abs(system.slow_roll->forward)},
                              {"forward_lag", system.slow_roll->forwardLag()},
                              {"backward", std::abs(system.slow_roll->backward)},
                              {"backward_lag", system.slow_roll->backwardLag()}};
      }
      of_it["spectrum"] = system.spectrum ? spectrumJson(*system.spectrum) : Json(nullptr);
    }
  }
  json["alerts"] = Json::array();
  for (const AlertCourse& alert : run.alerts) {
    json["alerts"].push_back({{"id", alert.worst.id},
                              {"type", alert.worst.type},
                              {"system", alert.worst.system},
                              {"severity", severityName(alert.worst.severity)},
                              {"raised", alert.raised},
                              {"cleared", alert.cleared},
                              {"raised_at", textOrNull(alert.raised_at)},
                              {"cleared_at", textOrNull(alert.cleared_at)},
                              {"first_out", alert.worst.first_out},
                              {"repeats", alert.worst.repeats},
                              {"text", alert.worst.text},
                              {"why_cleared", alert.why_cleared}});
  }
  return json;
}

CsvTables tables(const MonitoredLog& run) {
  CsvTable resonances{"resonances",
                      {"system", "time", "speed", "amplitude", "half_power_below",
                       "half_power_above", "amplification_factor", "acceleration",
                       "model_critical_speed", "model_amplification_factor"}};
  for (const SystemCourse& system : run.systems) {
    for (const PassedResonance& resonance : system.resonances) {
      Json row = resonanceJson(resonance);
      row["system"] = system.name;
      resonances.rows.push_back(row);
    }
  }
  return {{"",
           {"id", "type", "system", "severity", "raised", "cleared", "raised_at", "cleared_at",
            "first_out", "repeats", "text", "why_cleared"},
           json(run)["alerts"]},
          resonances};
}

}  // namespace whirl_twin
