// What the columns of a run are in. A name that ends in a unit, `q1[deg]`, as adapters of
// acquisition cards write it, says so; of others, numbers that cannot be in the unit that they are
// taken in are refused, and those that hardly can are remarked.
#pragma once

#include <string>
#include <vector>

#include "estimation/fit_study.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Angles of encoders that count within a turn, from -pi to pi or from 0 to 360 deg, as angles that
// go on from turn to turn.

/// Unwraps the column [rad] of a channel: from row to row it then moves by half a turn at most. As
/// the channel's `wrap` says; where that says nothing, a column that jumps by more than half a turn
/// from a row to the next is wrapped if it stays within a turn, or if it hardly moves before and
/// after the jumps. Remarks on it. Throws Refusal where the direction between two rows is not
/// known: in a gap, or of less than three rows a turn.
void unwrapTurns(MeasuredRun& run, const MeasuredChannel& channel);

/// Brings columns with a unit to those of the study's channels and inputs (unitScale()), and adds
/// remarks. Throws Refusal with what is wrong: a unit of
/// another kind, a time that is not in s, numbers that no machine shows.
void settleUnits(StudyRun& run, const std::string& time, const std::vector<InputInfo>& inputs,
                 double step_seconds);

/// Throws Refusal where nothing can be fitted to a run: windows [s] that hold hardly a row, and of
/// one to be fitted, measured columns that are one number each in all rows.
void requireUse(const StudyRun& run, double window);

}  // namespace whirl_twin
