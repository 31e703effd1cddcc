// Bode and polar plots of the unbalance response, and orbits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "reports/response_report.h"

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRpm = 30.0 / kPi;       // of a rad/s
constexpr std::size_t kMostStations = 7;  // of one chart: as many as it has colours
constexpr double kNeedles = 0.125;        // of the range

/// Some of the stations, evenly along the list: its first, its last and what lies between.
std::vector<std::size_t> shownStations(const ResponseReport& r) {
  const std::size_t count = r.stations.size();
  if (count <= kMostStations) {
    return r.stations;
  }
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < kMostStations; ++i) {
    shown.push_back(r.stations[i * (count - 1) / (kMostStations - 1)]);
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
                 synchronousResponse(r.system->rotor, r.system->stations, between));
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
                std::size_t station, Chart& polar) {
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
    polar.notes.push_back({at.real(), at.imag(), fmt::format("{:.4g} rad/s", sweep[k].speed)});
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
      y = y < kFaintest * highest ? std::numeric_limits<double>::quiet_NaN() : y;
    }
  }
}

ChartAxis speedAxis() {
  return {"shaft speed (rad/s)", false, true, SecondScale{"rpm", kRpm}};
}

std::string speedName(double speed) {
  return fmt::format("{:.4g} rad/s, {:.0f} rpm", speed, kRpm * speed);
}

/// Degrees from -90 to 270, broken where it passes from one end to the other.
Series lagSeries(const ResponseReport& r, std::size_t station) {
  Series series;
  double before = std::numeric_limits<double>::quiet_NaN();
  for (const SynchronousResponse& response : r.sweep) {
    const double lag =
        phaseLag(response.orbits[station], r.system->dynamics->phaseMark()) * 180.0 / kPi;
    const double now = lag < -90.0 ? lag + 360.0 : lag;
    if (std::fabs(now - before) > 180.0) {
      series.x.push_back(response.speed);
      series.y.push_back(std::numeric_limits<double>::quiet_NaN());
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

Figure figure(const ResponseReport& r) {
  Chart amplitude, lag, polar;
  amplitude.x = speedAxis();
  amplitude.y.label = "semi-major axis (m)";
  lag.x = {"shaft speed (rad/s)", false, true};
  lag.y.label = "phase lag of the whirl (deg)";
  lag.y.degrees = true;
  polar.x.label = "in line with the unbalance (m)";
  polar.y.label = "ahead of the unbalance (m)";
  polar.title = "forward whirl seen from the shaft";
  polar.equal_aspect = true;
  const std::vector<std::size_t> shown = shownStations(r);
  for (const std::size_t i : shown) {
    Series major;
    major.name = r.system->stations[i].name;
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
  markSpeeds(r, smoothSweep(r, shown.front()), shown.front(), polar);
  for (const CriticalSpeed& peak : r.peaks) {
    amplitude.vertical.push_back({peak.speed, speedName(peak.speed)});
    lag.vertical.push_back({peak.speed, ""});
  }
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

namespace {

constexpr int kOrbitPoints = 181;

/// One turn of the shaft, from an angle of it on [rad]: x along, y up [m].
Series orbitPath(const Orbit& orbit, double start) {
  Series path;
  for (int k = 0; k < kOrbitPoints; ++k) {
    const std::complex<double> turn = std::polar(1.0, start + 2.0 * kPi * k / (kOrbitPoints - 1));
    path.x.push_back((orbit.x * turn).real());
    path.y.push_back((orbit.y * turn).real());
  }
  return path;
}

Pen penOf(const Orbit& orbit) {
  const bool forward = std::abs(orbit.forward) >= std::abs(orbit.backward);
  return {forward ? ink::kBlue : ink::kVermilion, 1.8};
}

/// Where the paths begin: the shaft at one instant.
Series startsOf(const std::vector<Series>& paths) {
  Series mark{"the shaft at one instant", {}, {}, Pen{ink::kBlack, 1.2}};
  for (const Series& path : paths) {
    mark.x.push_back(path.x.front());
    mark.y.push_back(path.y.front());
  }
  mark.marks = Marks::kDots;
  return mark;
}

/// Stations in order along the shaft; empty where they are not apart.
std::vector<std::size_t> alongShaft(const OrbitReport& r) {
  std::vector<std::size_t> order(r.response.orbits.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto position = [&](std::size_t i) { return r.system->stations[i].position; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return position(a) < position(b); });
  constexpr std::size_t kFewest = 3;
  const bool apart = order.size() >= kFewest && position(order.back()) > position(order.front());
  return apart ? order : std::vector<std::size_t>();
}

/// The orbits where they are on the shaft, seen from the side: x goes into the picture, aslant.
Chart orbitsAlongShaft(const OrbitReport& r, const std::vector<std::size_t>& order) {
  constexpr double kAslant = 0.05;  // of the shaft's length, the largest amplitude
  double largest = 0.0;
  double highest = 0.0;  // [rad], the shaft's angle where the largest orbit is highest
  for (const Orbit& orbit : r.response.orbits) {
    if (orbit.major() > largest) {
      largest = orbit.major();
      highest = -std::arg(orbit.y);
    }
  }
  const auto position = [&](std::size_t i) { return r.system->stations[i].position; };
  const double length = position(order.back()) - position(order.front());
  const double slant = largest > 0.0 ? kAslant * length / largest : 0.0;
  Chart chart;
  chart.x = {"along the shaft (m); x of the orbits is drawn aslant", false, true};
  chart.y.label = "y (m)";
  bool named[2] = {false, false};
  std::vector<Series> paths;
  for (const std::size_t i : order) {
    const Orbit& orbit = r.response.orbits[i];
    Series path = orbitPath(orbit, highest);
    for (double& x : path.x) {
      x = position(i) + slant * x;
    }
    path.pen = penOf(orbit);
    const bool forward = std::abs(orbit.forward) >= std::abs(orbit.backward);
    bool& done = named[forward ? 0 : 1];
    path.name = done ? "" : forward ? "forward" : "backward";
    done = true;
    paths.push_back(path);
  }
  chart.series = paths;
  chart.series.push_back({"axis",
                          {position(order.front()), position(order.back())},
                          {0.0, 0.0},
                          Pen{ink::kGrey, 1.2, {8.0, 4.0}}});
  chart.series.push_back(startsOf(paths));
  return chart;
}

Chart orbitsInOnePlane(const OrbitReport& r) {
  Chart chart;
  chart.x.label = "x (m)";
  chart.y.label = "y (m)";
  chart.equal_aspect = true;
  for (std::size_t i = 0; i < r.response.orbits.size(); ++i) {
    Series path = orbitPath(r.response.orbits[i], 0.0);  // where the shaft's mark passes x
    path.name =
        fmt::format("{}, {}", r.system->stations[i].name, name(r.response.orbits[i].direction()));
    chart.series.push_back(path);
  }
  Series mark = startsOf(chart.series);
  mark.name.clear();
  mark.line = false;
  chart.series.push_back(mark);
  return chart;
}

}  // namespace

Figure figure(const OrbitReport& r) {
  const std::vector<std::size_t> order = alongShaft(r);
  Figure figure;
  figure.title = fmt::format("{}: orbits at {}", r.system->title(), speedName(r.response.speed));
  figure.charts = {order.empty() ? orbitsInOnePlane(r) : orbitsAlongShaft(r, order)};
  figure.width = order.empty() ? 640 : 900;
  figure.chart_height = order.empty() ? 640 : 460;
  return figure;
}

}  // namespace whirl_twin
