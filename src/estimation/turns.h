// Angles of encoders that count within a turn, from -pi to pi or from 0 to 360 deg, as angles that
// go on from turn to turn.
#pragma once

#include "estimation/fit_study.h"

namespace whirl_twin {

/// Unwraps the column [rad] of a channel: from row to row it then moves by half a turn at most. As
/// the channel's `wrap` says; where that says nothing, a column that jumps by more than half a turn
/// from a row to the next is wrapped if it stays within a turn, or if it hardly moves before and
/// after the jumps. Remarks on it. Throws Refusal where the direction between two rows is not
/// known: in a gap, or of less than three rows a turn.
void unwrapTurns(MeasuredRun& run, const MeasuredChannel& channel);

}  // namespace whirl_twin
