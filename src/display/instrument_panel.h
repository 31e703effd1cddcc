// Two instruments on a board above each system: its damping, on a scale with the edge of stability
// and the level below which the monitor warns, and its speed, on a scale with the barred speed
// ranges. Without a live verdict they show only the speed; where the monitor requires no damping
// the first shows only instability.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display/marker_canvas.h"
#include "whirl_twin/StabilityMargin.h"

namespace whirl_twin {

/// A stability verdict and its status.
struct LiveMargin {
  StabilityMargin::ConstPtr margin;                       ///< null: no live verdict
  double age = std::numeric_limits<double>::quiet_NaN();  ///< [s], wall time; NaN: unknown
  std::string why_not;                                    ///< reason for the absence of a live
                                                          ///< verdict
  double least_decrement = 0.1;   ///< [-], log decrement below which the monitor warns; 0: no limit
  double least_decay_rate = 0.0;  ///< [1/s], decay rate, likewise
};

/// Whether a verdict is still live.
/// @param margin the latest; null: none yet  @param since_heard [s], wall time since it came
/// @param held the simulation is paused: the verdict stays live during the pause, without an age
/// @param silence of the monitor; "" without a timeout
LiveMargin liveMargin(const StabilityMargin::ConstPtr& margin, double since_heard, bool held,
                      const std::string& silence);

/// Shaft speeds [rad/s], from and to.
using SpeedRange = std::pair<double, double>;

/// Scale of shaft speeds.
struct SpeedScale {
  double end = 1.0;                  ///< [rad/s], a round number; it starts at 0
  std::vector<SpeedRange> avoid;     ///< around critical speeds, ascending, within the scale
  std::vector<SpeedRange> unstable;  ///< likewise
};
/// Scale that includes the speed, the next band above it and the next threshold. @param margin may
/// be null
SpeedScale speedScale(double speed, const StabilityMargin* margin);
/// "0 to 100 rad/s: avoid 48.1 to 70.7, unstable above 80"
std::string scaleText(const SpeedScale& scale);

/// A margin on its scale from 0, unstable, to 1, and the level below which LOW_DAMPING is raised.
struct MarginScale {
  double place = 0.0;
  double required = kEdge;  ///< kEdge: no damping is required, only instability is shown
  std::string text;         ///< "log decrement 0.314 (0.1 required)"

  /// Position of the edge of stability.
  static constexpr double kEdge = 0.25;
};
/// For the decrement or the decay rate, whichever is nearer to its level. Empty where the margin is
/// unknown or not live, and where no damping is required of a system that is not unstable.
std::optional<MarginScale> marginScale(const LiveMargin& live);

/// "log decrement 0.314 (0.1 required), 0.1 s old"; the reason if there is none; "" if none is
/// required.
std::string marginText(const LiveMargin& live);

/// Draws both upwards from the origin of the board (layout.h).
/// @param speed [rad/s], of the shaft; NaN: no shaft, and no scale for it
/// @param compact larger, without text
/// @return [m], their height
double drawInstruments(const LiveMargin& live, double speed, bool compact, MarkerCanvas& board);

}  // namespace whirl_twin
