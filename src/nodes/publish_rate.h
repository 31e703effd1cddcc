// How often a node publishes: its private parameter ~publish_rate.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "messages/refusal.h"
#include "nodes/private_parameter.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Steps of the scene from one publication to the next, at ~publish_rate Hz, by default 0: every
/// one. Throws Refusal for a rate below 0.001 Hz.
inline std::int64_t stepsToPublish(const Scene& scene) {
  constexpr double kSlowestRate = 1.0e-3;  // Hz
  const auto rate = privateParameter("publish_rate", "a number in Hz", 0.0);
  if (!(rate == 0.0 || (rate >= kSlowestRate && std::isfinite(rate)))) {
    throw Refusal(fmt::format("publish_rate: must be 0 (every step), or at least {} Hz, found {}",
                              kSlowestRate, rate));
  }
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

}  // namespace whirl_twin
