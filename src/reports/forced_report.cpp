#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/modes_report.h"
#include "reports/report_values.h"
#include "reports/response_report.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

constexpr double kMaxFrequency = 1.0e6;  // rad/s
constexpr int kMaxSweepPoints = 10'000;

double within(const char* option, double value) {
  if (!(value >= 0.0 && value <= kMaxFrequency)) {
    throw InputError(
        fmt::format("{}: expected from 0 to {:g} rad/s, found {:g}", option, kMaxFrequency, value));
  }
  return value;
}

/// Along the force.
Complex along(const ForcedReport& r, const ForcedResponse& response, std::size_t station) {
  const Orbit& orbit = response.orbits[station];
  return r.request.along == "x" ? orbit.x : orbit.y;
}

/// Frequencies at which the receptance is largest, places in the sweep.
std::vector<std::size_t> peaksOf(const ForcedReport& r, std::size_t station) {
  std::vector<std::size_t> peaks;
  const auto size = [&](std::size_t k) { return std::abs(along(r, r.sweep[k], station)); };
  for (std::size_t k = 1; k + 1 < r.sweep.size(); ++k) {
    if (size(k) > size(k - 1) && size(k) >= size(k + 1)) {
      peaks.push_back(k);
    }
  }
  return peaks;
}

}  // namespace

ForcedReport forcedReport(const RotorSystem& system, const ForcedRequest& request) {
  ForcedReport r;
  r.system = &system;
  r.request = request;
  const std::size_t force = system.stationNamed("--force", request.force);
  if (request.along != "x" && request.along != "y") {
    throw InputError(fmt::format("--along: expected x or y, found '{}'", request.along));
  }
  if (request.points < 2 || request.points > kMaxSweepPoints) {
    throw InputError(
        fmt::format("--points: expected from 2 to {}, found {}", kMaxSweepPoints, request.points));
  }
  for (const std::string& name : request.at) {
    r.stations.push_back(system.placeNamed("--at", name));
  }
  if (r.stations.empty()) {
    r.stations = {force};
  }
  r.speed = within("--speed", request.speed.value_or(system.highest_speed));
  const std::vector<WhirlMode> modes = modesReport(system, r.speed).model;
  r.grows = std::any_of(modes.begin(), modes.end(),
                        [](const WhirlMode& mode) { return mode.eigenvalue.real() > 0.0; });
  const double from = within("--from", request.from.value_or(0.0));
  const double usual =
      modes.empty()
          ? std::max(2.0 * r.speed, 100.0)
          : kBeyondLastMode * modes[std::min(modes.size(), kModesOfInterest) - 1].dampedFrequency();
  const double to = within("--to", request.to.value_or(std::min(usual, kMaxFrequency)));
  if (!(from < to)) {
    throw InputError(
        fmt::format("--from, --to: --from must be < --to, found {:g} and {:g} rad/s", from, to));
  }
  const FullOrderModel full = fullOrderModel(system, force);
  const Station& place = full.places[force];
  r.sweep = forcedResponse(full.rotor, full.places, r.speed,
                           request.along == "x" ? place.along_x : place.along_y,
                           frequenciesAround(modes, from, to, request.points));
  return r;
}

Json json(const ForcedReport& r) {
  Json json{{"model", r.system->model},
            {"speed", r.speed},
            {"force", {{"station", r.request.force}, {"along", r.request.along}}},
            {"grows", r.grows}};
  json["frequencies"] =
      listJson(r.sweep, [](const ForcedResponse& response) { return response.frequency; });
  for (const std::size_t i : r.stations) {
    Json& station = json["stations"][r.system->places[i].name];
    for (const bool mobility : {false, true}) {
      for (const bool x : {true, false}) {
        station[mobility ? "mobility" : "receptance"][x ? "x" : "y"] =
            listJson(r.sweep, [&](const ForcedResponse& response) {
              const Complex z = x ? response.orbits[i].x : response.orbits[i].y;
              return complexJson(mobility ? Complex(0.0, response.frequency) * z : z);
            });
      }
    }
  }
  return json;
}

