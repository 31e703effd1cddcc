// A step divided into sub-steps between the instants of the controllers, with a map prepared for
// each length.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "control/inputs.h"
#include "integration/motion_state.h"

namespace whirl_twin {

/// Map: a step of one length.
template <class Map>
class StepParts {
 public:
  /// For the lengths of Inputs::parts(); nullptr: for none. make(length [s]) is a Map.
  template <class Make>
  StepParts(const Inputs* inputs, const Make& make) {
    if (inputs == nullptr) {
      return;
    }
    for (const std::int64_t length : inputs->parts()) {
      parts_.emplace_back(length, make(static_cast<double>(length) / 1e9));
    }
  }

  /// From one instant to another [ns]: take(map, offset [s], length [s]) for each part, until one
  /// is not kOk. Real-time safe.
  template <class Take>
  StepStatus advance(std::int64_t from, std::int64_t to, const Take& take) noexcept {
    StepStatus status = StepStatus::kOk;
    for (auto& [length, map] : parts_) {
      for (; status == StepStatus::kOk && to - from >= length; from += length) {
        status = take(map, static_cast<double>(from) / 1e9, static_cast<double>(length) / 1e9);
      }
    }
    return status;
  }

 private:
  std::vector<std::pair<std::int64_t, Map>> parts_;  ///< longest first
};

}  // namespace whirl_twin
