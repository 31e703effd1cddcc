// Bode and polar plots of the unbalance response, and orbits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "reports/report_values.h"
#include "reports/response_report.h"
#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

constexpr double kNeedles = 0.125;  // of the range

/// Some of the stations, evenly along the list: its first, its last and what lies between.
std::vector<std::size_t> shownStations(const ResponseReport& r) {
  const std::size_t count = r.stations.size();
  if (count <= kMaxStationsDrawn) {
    return r.stations;
  }
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < kMaxStationsDrawn; ++i) {
    shown.push_back(r.stations[i * (count - 1) / (kMaxStationsDrawn - 1)]);
  }
  return shown;
}

/// The forward whirl in the shaft's axes [m].
std::complex<double> fromShaft(const ResponseReport& r, const SynchronousResponse& response,
                               std::size_t station) {
  const Orbit& orbit = response.orbits[station];
  return std::polar(std::abs(orbit.forward), -phaseLag(orbit, r.system->dynamics->phaseMark()));
}

/// The sweep with as many more speeds as make the locus of a station smooth.
std::vector<SynchronousResponse> smoothSweep(const ResponseReport& r, std::size_t station) {
  constexpr std::size_t kMost = 400;  // more speeds
  std::vector<SynchronousResponse> sweep = r.sweep;
  double size = 0.0;
  for (const SynchronousResponse& response : sweep) {
    size = std::max(size, std::abs(response.orbits[station].forward));
  }
  const std::size_t end = sweep.size() + kMost;
  for (std::size_t k = 0; k + 1 < sweep.size();) {
    const double gap =
        std::abs(fromShaft(r, sweep[k + 1], station) - fromShaft(r, sweep[k], station));
    if (gap <= 0.04 * size || sweep.size() >= end) {
      ++k;
      continue;
    }
    const double between = 0.5 * (sweep[k].speed + sweep[k + 1].speed);
    sweep.insert(sweep.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                 synchronousResponse(r.system->rotor, r.system->places, between));
  }
  return sweep;
}

Series locus(const ResponseReport& r, const std::vector<SynchronousResponse>& sweep,
             std::size_t station) {
  Series path;
  for (const SynchronousResponse& response : sweep) {
    const std::complex<double> at = fromShaft(r, response, station);
    path.x.push_back(at.real());
    path.y.push_back(at.imag());
  }
  return path;
}

/// Speeds along the locus, at equal distances on it, and which way it is run through.
void markSpeeds(const ResponseReport& r, const std::vector<SynchronousResponse>& sweep,
                std::size_t station, const ShownUnit& unit, Chart& polar) {
  constexpr double kParts = 7.0;
  std::vector<double> way{0.0};
  for (std::size_t k = 0; k + 1 < sweep.size(); ++k) {
    way.push_back(way.back() +
                  std::abs(fromShaft(r, sweep[k + 1], station) - fromShaft(r, sweep[k], station)));
  }
  Series marks{"", {}, {}, Pen{ink::kBlue, 1.8}};
  marks.line = false;
  marks.marks = Marks::kDots;
  double next = way.back() / kParts;
  for (std::size_t k = 1; k + 1 < sweep.size(); ++k) {
    if (way[k] < next) {
      continue;
    }
    const std::complex<double> at = fromShaft(r, sweep[k], station);
    marks.x.push_back(at.real());
    marks.y.push_back(at.imag());
    polar.notes.push_back({at.real(), at.imag(), unit.shortText(sweep[k].speed)});
    next = way[k] + way.back() / kParts;
  }
  polar.series.push_back(marks);
  const auto half = static_cast<std::size_t>(
      std::lower_bound(way.begin(), way.end(), 0.5 * way.back() + 0.04 * way.back()) - way.begin());
  if (half == 0 || half + 1 >= sweep.size()) {
    return;
  }
  const std::complex<double> tip = fromShaft(r, sweep[half], station);
  std::complex<double> along = tip - fromShaft(r, sweep[half - 1], station);
  along *= 0.02 * way.back() / std::max(std::abs(along), 1e-300);
  const std::complex<double> left = tip + along * std::polar(1.0, 0.85 * kPi);
  const std::complex<double> right = tip + along * std::polar(1.0, -0.85 * kPi);
  polar.series.push_back({"",
                          {left.real(), tip.real(), right.real()},
                          {left.imag(), tip.imag(), right.imag()},
                          Pen{ink::kBlue, 2.2}});
}

/// Are the peaks so sharp that little else is to be seen beside them: above a tenth of the highest
/// in less than a part of the range only?
bool needles(const std::vector<Series>& all) {
  double highest = 0.0;
  for (const Series& series : all) {
    highest = std::max(highest, *std::max_element(series.y.begin(), series.y.end()));
  }
  double widest = 0.0;
  for (const Series& series : all) {
    double wide = 0.0;
    for (std::size_t k = 0; k + 1 < series.x.size(); ++k) {
      wide += series.y[k] > 0.1 * highest ? series.x[k + 1] - series.x[k] : 0.0;
    }
    widest = std::max(widest, wide);
  }
  const std::vector<double>& speeds = all.front().x;
  return widest < kNeedles * (speeds.back() - speeds.front());
}

