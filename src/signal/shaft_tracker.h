// Angle of a shaft from the pulses of a keyphasor, one per turn: a Kalman filter of angle, speed
// and acceleration, whose jerk is white noise of a given density. Whole turns are counted
// separately from the fraction of a turn, so that the phase after a month is as exact as after a
// minute.
//
// A pulse is assigned to the mark nearest to the predicted angle, so that turns whose pulse is
// missing are counted; one that lies too far from every mark is rejected. Between the last two
// pulses the angle is that of the smoother (Rauch, Tung, Striebel, "Maximum likelihood estimates of
// linear dynamic systems", AIAA J. 3 (1965)), after them that of the prediction.
//
// Where the acceleration jumps, as at the start of a fast run-up, the first pulses are rejected.
// Four consecutive pulses that fit a different constant acceleration, two of them rejected, restart
// the filter.
//
// The scatter of the pulse instants is estimated, too: four consecutive pulses give one residual
// that neither angle, speed nor a constant acceleration explains, and the 7/8 quantile of the last
// 64 residuals is compared with the specified scatter. Where it is clearly larger, it is used
// instead, so that pulses of a converter whose clock is coarser than specified are not rejected.
//
// A keyphasor does not measure the direction of rotation: forward rotation is assumed, without
// reversal on deceleration.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <limits>
#include <optional>

#include "control/keyphasor.h"
#include "control/shaft_angle.h"

namespace whirl_twin {

struct ShaftTrackerSettings {
  double mark = 0.0;       ///< [rad], in [0, 2 pi): angle of the shaft at which a pulse comes
  double jitter = 1.0e-6;  ///< [s], standard deviation of a pulse's instant, that of its clock too,
                           ///< as stated: the pulses themselves may show that it is more
  double white_jerk = 10.0;  ///< [rad^2/s^5], its density: the acceleration wanders by the root of
                             ///< it in a second
};

/// Settings for a keyphasor whose mark lies an angle `phase` [rad] behind the required one. A step
/// of its clock of length r has a standard deviation of r / sqrt(12); none is below `least` [s].
ShaftTrackerSettings trackerOf(const KeyphasorSettings& keyphasor, double phase = 0.0,
                               double least = 1.0e-7);

/// A shaft at an instant.
struct ShaftEstimate {
  bool known = false;  ///< two standard deviations are less than half a turn
  ShaftAngle angle;
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s^2]
  double deviation = 0.0;     ///< [rad], standard deviation of the angle
};

/// What has become of the pulses.
struct PulseCounts {
  std::int64_t taken = 0;
  std::int64_t refused = 0;  ///< too far from the mark, or not later than the one before
  std::int64_t missed = 0;   ///< turns without a pulse, between two that were taken
  std::int64_t locked = 0;   ///< number of locks, including restarts
};

class ShaftTracker {
 public:
  static constexpr int kLately = 16;  ///< pulses of which refusedLately() counts

  explicit ShaftTracker(const ShaftTrackerSettings& settings = {});

  /// Adds the next pulse, at an instant [ns]; true where it is accepted.
  bool take(std::int64_t instant);
  /// Restarts, as after time was set back; counters continue.
  void clear();
  /// The shaft at an instant [ns] that is not before the last pulse but one that was taken. Not
  /// known before there have been four pulses in a row that agree.
  ShaftEstimate at(std::int64_t instant) const;
  /// [ns], of the last pulse that was taken; only where one was.
  std::int64_t newest() const { return after_->time; }
  bool locked() const { return after_.has_value(); }
  const PulseCounts& counts() const { return counts_; }
  /// Of the last kLately pulses, those that were not taken.
  int refusedLately() const { return static_cast<int>(refused_.count()); }
  /// [s], standard deviation of a pulse's instant: as stated, or as the pulses show.
  double jitter() const { return jitter_; }

 private:
  /// Angle [rad] beyond the mark of the turn, speed and acceleration, with their covariance.
  struct State {
    std::int64_t time = 0;   // [ns]
    std::int64_t turns = 0;  // marks that have passed
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  struct Lost {
    std::int64_t time = std::numeric_limits<std::int64_t>::min();  // [ns]
    std::int64_t turns = -1;
  };

  State predicted(const State& from, std::int64_t time) const;
  State smoothed(std::int64_t time) const;
  static State corrected(const State& predicted, double innovation, double variance);
  static double deviationOf(const State& state);
  double pulseVariance(double speed) const;
  bool judge(std::int64_t instant);
  void take(const State& predicted, double innovation, double variance);
  bool refuse();
  bool lock();
  double intervals(std::array<double, 4>& t) const;
  std::optional<double> agreement() const;
  void learnJitter();

  ShaftTrackerSettings settings_;
  std::array<std::int64_t, 4> pulses_{};  // [ns], the last ones, of whatever quality
  int kept_ = 0;                          // of them
  double jitter_;                         // [s]
  std::array<double, 64> misfits_{};      // [s], without sign
  std::size_t misfits_taken_ = 0;
  std::bitset<kLately> refused_;   // of the last pulses
  int doubt_ = 0;                  // rises by refused and missing pulses, falls by good ones
  Lost lost_;                      // where it was known last
  std::optional<State> before_;    // at the last pulse but one that was taken
  std::optional<State> expected_;  // at the last one, before it was taken
  std::optional<State> after_;     // and thereafter
  PulseCounts counts_;
};

}  // namespace whirl_twin
