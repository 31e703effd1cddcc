// A run for `twin fit`, from whatever recorded it: a table of comma-separated values, or the
// measurements in an LCM log or a rosbag.
#pragma once

#include <string>
#include <vector>

#include "estimation/measured_run.h"

namespace whirl_twin {

/// Columns of a file: those of a table (readMeasuredRun), or, of a file that ends in .lcmlog, .bag
/// or .bag.active, channels of its measurements on channels that begin with `prefix`: `theta`, or
/// `encoder/theta` where several sources have one of that name. All are of one source, so that a
/// row is an instant; time counts from its first sample, and `time` is not used. Throws Refusal as
/// readMeasuredRun(), and where a channel is not there.
MeasuredRun readRecordedRun(const std::string& path, const std::string& prefix,
                            const std::string& time, const std::vector<std::string>& columns);

}  // namespace whirl_twin
