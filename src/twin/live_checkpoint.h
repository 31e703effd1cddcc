// Checkpoints of a twin that runs, for the thread that sends it commands.
#pragma once

#include <functional>
#include <string>

#include "twin/checkpoint.h"
#include "twin/live_parameters.h"
#include "twin/live_twin.h"

namespace whirl_twin {

/// Takes the state between two steps: all of `out` but its scene and its observer, for whom a
/// record stands at its place among the others (RecordLayout::kSaved). wait() as that of
/// LiveParameters. False: not now, as the loop has ended or has a reset to tell of.
bool takeCheckpoint(LiveTwin& twin, const LiveParameters& parameters,
                    const std::function<bool()>& wait, Checkpoint& out);

/// The same of a twin whose loop has ended.
void takeAtRest(LiveTwin& twin, const LiveParameters& parameters, Checkpoint& out);

/// Before the loop runs, and before its state is observed: goes on from there. Throws Refusal, that
/// begins with `source`, for a state of a twin made otherwise.
void resume(const Checkpoint& checkpoint, LiveTwin& twin, LiveParameters& parameters,
            const std::string& source);

}  // namespace whirl_twin
