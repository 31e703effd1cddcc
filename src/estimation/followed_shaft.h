// The shaft of a followed machine: as its keyphasor tells it, and for a while after the last pulse;
// then at the speed that it had. Before there has been any pulse, and where the scene has no
// keyphasor, as the scene's drive says.
#pragma once

#include <cstdint>
#include <optional>

#include "control/drive.h"
#include "control/keyphasor.h"
#include "control/sensor.h"
#include "mechanics/moment.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

// A shaft on its way from one instant to another: its angle is the cubic through angles and speeds.

class ShaftPath {
 public:
  /// to_twin [ns]: what the instants are less than the twin's.
  ShaftPath(const ShaftInstant& from, const ShaftInstant& to, std::int64_t to_twin);

  /// At a part of the way there, from 0 to 1; its time is the twin's.
  Moment<double> at(double part) const;
  std::int64_t from() const { return from_.time; }  ///< [ns]
  double duration() const { return turn_.length; }  ///< [s]
  double turned() const { return turn_.to; }        ///< [rad], in all
  double startAngle() const { return angle_; }      ///< [rad], without whole turns
  /// At an instant [ns] on the way, not at its ends.
  ShaftInstant instantAt(std::int64_t time) const;

 private:
  ShaftInstant from_;
  double start_;     // [s], simulated
  double angle_;     // [rad], at the start, without whole turns
  CubicPiece turn_;  // [rad], since the start
};

class FollowedShaft {
 public:
  /// As the drive says: its angle is known.
  explicit FollowedShaft(Drive drive) : drive_(drive) {}
  /// As the pulses of a keyphasor say, from now on.
  void listenTo(const KeyphasorSettings& keyphasor);

  /// The machine's clock has been set: pulses before tell nothing of what comes.
  void restart();
  /// The next pulse, at an instant [ns].
  void take(std::int64_t pulse) { tracker_->take(pulse); }
  /// The pulses taken are not enough to tell of an instant [ns]: the next one is needed.
  bool needsPulse(std::int64_t instant) const {
    return tracker_ && !(tracker_->locked() && tracker_->newest() > instant);
  }
  /// At an instant [ns], to_twin [ns] less than the twin's. Where its angle is not known it goes on
  /// from where it was known last; turns go on when it is known again.
  ShaftEstimate at(std::int64_t instant, std::int64_t to_twin);

 private:
  ShaftEstimate unknown(std::int64_t instant, std::int64_t to_twin);

  Drive drive_;
  std::optional<ShaftTracker> tracker_;
  std::optional<ShaftInstant> known_;  // last
  bool is_known_ = false;
  std::int64_t untold_ = 0;  // turns that no pulse has told of
};

}  // namespace whirl_twin
