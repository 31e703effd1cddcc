// Shaft motion of a state estimator: from the pulses of its keyphasor, and for a while after the
// last pulse extrapolated at the last speed. Before the first pulse, and without a keyphasor, the
// motion of the scene's drive.
#pragma once

#include <cstdint>
#include <optional>

#include "control/drive.h"
#include "control/keyphasor.h"
#include "control/sensor.h"
#include "mechanics/evaluation_point.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

// Shaft motion between two instants: the angle is the cubic through angles and speeds at both ends.

class ShaftPath {
 public:
  /// to_twin [ns]: the twin's instants less these instants.
  ShaftPath(const ShaftInstant& from, const ShaftInstant& to, std::int64_t to_twin);

  /// At a fraction of the path, 0 to 1; the time is the twin's.
  EvaluationPoint<double> at(double part) const;
  std::int64_t from() const { return from_.time; }  ///< [ns]
  double duration() const { return turn_.length; }  ///< [s]
  double turned() const { return turn_.to; }        ///< [rad], total
  double startAngle() const { return angle_; }      ///< [rad], without whole turns
  /// At an instant [ns] inside the path, not at its ends.
  ShaftInstant instantAt(std::int64_t time) const;

 private:
  ShaftInstant from_;
  double start_;     // [s], simulated
  double angle_;     // [rad], at the start, without whole turns
  CubicPiece turn_;  // [rad], since the start
};

class EstimatorShaft {
 public:
  /// Motion of the drive: the angle is known.
  explicit EstimatorShaft(Drive drive) : drive_(drive) {}
  /// From now on, motion from the pulses of a keyphasor.
  void listenTo(const KeyphasorSettings& keyphasor);

  /// The machine's clock has been set: earlier pulses are invalid for later instants.
  void restart();
  /// The next pulse, at an instant [ns].
  void take(std::int64_t pulse) { tracker_->take(pulse); }
  /// More pulses are needed to estimate the motion at an instant [ns].
  bool needsPulse(std::int64_t instant) const {
    return tracker_ && !(tracker_->locked() && tracker_->newest() > instant);
  }
  /// At an instant [ns]; to_twin [ns]: the twin's instants less these. While the angle is not known
  /// it is extrapolated from the last known one; the count of turns continues when it is known
  /// again.
  ShaftEstimate at(std::int64_t instant, std::int64_t to_twin);

 private:
  ShaftEstimate unknown(std::int64_t instant, std::int64_t to_twin);

  Drive drive_;
  std::optional<ShaftTracker> tracker_;
  std::optional<ShaftInstant> known_;  // last
  bool is_known_ = false;
  std::int64_t extra_turns_ = 0;  // whole turns added to those of the keyphasor tracker
};

}  // namespace whirl_twin
