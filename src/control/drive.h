// A drive turns a shaft: at a constant speed, or through a list of jerk-limited moves. Speed and
// angle are integrated in closed form over pieces of constant jerk, never summed step by step:
//
//   omega = v + a tau + j tau^2/2,   theta = theta_0 + v tau + a tau^2/2 + j tau^3/6.
//
// The pieces' durations, jerks and starting values, rounded to doubles, define the motion. Against
// it angle() is within 3e-15 rad for each piece passed, whatever the time (up to 1e15 rad turned),
// and at(offset) within a few ulp of (2 pi + speed * offset). Speed and acceleration are continuous
// from piece to piece up to a few ulp of the largest ones in the move, and the commanded speed is
// reached exactly. A piece's limits are whole nanoseconds and a fraction, exact to 1e-16 ns.
//
// A drive may have barred speed ranges: its moves cross them at full acceleration and do not end in
// them (exclusion_bands.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "control/exclusion_bands.h"
#include "control/shaft_angle.h"
#include "control/speed_profile.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// Motion of the shaft at one instant.
struct ShaftMotion {
  double angle;         ///< [rad], good for sin and cos: remainder at begin() plus the turn since
  double speed;         ///< [rad/s]
  double acceleration;  ///< [rad/s^2]
  double jerk;          ///< [rad/s^3]
};

/// A shaft whose motion is prescribed. Copies are independent of each other. Not thread-safe, even
/// for reading: the angle at constant speed is computed on demand.
class Drive {
 public:
  // Not real-time safe.

  /// A constant speed [rad/s]; angle [rad] at simulated time 0.
  Drive(double speed, double angle);

  /// Moves that follow one another from `speed` and `angle` at simulated time `start_nanoseconds`,
  /// across the barred speed ranges. Throws InputError that names the move and the value.
  Drive(double speed, double angle, const std::vector<SpeedMove>& moves,
        std::int64_t start_nanoseconds = 0, ExclusionBands avoid = {});

  /// They never change.
  const ExclusionBands& avoid() const { return avoid_; }

  /// Lowest and highest speed [rad/s] of the profile, as far as its jerk-limited moves reach.
  std::pair<double, double> speedRange() const;
  /// Speeds [rad/s] at which the profile stays for a time, in its order.
  std::vector<double> constantSpeeds() const;

  // Real-time safe: no allocation, no lock, no exception.

  /// Starts the step at this simulated time. Time increases from call to call; it may go back too,
  /// but after setSpeed() only a reset() brings back what was before it. Before its first instant
  /// the motion is continued backwards with the jerk it starts with. |time| <= 8e18 ns, 250 years.
  void begin(std::int64_t time_nanoseconds) noexcept {
    time_ = time_nanoseconds;
    if (__builtin_expect(steady_ && until_ == kLatest && time_nanoseconds >= first_tick_, 1)) {
      within_ = kAngleUnknown;
    } else {
      beginInProfile();
    }
  }

  /// Motion at offset [s] >= 0 after begin(), of any size.
  ShaftMotion at(double offset) const noexcept {
    if (__builtin_expect(offset > within_, 0)) {
      return beyond(offset);
    }
    return {angle_.remainder +
                offset * (speed_ + offset * (0.5 * acceleration_ + offset * (jerk_ * (1.0 / 6.0)))),
            speed_ + offset * (acceleration_ + offset * (0.5 * jerk_)),
            acceleration_ + offset * jerk_, jerk_};
  }

  /// Motion at offset [s] >= 0 after begin(), with an angle of 0: computing the angle takes longer
  /// than the other values.
  ShaftMotion withoutAngle(double offset) const noexcept {
    if (__builtin_expect(offset > remaining_, 0)) {
      ShaftMotion motion = beyond(offset);
      motion.angle = 0.0;
      return motion;
    }
    return {0.0, speed_ + offset * (acceleration_ + offset * (0.5 * jerk_)),
            acceleration_ + offset * jerk_, jerk_};
  }

  /// Angle at begin().
  ShaftAngle angle() const noexcept {
    if (within_ == kAngleUnknown) {
      findAngle();
    }
    return angle_;
  }

