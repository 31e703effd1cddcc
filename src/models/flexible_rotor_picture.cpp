#include "models/flexible_rotor_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr int kConeRods = 4;
constexpr double kSeal = 0.1;        // of the stiffest bearing: softer ones carry no load
constexpr double kSealRing = 1.35;   // of the shaft's radius
constexpr double kSealWidth = 0.01;  // of the shaft's length

double size(const BearingCoefficients& b) {
  return std::max(std::fabs(b.kxx), std::fabs(b.kyy));
}

/// A node and how stiffly it is held: of what follows the speed at the last speed of its table.
struct Held {
  int node;
  double stiffness;
};

std::vector<Held> heldNodes(const FlexibleShaft& shaft) {
  std::vector<Held> held;
  for (const RotorBearing& bearing : shaft.bearings) {
    held.push_back({bearing.node, size(bearing.coefficients)});
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    const double speed = bearing.knots.empty() ? 0.0 : bearing.knots.back();
    held.push_back({bearing.node, size(bearing.coefficients(speed))});
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    held.push_back({support.node, std::numeric_limits<double>::max()});
  }
  return held;
}

SketchPoint between(const SketchPoint& a, const SketchPoint& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

}  // namespace

FlexibleRotorPicture::FlexibleRotorPicture(const FlexibleShaft& shaft,
                                           std::vector<Station> stations,
                                           std::vector<Station> pedestals, int probe_node)
    : stations_(std::move(stations)),
      pedestal_stations_(std::move(pedestals)),
      probe_node_(probe_node) {
  length_ = stations_.back().position;
  for (std::size_t i = 0; i < shaft.elements.size(); ++i) {
    addRods(static_cast<int>(i), shaft.elements[i],
            shaft.elements[i].coupling ? SketchRole::kSpring : SketchRole::kBody);
  }
  for (const ShaftSleeve& sleeve : shaft.sleeves) {
    addRods(sleeve.element, sleeve.layer.section, SketchRole::kMass);
  }
  double widest = 0.0;
  for (const Rod& rod : rods_) {
    widest = std::max(widest, rod.radius);
  }
  for (const RotorDisc& disc : shaft.discs) {
    if (disc.diameter > 0.0) {
      discs_.push_back({disc.node, 0.5 * disc.diameter, disc.width});
      widest = std::max(widest, discs_.back().radius);
    } else if (disc.mass > 0.0 && disc.polar_inertia > 0.0) {
      // A solid cylinder of these inertias: I_p = m r^2 / 2, I_d = m (3 r^2 + h^2) / 12.
      const double radius = std::sqrt(2.0 * disc.polar_inertia / disc.mass);
      const double thickness = std::sqrt(
          std::max(0.0, 12.0 * disc.transverse_inertia / disc.mass - 3.0 * radius * radius));
      discs_.push_back({disc.node, std::min(radius, 0.5 * length_),
                        std::clamp(thickness, 0.01 * length_, 0.1 * length_)});
      widest = std::max(widest, discs_.back().radius);
    }
  }
  const std::vector<Held> held = heldNodes(shaft);
  double stiffest = 0.0;  // of those that yield
  for (const Held& at : held) {
    if (at.stiffness < std::numeric_limits<double>::max()) {
      stiffest = std::max(stiffest, at.stiffness);
    }
  }
  for (const Held& at : held) {
    if (at.stiffness < kSeal * stiffest && shaft.pedestalsOf(at.node) == 0) {
      seals_.push_back({at.node, kSealRing * radiusAt(at.node)});
    } else {
      bearings_.push_back(at.node);
    }
  }
  std::vector<int> above(stations_.size(), 0);
  for (const RotorPedestal& pedestal : shaft.pedestals) {
    pedestals_.push_back({pedestal.node, above[static_cast<std::size_t>(pedestal.node)]++});
  }
  height_ = std::max(0.3 * length_, 2.4 * widest);
}

double FlexibleRotorPicture::radiusAt(int node) const {
  double radius = 0.0;
  for (const Rod& rod : rods_) {
    if (rod.element == node - 1 || rod.element == node) {
      radius = std::max(radius, rod.radius);
    }
  }
  return radius;
}

