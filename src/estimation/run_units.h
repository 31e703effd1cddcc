// Units of the columns of a run. A column name may end in a unit, `q1[deg]`, as written by some
// data acquisition software; without one, values that are impossible in the assumed unit are
// rejected, and unlikely ones are remarked.
#pragma once

#include <string>
#include <vector>

#include "estimation/fit_study.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Unwraps angles of encoders that count within a turn, from -pi to pi or from 0 to 360 deg.

/// Unwraps the column [rad] of a channel: steps from row to row are then at most half a turn.
/// Governed by the channel's `wrap`; if that is not set, a column with jumps of more than half a
/// turn from a row to the next is wrapped if it stays within a turn, or if it hardly moves before
/// and after the jumps. Adds remarks. Throws InputError where the direction between two rows is not
/// known: in a gap, or with less than three rows a turn.
void unwrapTurns(MeasuredRun& run, const MeasuredChannel& channel);

/// Converts columns with a unit to the units of the study's channels and inputs (unitScale()), and
/// adds remarks. Throws InputError for a unit of another kind, and implausible values.
void settleUnits(StudyRun& run, const std::vector<InputInfo>& inputs, double step_seconds);

/// Throws InputError if a run cannot be used for a fit: windows [s] with too few rows, or, in a
/// training run, measured columns that are all constant.
void requireUse(const StudyRun& run, double window);

}  // namespace whirl_twin
