#include "reports/rotor_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kThinnestDisc = 0.005;  // of the shaft's length, a disc
constexpr double kWidestDisc = 0.1;

constexpr Ink kShaft{0.62, 0.68, 0.75};
constexpr Ink kSleeve{0.78, 0.72, 0.60};
constexpr Ink kDisc{0.47, 0.56, 0.66};
constexpr Ink kBearing{0.35, 0.37, 0.40};

double radiusAt(const ShaftSection& section, double share) {
  return 0.5 * (section.outer_diameter + share * section.outer_growth);
}

/// Both sides of a cylinder or cone.
Series mirrored(double from, double to, double first, double last, const Ink& ink) {
  Series area;
  area.x = {from, to, to, from};
  area.y = {first, last, -last, -first};
  area.fill = ink;
  return area;
}

/// The edge of such areas, all in one line.
void addEdge(const Series& area, Series& edges) {
  for (std::size_t i = 0; i <= area.x.size(); ++i) {
    edges.x.push_back(area.x[i % area.x.size()]);
    edges.y.push_back(area.y[i % area.y.size()]);
  }
  edges.x.push_back(kNaN);
  edges.y.push_back(kNaN);
}

double shaftRadiusAt(const FlexibleShaft& shaft, int node) {
  double radius = 0.0;
  for (const int i : {node - 1, node}) {
    if (i >= 0 && i < static_cast<int>(shaft.elements.size())) {
      radius = std::max(radius, radiusAt(shaft.elements[static_cast<std::size_t>(i)], 0.5));
    }
  }
  return radius;
}

constexpr int kOrbitPoints = 181;
constexpr std::size_t kMaxOrbits = 24;   // along a shaft
constexpr std::size_t kPlaneOrbits = 6;  // in one plane, as many as colours differ well

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
  const std::size_t stride = 1 + (order.size() - 1) / kMaxOrbits;
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

/// A dot on each where the shaft's phase mark passes x, as a keyphasor marks it on a screen.
Chart orbitsInOnePlane(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                       const std::string& unit) {
  std::vector<std::size_t> widest(orbits.size());
  std::iota(widest.begin(), widest.end(), std::size_t{0});
  std::stable_sort(widest.begin(), widest.end(), [&](std::size_t a, std::size_t b) {
    return orbits[a].major() > orbits[b].major();
  });
  widest.resize(std::min(widest.size(), kPlaneOrbits));
  std::sort(widest.begin(), widest.end());
  Chart chart;
  chart.x.label = fmt::format("x ({})", unit);
  chart.y.label = fmt::format("y ({})", unit);
  chart.equal_aspect = true;
  for (const std::size_t i : widest) {
    Series path = orbitPath(orbits[i], 0.0);  // where the shaft's mark passes x
    path.name = fmt::format("{}, {}", stations[i].name, name(orbits[i].direction()));
    chart.series.push_back(path);
  }
  Series starts{"phase mark passes x", {}, {}, Pen{ink::kBlack, 1.2}};
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

DrawnDisc drawnDisc(const FlexibleShaft& shaft, const RotorDisc& disc) {
  const double length = shaft.positions().back();
  if (disc.diameter > 0.0) {
    return {0.5 * disc.diameter, disc.width};
  }
  if (!(disc.mass > 0.0 && disc.polar_inertia > 0.0)) {
    return {1.3 * shaftRadiusAt(shaft, disc.node), kThinnestDisc * length};
  }
  // I_p = m r^2 / 2, I_d = m (3 r^2 + h^2) / 12.
  const double radius = std::sqrt(2.0 * disc.polar_inertia / disc.mass);
  const double width =
      std::sqrt(std::max(0.0, 12.0 * disc.transverse_inertia / disc.mass - 3.0 * radius * radius));
  return {std::min(radius, 0.5 * length),
          std::clamp(width, kThinnestDisc * length, kWidestDisc * length)};
}

double largestRadius(const FlexibleShaft& shaft) {
  double largest = 0.0;
  for (int i = 0; i < static_cast<int>(shaft.elements.size()); ++i) {
    for (const ShaftLayer& layer : shaft.layers(i)) {
      largest = std::max({largest, radiusAt(layer.section, 0.0), radiusAt(layer.section, 1.0)});
    }
  }
  for (const RotorDisc& disc : shaft.discs) {
    largest = std::max(largest, drawnDisc(shaft, disc).radius);
  }
  return largest;
}

std::vector<int> bearingNodes(const FlexibleShaft& shaft) {
  std::vector<int> nodes;
  for (const RotorBearing& bearing : shaft.bearings) {
    nodes.push_back(bearing.node);
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    nodes.push_back(bearing.node);
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    nodes.push_back(support.node);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<Series> rotorOutline(const FlexibleShaft& shaft, double scale, double pale) {
  const std::vector<double> z = shaft.positions();
  std::vector<Series> all;
  Series edges{"", {}, {}, Pen{paler(ink::kBlack, 0.4 + 0.6 * pale), 0.8}};
  const auto add = [&](const Series& area) {
    all.push_back(area);
    addEdge(area, edges);
  };
  for (const RotorDisc& disc : shaft.discs) {
    const DrawnDisc drawn = drawnDisc(shaft, disc);
    const double at = z[static_cast<std::size_t>(disc.node)];
    add(mirrored(at - 0.5 * drawn.width, at + 0.5 * drawn.width, scale * drawn.radius,
                 scale * drawn.radius, paler(kDisc, pale)));
  }
  for (const bool sleeves : {true, false}) {  // the shaft in front of what sits on it
    for (std::size_t i = 0; i < shaft.elements.size(); ++i) {
      const std::vector<ShaftLayer> layers = shaft.layers(static_cast<int>(i));
      for (std::size_t k = layers.size(); k-- > 0;) {
        const ShaftSection& section = layers[k].section;
        if ((k > 0) == sleeves) {
          add(mirrored(z[i], z[i + 1], scale * radiusAt(section, 0.0),
                       scale * radiusAt(section, 1.0), paler(k > 0 ? kSleeve : kShaft, pale)));
        }
      }
    }
  }
  const double foot = 0.012 * (z.back() - z.front());
  for (const int node : bearingNodes(shaft)) {
    const double at = z[static_cast<std::size_t>(node)];
    const double under = -scale * shaftRadiusAt(shaft, node);
    const double depth = 0.25 * scale * largestRadius(shaft);
    Series wedge;
    wedge.x = {at, at + foot, at - foot};
    wedge.y = {under, under - depth, under - depth};
    wedge.fill = paler(kBearing, pale);
    all.push_back(wedge);
  }
  all.push_back(edges);
  return all;
}

OrbitChart orbitChart(const std::vector<Orbit>& orbits, const std::vector<Station>& stations,
                      const std::string& unit, DrawnInstant instant) {
  const std::vector<std::size_t> order = orderAlongShaft(stations);
  OrbitChart drawn;
  drawn.along_shaft = !order.empty();
  drawn.plane = orbitsInOnePlane(orbits, stations, unit);
  drawn.chart = drawn.plane;
  if (drawn.along_shaft) {
    drawn.chart = orbitsAlongShaft(orbits, stations, order, instant);
    drawn.chart.y.label += fmt::format(" ({})", unit);
  }
  return drawn;
}

}  // namespace whirl_twin
