// Where systems stand so that a viewer sees them all at once, none before another: on shelves in
// an upright plane that faces the camera of config/rviz/demo.rviz, with a column for what is said
// of the twin as a whole at their right; and how far back the camera has to stand for it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace whirl_twin {

/// The camera of config/rviz/demo.rviz: it looks at the tf frame `twin_view` from this far and this
/// direction, so that where that frame is decides what it sees.
struct ViewedFrom {
  static constexpr const char* kFrame = "twin_view";
  static constexpr double kDistance = 4.0;    ///< [m]
  static constexpr double kYaw = 5.52;        ///< [rad]
  static constexpr double kPitch = 0.26;      ///< [rad]
  static constexpr double kAngle = 0.785398;  ///< [rad], of the view, upright
  static constexpr double kAspect = 1.85;     ///< [-], width by height, of its window at least
};

/// From what the viewer looks at to the camera, a unit vector.
Eigen::Vector3d towardsViewer();

/// Axes of a board that faces the viewer: x to the right, y upwards (world z), z out of it.
Eigen::Matrix3d boardAxes();

struct Layout {
  bool compact = false;                 ///< there are many: less is said of each
  double cell_width = 0.0;              ///< [m], of a place, across the view
  double cell_height = 0.0;             ///< [m], upwards
  std::vector<Eigen::Vector3d> places;  ///< [m], where each stands, from top left on
  Eigen::Vector3d column;               ///< [m], lower edge of the column, its middle
  double column_width = 0.0;            ///< [m]
  Eigen::Vector3d view;                 ///< [m], where the frame of the camera has to be
};

Layout layoutOf(std::size_t systems);

}  // namespace whirl_twin
