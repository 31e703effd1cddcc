// A pendulum as a picture: bracket, vertical axis, rods and bobs, the trail of the last bob, its
// angles, margins and alerts in words. A system whose coordinates are not those of a pendulum is
// described in words alone.
//
// Pendulum axes (see pendulum_geometry.h) lie in the world with x = world y, so that a swing at
// plane angle 0 is seen broadside from the front (world x), positive angles to the right.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "nodes/pendulum_geometry.h"
#include "nodes/system_display.h"

namespace whirl_twin {

class PendulumDisplay : public SystemDisplay {
 public:
  static constexpr double kTrailTime = 2.0;               ///< [s], simulated
  static constexpr double kTrailStep = kTrailTime / 400;  ///< [s] between points of the trail

  /// @param name of the system
  explicit PendulumDisplay(std::string name);

  void setGeometry(const PendulumGeometry& geometry) { geometry_ = geometry; }
  const PendulumGeometry& geometry() const { return geometry_; }

  /// Takes the next state; cheap enough for every step of the twin.
  /// @param drive the state of the geometry's drive; null without one
  void update(const PendulumState& state, const DriveState* drive);

  Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const override;
  void draw(const SystemStatus& status, MarkerCanvas& canvas) const override;
  std::string bodyName() const override { return "bob"; }
  Eigen::Isometry3d bodyPose() const override;

 private:
  struct TrailPoint {
    double time;               // s, simulated
    Eigen::Vector3d position;  // m, unscaled
  };

  double pictureScale() const;
  void drawBracket(MarkerCanvas& canvas) const;
  void drawPendulum(const Color& color, MarkerCanvas& canvas) const;

  std::string name_;
  PendulumGeometry geometry_;
  PendulumState state_;
  double shaft_speed_ = 0.0;  // rad/s
  double plane_angle_ = 0.0;  // rad
  std::vector<Eigen::Vector3d> joints_;
  std::deque<TrailPoint> trail_;
};

}  // namespace whirl_twin
