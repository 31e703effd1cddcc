// Detects and resolves resonance capture of a shaft that its motor brings up through barred speed
// ranges: near a critical speed all the torque of a limited motor may go into the whirl (Sommerfeld
// 1902).
//
// A shaft is captured if its motor was at its torque limit in two consecutive windows of time, in
// or just below a range that it is passing through, while its mean speed rose by less than a
// fiftieth of the planned rise. It is then unloaded: its motor only brakes, until it is below the
// range; it returns to the start of the run-up with the highest acceleration, waits there for a
// window, until its whirl has decayed, and tries again. After the maximum number of tries it stays
// there.
//
// Hence no stay at the torque limit is longer than two windows, except one that advances by a
// fiftieth of the plan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "control/exclusion_bands.h"
#include "messages/controller_state.h"
#include "realtime/state_image.h"

namespace whirl_twin {

class CaptureSupervisor {
 public:
  /// Command to the speed controller from this sample on.
  enum class Order {
    kNone,    ///< as before
    kUnload,  ///< let the speed fall to runUpOf(band()), with no torque upwards
    kReturn,  ///< bring it there, with torque in both directions
    kRetry    ///< continue to the target, as fast as possible
  };
  struct Rules {
    std::vector<SpeedBand> bands;  ///< ascending, above 0, separated by more than the run-up
    double run_up = 0.0;           ///< [rad/s], of the highest acceleration
    double acceleration = 0.0;     ///< [rad/s^2], the highest
    double tries = 0.0;
    double period = 0.0;  ///< [s], of the samples
  };
  /// A sample, with signs such that the speed rises towards the target.
  struct Look {
    double speed;         ///< [rad/s]
    double target;        ///< [rad/s]
    double acceleration;  ///< [rad/s^2], planned at this speed
    bool at_limit;        ///< its motor gives all it has
    bool arrived;         ///< the set-point stays
  };

  explicit CaptureSupervisor(Rules rules) : rules_(std::move(rules)) {}

  /// The speed [rad/s] below a band at which the crossing starts, and below which a shaft stays
  /// that does not cross it.
  double runUpOf(const SpeedBand& band) const noexcept {
    return std::max(0.0, band.from - rules_.run_up);
  }
  const std::vector<SpeedBand>& bands() const { return rules_.bands; }

  // Real-time safe.

  /// Clears the state. refused: no attempt is made.
  void reset(bool refused) noexcept {
    phase_ = refused ? Phase::kStaying : Phase::kGoing;
    state_ = refused ? state::Supervision::kRefused : state::Supervision::kNone;
    captures_ = 0.0;
    window_ = {};
  }
  Order look(const Look& at) noexcept;
  void exchange(StateImage& image) noexcept {
    image(phase_, state_, band_, captures_, rested_, window_);
    image.requireWithin(phase_, Phase::kGoing, Phase::kStaying);
    image.requireWithin(state_, state::Supervision::kNone, state::Supervision::kRefused);
  }
  bool unloads() const noexcept { return phase_ == Phase::kUnloading; }
  /// The band of the last capture.
  const SpeedBand& band() const noexcept { return band_; }
  state::Supervision state() const noexcept { return state_; }

 private:
  enum class Phase { kGoing, kUnloading, kReturning, kStaying };
  struct Window {
    std::int64_t samples = 0;
    std::int64_t at_limit = 0;
    double sum = 0.0;          // of speeds [rad/s]
    double before = 0.0;       // mean speed of the previous window [rad/s]
    bool before_held = false;  // it was at its limit
  };
  Order watch(const Look& at) noexcept;
  std::int64_t windowOf(const SpeedBand& band) const noexcept;

  Rules rules_;
  Phase phase_ = Phase::kGoing;
  state::Supervision state_ = state::Supervision::kNone;
  SpeedBand band_;
  double captures_ = 0.0;  // consecutive captures by band_
  std::int64_t rested_ = 0;
  Window window_;
};

}  // namespace whirl_twin
