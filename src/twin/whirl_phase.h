// Phase lag of a whirl behind the phase reference of its shaft, unwrapped from step to step.
//
// Unwrapping selects the lag nearest to that of the step before. For steps that are not published
// this requires only the direction in which the whirl passes the centre: the turns of the reference
// are counted by its shaft, and within a quarter of a turn the shorter path crosses the negative x
// axis where y changes sign at negative x. follow() does this with a few multiplications; the lag
// is computed only when required, and is bit-identical to one computed at every step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "control/shaft_angle.h"
#include "mechanics/dynamics.h"
#include "realtime/state_image.h"
#include "twin/record.h"

namespace whirl_twin {

/// Whirl of a rotor at a station: position [m] and velocity [m/s].
struct WhirlMotion {
  double x = 0.0, y = 0.0, x_rate = 0.0, y_rate = 0.0;

  double radius() const;  ///< [m]
};

/// Phase reference of a shaft: angle of the shaft, and of the mark on it [rad].
struct ShaftMark {
  ShaftAngle shaft;
  double on_shaft = 0.0;

  double direction() const { return shaft.remainder + on_shaft; }  ///< [rad]
};

class WhirlPhase {
 public:
  /// The next record. After follow(), call settle() first.
  void observe(const WhirlMotion& whirl, const ShaftMark& mark);

  /// The next step, from its position [m] only. False, with no effect, if the whirl moved by a
  /// quarter of a turn or more, passed the centre, or had no angle: the step must be observed. The
  /// reference must have turned by less than a quarter of a turn.
  bool follow(double x, double y) noexcept {
    const double square = x * x + y * y;
    const bool near = valid_ && x * x_ + y * y_ > 0.0 && square > kMinSquare * largest_square_ &&
                      square < kInfinite;
    if (!near) {
      return false;
    }
    // On both sides of the x axis and less than a quarter of a turn apart: x keeps its sign.
    if (std::signbit(y) != std::signbit(y_) && x < 0.0) {
      around_ += std::signbit(y) ? 1 : -1;
    }
    x_ = x;
    y_ = y;
    largest_square_ = std::max(largest_square_, square);
    followed_ = true;
    return true;
  }
  /// Sets the reference at the last followed step, if any since the last observed one.
  void settle(const ShaftMark& mark);

  /// The radius is large enough for an angle to be defined.
  bool valid() const { return valid_; }
  double lag() const;  ///< [rad], of the last record observed; NaN unless valid

 private:
  /// A radius below this fraction of the largest one so far has no defined angle.
  static constexpr double kMinRadius = 1.0e-9;
  /// The square of twice that: within this margin observe() decides whether there is an angle.
  static constexpr double kMinSquare = 4.0 * kMinRadius * kMinRadius;
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  double largest_radius_ = 0.0;  // [m], so far
  double lag_ = 0.0;             // [rad], last valid; the first one is nearest to 0
  bool valid_ = false;

  // Of the last valid record.
  ShaftMark mark_;
  double turns_ = 0.0;  // [turns], lag less (direction of mark - direction of whirl)

  // Of the last step with an angle, observed or followed.
  double x_ = 0.0, y_ = 0.0;     // [m]
  std::int64_t around_ = 0;      // signed turns round the centre since the last valid record
  bool followed_ = false;        // since then
  double largest_square_ = 0.0;  // [m^2], of the radius
};

// Whirl of a rotor at all published stations: their phases, from the published steps and, position
// only, from those between.

class WhirlPhaseTracker {
 public:
  /// Sets the stations, the first of them the rotor's own; their phases continue.
  void put(const std::vector<Station>& stations);

  const Station& station(std::size_t k) const { return places_[k].at; }
  const WhirlPhase& phase(std::size_t k) const { return places_[k].phase; }
  WhirlMotion motion(std::size_t k, const double* q, const double* v) const;

  /// A published step: settle() with the reference before any change, then observe(). seconds:
  /// duration of a step.
  void settle(std::int64_t step, const ShaftView& shaft, double on_shaft, double seconds);
  void observe(std::int64_t step, const double* q, const double* v, const ShaftMark& mark);
  void exchange(StateImage& image) noexcept { image(places_); }
  /// The next step, from its position only. False: it must be observed. The shaft must turn by less
  /// than a quarter of a turn per step.
  bool follow(std::int64_t step, const double* q) noexcept;

 private:
  struct Place {
    Station at;
    WhirlPhase phase;
    std::int64_t seen = 0;            // step of the phase
    std::vector<double> across = {};  // x and y of each coordinate in turn

    void exchange(StateImage& image) noexcept { image(phase, seen); }
  };

  std::vector<Place> places_;
};

}  // namespace whirl_twin
