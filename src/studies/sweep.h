// Runs the unfinished points of a study block by block on several threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "studies/result_folder.h"
#include "studies/study.h"

namespace whirl_twin {

/// Share of the blocks: hand `part` (from 0) of `parts`, dealt in turn.
struct Share {
  std::uint64_t part = 0;
  std::uint64_t parts = 1;
};

/// The unfinished blocks of a share, in order.
std::vector<std::uint64_t> unfinishedBlocks(const Study& study, const ResultFolder& folder,
                                            const Share& share);

/// Returns the next block to run; empty: none is available. Called from any thread with the number
/// of points run by this process.
using BlockDealer = std::function<std::optional<std::uint64_t>(std::uint64_t done)>;

/// Called ten times a second, by the thread that called sweep(), with the number of completed
/// points.
using SweepProgress = std::function<void(std::uint64_t done)>;

/// Runs the dealt blocks. Results are independent of the number of workers and of the assignment of
/// blocks. `stop` may be set from outside, by a signal handler: unfinished blocks are discarded.
/// Throws RunFailure if it was stopped, if a block could not be written, or if a point failed and
/// the study is configured to stop then.
void sweep(const Study& study, const ResultFolder& folder, unsigned workers,
           const BlockDealer& dealer, std::atomic<bool>& stop, const SweepProgress& progress);

/// Deals these blocks in order, to any thread.
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
