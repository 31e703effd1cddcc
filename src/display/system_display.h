// The picture of one system: what every display of a kind of system has to offer. A new kind of
// system is a new class beside RotorDisplay and MechanismDisplay.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "display/marker_canvas.h"
#include "whirl_twin/Alert.h"
#include "whirl_twin/OrderState.h"
#include "whirl_twin/StabilityMargin.h"

namespace whirl_twin {

/// What is known of a system at the moment, beside its state.
struct SystemStatus {
  StabilityMargin::ConstPtr margin;  ///< null before the first
  OrderState::ConstPtr orders;       ///< of a rotor, likewise
  std::vector<Alert> alerts;         ///< active, most severe first
};

class SystemDisplay {
 public:
  virtual ~SystemDisplay() = default;

  /// Pose of the system's axes in the world (REP 103: z up) when it stands at `place` [m].
  virtual Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const = 0;

  /// Draws everything, in the system's axes.
  virtual void draw(const SystemStatus& status, MarkerCanvas& canvas) const = 0;

  /// Name of the part that moves; with the system's name before it, the name of its tf frame.
  virtual std::string bodyName() const = 0;

  /// Where that part is drawn, in the system's axes.
  virtual Eigen::Isometry3d bodyPose() const = 0;
};

/// Distance between neighbouring systems in the world [m], along y.
constexpr double kPlaceWidth = 1.4;

/// How far each stands before its left neighbour, per distance along y: so the row faces a viewer
/// who looks at the shafts from the front and somewhat from the side.
constexpr double kEchelon = 0.9;

/// Where so many systems stand on the ground, from left to right about the origin [m].
std::vector<Eigen::Vector3d> sideBySide(std::size_t places);

/// Colour of the highest severity among the alerts, `calm` when there is none.
Color severityColor(const std::vector<Alert>& alerts, const Color& calm);

/// Colour of an alert's severity.
Color severityColor(int severity);

/// Writes the headline, the lines and, above them, the active alerts.
/// @param foot [m], lower edge of the writing, in the system's axes
/// @param up unit vector upwards in the system's axes
void drawStatus(const std::string& headline, const std::vector<std::string>& lines,
                const std::vector<Alert>& alerts, const Eigen::Vector3d& foot,
                const Eigen::Vector3d& up, MarkerCanvas& canvas);

}  // namespace whirl_twin
