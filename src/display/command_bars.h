// What controllers give: of each output that acts on a system a bar from the middle of its scale,
// whose ends are what the actuator can give, or the largest output so far; red while it can give no
// more. Above them, how far their loop is from instability.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "display/marker_canvas.h"
#include "whirl_twin/ControllerMargins.h"
#include "whirl_twin/ControllerState.h"

namespace whirl_twin {

/// An output of a controller, as it acts.
struct Command {
  std::string input;  ///< "force_x", of the system
  std::string unit;   ///< of what follows
  double value = 0.0;
  double end = 1.0;       ///< > 0, of its scale
  bool at_limit = false;  ///< the actuator gives no more
};

/// A controller as it was told last.
class LiveController {
 public:
  /// limit: of its actuators, in the unit of its outputs; infinite: there is none, or nobody knows
  void take(const ControllerState& state, double limit);
  void take(const ControllerMargins::ConstPtr& margins) { margins_ = margins; }

  /// Those of its outputs that act on a system.
  std::vector<Command> commandsOn(const std::string& system) const;
  /// "sensitivity 2.31, zone A; 12 % saturated"; "": not told.
  std::string loopText() const;

 private:
  ControllerState state_;
  ControllerMargins::ConstPtr margins_;
  double limit_ = std::numeric_limits<double>::infinity();
  std::vector<double> largest_;  // of each output so far
};

/// "force_x 0.83 of 5 N"
std::string commandText(const Command& command);

/// Draws them upwards from a height y [m] of the board; of no commands it takes all away.
/// @param loops a line each  @param compact larger, without words
/// @return [m], how high they reach
double drawCommands(const std::vector<Command>& commands, const std::vector<std::string>& loops,
                    bool compact, double y, MarkerCanvas& board);

}  // namespace whirl_twin
