// How strongly the whirl is exaggerated on the screen. The orbit of a real rotor is micrometres
// wide and would be invisible drawn true, so it is drawn times a round number of the 1-2-5 series.
//
// The number follows a peak-hold of the whirl radius with a slow decay, and with hysteresis: it
// falls when the orbit outgrows its place in the picture and rises only when the orbit has become
// small in it. In between, growth and decay of the whirl are seen as they are.
#pragma once

namespace whirl_twin {

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
