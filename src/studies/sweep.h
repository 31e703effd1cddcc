// Runs the points of a study that are not finished, block by block, on some threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "studies/result_folder.h"
#include "studies/study.h"

namespace whirl_twin {

/// Which blocks are run: number `part` of `parts` hands of them, dealt in turn; 0 is the first.
struct Share {
  std::uint64_t part = 0;
  std::uint64_t parts = 1;
};

/// Those of a share that are not finished, in their order.
std::vector<std::uint64_t> unfinishedBlocks(const Study& study, const ResultFolder& folder,
                                            const Share& share);

/// The next block that is to be run; nothing: there is none left. Called by any thread, with how
/// many points this process has run.
using BlockDealer = std::function<std::optional<std::uint64_t>(std::uint64_t done)>;

/// Called ten times a second, by the thread that called sweep(), with how many points are done.
using SweepProgress = std::function<void(std::uint64_t done)>;

/// Runs what is dealt. Results do not depend on the number of workers, nor on who runs which block.
/// `stop` may be set from outside, by a signal handler: what is unfinished then is dropped. Throws
/// RunFailure where it was stopped, where a block could not be written, or where a point failed and
/// the study stops at that.
void sweep(const Study& study, const ResultFolder& folder, unsigned workers,
           const BlockDealer& dealer, std::atomic<bool>& stop, const SweepProgress& progress);

/// Deals these, in their order, to all who ask.
class BlockDeck {
 public:
  explicit BlockDeck(std::vector<std::uint64_t> blocks) : blocks_(std::move(blocks)) {}
  std::optional<std::uint64_t> next() {
    const std::size_t at = next_++;
    return at < blocks_.size() ? std::optional(blocks_[at]) : std::nullopt;
  }

 private:
  std::vector<std::uint64_t> blocks_;
  std::atomic<std::size_t> next_{0};
};

}  // namespace whirl_twin
