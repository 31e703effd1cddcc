#include "plots/sketch_parts.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

constexpr int kWindings = 9;   // of a spring
constexpr double kThin = 1.1;  // px, of outlines

constexpr Ink kSteel{0.70, 0.73, 0.77};
constexpr Ink kIron{0.52, 0.56, 0.61};
constexpr Ink kSpringWire{0.45, 0.36, 0.10};

/// The convex hull of points (A. M. Andrew, 1979).
std::vector<Spot> hull(std::vector<Spot> spots) {
  std::sort(spots.begin(), spots.end(),
            [](const Spot& a, const Spot& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Spot> outline;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = outline.size();
    for (const Spot& spot : spots) {
      while (outline.size() >= start + 2) {
        const Spot& a = outline[outline.size() - 2];
        const Spot& b = outline.back();
        if ((b.x - a.x) * (spot.y - a.y) - (b.y - a.y) * (spot.x - a.x) > 0.0) {
          break;
        }
        outline.pop_back();
      }
      outline.push_back(spot);
    }
    outline.pop_back();
    std::reverse(spots.begin(), spots.end());
  }
  return outline;
}

class PartDrawing {
 public:
  PartDrawing(const SketchView& view, double pale, Canvas& canvas)
      : view_(view), pale_(pale), canvas_(canvas) {}

  void drawOutline(const Sketch::Rod& rod) const {
    barOutline(view_.at(rod.from), view_.at(rod.to), pixels(rod.radius), color(rod.role));
  }
  void draw(const Sketch::Rod& rod) const {
    barFilling(view_.at(rod.from), view_.at(rod.to), pixels(rod.radius), color(rod.role));
  }
  void draw(const Sketch::Ball& ball) const {
    const Spot centre = view_.at(ball.at);
    const double radius = pixels(ball.radius);
    const Ink ink = color(ball.role);
    canvas_.circle(centre, radius, ink, outline(ink));
    const Ink light = paler(ink, 0.55);
    canvas_.circle({centre.x - 0.3 * radius, centre.y - 0.3 * radius}, 0.22 * radius, light,
                   {light, 0.1});
  }
  void draw(const Sketch::Disc& disc) const {
    const DiscAxes axes = axesOf(disc);
    const double towards_eye =
        view_.depth(sum(disc.at, 1.0, axes.axis)) < view_.depth(disc.at) ? 0.5 : -0.5;
    std::vector<Spot> near, both;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = kTwoPi * i / kCorners;
      near.push_back(view_.at(onRim(disc, axes, angle, towards_eye * disc.thickness)));
      both.push_back(near.back());
      both.push_back(view_.at(onRim(disc, axes, angle, -towards_eye * disc.thickness)));
    }
    const Ink ink = color(disc.role);
    canvas_.polygon(hull(both), darker(ink, 0.2), outline(ink));
    canvas_.polygon(near, ink, outline(ink));
    canvas_.line({view_.at(sum(disc.at, towards_eye * disc.thickness, axes.axis)),
                  view_.at(onRim(disc, axes, disc.angle, towards_eye * disc.thickness))},
                 {paler(ink::kVermilion, pale_), 2.5});
  }
  void draw(const Sketch::Box& box) const {
    const SketchPoint along{std::cos(box.pitch), 0.0, std::sin(box.pitch)};
    const SketchPoint across{-std::sin(box.pitch), 0.0, std::cos(box.pitch)};
    const SketchPoint inwards{0.0, 1.0, 0.0};
    const Ink ink = color(box.role);
    const auto face = [&](const SketchPoint& normal, double half, const SketchPoint& u,
                          double half_u, const SketchPoint& v, double half_v, double shade) {
      const bool seen = view_.depth(normal) < 0.0;
      const SketchPoint centre = sum(box.at, seen ? half : -half, normal);
      std::vector<Spot> corners;
      for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        corners.push_back(view_.at(sum(sum(centre, a * half_u, u), b * half_v, v)));
      }
      canvas_.polygon(corners, shade < 0.0 ? paler(ink, -shade) : darker(ink, shade), outline(ink));
    };
    const double x = 0.5 * box.size.x, y = 0.5 * box.size.y, z = 0.5 * box.size.z;
    face(across, z, along, x, inwards, y, -0.25);
    face(along, x, across, z, inwards, y, 0.15);
    face(inwards, y, along, x, across, z, 0.0);
  }
  void draw(const Sketch::Spring& spring) const {
    constexpr double kStraight = 0.08;  // of the length, at either end
    const Spot from = view_.at(spring.from);
    const Spot to = view_.at(spring.to);
    const double length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-3);
    const Spot along{(to.x - from.x) / length, (to.y - from.y) / length};
    const double radius = pixels(spring.radius);
    std::vector<Spot> wire{from};
    constexpr int kPoints = 12 * kWindings;
    for (int i = 0; i <= kPoints; ++i) {
      const double s = static_cast<double>(i) / kPoints;
      const double way = (kStraight + (1.0 - 2.0 * kStraight) * s) * length;
      const double out = radius * std::sin(kTwoPi * kWindings * s);
      wire.push_back(
          {from.x + way * along.x - out * along.y, from.y + way * along.y + out * along.x});
    }
    wire.push_back(to);
    canvas_.line(wire, {paler(kSpringWire, pale_), std::clamp(0.2 * radius, 1.3, 3.5)});
  }
  void draw(const Sketch::Damper& damper) const {
    const Spot from = view_.at(damper.from);
    const Spot to = view_.at(damper.to);
    const double length = std::max(std::hypot(to.x - from.x, to.y - from.y), 1e-3);
    const double radius = pixels(damper.radius);
    const double pot = std::min(0.5, 10.0 * radius / length);
    bar(from, to, 0.3 * radius, color(SketchRole::kBody));
    bar(from, {from.x + pot * (to.x - from.x), from.y + pot * (to.y - from.y)}, radius,
        color(SketchRole::kSupport));
  }
  void draw(const Sketch::Arrow& arrow) const {
    const Spot from = view_.at(arrow.from);
    const Spot to = view_.at(arrow.to);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length < 1.0) {
      return;
    }
    const Ink ink = paler(ink::kBlue, pale_);
    const double head = std::min(12.0, 0.6 * length);
    const Spot u{(to.x - from.x) / length, (to.y - from.y) / length};
    const Spot neck{to.x - head * u.x, to.y - head * u.y};
    canvas_.line({from, neck}, {ink, 3.0});
    canvas_.polygon({to,
                     {neck.x - 0.45 * head * u.y, neck.y + 0.45 * head * u.x},
                     {neck.x + 0.45 * head * u.y, neck.y - 0.45 * head * u.x}},
                    ink, {ink, 1.0});
  }
  void draw(const Sketch::Line& line) const {
    std::vector<Spot> spots;
    for (const SketchPoint& point : line.points) {
      spots.push_back(view_.at(point));
    }
    if (line.role == SketchRole::kMark) {
      canvas_.line(spots, {paler(ink::kGrey, std::max(pale_, 0.3)), 1.2, {6.0, 4.0}});
    } else {
      canvas_.line(spots, {darker(color(line.role), 0.2), 2.5});
    }
  }

 private:
  double pixels(double length) const { return view_.scale * length; }
  Pen outline(const Ink& ink) const { return {darker(ink, 0.45 * (1.0 - pale_)), kThin}; }
  Ink color(SketchRole role) const {
    switch (role) {
      case SketchRole::kBody:
        return paler(kSteel, pale_);
      case SketchRole::kMass:
        return paler(ink::kBlue, pale_);
      case SketchRole::kSupport:
        return paler(kIron, pale_);
      case SketchRole::kSpring:
        return paler(kSpringWire, pale_);
      case SketchRole::kMark:
        break;
    }
    return paler(ink::kGrey, pale_);
  }
  /// A round bar, seen from the side or, where it is short, from its end.
  void bar(const Spot& from, const Spot& to, double radius, const Ink& ink) const {
    barOutline(from, to, radius, ink);
    barFilling(from, to, radius, ink);
  }
  void barOutline(const Spot& from, const Spot& to, double radius, const Ink& ink) const {
    canvas_.line({from, to}, {outline(ink).ink, barWidth(radius) + 2.0 * kThin});
  }
  void barFilling(const Spot& from, const Spot& to, double radius, const Ink& ink) const {
    canvas_.line({from, to}, {ink, barWidth(radius)});
  }
  static double barWidth(double radius) { return std::max(2.0 * radius, 2.2); }

  const SketchView& view_;
  double pale_;
  Canvas& canvas_;
};

