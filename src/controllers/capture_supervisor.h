// Watches over a shaft that its motor brings up through bands of resonance, and frees it where one
// holds it: near a critical speed all that a motor of limited torque gives may go into the whirl
// (Sommerfeld 1902).
//
// Captured is a shaft whose motor gave all it has in two windows of time, one after the other, in
// or just below a band that it is on its way through, while its mean speed rose by less than a
// fiftieth of what was planned. It is then unloaded: its motor only brakes, until it is below the
// band; it returns to where the run-up for the highest acceleration begins, waits there for a
// window, until its whirl has died down, and tries again. After so many tries it stays there.
//
// So it never sits: no stay at the limit of torque is longer than two windows, but for one that
// goes on by a fiftieth of the plan.
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
  /// What the law is to do from this sample on.
  enum class Order {
    kNone,    ///< as before
    kUnload,  ///< let the speed fall to runUpOf(band()), with no torque upwards
    kReturn,  ///< bring it there, with any torque
    kRetry    ///< go on to the target, in the fastest way
  };
  struct Rules {
    std::vector<SpeedBand> bands;  ///< ascending, above 0, further apart than the run-up
    double run_up = 0.0;           ///< [rad/s], of the highest acceleration
    double acceleration = 0.0;     ///< [rad/s^2], the highest
    double tries = 0.0;
    double period = 0.0;  ///< [s], of the samples
  };
  /// A sample, with the signs that make the way to the target one of rising speed.
  struct Look {
    double speed;         ///< [rad/s]
    double target;        ///< [rad/s]
    double acceleration;  ///< [rad/s^2], planned at this speed
    bool at_limit;        ///< its motor gives all it has
    bool arrived;         ///< the set-point stays
  };

  explicit CaptureSupervisor(Rules rules) : rules_(std::move(rules)) {}

  /// The speed [rad/s] below a band from which it is crossed, and below which a shaft stays that
  /// does not cross it.
  double runUpOf(const SpeedBand& band) const noexcept {
    return std::max(0.0, band.from - rules_.run_up);
  }
  const std::vector<SpeedBand>& bands() const { return rules_.bands; }

  // Real-time safe.

  /// Forgets the past. refused: it will not try.
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
  /// Of the band that held it last.
  const SpeedBand& band() const noexcept { return band_; }
  state::Supervision state() const noexcept { return state_; }

 private:
  enum class Phase { kGoing, kUnloading, kReturning, kStaying };
  struct Window {
    std::int64_t samples = 0;
    std::int64_t at_limit = 0;
    double sum = 0.0;          // of speeds [rad/s]
    double before = 0.0;       // mean speed of the window before [rad/s]
    bool before_held = false;  // it was at its limit
  };
  Order watch(const Look& at) noexcept;
  std::int64_t windowOf(const SpeedBand& band) const noexcept;

  Rules rules_;
  Phase phase_ = Phase::kGoing;
  state::Supervision state_ = state::Supervision::kNone;
  SpeedBand band_;
  double captures_ = 0.0;  // by band_, one after the other
  std::int64_t rested_ = 0;
  Window window_;
};

}  // namespace whirl_twin
