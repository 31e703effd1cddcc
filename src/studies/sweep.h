// Runs the points of a study that are not finished, block by block, on some threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "studies/result_folder.h"
#include "studies/study.h"

namespace whirl_twin {

/// Which blocks are run: number `part` of `parts` hands of them, dealt in turn; 0 is the first.
struct Share {
  std::uint64_t part = 0;
  std::uint64_t parts = 1;
};

/// Called ten times a second, by the thread that called sweep(), with how many points are done of
/// how many that were to be done.
using SweepProgress = std::function<void(std::uint64_t done, std::uint64_t of)>;

/// Results do not depend on the number of workers. `stop` may be set from outside, by a signal
/// handler: what is unfinished then is dropped. Throws RunFailure where it was stopped, where a
/// block could not be written, or where a point failed and the study stops at that.
void sweep(const Study& study, const ResultFolder& folder, unsigned workers, const Share& share,
           std::atomic<bool>& stop, const SweepProgress& progress);

}  // namespace whirl_twin
