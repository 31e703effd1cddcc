// Two instruments on a board above each system: how damped it is, on a scale with the edge of
// stability and the level below which the monitor warns, and how fast it turns, on a scale with the
// speeds to avoid. Without a verdict that is live neither has anything to show but the speed; and
// where the monitor requires no damping the first shows nothing but instability.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display/marker_canvas.h"
#include "whirl_twin/StabilityMargin.h"

namespace whirl_twin {

/// A verdict, and how it stands with it.
struct LiveMargin {
  StabilityMargin::ConstPtr margin;                       ///< null: none that is live
  double age = std::numeric_limits<double>::quiet_NaN();  ///< [s], wall time; NaN: not told
  std::string why_not;                                    ///< there is none that is live
  double least_decrement = 0.1;   ///< [-], log decrement below which the monitor warns; 0: none
  double least_decay_rate = 0.0;  ///< [1/s], decay rate, likewise
};

/// Whether a verdict is still live.
/// @param margin the latest; null: none yet  @param since_heard [s], wall time since it came
/// @param held the simulation is: the verdict holds as long as that lasts, and has no age
/// @param silence of the monitor; "" while it beats
LiveMargin liveMargin(const StabilityMargin::ConstPtr& margin, double since_heard, bool held,
                      const std::string& silence);

/// Shaft speeds [rad/s], from and to.
using SpeedRange = std::pair<double, double>;

/// What the scale of speeds shows.
struct SpeedScale {
  double end = 1.0;                  ///< [rad/s], a round number; it begins at 0
  std::vector<SpeedRange> avoid;     ///< around critical speeds, ascending, within the scale
  std::vector<SpeedRange> unstable;  ///< likewise
};
/// Reaches over the speed, the next band above it and the next threshold. @param margin may be null
SpeedScale speedScale(double speed, const StabilityMargin* margin);
/// "0 to 100 rad/s: avoid 48.1 to 70.7, unstable above 80"
std::string scaleText(const SpeedScale& scale);

/// A margin on its scale from 0, unstable, to 1, and the level below which LOW_DAMPING is raised.
struct MarginScale {
  double place = 0.0;
  double required = kEdge;  ///< kEdge: no damping is required, instability is all there is to show
  std::string text;         ///< "log decrement 0.314 (0.1 required)"

  /// Where the edge of stability is.
  static constexpr double kEdge = 0.25;
};
/// Of the decrement or the decay rate, whichever is nearer to its level. Nothing where the margin
/// is not known or not live, and where no damping is required of a system that is not unstable.
std::optional<MarginScale> marginScale(const LiveMargin& live);

/// "log decrement 0.314 (0.1 required), 0.1 s old"; why there is none; "" where none is required.
std::string marginText(const LiveMargin& live);

/// Draws both upwards from the origin of the board (layout.h).
/// @param speed [rad/s], of the shaft; NaN: there is none, and no scale for it
/// @param compact larger, without words
/// @return [m], how high they are
double drawInstruments(const LiveMargin& live, double speed, bool compact, MarkerCanvas& board);

}  // namespace whirl_twin
