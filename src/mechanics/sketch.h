// Picture of a system: the bodies, springs and supports at one instant, for displays and pictures.
// Not real-time safe.
//
// Lengths in m. Axes: x to the right, z up, y into the picture; a motion in a vertical plane is in
// x and z, an angle from the hanging vertical turns from -z towards +x. The number of parts of each
// kind is constant during a motion; an arrow of zero length is invisible.
#pragma once

#include <cmath>
#include <vector>

namespace whirl_twin {

struct SketchPoint {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// What a part is, so that every display can colour it in its own way.
enum class SketchRole { kBody, kMass, kSupport, kSpring, kMark };

struct Sketch {
  struct Rod {
    SketchPoint from, to;
    double radius;
    SketchRole role;
  };
  struct Ball {
    SketchPoint at;
    double radius;
    SketchRole role;
  };
  /// A round plate; `angle` [rad] about `axis` turns its mark (a spoke), right-handed, from +z or,
  /// where the axis is z, from +x.
  struct Disc {
    SketchPoint at, axis;
    double radius, thickness, angle;
    SketchRole role;
  };
  /// Centre, full size along its own axes, turned by `pitch` [rad] about y from +x towards +z.
  struct Box {
    SketchPoint at, size;
    double pitch;
    SketchRole role;
  };
  struct Spring {
    SketchPoint from, to;
    double radius;
  };
  struct Damper {
    SketchPoint from, to;
    double radius;
  };
  struct Arrow {  ///< a force or a prescribed motion
    SketchPoint from, to;
  };
  struct Line {  ///< a path, or the ground
    std::vector<SketchPoint> points;
    SketchRole role;
  };

  std::vector<Rod> rods;
  std::vector<Ball> balls;
  std::vector<Disc> discs;
  std::vector<Box> boxes;
  std::vector<Spring> springs;
  std::vector<Damper> dampers;
  std::vector<Arrow> arrows;
  std::vector<Line> lines;
  bool empty() const {
    return rods.empty() && balls.empty() && discs.empty() && boxes.empty() && springs.empty() &&
           lines.empty();
  }

  SketchPoint tracer;  ///< the point whose path a display may draw
  bool has_tracer = false;
  // The whole picture, constant during a motion.
  double size = 1.0;    ///< [m], its width
  double height = 0.0;  ///< [m]; 0: as its width
  SketchPoint centre;
  bool spatial = false;  ///< it leaves the plane x, z: no background board is drawn
};

/// Distance [sizes] from the plane of a plane motion to the board behind it.
constexpr double kBoardDistance = 0.07;

/// The point `length` [m] from another, at an angle [rad] from the hanging vertical.
inline SketchPoint hangingPoint(const SketchPoint& from, double length, double angle) {
  return {from.x + length * std::sin(angle), from.y, from.z - length * std::cos(angle)};
}

/// A fixed pivot: a pin out of the board. To be called once the size is set.
inline void addPin(Sketch& sketch, const SketchPoint& at) {
  const double size = sketch.size;
  sketch.rods.push_back({{at.x, at.y + kBoardDistance * size, at.z},
                         {at.x, at.y - 0.025 * size, at.z},
                         0.016 * size,
                         SketchRole::kSupport});
}

}  // namespace whirl_twin
