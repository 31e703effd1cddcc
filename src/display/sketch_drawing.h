// Draws a model's sketch as markers: rods, masses, supports, coils, dampers, discs with a spoke,
// arrows.
#pragma once

#include <Eigen/Core>

#include "display/marker_canvas.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

inline Eigen::Vector3d toVector(const SketchPoint& p) {
  return {p.x, p.y, p.z};
}

/// Everything but the tracer, in the sketch's axes.
/// @param scale [-], metres in the picture per metre of the machine
/// @param mass colour of the masses
void drawSketch(const Sketch& sketch, double scale, const Color& mass, MarkerCanvas& canvas);

/// The moving elements of a sketch, as a pale hull about the same sketch drawn in full: the
/// measured position. Without supports, forces and paths.
void drawHull(const Sketch& sketch, double scale, MarkerCanvas& canvas);

/// Windings of a spring between its ends, straight for a short way at either; [m].
std::vector<Eigen::Vector3d> coil(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                  double radius);

}  // namespace whirl_twin
