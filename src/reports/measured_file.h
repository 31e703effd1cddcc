// Measurements of a recording, for `twin follow` and `twin fit`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "estimation/estimator_sources.h"
#include "estimation/measured_run.h"
#include "messages/measurement.h"
#include "reports/recording.h"

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
/// recorded time. Throws InputError for a file that cannot be read, that has none of them, or no
/// sample of an input, or whose messages are out of order and of two runs.
MeasuredFile readMeasurements(const Recording& recording, const std::string& scene,
                              const std::vector<EstimatorSource>& sources,
                              const std::function<void(const state::Measurement&)>& take,
                              const LogProgress& advanced);

/// Columns of a file: those of a table (readMeasuredRun), or, of a log, channels of its
/// measurements on channels that begin with `prefix`: `theta`, or `encoder/theta` where several
/// sources have one of that name. All are of one source, so that a row is an instant; time counts
/// from its first sample. Throws InputError as readMeasuredRun(), and where a channel is not there.
MeasuredRun readRecordedRun(const std::string& path, const std::string& prefix,
                            const TableSettings& table, const std::vector<WantedColumn>& columns);

}  // namespace whirl_twin
