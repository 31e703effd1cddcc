// What was measured, out of a file: the Measurement messages of an LCM log or a rosbag, or a table
// of comma-separated values with a column `time` [s] and one for each channel of the sources.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "estimation/followed_sources.h"
#include "messages/measurement.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

struct MeasuredFile {
  std::uint64_t messages = 0;
  std::uint64_t rejected = 0;  ///< payloads that are no sound message
  std::uint64_t damaged = 0;   ///< places of the log that are no event
  std::string first_damage;    ///< where, and what; "": none
  /// Messages or rows that were out of order; of a table gaps, uneven steps, columns that stand
  /// still.
  std::vector<std::string> remarks;
};

/// Gives `take` every message of the sources, those of a scene by this name, in the order of
/// recorded time; a table ends in .csv. Throws Refusal for a file that cannot be read, that has
/// none of them, or no sample of an input, or whose messages are out of order and of two runs.
MeasuredFile readMeasurements(const std::string& path, const std::string& scene,
                              const std::vector<FollowedSource>& sources, const std::string& prefix,
                              const std::function<void(const state::Measurement&)>& take,
                              const LogProgress& advanced);

}  // namespace whirl_twin
