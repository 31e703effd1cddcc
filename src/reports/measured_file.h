// Measurements of a file: the Measurement messages of an LCM log or a rosbag, or a table of
// comma-separated values, for `twin follow` and `twin fit`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "estimation/estimator_sources.h"
#include "estimation/measured_run.h"
#include "messages/measurement.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

struct MeasuredFile {
  std::uint64_t messages = 0;
  std::uint64_t rejected = 0;  ///< payloads that are no valid message
  std::uint64_t damaged = 0;   ///< places of the log that are no event
  std::string first_damage;    ///< where, and what; "": none
  /// Messages or rows that were out of order; of a table gaps, uneven steps, columns that do not
  /// change.
  std::vector<std::string> remarks;
};

/// Gives `take` every message of the sources, those of a scene by this name, in the order of
/// recorded time; a table ends in .csv. Throws InputError for a file that cannot be read, that has
/// none of them, or no sample of an input, or whose messages are out of order and of two runs.
MeasuredFile readMeasurements(const std::string& path, const std::string& scene,
                              const std::vector<EstimatorSource>& sources,
                              const std::string& prefix,
                              const std::function<void(const state::Measurement&)>& take,
                              const LogProgress& advanced);

/// Columns of a file: those of a table (readMeasuredRun), or, of a file that ends in .lcmlog, .bag
/// or .bag.active, channels of its measurements on channels that begin with `prefix`: `theta`, or
/// `encoder/theta` where several sources have one of that name. All are of one source, so that a
/// row is an instant; time counts from its first sample, and `time` is not used. Throws InputError
/// as readMeasuredRun(), and where a channel is not there.
MeasuredRun readRecordedRun(const std::string& path, const std::string& prefix,
                            const std::string& time, const std::vector<std::string>& columns);

}  // namespace whirl_twin