CsvTables tables(const ForcedReport& r) {
  CsvTable sweep{"",
                 {"station", "frequency", "receptance_x", "lag_x", "receptance_y", "lag_y",
                  "mobility_x", "mobility_y"}};
  for (const std::size_t i : r.stations) {
    for (const ForcedResponse& response : r.sweep) {
      const Orbit& orbit = response.orbits[i];
      sweep.rows.push_back({{"station", r.system->places[i].name},
                            {"frequency", response.frequency},
                            {"receptance_x", std::abs(orbit.x)},
                            {"lag_x", 0.0 - std::arg(orbit.x)},
                            {"receptance_y", std::abs(orbit.y)},
                            {"lag_y", 0.0 - std::arg(orbit.y)},
                            {"mobility_x", response.frequency * std::abs(orbit.x)},
                            {"mobility_y", response.frequency * std::abs(orbit.y)}});
    }
  }
  return {sweep};
}

std::string text(const ForcedReport& r, const ShownUnits& u) {
  const ShownUnit beside = u.besideFrequency();
  std::string out = fmt::format(
      "{}: response to a force along {} at {} in a fixed direction, shaft at {:g} {}\n",
      r.system->title(), r.request.along, r.request.force, u.speed.in(r.speed), u.speed.name);
  if (r.grows) {
    out += "  a mode is unstable at this speed: this response is never reached\n";
  }
  for (const std::size_t i : r.stations) {
    out += fmt::format(
        "  at {}, along {}: peaks\n"
        "{:>14} {:>11}  receptance, m/N  mobility, m/(N s) {:>11}\n",
        r.system->places[i].name, r.request.along, u.frequency.name, beside.name,
        "lag, " + u.angle.name);
    const std::vector<std::size_t> peaks = peaksOf(r, i);
    for (const std::size_t k : peaks) {
      const Complex x = along(r, r.sweep[k], i);
      out += fmt::format("    {:>10.5g} {:>11.5g} {:>16.5g} {:>18.5g} {:>11.4g}\n",
                         u.frequency.in(r.sweep[k].frequency), beside.in(r.sweep[k].frequency),
                         std::abs(x), r.sweep[k].frequency * std::abs(x), u.angle.in(-std::arg(x)));
    }
    if (peaks.empty()) {
      out += "    none in the range\n";
    }
  }
  return out + fmt::format("  {} frequencies from {:.5g} to {:.5g} {}: --json, --csv\n",
                           r.sweep.size(),
                           r.sweep.empty() ? 0.0 : u.frequency.in(r.sweep.front().frequency),
                           r.sweep.empty() ? 0.0 : u.frequency.in(r.sweep.back().frequency),
                           u.frequency.name);
}

Figure figure(const ForcedReport& r, const ShownUnits& u) {
  Chart receptance, mobility, phase;
  receptance.x = tightAxis("frequency of the force", u.frequency, u.besideFrequency());
  mobility.x = phase.x = tightAxis("frequency of the force", u.frequency);
  receptance.y.label = "receptance (m/N)";
  mobility.y.label = "mobility (m/(N s))";
  phase.y = lagAxis("lag of the displacement", u.angle);
  receptance.y.logarithmic = mobility.y.logarithmic = true;
  const std::size_t shown = std::min(r.stations.size(), kMaxStationsDrawn);
  for (std::size_t s = 0; s < shown; ++s) {
    const std::size_t i = r.stations[s];
    Series amplitude{r.system->places[i].name, {}, {}};
    Series rate, lag;
    double before = kNaN;
    for (const ForcedResponse& response : r.sweep) {
      const Complex x = along(r, response, i);
      amplitude.x.push_back(response.frequency);
      amplitude.y.push_back(std::abs(x));
      rate.x.push_back(response.frequency);
      rate.y.push_back(response.frequency * std::abs(x));
      double now = -std::arg(x) / kDegree;
      now = now < -90.0 ? now + 360.0 : now;
      if (std::fabs(now - before) > 180.0) {  // from one end of the axis to the other
        lag.x.push_back(response.frequency);
        lag.y.push_back(kNaN);
      }
      lag.x.push_back(response.frequency);
      lag.y.push_back(now);
      before = now;
    }
    receptance.series.push_back(amplitude);
    mobility.series.push_back(rate);
    phase.series.push_back(lag);
  }
  if (r.speed > 0.0) {
    receptance.vertical.push_back({r.speed, "speed of the shaft"});
  }
  Figure figure;
  figure.title = fmt::format("{}: force along {} at {}, shaft at {}", r.system->title(),
                             r.request.along, r.request.force, u.speedText(r.speed));
  if (shown < r.stations.size()) {
    figure.title += fmt::format(", {} of {} stations", shown, r.stations.size());
  }
  figure.charts = {receptance, mobility, phase};
  figure.width = 860;
  figure.chart_height = 340;
  return figure;
}

}  // namespace whirl_twin
