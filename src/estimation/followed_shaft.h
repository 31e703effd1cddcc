// The shaft of a followed machine: as its keyphasor tells it, and for a while after the last pulse;
// then at the speed that it had. Before there has been any pulse, and where the scene has no
// keyphasor, as the scene's drive says.
#pragma once

#include <cstdint>
#include <optional>

#include "control/drive.h"
#include "control/keyphasor.h"
#include "signal/shaft_tracker.h"

namespace whirl_twin {

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
