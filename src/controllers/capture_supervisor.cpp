#include "controllers/capture_supervisor.h"

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kProgress = 0.02;  // fraction of the planned rise
constexpr double kAtLimit = 0.9;    // of a window's samples
constexpr double kTurns = 20.0;     // minimum number of shaft revolutions in a window
constexpr double kFewest = 10.0;    // samples of a window

}  // namespace

/// Window in samples: the time to cross a band, and at least some revolutions.
std::int64_t CaptureSupervisor::windowOf(const SpeedBand& band) const noexcept {
  const double time =
      std::max((band.to - band.from) / rules_.acceleration, kTurns * kTwoPi / band.from);
  return static_cast<std::int64_t>(std::ceil(std::max(kFewest, time / rules_.period)));
}

CaptureSupervisor::Order CaptureSupervisor::look(const Look& at) noexcept {
  switch (phase_) {
    case Phase::kGoing:
      return watch(at);
    case Phase::kUnloading:
      if (at.speed < band_.from) {
        phase_ = Phase::kReturning;
        rested_ = 0;
        return Order::kReturn;
      }
      break;
    case Phase::kReturning:
      if (!at.arrived || ++rested_ < windowOf(band_)) {
        break;
      }
      if (captures_ < rules_.tries) {
        phase_ = Phase::kGoing;
        state_ = state::Supervision::kTryingAgain;
        return Order::kRetry;
      }
      phase_ = Phase::kStaying;
      state_ = state::Supervision::kGivenUp;
      break;
    case Phase::kStaying:
      break;
  }
  return Order::kNone;
}

CaptureSupervisor::Order CaptureSupervisor::watch(const Look& at) noexcept {
  if (captures_ > 0.0 && at.speed > band_.to) {
    captures_ = 0.0;
    state_ = state::Supervision::kNone;
  }
  const auto ahead = std::find_if(rules_.bands.begin(), rules_.bands.end(),
                                  [&](const SpeedBand& band) { return band.to > at.speed; });
  if (ahead == rules_.bands.end() || ahead->to > at.target ||
      at.speed < 2.0 * ahead->from - ahead->to) {
    window_ = {};
    return Order::kNone;
  }
  ++window_.samples;
  window_.at_limit += at.at_limit ? 1 : 0;
  window_.sum += at.speed;
  const std::int64_t whole = windowOf(*ahead);
  if (window_.samples < whole) {
    return Order::kNone;
  }
  const auto samples = static_cast<double>(window_.samples);
  const bool held = static_cast<double>(window_.at_limit) >= kAtLimit * samples;
  const double mean = window_.sum / samples;
  const double least = kProgress * at.acceleration * rules_.period * samples;
  const bool captured = held && window_.before_held && mean - window_.before < least;
  window_ = {};
  if (!captured) {
    window_.before = mean;
    window_.before_held = held;
    return Order::kNone;
  }
  band_ = *ahead;
  captures_ += 1.0;
  phase_ = Phase::kUnloading;
  state_ = state::Supervision::kRetreating;
  return Order::kUnload;
}

}  // namespace whirl_twin
