#include "models/flexible_rotor_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

FlexibleRotorPicture::FlexibleRotorPicture(const FlexibleShaft& shaft,
                                           std::vector<Station> stations, int probe_node)
    : stations_(std::move(stations)), probe_node_(probe_node) {
  length_ = stations_.back().position;
  double widest = 0.0;
  for (const ShaftSection& element : shaft.elements) {
    radii_.push_back(0.5 * element.outer_diameter);
    widest = std::max(widest, radii_.back());
  }
  for (const RotorDisc& disc : shaft.discs) {
    if (disc.mass > 0.0 && disc.polar_inertia > 0.0) {
      // A solid cylinder of these inertias: I_p = m r^2 / 2, I_d = m (3 r^2 + h^2) / 12.
      const double radius = std::sqrt(2.0 * disc.polar_inertia / disc.mass);
      const double thickness = std::sqrt(
          std::max(0.0, 12.0 * disc.transverse_inertia / disc.mass - 3.0 * radius * radius));
      discs_.push_back({disc.node, std::min(radius, 0.5 * length_),
                        std::clamp(thickness, 0.01 * length_, 0.1 * length_)});
      widest = std::max(widest, discs_.back().radius);
    }
  }
  for (const RotorBearing& bearing : shaft.bearings) {
    bearings_.push_back(bearing.node);
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    bearings_.push_back(bearing.node);
  }
  height_ = std::max(0.3 * length_, 2.4 * widest);
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
  for (std::size_t i = 0; i < radii_.size(); ++i) {
    const int node = static_cast<int>(i);
    sketch.rods.push_back({at(node), at(node + 1), radii_[i], SketchRole::kBody});
  }
  const int last = static_cast<int>(radii_.size());
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
  for (const int node : bearings_) {
    const SketchPoint journal = at(node);
    const double ground = -0.45 * height_;
    sketch.springs.push_back({{journal.x, 0.0, ground}, journal, 0.02 * length_});
    sketch.boxes.push_back({{journal.x, 0.0, ground},
                            {0.06 * length_, 0.06 * length_, 0.02 * length_},
                            0.0,
                            SketchRole::kSupport});
  }
  sketch.tracer = at(probe_node_);
  sketch.has_tracer = true;
  return sketch;
}

}  // namespace whirl_twin