/// On a logarithmic axis slow speeds, with next to no unbalance force, would take most of the room.
void cutFaint(std::vector<Series>& all) {
  constexpr double kFaintest = 1.0e-5;  // of the highest
  double highest = 0.0;
  for (const Series& series : all) {
    highest = std::max(highest, *std::max_element(series.y.begin(), series.y.end()));
  }
  for (Series& series : all) {
    for (double& y : series.y) {
      y = y < kFaintest * highest ? kNaN : y;
    }
  }
}

/// Degrees from -90 to 270, broken where it passes from one end to the other.
Series lagSeries(const ResponseReport& r, std::size_t station) {
  Series series;
  double before = kNaN;
  for (const SynchronousResponse& response : r.sweep) {
    const double lag =
        phaseLag(response.orbits[station], r.system->dynamics->phaseMark()) * 180.0 / kPi;
    const double now = lag < -90.0 ? lag + 360.0 : lag;
    if (std::fabs(now - before) > 180.0) {
      series.x.push_back(response.speed);
      series.y.push_back(kNaN);
    }
    if (response.speed > 0.0) {
      series.x.push_back(response.speed);
      series.y.push_back(now);
      before = now;
    }
  }
  return series;
}

}  // namespace

Figure figure(const ResponseReport& r, const ShownUnits& u) {
  Chart amplitude, lag, polar;
  amplitude.x = tightAxis("shaft speed", u.speed, u.besideSpeed());
  const bool semi_axis = u.vibration.name == u.length.name;  // not peak to peak
  amplitude.y = tightAxis(semi_axis ? "semi-major axis" : "along the major axis", u.vibration);
  amplitude.y.tight = false;
  lag.x = tightAxis("shaft speed", u.speed);
  lag.y = lagAxis("lag behind the phase mark", u.angle);
  polar.x = tightAxis("along the shaft's phase mark", u.vibration);
  polar.y = tightAxis("ahead of the phase mark", u.vibration);
  polar.title = "forward whirl in the shaft's frame";
  polar.equal_aspect = true;
  const std::vector<std::size_t> shown = shownStations(r);
  for (const std::size_t i : shown) {
    Series major;
    major.name = r.system->places[i].name;
    for (const SynchronousResponse& response : r.sweep) {
      major.x.push_back(response.speed);
      major.y.push_back(response.orbits[i].major());
    }
    amplitude.series.push_back(major);
    lag.series.push_back(lagSeries(r, i));
    polar.series.push_back(locus(r, smoothSweep(r, i), i));
  }
  if (needles(amplitude.series)) {
    amplitude.y.logarithmic = true;
    cutFaint(amplitude.series);
  }
  markSpeeds(r, smoothSweep(r, shown.front()), shown.front(), u.speed, polar);
  for (const CriticalSpeed& peak : r.peaks) {
    amplitude.vertical.push_back({peak.speed, u.speedText(peak.speed)});
    lag.vertical.push_back({peak.speed, ""});
  }
  shadeBeyond(r.system->tables(), r.sweep.front().speed, r.sweep.back().speed, true, amplitude);
  shadeBeyond(r.system->tables(), r.sweep.front().speed, r.sweep.back().speed, false, lag);
  lag.horizontal = {{90.0, ""}, {180.0, ""}};
  Figure figure;
  figure.title = r.system->title() + ": unbalance response";
  if (shown.size() < r.stations.size()) {
    figure.title += fmt::format(", {} of {} stations", shown.size(), r.stations.size());
  }
  figure.charts = {amplitude, lag, polar};
  figure.width = 800;
  figure.chart_height = 400;
  return figure;
}

Figure figure(const OrbitReport& r, const ShownUnits& u) {
  OrbitChart orbits =
      orbitChart(r.response.orbits, r.system->places, u.length.name, DrawnInstant::kPhaseMark);
  orbits.plane.x.unit = orbits.plane.y.unit = orbits.chart.y.unit = u.length.size;
  orbits.chart.x.unit = orbits.along_shaft ? 1.0 : u.length.size;
  Figure figure;
  figure.title = fmt::format("{}: orbits at {}{}", r.system->title(), u.speedText(r.response.speed),
                             beyondMark(r.system->tables(), r.response.speed));
  figure.charts = {orbits.chart};
  if (orbits.along_shaft) {
    figure.charts.push_back(orbits.plane);
  }
  figure.width = orbits.along_shaft ? 900 : 640;
  figure.chart_height = orbits.along_shaft ? 460 : 640;
  return figure;
}

}  // namespace whirl_twin
