// Whether what comes from a system can be evaluated at all: data quality, as machine protection has
// it, which is no alarm, raises none and clears none.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algebra/constants.h"
#include "messages/states.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// A channel of measurement that is stuck: it moved, in every sample, and from one to the next no
/// digit changes any more.
///
/// Distinguished from it: a motion that dies away (its steps shrink to the last digit before they
/// stop), a machine at rest, a resolution so coarse that samples are often alike (it has not moved
/// in every sample), a sampling rate that keeps step with the motion (likewise). So a channel that
/// repeated itself now and then before it got stuck is not detected.
class StuckChannel {
 public:
  void take(double value) {
    if (value == last_) {
      if (alike_++ == 0) {
        in_motion_ = moves_ >= kMoves && std::max(newest_, older_) >= kCoarse * smallest_ &&
                     std::max(newest_, older_) >= kFine * (std::fabs(value) + newest_);
      }
      moves_ = 0;
      return;
    }
    const double step = std::fabs(value - last_);
    last_ = value;
    alike_ = 0;
    in_motion_ = false;
    if (std::isfinite(step)) {
      ++moves_;
      older_ = std::exchange(newest_, step);
      smallest_ = std::min(smallest_, step);
    }
  }
  bool stuck() const { return in_motion_ && alike_ >= kAlike; }

 private:
  static constexpr int kMoves = 8;         ///< samples that it has moved in
  static constexpr int kAlike = 20;        ///< samples that are the same, besides the first
  static constexpr double kCoarse = 4.0;   ///< times the resolution, as far as it has shown
  static constexpr double kFine = 1.0e-7;  ///< of the value: a motion that has died away is slower

  double last_ = kNaN;
  int moves_ = 0;  ///< in a row
  int alike_ = 0;  ///< in a row
  bool in_motion_ = false;
  double newest_ = 0.0, older_ = 0.0;  ///< steps, the last two
  double smallest_ = kInfinity;
};

/// Bad are states that are stale: none for data_timeout, while the simulation is not paused; not
/// finite: a number of the newest is none; out of range: the whirl is wider than the range in the
/// settings; stuck: x or y of the whirl moved, and has been the same to the last digit since.
class DataQuality {
 public:
  DataQuality(std::string system, const AlarmSettings& settings);
  /// timeout [s, wall], range [m].
  DataQuality(double timeout, double range) : timeout_(timeout), range_(range) {}

  /// New settings, for the next state.
  void set(const AlarmSettings& settings);
  void set(double timeout, double range) {
    timeout_ = timeout;
    range_ = range;
  }
  /// A state came at wall_time [s]; returns whether it can be evaluated.
  bool take(const state::WhirlState& whirl, double wall_time);
  bool take(const state::PendulumState& pendulum, double wall_time);
  /// Time restarts: earlier samples are no reference for later ones.
  void restart() { sampled_at_ = kNaN; }
  /// Some state has come.
  bool received() const { return !std::isinf(received_at_); }
  /// No state has come for too long, or none ever.
  bool isStale(double wall_time) const;
  /// Why the newest state cannot be evaluated; "": it can. paused: the simulation reports a pause.
  std::string problem(double wall_time, bool paused) const;

 private:
  bool take(std::string unfit, double wall_time);
  std::string stuck(const state::WhirlState& whirl);

  std::string system_;
  double timeout_ = 0.0;             ///< [s, wall]
  double range_ = kInfinity;         ///< [m]
  double received_at_ = -kInfinity;  ///< [s, wall]
  std::string unfit_;                ///< why the newest state is
  StuckChannel x_, y_;
  double sampled_at_ = kNaN;  ///< [s], simulated
  double period_ = 0.0;       ///< [s], between samples
};

}  // namespace whirl_twin
