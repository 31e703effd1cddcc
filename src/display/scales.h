// A scale on a board: coloured ranges at positions 0 to 1 of its length, and a pointer.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "display/marker_canvas.h"

namespace whirl_twin {

class ScaleBar {
 public:
  static constexpr double kWidth = 1.3;  ///< [m]

  /// middle [m]: height of its centre on the board; height [m]
  ScaleBar(std::string part, double middle, double height, MarkerCanvas& board)
      : part_(std::move(part)), middle_(middle), height_(height), board_(board) {}

  /// Removed where it has no length. A higher layer is in front.
  void range(const std::string& name, double from, double to, const Color& color, int layer) {
    from = std::clamp(from, 0.0, 1.0);
    to = std::clamp(to, 0.0, 1.0);
    if (!(to > from)) {
      board_.gone(part_ + "_" + name);
      return;
    }
    board_.box(part_ + "_" + name, at(0.5 * (from + to), layer),
               {(to - from) * kWidth, height_, kThick}, color);
  }
  void pointer(double place) {
    board_.box(part_ + "_pointer", at(std::clamp(place, 0.0, 1.0), 4),
               {0.024, 1.6 * height_, kThick}, {1.0F, 1.0F, 1.0F});
  }
  void noPointer() { board_.gone(part_ + "_pointer"); }

 private:
  static constexpr double kThick = 0.004;  // m

  Eigen::Isometry3d at(double place, int layer) const {
    return Eigen::Isometry3d(Eigen::Translation3d((place - 0.5) * kWidth, middle_, 0.006 * layer));
  }

  std::string part_;
  double middle_;
  double height_;
  MarkerCanvas& board_;
};

// Display magnification of the whirl. The orbit of a real rotor is micrometres wide and would be
// invisible to scale, so it is multiplied by a round number of the 1-2-5 series.
//
// The factor follows a peak-hold of the whirl radius with a slow decay, and with hysteresis: it
// falls when the orbit outgrows its space in the picture and rises only when the orbit has become
// small in it. In between, growth and decay of the whirl are shown undistorted.

class WhirlScale {
 public:
  static constexpr double kTargetRadius = 0.25;  ///< [m] in the picture, at most, after a choice
  static constexpr double kMaxRadius = 0.30;     ///< [m] in the picture; beyond it the scale falls
  static constexpr double kMinRadius = 0.04;     ///< [m] in the picture; below it the scale rises
  static constexpr double kPeakDecayTime = 3.0;  ///< [s], time constant of the peak-hold

  /// @param fixed [-], a constant scale, whatever the whirl; 0: automatic.
  /// @param room [-], available space: the radii above are multiplied by it
  explicit WhirlScale(double fixed = 0.0, double room = 1.0);

  /// Processes the next whirl radius. A radius that is not finite is ignored.
  /// @param radius [m]  @param time [s], simulated; a step backwards restarts the peak-hold
  void observe(double radius, double time);

  /// [-], metres in the picture per metre of whirl.
  double value() const { return value_; }

 private:
  double fixed_, room_;
  double value_;
  double peak_ = 0.0;  // [m]
  double time_ = 0.0;  // [s]
};

}  // namespace whirl_twin
