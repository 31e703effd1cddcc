#include "display/sketch_drawing.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {
namespace {

constexpr Color kBrass{0.86F, 0.73F, 0.40F};
constexpr Color kForce{0.35F, 0.85F, 1.0F};

constexpr Color kHull{0.55F, 0.85F, 1.0F, 0.35F};
constexpr double kHullWidth = 1.7;  // thickness relative to the enclosed element

constexpr int kWindings = 9;
constexpr int kPointsPerWinding = 14;
constexpr double kMinLength = 1e-6;  // m in the picture, of an element with a direction

class SketchDrawing {
 public:
  /// alike: all in the colour of the masses
  SketchDrawing(double scale, const Color& mass, MarkerCanvas& canvas, bool alike = false)
      : scale_(scale), mass_(mass), alike_(alike), canvas_(canvas) {}

  void draw(const Sketch::Rod& rod) {
    const Eigen::Vector3d from = at(rod.from);
    canvas_.cylinder("rod", from, apart(from, at(rod.to)), scale_ * rod.radius, color(rod.role));
  }
  void draw(const Sketch::Ball& ball) {
    canvas_.sphere("ball", at(ball.at), scale_ * ball.radius, color(ball.role));
  }
  void draw(const Sketch::Box& box) {
    // A positive rotation about y is from z to x.
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(at(box.at)) * Eigen::AngleAxisd(-box.pitch, Eigen::Vector3d::UnitY());
    canvas_.box("box", pose, at(box.size), color(box.role));
  }
  void draw(const Sketch::Disc& disc) {
    const Eigen::Vector3d axis = toVector(disc.axis).normalized();
    const Eigen::Vector3d face = 0.5 * scale_ * disc.thickness * axis;
    const Eigen::Vector3d centre = at(disc.at);
    canvas_.cylinder("disc", centre - face, centre + face, scale_ * disc.radius, color(disc.role));
    const Eigen::Vector3d zero =
        std::abs(axis.z()) > 0.99 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d spoke =
        Eigen::AngleAxisd(disc.angle, axis) * (zero - zero.dot(axis) * axis).normalized();
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d hub = centre + side * (face + 0.004 * axis);
      canvas_.line("spoke", {hub, hub + scale_ * disc.radius * spoke}, 0.01, kMarkColor);
    }
  }
  void draw(const Sketch::Spring& spring) {
    const Eigen::Vector3d from = at(spring.from);
    const double radius = scale_ * spring.radius;
    canvas_.tube("spring", coil(from, apart(from, at(spring.to)), radius), 0.22 * radius, kBrass,
                 6);
  }
  void draw(const Sketch::Damper& damper) {
    const Eigen::Vector3d from = at(damper.from);
    const Eigen::Vector3d to = apart(from, at(damper.to));
    const double radius = scale_ * damper.radius;
    canvas_.cylinder("damper", from, to, 0.3 * radius, kSteelColor);
    canvas_.cylinder("damper", from, from + 10.0 * radius * (to - from).normalized(), radius,
                     kIronColor);
  }
  void draw(const Sketch::Arrow& arrow) {
    canvas_.arrow("arrow", at(arrow.from), at(arrow.to), 0.02, kForce);
  }
  void draw(const Sketch::Line& line) {
    std::vector<Eigen::Vector3d> points;
    for (const SketchPoint& point : line.points) {
      points.push_back(at(point));
    }
    canvas_.line("line", points, 0.004,
                 line.role == SketchRole::kMark ? kFaintColor : color(line.role));
  }

 private:
  Eigen::Vector3d at(const SketchPoint& point) const { return scale_ * toVector(point); }
  // Second end point of an element that needs a direction.
  static Eigen::Vector3d apart(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return (to - from).norm() < kMinLength ? from + kMinLength * Eigen::Vector3d::UnitX() : to;
  }
  Color color(SketchRole role) const {
    if (alike_) {
      return mass_;
    }
    switch (role) {
      case SketchRole::kBody:
        return kSteelColor;
      case SketchRole::kMass:
        return mass_;
      case SketchRole::kSupport:
        return kIronColor;
      case SketchRole::kSpring:
        return kBrass;
      case SketchRole::kMark:
        break;
    }
    return kMarkColor;
  }

  double scale_;
  Color mass_;
  bool alike_;
  MarkerCanvas& canvas_;
};

}  // namespace

std::vector<Eigen::Vector3d> coil(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                  double radius) {
  constexpr double kStraight = 0.08;  // of the length, at either end
  const Eigen::Vector3d way = to - from;
  const Eigen::Vector3d u = way.unitOrthogonal();
  const Eigen::Vector3d v = way.normalized().cross(u);
  std::vector<Eigen::Vector3d> line = {from};
  const int points = kWindings * kPointsPerWinding;
  for (int i = 0; i <= points; ++i) {
    const double s = static_cast<double>(i) / points;
    const double angle = 2.0 * M_PI * kWindings * s;
    // The radius grows over the first and the last half winding, so that the wire has no kink.
    const double open = std::min({1.0, 2.0 * kWindings * s, 2.0 * kWindings * (1.0 - s)});
    line.emplace_back(from + (kStraight + (1.0 - 2.0 * kStraight) * s) * way +
                      open * radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  line.push_back(to);
  return line;
}

void drawHull(const Sketch& sketch, double scale, MarkerCanvas& canvas) {
  Sketch hull;
  const auto moves = [](SketchRole role) { return role != SketchRole::kSupport; };
  for (Sketch::Rod rod : sketch.rods) {
    if (moves(rod.role)) {
      rod.radius *= kHullWidth;
      hull.rods.push_back(rod);
    }
  }
  for (Sketch::Ball ball : sketch.balls) {
    if (moves(ball.role)) {
      ball.radius *= kHullWidth;
      hull.balls.push_back(ball);
    }
  }
  for (Sketch::Box box : sketch.boxes) {
    if (moves(box.role)) {
      const double wider = (kHullWidth - 1.0) * std::min({box.size.x, box.size.y, box.size.z});
      box.size = {box.size.x + wider, box.size.y + wider, box.size.z + wider};
      hull.boxes.push_back(box);
    }
  }
  SketchDrawing drawing(scale, kHull, canvas, true);
  const auto draw = [&drawing](const auto& parts) {
    for (const auto& part : parts) {
      drawing.draw(part);
    }
  };
  draw(hull.rods);
  draw(hull.balls);
  draw(hull.boxes);
}

void drawSketch(const Sketch& sketch, double scale, const Color& mass, MarkerCanvas& canvas) {
  SketchDrawing drawing(scale, mass, canvas);
  const auto draw = [&drawing](const auto& parts) {
    for (const auto& part : parts) {
      drawing.draw(part);
    }
  };
  draw(sketch.boxes);
  draw(sketch.rods);
  draw(sketch.discs);
  draw(sketch.balls);
  draw(sketch.springs);
  draw(sketch.dampers);
  draw(sketch.arrows);
  draw(sketch.lines);
}

}  // namespace whirl_twin
