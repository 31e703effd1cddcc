// The phase lag of a whirl behind the mark on its shaft, unwrapped from record to record.
#pragma once

namespace whirl_twin {

/// Where a rotor's whirl is seen: position [m] and velocity [m/s] there.
struct WhirlMotion {
  double x = 0.0, y = 0.0, x_rate = 0.0, y_rate = 0.0;

  double radius() const;  ///< [m]
};

class WhirlPhase {
 public:
  /// The next record: the whirl, and the direction [rad] of the phase mark.
  void observe(const WhirlMotion& whirl, double mark);

  /// The radius is large enough to have an angle.
  bool valid() const { return valid_; }
  double lag() const;  ///< [rad]; NaN unless valid
  /// [s] from the last record, where the whirl was this one, for which neither the whirl nor a mark
  /// that turns at `speed` [rad/s] leaves its quadrant: the phase need not be seen for so long.
  /// `fastest` [rad/s]: no frequency of the whirl is above it, and amplitudes are not above twice
  /// the largest radius seen, so that the whirl goes no further than v t + (fastest)^2 R t^2.
  double quietFor(const WhirlMotion& whirl, double speed, double fastest) const;

 private:
  double largest_radius_ = 0.0;  // [m], so far
  double lag_ = 0.0;             // [rad], last valid
  bool known_ = false;
  bool valid_ = false;
};

}  // namespace whirl_twin