SketchPoint middle(const SketchPoint& a, const SketchPoint& b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
}
SketchPoint placeOf(const Sketch::Ball& part) {
  return part.at;
}
SketchPoint placeOf(const Sketch::Disc& part) {
  return part.at;
}
SketchPoint placeOf(const Sketch::Box& part) {
  return part.at;
}
template <class Part>
SketchPoint placeOf(const Part& part) {
  return middle(part.from, part.to);
}

}  // namespace

void drawParts(const Sketch& sketch, const SketchView& view, double pale, Canvas& canvas) {
  const PartDrawing drawing(view, pale, canvas);
  for (const Sketch::Line& line : sketch.lines) {
    drawing.draw(line);
  }
  struct Placed {
    double depth;
    std::function<void()> draw;
  };
  std::vector<Placed> parts;
  const auto add = [&](const auto& all) {
    for (const auto& part : all) {
      parts.push_back({view.depth(placeOf(part)), [&drawing, &part] { drawing.draw(part); }});
    }
  };
  add(sketch.boxes);
  // Rods at one depth share an outline: a beam of many rods appears as one piece.
  for (const Sketch::Rod& rod : sketch.rods) {
    parts.push_back({view.depth(placeOf(rod)), [&drawing, &rod] { drawing.drawOutline(rod); }});
  }
  add(sketch.rods);
  add(sketch.discs);
  add(sketch.dampers);
  add(sketch.springs);
  add(sketch.balls);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Placed& a, const Placed& b) { return a.depth > b.depth; });
  for (const Placed& part : parts) {
    part.draw();
  }
  for (const Sketch::Arrow& arrow : sketch.arrows) {
    drawing.draw(arrow);
  }
}

}  // namespace whirl_twin
