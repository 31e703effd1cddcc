// Draws one system of the twin as rviz markers: shapes are given in the system's own axes [m] and
// transformed to the world frame by the system's pose.
//
// Markers keep their namespace "<system>/<part>" and a number counted within the part, so every
// frame replaces the previous one in place. Their stamp is 0, which rviz interprets as "at the
// latest transform".
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

namespace whirl_twin {

struct Color {
  float r, g, b;
  float a = 1.0F;
};

// Colours used by several pictures.
inline constexpr Color kSteelColor{0.66F, 0.69F, 0.73F};
inline constexpr Color kIronColor{0.48F, 0.52F, 0.58F};
inline constexpr Color kBaseColor{0.75F, 0.80F, 0.88F};
inline constexpr Color kCalmDiscColor{0.30F, 0.62F, 0.52F};
inline constexpr Color kMarkColor{1.0F, 0.93F, 0.45F};
inline constexpr Color kFaintColor{0.80F, 0.83F, 0.87F, 0.55F};  ///< thin lines
inline constexpr Color kTrackColor{0.34F, 0.38F, 0.43F};         ///< track of a bar
inline constexpr Color kWordsColor{0.90F, 0.92F, 0.94F};

class MarkerCanvas {
 public:
  static constexpr const char* kWorldFrame = "world";

  /// @param markers receives the markers
  /// @param world_from_system pose of the system's axes in the world
  MarkerCanvas(visualization_msgs::MarkerArray& markers, std::string system,
               const Eigen::Isometry3d& world_from_system);

  /// Canvas of the same system with other axes: at a point in the system's axes, rotated in the
  /// world.
  MarkerCanvas turned(const Eigen::Vector3d& at, const Eigen::Matrix3d& world_axes) const;

  /// Canvas of the same system with the axes of a pose in its axes.
  MarkerCanvas moved(const Eigen::Isometry3d& pose) const;

  /// Another picture of the same system, in the same axes: its parts are "<name>/<part>".
  /// @param lifetime [s], after which markers that are not redrawn disappear
  MarkerCanvas beside(const std::string& name, double lifetime) const;

  /// Removes the next marker of the part, and keeps its number.
  void gone(const std::string& part);

  /// Round bar between the centres of its two ends; radius [m].
  void cylinder(const std::string& part, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                double radius, const Color& color);

  /// @param radius [m]
  void sphere(const std::string& part, const Eigen::Vector3d& centre, double radius,
              const Color& color);

  /// Box with the given pose in the system's axes; size [m] along its own axes.
  void box(const std::string& part, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
           const Color& color);

  /// Arrow; `width` [m] of its shaft. One too short for its head is removed.
  void arrow(const std::string& part, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             double width, const Color& color);

  /// Polyline; width [m]. With `fading` its beginning is transparent, its end opaque.
  void line(const std::string& part, const std::vector<Eigen::Vector3d>& points, double width,
            const Color& color, bool fading = false);

  /// Round tube along a smooth centre line of at least two points; radius [m].
  /// @param sides of its cross-section
  void tube(const std::string& part, const std::vector<Eigen::Vector3d>& centre_line, double radius,
            const Color& color, int sides = 14);

  /// Lines of text, left-aligned, facing the viewer; the block is centred on `centre`.
  /// @param height [m] of a line. An empty text removes the marker.
  void text(const std::string& part, const Eigen::Vector3d& centre, double height,
            const std::string& lines, const Color& color);

 private:
  visualization_msgs::Marker& add(const std::string& part, int type, const Eigen::Isometry3d& pose,
                                  const Eigen::Vector3d& scale, const Color& color);

  visualization_msgs::MarkerArray& markers_;
  std::string system_;
  Eigen::Isometry3d world_from_system_;
  double lifetime_ = 0.0;  // [s]; 0: for ever
  std::map<std::string, int> next_id_;
};

/// Removes every marker from the display, before a new layout of the systems.
visualization_msgs::Marker deleteAllMarkers();

}  // namespace whirl_twin