void FlexibleRotorPicture::addRods(int element, const ShaftSection& section, SketchRole role) {
  const int rods = section.tapers() ? kConeRods : 1;
  for (int i = 0; i < rods; ++i) {
    const double from = static_cast<double>(i) / rods;
    const double to = static_cast<double>(i + 1) / rods;
    rods_.push_back({element, from, to, 0.5 * section.at(0.5 * (from + to)).outer_diameter, role});
  }
}

Sketch FlexibleRotorPicture::operator()(const Eigen::VectorXd& q, double angle) const {
  const auto at = [&](int node) {
    const Station& station = stations_[static_cast<std::size_t>(node)];
    return SketchPoint{station.position, station.along_x.dot(q), station.along_y.dot(q)};
  };
  Sketch sketch;
  sketch.size = 1.2 * length_;
  sketch.height = height_;
  sketch.centre = {0.5 * length_, 0.0, 0.0};
  sketch.spatial = true;
  for (const Rod& rod : rods_) {
    const SketchPoint first = at(rod.element);
    const SketchPoint second = at(rod.element + 1);
    sketch.rods.push_back(
        {between(first, second, rod.from), between(first, second, rod.to), rod.radius, rod.role});
  }
  const int last = static_cast<int>(stations_.size()) - 1;
  for (const Disc& disc : discs_) {
    // Across the shaft between the nodes beside it; its mark is the shaft's, +x of the rotor at 0.
    const SketchPoint before = at(std::max(disc.node - 1, 0));
    const SketchPoint after = at(std::min(disc.node + 1, last));
    const double length = after.x - before.x;
    sketch.discs.push_back({at(disc.node),
                            {1.0, (after.y - before.y) / length, (after.z - before.z) / length},
                            disc.radius,
                            disc.thickness,
                            angle - 0.5 * kPi,
                            SketchRole::kMass});
  }
  for (const Seal& seal : seals_) {
    const double z = stations_[static_cast<std::size_t>(seal.node)].position;
    const double half = 0.5 * kSealWidth * length_;
    sketch.rods.push_back(
        {{z - half, 0.0, 0.0}, {z + half, 0.0, 0.0}, seal.radius, SketchRole::kSupport});
  }
  const double ground = -0.45 * height_;
  const SketchPoint size{0.06 * length_, 0.06 * length_, 0.02 * length_};
  const auto boxAt = [&](const SketchPoint& place) {
    sketch.boxes.push_back({place, size, 0.0, SketchRole::kSupport});
  };
  // Each pedestal a box between the shaft and the ground, a chain of them evenly.
  std::vector<int> below(stations_.size(), 0);
  for (const Pedestal& pedestal : pedestals_) {
    ++below[static_cast<std::size_t>(pedestal.node)];
  }
  const auto pedestalAt = [&](std::size_t i) {
    const Pedestal& pedestal = pedestals_[i];
    const Station& station = pedestal_stations_[i];
    const double share =
        (pedestal.depth + 1.0) / (below[static_cast<std::size_t>(pedestal.node)] + 1.0);
    return SketchPoint{station.position, station.along_x.dot(q),
                       share * ground + station.along_y.dot(q)};
  };
  const auto standsOn = [&](int node, int depth) {
    for (std::size_t i = 0; i < pedestals_.size(); ++i) {
      if (pedestals_[i].node == node && pedestals_[i].depth == depth) {
        return pedestalAt(i);
      }
    }
    return SketchPoint{stations_[static_cast<std::size_t>(node)].position, 0.0, ground};
  };
  for (const int node : bearings_) {
    sketch.springs.push_back({standsOn(node, 0), at(node), 0.02 * length_});
    boxAt(standsOn(node, below[static_cast<std::size_t>(node)]));
  }
  for (std::size_t i = 0; i < pedestals_.size(); ++i) {
    const SketchPoint place = pedestalAt(i);
    sketch.springs.push_back(
        {standsOn(pedestals_[i].node, pedestals_[i].depth + 1), place, 0.02 * length_});
    boxAt(place);
  }
  sketch.tracer = at(probe_node_);
  sketch.has_tracer = true;
  return sketch;
}

}  // namespace whirl_twin
