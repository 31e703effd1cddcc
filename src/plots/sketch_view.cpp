#include "plots/sketch_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

double dot(const SketchPoint& a, const SketchPoint& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
SketchPoint cross(const SketchPoint& a, const SketchPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SketchPoint unit(const SketchPoint& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace

SketchPoint sum(const SketchPoint& a, double factor, const SketchPoint& b) {
  return {a.x + factor * b.x, a.y + factor * b.y, a.z + factor * b.z};
}
DiscAxes axesOf(const Sketch::Disc& disc) {
  const SketchPoint axis = unit(disc.axis);
  const SketchPoint up =
      std::fabs(axis.z) > 0.99 ? SketchPoint{1.0, 0.0, 0.0} : SketchPoint{0.0, 0.0, 1.0};
  const SketchPoint zero = unit(sum(up, -dot(up, axis), axis));
  return {axis, zero, cross(axis, zero)};
}
SketchPoint onRim(const Sketch::Disc& disc, const DiscAxes& axes, double angle, double along) {
  const SketchPoint centre = sum(disc.at, along, axes.axis);
  return sum(sum(centre, disc.radius * std::cos(angle), axes.zero), disc.radius * std::sin(angle),
             axes.side);
}

Spot SketchView::at(const SketchPoint& p) const {
  const double right = p.x * std::cos(turned) + p.y * std::sin(turned);
  const double away = p.y * std::cos(turned) - p.x * std::sin(turned);
  const double up = p.z * std::cos(raised) + away * std::sin(raised);
  return {origin.x + scale * right, origin.y - scale * up};
}

double SketchView::depth(const SketchPoint& p) const {
  const double away = p.y * std::cos(turned) - p.x * std::sin(turned);
  return away * std::cos(raised) - p.z * std::sin(raised);
}

SketchBounds boundsOf(const Sketch& sketch, const SketchView& view) {
  const double infinity = std::numeric_limits<double>::infinity();
  SketchBounds bounds{infinity, infinity, -infinity, -infinity};
  const auto include = [&](const SketchPoint& point, double radius) {
    const Spot spot = view.at(point);
    const double room = view.scale * radius;
    bounds = {std::min(bounds.left, spot.x - room), std::min(bounds.top, spot.y - room),
              std::max(bounds.right, spot.x + room), std::max(bounds.bottom, spot.y + room)};
  };
  const auto includeEnds = [&](const auto& parts) {
    for (const auto& part : parts) {
      include(part.from, part.radius);
      include(part.to, part.radius);
    }
  };
  includeEnds(sketch.rods);
  includeEnds(sketch.springs);
  includeEnds(sketch.dampers);
  for (const Sketch::Arrow& arrow : sketch.arrows) {
    include(arrow.from, 0.0);
    include(arrow.to, 0.0);
  }
  for (const Sketch::Ball& ball : sketch.balls) {
    include(ball.at, ball.radius);
  }
  for (const Sketch::Disc& disc : sketch.discs) {
    const DiscAxes axes = axesOf(disc);
    for (int i = 0; i < kCorners; ++i) {
      include(onRim(disc, axes, kTwoPi * i / kCorners, 0.5 * disc.thickness), 0.0);
      include(onRim(disc, axes, kTwoPi * i / kCorners, -0.5 * disc.thickness), 0.0);
    }
  }
  for (const Sketch::Box& box : sketch.boxes) {
    const double c = std::cos(box.pitch), s = std::sin(box.pitch);
    for (int corner = 0; corner < 8; ++corner) {
      const double u = (corner & 1) != 0 ? 0.5 * box.size.x : -0.5 * box.size.x;
      const double v = (corner & 2) != 0 ? 0.5 * box.size.y : -0.5 * box.size.y;
      const double w = (corner & 4) != 0 ? 0.5 * box.size.z : -0.5 * box.size.z;
      include({box.at.x + c * u - s * w, box.at.y + v, box.at.z + s * u + c * w}, 0.0);
    }
  }
  for (const Sketch::Line& line : sketch.lines) {
    for (const SketchPoint& point : line.points) {
      include(point, 0.0);
    }
  }
  return bounds;
}

}  // namespace whirl_twin
