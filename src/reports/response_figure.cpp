// Bode and polar plots of the unbalance response, and orbits.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "reports/response_report.h"

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Degrees from -90 to 270, broken where it passes from one end to the other.
Series lagSeries(const ResponseReport& r, std::size_t station) {
  Series series;
  series.name = r.system->stations[station].name;
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
  amplitude.x = {"shaft speed (rad/s)", false, true};
  amplitude.y.label = "semi-major axis (m)";
  lag.x = {"shaft speed (rad/s)", false, true};
  lag.y.label = "phase lag of the whirl (deg)";
  polar.x.label = "in line with the unbalance (m)";
  polar.y.label = "ahead of the unbalance (m)";
  polar.title = "forward whirl seen from the shaft";
  polar.equal_aspect = true;
  for (const std::size_t i : r.stations) {
    Series major, path;
    major.name = path.name = r.system->stations[i].name;
    for (const SynchronousResponse& response : r.sweep) {
      const Orbit& orbit = response.orbits[i];
      major.x.push_back(response.speed);
      major.y.push_back(orbit.major());
      const double angle = -phaseLag(orbit, r.system->dynamics->phaseMark());
      path.x.push_back(std::abs(orbit.forward) * std::cos(angle));
      path.y.push_back(std::abs(orbit.forward) * std::sin(angle));
    }
    amplitude.series.push_back(major);
    lag.series.push_back(lagSeries(r, i));
    polar.series.push_back(path);
  }
  for (const CriticalSpeed& peak : r.peaks) {
    amplitude.vertical.push_back({peak.speed, fmt::format("{:.4g} rad/s", peak.speed)});
    lag.vertical.push_back({peak.speed, ""});
  }
  lag.horizontal = {{90.0, ""}, {180.0, ""}};
  Figure figure;
  figure.title = r.system->title() + ": unbalance response";
  figure.charts = {amplitude, lag, polar};
  figure.width = 800;
  figure.chart_height = 400;
  return figure;
}

Figure figure(const OrbitReport& r) {
  constexpr int kPoints = 181;
  Chart chart;
  chart.x.label = "x (m)";
  chart.y.label = "y (m)";
  chart.equal_aspect = true;
  for (std::size_t i = 0; i < r.response.orbits.size(); ++i) {
    const Orbit& orbit = r.response.orbits[i];
    Series path;
    path.name = fmt::format("{}, {}", r.system->stations[i].name, name(orbit.direction()));
    for (int k = 0; k < kPoints; ++k) {
      const std::complex<double> turn = std::polar(1.0, 2.0 * kPi * k / (kPoints - 1));
      path.x.push_back((orbit.x * turn).real());
      path.y.push_back((orbit.y * turn).real());
    }
    chart.series.push_back(path);
  }
  const std::size_t orbits = chart.series.size();
  for (std::size_t i = 0; i < orbits; ++i) {  // where the shaft's mark passes the x axis
    Series mark{"", {chart.series[i].x.front()}, {chart.series[i].y.front()}};
    mark.pen = Pen{ink::kBlack, 1.0};
    mark.line = false;
    mark.marks = Marks::kDots;
    chart.series.push_back(mark);
  }
  Figure figure;
  figure.title = fmt::format("{}: orbits at {:g} rad/s", r.system->title(), r.response.speed);
  figure.charts = {chart};
  figure.width = 640;
  figure.chart_height = 640;
  return figure;
}

}  // namespace whirl_twin
