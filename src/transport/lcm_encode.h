// A message -> the bytes of an LCM event.
#pragma once

#include <cstdint>
#include <vector>

#include "transport/lcm_converters.h"

namespace whirl_twin {

/// The payload of a message; returns its timestamp in a log of simulated time [us].
template <class State>
std::int64_t encode(const State& state, std::vector<std::uint8_t>& payload) {
  const LcmType<State> message = toLcm(state);
  payload.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(payload.data(), 0, static_cast<int>(payload.size()));
  return message.utime;
}

}  // namespace whirl_twin
