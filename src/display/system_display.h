// Interface of the picture of one system. A new kind of system is a new class beside RotorDisplay
// and MechanismDisplay.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "display/instrument_panel.h"
#include "display/marker_canvas.h"
#include "display/vibration_limits.h"
#include "whirl_twin/Alert.h"
#include "whirl_twin/ControllerMargins.h"
#include "whirl_twin/ControllerState.h"
#include "whirl_twin/FollowState.h"
#include "whirl_twin/OrderState.h"

namespace whirl_twin {

// Outputs of controllers: for each output that acts on a system a bar from the middle of its scale,
// whose ends are the actuator limit, or the largest output so far; red in saturation. Above them,
// the distance of their loop from instability.

/// An output of a controller, after its actuator.
struct Command {
  std::string input;  ///< "force_x", of the system
  std::string unit;   ///< of what follows
  double value = 0.0;
  double end = 1.0;       ///< > 0, end of its scale
  bool at_limit = false;  ///< the actuator gives no more
};

/// The last received state of a controller.
class LiveController {
 public:
  /// limit: of its actuators, in the unit of its outputs; infinite: none, or unknown
  void take(const ControllerState& state, double limit);
  void take(const ControllerMargins::ConstPtr& margins) { margins_ = margins; }

  /// Its outputs that act on a system.
  std::vector<Command> commandsOn(const std::string& system) const;
  /// "sensitivity 2.31, zone A; 12 % saturated"; "": no data.
  std::string loopText() const;

 private:
  ControllerState state_;
  ControllerMargins::ConstPtr margins_;
  double limit_ = std::numeric_limits<double>::infinity();
  std::vector<double> largest_;  // of each output so far
};

/// "force_x 0.83 of 5 N"
std::string commandText(const Command& command);

/// Draws them upwards from a height y [m] of the board; without commands it removes them.
/// @param loops a line each  @param compact larger, without text
/// @return [m], their height
double drawCommands(const std::vector<Command>& commands, const std::vector<std::string>& loops,
                    bool compact, double y, MarkerCanvas& board);

/// Present status of a system, in addition to its state.
struct SystemStatus {
  LiveMargin live;
  OrderState::ConstPtr orders;  ///< of a rotor, null before the first
  double vibration = std::numeric_limits<double>::quiet_NaN();  ///< [m], of a rotor
  FollowState::ConstPtr follow;                                 ///< of a state estimator, else null
  std::vector<Alert> alerts;                                    ///< active, most severe first
  std::vector<VibrationLimit> limits;                           ///< of a rotor
  std::map<std::string, std::vector<VibrationLimit>> further_limits;  ///< of its further stations
  std::vector<Command> commands;   ///< of controllers that act on it
  std::vector<std::string> loops;  ///< distance of their loops from instability
  bool compact = false;            ///< little space: its name, instruments, one alert
};

class SystemDisplay {
 public:
  virtual ~SystemDisplay() = default;

  /// Pose of the system's axes in the world (REP 103: z up) when its position is `place` [m].
  virtual Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const = 0;

  /// Draws everything, in the system's axes.
  virtual void draw(const SystemStatus& status, MarkerCanvas& canvas) const = 0;

  /// Name of the moving part; prefixed by the system's name, the name of its tf frame.
  virtual std::string bodyName() const = 0;

  /// Pose of the drawn body, in the system's axes.
  virtual Eigen::Isometry3d bodyPose() const = 0;
};

/// Colour of the highest severity among the alerts, `calm` when there is none.
Color severityColor(const std::vector<Alert>& alerts, const Color& calm);

/// Colour of an alert's severity.
Color severityColor(int severity);

/// Draws the instruments on a board that faces the viewer and, above them, writes the lines, the
/// state estimator's results, the headline and the active alerts; if compact, the headline with the
/// speed and the first alert's type.
/// @param speed [rad/s], of the shaft; NaN without one
/// @param foot [m], lower edge of the board, in the system's axes
void drawStatus(const std::string& headline, const std::vector<std::string>& lines, double speed,
                const SystemStatus& status, const Eigen::Vector3d& foot, MarkerCanvas& canvas);

/// Stacks blocks of text upwards on a board. rviz spaces lines by their height and 0.01 m; blocks
/// are a third of a line apart.
class TextStack {
 public:
  /// @param foot [m], lower edge of the first, in the axes of the board
  TextStack(const Eigen::Vector3d& foot, MarkerCanvas& board) : foot_(foot), board_(board) {}

  /// @param height [m], of a line. Without lines the marker is removed.
  void add(const std::string& part, const std::vector<std::string>& lines, double height,
           const Color& color);

 private:
  Eigen::Vector3d foot_;
  MarkerCanvas& board_;
};

}  // namespace whirl_twin
