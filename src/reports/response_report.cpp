#include "reports/response_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/report_values.h"

namespace whirl_twin {

namespace {

void requireForce(const RotorSystem& system) {
  if (!hasSynchronousForce(system.rotor)) {
    throw InputError(
        fmt::format("{}: must have an unbalance or a bow, found a balanced rotor without response",
                    system.title()));
  }
}

Json orbitJson(const Orbit& orbit, double phase_mark) {
  return {{"x", complexJson(orbit.x)},
          {"y", complexJson(orbit.y)},
          {"forward", std::abs(orbit.forward)},
          {"backward", std::abs(orbit.backward)},
          {"major", orbit.major()},
          {"minor", orbit.minor()},
          {"inclination", orbit.inclination()},
          {"direction", name(orbit.direction())},
          {"phase_lag", phaseLag(orbit, phase_mark)}};
}

/// Of a table: what it begins with, the orbit, and whether the speed is beyond the tables.
Json orbitRow(const RotorSystem& system, Json row, const Orbit& orbit, double speed) {
  row.update(orbitJson(orbit, system.dynamics->phaseMark()));
  row["beyond_tables"] = !system.tables().covers(speed);
  return row;
}

/// The name of the unit of vibrations widens its columns.
std::size_t moreColumns(const ShownUnits& u) {
  return std::max<std::size_t>(1, u.vibration.name.size()) - 1;
}

std::string orbitText(const std::string& start, const Orbit& orbit, double phase_mark,
                      const ShownUnits& u, const std::string& mark = "") {
  constexpr double kRound = 1.0e-6;  // of a circle: how far the axes may be apart
  const bool circle = orbit.major() - orbit.minor() <= kRound * orbit.major();
  const std::size_t more = moreColumns(u);
  return fmt::format("    {:<14} {:>{}.5g} {:>{}.5g} {:>13}  {:<9} {:>{}.5g} {:>10.5g}{}\n", start,
                     u.vibration.in(orbit.major()), 11 + more, u.vibration.in(orbit.minor()),
                     11 + more,
                     circle ? "circle" : fmt::format("{:.5g}", u.angle.in(orbit.inclination())),
                     name(orbit.direction()), u.vibration.in(std::abs(orbit.forward)), 12 + more,
                     u.angle.in(phaseLag(orbit, phase_mark)), mark);
}

std::vector<std::string> withOrbit(std::vector<std::string> columns) {
  for (const char* column : {"major", "minor", "inclination", "direction", "forward", "backward",
                             "phase_lag", "beyond_tables"}) {
    columns.emplace_back(column);
  }
  return columns;
}

std::string orbitHead(const std::string& first, const ShownUnits& u) {
  const std::string& m = u.vibration.name;
  const std::size_t more = moreColumns(u);
  return fmt::format("{:<16}{:>{}} {:>{}} {:>14}  direction {:>{}} {:>10}\n", "    " + first,
                     "major, " + m, 13 + more, "minor, " + m, 11 + more,
                     "inclined, " + u.angle.name, "forward, " + m, 10 + more,
                     "lag, " + u.angle.name);
}

}  // namespace

ResponseReport responseReport(const RotorSystem& system, const SpeedRange& range,
                              const std::optional<std::string>& station) {
  requireForce(system);
  ResponseReport r;
  r.system = &system;
  if (station) {
    r.stations = {system.placeNamed("--station", *station)};
  } else {
    r.stations.resize(system.places.size());
    std::iota(r.stations.begin(), r.stations.end(), 0);
  }
  r.sweep = synchronousSweep(system.rotor, system.places, range.from, range.to, range.points);
  r.peaks = criticalSpeeds(*system.dynamics);
  r.peaks.erase(std::remove_if(r.peaks.begin(), r.peaks.end(),
                               [&](const CriticalSpeed& peak) {
                                 return peak.speed < range.from || peak.speed > range.to;
                               }),
                r.peaks.end());
  return r;
}

Json json(const ResponseReport& r) {
  const DataSpeeds data = r.system->tables();
  const double phase_mark = r.system->dynamics->phaseMark();
  std::vector<double> speeds;
  for (const SynchronousResponse& response : r.sweep) {
    speeds.push_back(response.speed);
  }
  Json json{{"model", r.system->model},
            {"phase_mark", phase_mark},
            {"unbalance_angle", phase_mark},  // as scripts know it
            {"speeds", speeds},
            {"table_speeds", tableSpeedsJson(data)},  // null: every speed
            {"beyond_tables", beyondJson(data, speeds)}};
  for (const std::size_t i : r.stations) {
    json["stations"][r.system->places[i].name] =
        listJson(r.sweep, [&](const SynchronousResponse& response) {
          return orbitJson(response.orbits[i], phase_mark);
        });
  }
  json["peaks"] = listJson(r.peaks, [&](const CriticalSpeed& peak) -> Json {
    return {{"speed", peak.speed},
            {"major", peak.peak},
            {"direction", peak.forward ? "forward" : "backward"},
            {"amplification_factor", peak.amplification_factor},
            {"beyond_tables", !data.covers(peak.speed)}};
  });
  return json;
}

CsvTables tables(const ResponseReport& r) {
  CsvTable sweep{"", withOrbit({"station", "speed"})};
  for (const std::size_t i : r.stations) {
    for (const SynchronousResponse& response : r.sweep) {
      sweep.rows.push_back(
          orbitRow(*r.system, {{"station", r.system->places[i].name}, {"speed", response.speed}},
                   response.orbits[i], response.speed));
    }
  }
  return {sweep,
          {"peaks",
           {"speed", "major", "direction", "amplification_factor", "beyond_tables"},
           json(r)["peaks"]}};
}

std::string text(const ResponseReport& r, const ShownUnits& u) {
  constexpr std::size_t kRows = 20;
  const std::size_t stride = 1 + r.sweep.size() / kRows;
  const DataSpeeds data = r.system->tables();
  std::string out = fmt::format("{}: response to its unbalance\n", r.system->title());
  if (stride > 1) {
    out += fmt::format("  1 in {} of {} speeds; all of them with --json or --csv\n", stride,
                       r.sweep.size());
  }
  for (const std::size_t i : r.stations) {
    out += fmt::format("  at {}\n{}", r.system->places[i].name,
                       orbitHead("speed, " + u.speed.name, u));
    for (std::size_t k = 0; k < r.sweep.size(); k += stride) {
      out += orbitText(fmt::format("{:.6g}", u.speed.in(r.sweep[k].speed)), r.sweep[k].orbits[i],
                       r.system->dynamics->phaseMark(), u, beyondMark(data, r.sweep[k].speed));
    }
  }
  out += fmt::format("  peaks at {}\n", r.system->places.front().name);
  for (const CriticalSpeed& peak : r.peaks) {
    out += fmt::format("    {:.6g} {}: {:.5g} {}, {}, amplification {}{}\n", u.speed.in(peak.speed),
                       u.speed.name, u.vibration.in(peak.peak), u.vibration.name,
                       peak.forward ? "forward" : "backward",
                       defined(peak.amplification_factor, "-"), beyondMark(data, peak.speed));
  }
  return out + (r.peaks.empty() ? "    none in the range\n" : "") +
         beyondLine(data, r.sweep.front().speed, r.sweep.back().speed);
}

OrbitReport orbitReport(const RotorSystem& system, double speed) {
  requireForce(system);
  if (!(speed >= 0.0 && std::isfinite(speed))) {
    throw InputError(fmt::format("--speed: expected a shaft speed >= 0 rad/s, found {:g}", speed));
  }
  return {&system, synchronousResponse(system.rotor, system.places, speed)};
}

Json json(const OrbitReport& r) {
  Json json{{"model", r.system->model},
            {"speed", r.response.speed},
            {"beyond_tables", !r.system->tables().covers(r.response.speed)}};
  for (std::size_t i = 0; i < r.response.orbits.size(); ++i) {
    const Station& station = r.system->places[i];
    json["stations"][station.name] =
        orbitJson(r.response.orbits[i], r.system->dynamics->phaseMark());
    json["stations"][station.name]["position"] = station.position;
  }
  return json;
}

CsvTables tables(const OrbitReport& r) {
  CsvTable orbits{"", withOrbit({"station", "position"})};
  for (std::size_t i = 0; i < r.response.orbits.size(); ++i) {
    const Station& station = r.system->places[i];
    orbits.rows.push_back(orbitRow(*r.system,
                                   {{"station", station.name}, {"position", station.position}},
                                   r.response.orbits[i], r.response.speed));
  }
  return {orbits};
}

std::string text(const OrbitReport& r, const ShownUnits& u) {
  std::string out =
      fmt::format("{}: orbits at {:g} {}\n{}", r.system->title(), u.speed.in(r.response.speed),
                  u.speed.name, orbitHead("station", u));
  for (std::size_t i = 0; i < r.response.orbits.size(); ++i) {
    out += orbitText(r.system->places[i].name, r.response.orbits[i],
                     r.system->dynamics->phaseMark(), u);
  }
  return out + beyondLine(r.system->tables(), r.response.speed, r.response.speed);
}

}  // namespace whirl_twin