  /// Of begin().
  std::int64_t nanoseconds() const noexcept { return time_; }
  /// Number of the piece of constant jerk, changed on entry to each piece: between two times with
  /// the same number the shaft has turned as that piece specifies.
  std::uint64_t piece() const noexcept { return piece_; }

  /// The speed is constant from begin() for a duration [s].
  bool constantFor(double duration) const noexcept {
    return acceleration_ == 0.0 && jerk_ == 0.0 && duration <= remaining_;
  }

  /// The first breakpoint of the motion, where its jerk changes, after an offset [s] >= 0 from
  /// begin(); infinity if there is none.
  double nextCorner(double offset) const noexcept {
    return offset < remaining_ ? remaining_ : cornerBeyond(offset);
  }

  /// Final speed [rad/s] of the present move, regardless of detours for a barred range.
  double targetSpeed() const noexcept { return segments()[cursor_].target; }

  /// From the instant of the last begin(), replaces the remainder of the profile by one move to
  /// `speed` [rad/s] within max_acceleration [rad/s^2] and max_jerk [rad/s^3], or to the edge of a
  /// band that it is in. Speed and acceleration continue from their present values; only with
  /// max_jerk 0 may the acceleration jump. False, with nothing changed, for bad arguments: not
  /// finite, a limit not positive (jerk: negative), a requested or intermediate speed beyond
  /// kMaxSpeed, a move that would last longer than kMaxDuration.
  bool setSpeed(double speed, double max_acceleration, double max_jerk) noexcept;

  /// Duration [s] of the last setSpeed() move; 0 without one.
  double moveDuration() const noexcept { return move_duration_; }

  /// Restores the profile given at construction, at its first instant.
  void reset() noexcept;
  void exchange(StateImage& image) noexcept {
    image(live_, live_count_, cursor_, move_duration_, piece_, first_tick_, until_, next_lead_,
          steady_, turn_, time_, angle_, within_, speed_, acceleration_, jerk_, remaining_);
    if (image.puts()) {
      findPlace(image);
    }
  }

 private:
  /// A piece of constant jerk, placed on the time axis.
  struct Segment {
    SpeedSegment motion;
    double target;            // [rad/s], where the move ends
    std::int64_t first_tick;  // [ns], first whole nanosecond in it
    double lead;              // [s], from its start to first_tick, in [0, 1e-9)
    ShaftAngle angle;         // at its start
  };

  static Segment following(const Segment& segment, const SpeedSegment& motion,
                           double target) noexcept;
  const Segment* segments() const noexcept {
    return live_count_ > 0 ? live_.data() : profile_.data();
  }
  std::size_t segmentCount() const noexcept {
    return live_count_ > 0 ? live_count_ : profile_.size();
  }
  void beginInProfile() noexcept;
  void enter(std::int64_t time_nanoseconds) noexcept;
  /// After pieces, time and number of the piece were restored: recomputes all derived values.
  void findPlace(StateImage& image) noexcept;
  void findAngle() const noexcept;
  ShaftMotion beyond(double offset) const noexcept;
  double cornerBeyond(double offset) const noexcept;

  static constexpr std::int64_t kLatest = std::numeric_limits<std::int64_t>::max();
  static constexpr double kAngleUnknown = -1.0;  // [s], less than any offset

  ExclusionBands avoid_;
  std::vector<Segment> profile_;
  std::array<Segment, BandedChange::kMaxPieces + 1> live_{};  // the last setSpeed() move, and after
  std::size_t live_count_ = 0;                                // 0: the profile holds
  std::size_t cursor_ = 0;
  double move_duration_ = 0.0;

  // Of the segment at the cursor.
  std::uint64_t piece_ = 0;
  std::int64_t first_tick_ = 0;
  std::int64_t until_ = 0;  // [ns], first tick of the next; of the last the latest time there is
  double next_lead_ = 0.0;  // [s], from the end to until_
  bool steady_ = false;     // at constant speed
  SteadyTurn turn_;         // if so, counted from first_tick_

  // At begin().
  std::int64_t time_ = 0;
  mutable ShaftAngle angle_;
  mutable double within_ = kAngleUnknown;  // [s]: remaining_, if the angle is known
  double speed_ = 0.0;
  double acceleration_ = 0.0;
  double jerk_ = 0.0;
  double remaining_ = 0.0;  // [s], to the end of the segment
};

}  // namespace whirl_twin
