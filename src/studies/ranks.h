// Distributes a study over MPI processes on one or more machines, started by mpirun or srun. The
// first process deals blocks on request; each runs them on its own threads and writes finished
// blocks into the folder, which must be shared. If a process dies all are terminated: finished
// blocks are on the disk, and the same command resumes the study.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "studies/sweep.h"

namespace whirl_twin {

/// One instance per process.
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
  /// Barrier: the others wait here for the first process.
  void letTheFirstGoFirst();
  /// Terminates all processes with this exit status.
  [[noreturn]] void end(int status);

  /// In the first process: runs these blocks with the others; `progress` covers all of them.
  /// Returns when all have ended; throws as sweep().
  void lead(const Study& study, const ResultFolder& folder, unsigned workers,
            const std::vector<std::uint64_t>& blocks, std::atomic<bool>& stop,
            const SweepProgress& progress);
  /// In the other processes: runs the blocks dealt by the first. Throws as sweep().
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
