// Many processes at one study, on one machine or many, started by mpirun or srun (MPI). The first
// deals the blocks out as they are asked for; each runs what it is dealt on threads of its own and
// writes what it has finished into the folder, which all of them see. A process that dies ends them
// all: finished blocks are on the disk, and the same command goes on.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "studies/sweep.h"

namespace whirl_twin {

/// Of this process's life, once.
class Ranks {
 public:
  Ranks();
  /// Waits for the others.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool first() const { return rank_ == 0; }
  /// "rank 3 on host"
  std::string name() const;
  /// The others wait in here for the first.
  void letTheFirstGoFirst();
  /// Ends all of them, with this exit status.
  [[noreturn]] void end(int status);

  /// In the first: runs these blocks with the others. `progress` is that of all of them. Returns
  /// when every one has ended; throws as sweep().
  void lead(const Study& study, const ResultFolder& folder, unsigned workers,
            const std::vector<std::uint64_t>& blocks, std::atomic<bool>& stop,
            const SweepProgress& progress);
  /// In the others: runs what the first deals. Throws as sweep().
  void work(const Study& study, const ResultFolder& folder, unsigned workers,
            std::atomic<bool>& stop);

 private:
  void deal(BlockDeck& deck, std::atomic<std::uint64_t>& done, const std::atomic<bool>& stop);
  std::optional<std::uint64_t> ask(std::uint64_t done, const std::atomic<bool>& stop);

  int rank_ = 0;
  int count_ = 1;
  std::mutex asking_;
};

}  // namespace whirl_twin
