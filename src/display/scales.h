// A scale on a board: ranges of colours between places 0 to 1 of its length, and a pointer.
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

  /// middle [m]: how high on the board; height [m]
  ScaleBar(std::string part, double middle, double height, MarkerCanvas& board)
      : part_(std::move(part)), middle_(middle), height_(height), board_(board) {}

  /// Takes it away where it has no length. A higher layer is in front.
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

// How strongly the whirl is exaggerated on the screen. The orbit of a real rotor is micrometres
// wide and would be invisible drawn true, so it is drawn times a round number of the 1-2-5 series.
//
// The number follows a peak-hold of the whirl radius with a slow decay, and with hysteresis: it
// falls when the orbit outgrows its place in the picture and rises only when the orbit has become
// small in it. In between, growth and decay of the whirl are seen as they are.

class WhirlScale {
 public:
  static constexpr double kTargetRadius = 0.25;   ///< [m] in the picture, at most, after a choice
  static constexpr double kLargestRadius = 0.30;  ///< [m] in the picture; beyond it the scale falls
  static constexpr double kSmallestRadius = 0.04;  ///< [m] in the picture; below it the scale rises
  static constexpr double kPeakDecayTime = 3.0;    ///< [s], time constant of the peak-hold

  /// @param fixed [-], a scale that is kept whatever the whirl does; 0: chosen automatically.
  /// @param room [-], how much there is: the radii above are times this
  explicit WhirlScale(double fixed = 0.0, double room = 1.0);

  /// Takes the next whirl radius into account. A radius that is not finite is passed over.
  /// @param radius [m]  @param time [s], simulated; a step backwards starts the peak-hold anew
  void observe(double radius, double time);

  /// [-], metres in the picture for a metre of whirl.
  double value() const { return value_; }

 private:
  double fixed_, room_;
  double value_;
  double peak_ = 0.0;  // [m]
  double time_ = 0.0;  // [s]
};

}  // namespace whirl_twin
