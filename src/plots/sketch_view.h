// View of a sketch: a parallel projection of its points on the plane of a picture.
#pragma once

#include "mechanics/sketch.h"
#include "plots/canvas.h"

namespace whirl_twin {

/// Looking along y, raised and turned about the vertical.
struct SketchView {
  double raised = 0.0;  ///< [rad], of the eye above the horizontal
  double turned = 0.0;  ///< [rad], of the eye to the left
  double scale = 1.0;   ///< [px/m]
  Spot origin;          ///< [px], where (0, 0, 0) is seen

  Spot at(const SketchPoint& point) const;
  /// Away from the eye [m].
  double depth(const SketchPoint& point) const;
};

/// a + factor b.
SketchPoint sum(const SketchPoint& a, double factor, const SketchPoint& b);

/// A disc's own axes: its axis, the direction of the zero of its angle, and the third.
struct DiscAxes {
  SketchPoint axis, zero, side;
};
DiscAxes axesOf(const Sketch::Disc& disc);
/// A point of its rim at an angle [rad] from its zero, `along` [m] its axis from the centre.
SketchPoint onRim(const Sketch::Disc& disc, const DiscAxes& axes, double angle, double along);
constexpr int kCorners = 60;  ///< of a circle

/// A rectangle [px] around all parts of a sketch.
struct SketchBounds {
  double left, top, right, bottom;
};
SketchBounds boundsOf(const Sketch& sketch, const SketchView& view);

}  // namespace whirl_twin
