#include "reports/orbit_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr int kOrbitPoints = 181;
constexpr std::size_t kMostOrbits = 24;  // along a shaft

/// One turn of the shaft, from an angle of it on [rad]: x along, y up [m].
Series orbitPath(const Orbit& orbit, double start) {
  Series path;
  for (int k = 0; k < kOrbitPoints; ++k) {
    const std::complex<double> turn = std::polar(1.0, start + kTwoPi * k / (kOrbitPoints - 1));
    path.x.push_back((orbit.x * turn).real());
    path.y.push_back((orbit.y * turn).real());
  }
  return path;
}

Pen orbitPen(const Orbit& orbit) {
  const bool forward = std::abs(orbit.forward) >= std::abs(orbit.backward);
  return {forward ? ink::kBlue : ink::kVermilion, 1.8};
}

/// Stations in order along the shaft; empty where they are not apart.
std::vector<std::size_t> orderAlongShaft(const std::vector<Station>& stations) {
  std::vector<std::size_t> order(stations.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto position = [&](std::size_t i) { return stations[i].position; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return position(a) < position(b); });
  constexpr std::size_t kFewest = 3;
  const bool apart = order.size() >= kFewest && position(order.back()) > position(order.front());
  return apart ? order : std::vector<std::size_t>();
}

/// The orbits where they are on the shaft, seen from the side: x goes into the picture, aslant.
Chart orbitsAlongShaft(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                       const std::vector<std::size_t>& order, DrawnInstant instant) {
  constexpr double kAslant = 0.05;  // of the shaft's length, the largest amplitude
  double largest = 0.0;
  double start = 0.0;  // [rad], the shaft's angle at that instant
  for (const Orbit& orbit : orbits) {
    if (orbit.major() > largest) {
      largest = orbit.major();
      start = instant == DrawnInstant::kPhaseMark ? 0.0 : -std::arg(orbit.y);
    }
  }
  const auto position = [&](std::size_t i) { return stations[i].position; };
  const double length = position(order.back()) - position(order.front());
  const double slant = largest > 0.0 ? kAslant * length / largest : 0.0;
  Chart chart;
  chart.x = {"along the shaft (m); x of the orbits is drawn oblique", false, true};
  chart.y.label = "y";
  bool named[2] = {false, false};
  Series shaft{instant == DrawnInstant::kPhaseMark ? "the shaft when its phase mark passes x"
                                                   : "the shaft at one instant",
               {},
               {},
               Pen{ink::kBlack, 1.2}};
  const std::size_t stride = 1 + (order.size() - 1) / kMostOrbits;
  shaft.marks = stride == 1 ? Marks::kDots : Marks::kNone;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    const Orbit& orbit = orbits[i];
    Series path = orbitPath(orbit, start);
    for (double& x : path.x) {
      x = position(i) + slant * x;
    }
    shaft.x.push_back(path.x.front());
    shaft.y.push_back(path.y.front());
    if (k % stride != 0) {
      continue;
    }
    path.pen = orbitPen(orbit);
    const bool forward = std::abs(orbit.forward) >= std::abs(orbit.backward);
    bool& done = named[forward ? 0 : 1];
    path.name = done ? "" : forward ? "forward" : "backward";
    done = true;
    chart.series.push_back(path);
  }
  chart.series.push_back({"axis",
                          {position(order.front()), position(order.back())},
                          {0.0, 0.0},
                          Pen{ink::kGrey, 1.2, {8.0, 4.0}}});
  chart.series.push_back(shaft);
  return chart;
}

Chart orbitsInOnePlane(const std::vector<Orbit>& orbits, const std::vector<Station>& stations) {
  Chart chart;
  chart.x.label = "x";
  chart.y.label = "y";
  chart.equal_aspect = true;
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    Series path = orbitPath(orbits[i], 0.0);  // where the shaft's mark passes x
    path.name = fmt::format("{}, {}", stations[i].name, name(orbits[i].direction()));
    chart.series.push_back(path);
  }
  Series starts{"", {}, {}, Pen{ink::kBlack, 1.2}};
  for (const Series& path : chart.series) {
    starts.x.push_back(path.x.front());
    starts.y.push_back(path.y.front());
  }
  starts.line = false;
  starts.marks = Marks::kDots;
  chart.series.push_back(starts);
  return chart;
}

}  // namespace

OrbitChart orbitChart(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                      const std::string& unit, DrawnInstant instant) {
  const std::vector<std::size_t> order = orderAlongShaft(stations);
  OrbitChart drawn;
  drawn.along_shaft = !order.empty();
  drawn.chart = drawn.along_shaft ? orbitsAlongShaft(orbits, stations, order, instant)
                                  : orbitsInOnePlane(orbits, stations);
  drawn.chart.y.label += fmt::format(" ({})", unit);
  if (!drawn.along_shaft) {
    drawn.chart.x.label += fmt::format(" ({})", unit);
  }
  return drawn;
}

}  // namespace whirl_twin
