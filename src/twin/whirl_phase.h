// The phase lag of a whirl behind the mark on its shaft, unwrapped from step to step.
//
// Unwrapping takes the lag of a step nearest to that of the step before. What that needs of a step
// that nobody is told of is only which way round the centre the whirl went: the mark's turns are
// counted by its shaft, and within a quarter of a turn the shorter way crosses the negative x axis
// where the sign of y changes at negative x. That is follow(), a few multiplications; the lag is
// worked out where it is asked for, and is the same to the last bit as if it had been all along.
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

/// Where a rotor's whirl is seen: position [m] and velocity [m/s] there.
struct WhirlMotion {
  double x = 0.0, y = 0.0, x_rate = 0.0, y_rate = 0.0;

  double radius() const;  ///< [m]
};

/// The mark on a shaft: where the shaft is, and the mark on it [rad].
struct ShaftMark {
  ShaftAngle shaft;
  double on_shaft = 0.0;

  double direction() const { return shaft.remainder + on_shaft; }  ///< [rad]
};

class WhirlPhase {
 public:
  /// The next record. After follow() settle() first.
  void observe(const WhirlMotion& whirl, const ShaftMark& mark);

  /// The next step, of which only the place [m] is looked at. False, with nothing done, where the
  /// whirl went a quarter of a turn or more, or through the centre, or has had no angle: the step
  /// is to be observed. The mark has to have turned by less than a quarter of a turn.
  bool follow(double x, double y) noexcept {
    const double square = x * x + y * y;
    const bool near = valid_ && x * x_ + y * y_ > 0.0 &&
                      square > kSmallestSquare * largest_square_ && square < kInfinite;
    if (!near) {
      return false;
    }
    // On both sides of the x axis, less than a quarter of a turn apart: x has one sign.
    if (std::signbit(y) != std::signbit(y_) && x < 0.0) {
      around_ += std::signbit(y) ? 1 : -1;
    }
    x_ = x;
    y_ = y;
    largest_square_ = std::max(largest_square_, square);
    followed_ = true;
    return true;
  }
  /// The last step followed, if any since the last one observed, had its mark there.
  void settle(const ShaftMark& mark);

  /// The radius is large enough to have an angle.
  bool valid() const { return valid_; }
  double lag() const;  ///< [rad], of the last record observed; NaN unless valid

 private:
  /// A radius below this part of the largest so far has no angle worth the name.
  static constexpr double kSmallestRadius = 1.0e-9;
  /// The square of twice that: whether there is an angle is left to observe().
  static constexpr double kSmallestSquare = 4.0 * kSmallestRadius * kSmallestRadius;
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  double largest_radius_ = 0.0;  // [m], so far
  double lag_ = 0.0;             // [rad], last valid; the first one is nearest to 0
  bool valid_ = false;

  // Of the last valid record.
  ShaftMark mark_;
  double turns_ = 0.0;  // by which its lag is more than the mark's direction less the whirl's

  // Of the last step with an angle, observed or followed.
  double x_ = 0.0, y_ = 0.0;     // [m]
  std::int64_t around_ = 0;      // times round the centre since the last valid record
  bool followed_ = false;        // since then
  double largest_square_ = 0.0;  // [m^2], of the radius
};

// A rotor's whirl wherever it is published: the phase there, from the steps that are published and
// from those between, of which only the position is evaluated.

class FollowedWhirl {
 public:
  /// The stations from now on, the first of them the rotor's own; their phases continue.
  void put(const std::vector<Station>& stations);

  const Station& station(std::size_t k) const { return places_[k].at; }
  const WhirlPhase& phase(std::size_t k) const { return places_[k].phase; }
  WhirlMotion motion(std::size_t k, const double* q, const double* v) const;

  /// A step that is published: settle() with the mark as it was before any change, then observe().
  /// seconds: of a step.
  void settle(std::int64_t step, const ShaftView& shaft, double on_shaft, double seconds);
  void observe(std::int64_t step, const double* q, const double* v, const ShaftMark& mark);
  void exchange(StateImage& image) noexcept { image(places_); }
  /// The next step, of which only the position is evaluated. False: it has to be observed. The
  /// shaft has to turn by less than a quarter of a turn in a step.
  bool follow(std::int64_t step, const double* q) noexcept;

 private:
  struct Place {
    Station at;
    WhirlPhase phase;
    std::int64_t seen = 0;            // step, of the phase
    std::vector<double> across = {};  // x and y of each coordinate in turn

    void exchange(StateImage& image) noexcept { image(phase, seen); }
  };

  std::vector<Place> places_;
};

}  // namespace whirl_twin
