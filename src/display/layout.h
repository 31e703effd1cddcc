// Layout of the systems in the 3-D view, without overlap: on shelves in a vertical plane that faces
// the camera of config/rviz/demo.rviz, with a column for the status of the twin as a whole on their
// right; and the camera distance that this needs.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace whirl_twin {

/// The camera of config/rviz/demo.rviz: its focal point is the tf frame `twin_view`, at this
/// distance and from this direction, so the pose of that frame determines the view.
struct ViewedFrom {
  static constexpr const char* kFrame = "twin_view";
  static constexpr double kDistance = 4.0;    ///< [m]
  static constexpr double kYaw = 5.52;        ///< [rad]
  static constexpr double kPitch = 0.26;      ///< [rad]
  static constexpr double kAngle = 0.785398;  ///< [rad], of the view, upright
  static constexpr double kAspect = 1.85;     ///< [-], smallest ratio of width to height of its
                                              ///< window
};

/// Unit vector from the camera's focal point to the camera.
Eigen::Vector3d towardsViewer();

/// Axes of a board that faces the viewer: x to the right, y upwards (world z), z out of it.
Eigen::Matrix3d boardAxes();

struct Layout {
  bool compact = false;                 ///< many systems: less text for each
  double cell_width = 0.0;              ///< [m], of a place, across the view
  double cell_height = 0.0;             ///< [m], upwards
  std::vector<Eigen::Vector3d> places;  ///< [m], position of each, starting at the top left
  Eigen::Vector3d column;               ///< [m], lower edge of the column, its middle
  double column_width = 0.0;            ///< [m]
  Eigen::Vector3d view;                 ///< [m], position of the camera frame
};

Layout layoutOf(std::size_t systems);

}  // namespace whirl_twin
