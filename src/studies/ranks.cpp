#include "studies/ranks.h"

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

namespace whirl_twin {

namespace {

constexpr int kAsk = 1;    // to the first: number of points run by this process
constexpr int kLeave = 2;  // likewise, and no further request
constexpr int kDealt = 3;  // reply: the block, or kNone
constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
/// Polling period; blocking MPI calls use a whole core.
constexpr std::chrono::microseconds kNap{200};

}  // namespace

Ranks::Ranks() {
  int provided = 0;  // calls from several threads, one at a time
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  MPI_Finalize();
}

std::string Ranks::name() const {
  std::array<char, MPI_MAX_PROCESSOR_NAME> host{};
  int length = 0;
  MPI_Get_processor_name(host.data(), &length);
  return fmt::format("rank {} on {}", rank_, host.data());
}

void Ranks::letTheFirstGoFirst() {
  MPI_Barrier(MPI_COMM_WORLD);
}

void Ranks::end(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

void Ranks::work(const Study& study, const ResultFolder& folder, unsigned workers,
                 std::atomic<bool>& stop) {
  std::uint64_t done = 0;
  sweep(
      study, folder, workers, [&](std::uint64_t so_far) { return ask(so_far, stop); }, stop,
      [&](std::uint64_t now) { done = now; });
  MPI_Send(&done, 1, MPI_UINT64_T, 0, kLeave, MPI_COMM_WORLD);
}

void Ranks::lead(const Study& study, const ResultFolder& folder, unsigned workers,
                 const std::vector<std::uint64_t>& blocks, std::atomic<bool>& stop,
                 const SweepProgress& progress) {
  BlockDeck deck(blocks);
  std::atomic<std::uint64_t> done{0};
  std::atomic<std::uint64_t> of_others{0};
  std::atomic<bool> ended{false};
  std::thread dealer([&] {
    deal(deck, of_others, stop);
    ended.store(true);
  });
  try {
    sweep(
        study, folder, workers, [&](std::uint64_t) { return deck.next(); }, stop,
        [&](std::uint64_t now) {
          done = now;
          progress(done + of_others);
        });
  } catch (...) {
    stop.store(true);
    dealer.join();
    throw;
  }
  while (!ended.load()) {
    progress(done + of_others);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  dealer.join();
  progress(done + of_others);
}

void Ranks::deal(BlockDeck& deck, std::atomic<std::uint64_t>& done, const std::atomic<bool>& stop) {
  std::vector<std::uint64_t> done_by(static_cast<std::size_t>(count_), 0);
  for (int left = count_ - 1; left > 0 && !stop.load();) {
    int asked = 0;
    MPI_Status from{};
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &asked, &from);
    if (asked == 0) {
      std::this_thread::sleep_for(kNap);
      continue;
    }
    std::uint64_t& now = done_by[static_cast<std::size_t>(from.MPI_SOURCE)];
    const std::uint64_t before = now;
    MPI_Recv(&now, 1, MPI_UINT64_T, from.MPI_SOURCE, from.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    done += now - before;
    if (from.MPI_TAG == kLeave) {
      --left;
      continue;
    }
    const std::uint64_t block = deck.next().value_or(kNone);
    MPI_Send(&block, 1, MPI_UINT64_T, from.MPI_SOURCE, kDealt, MPI_COMM_WORLD);
  }
}

std::optional<std::uint64_t> Ranks::ask(std::uint64_t done, const std::atomic<bool>& stop) {
  const std::lock_guard<std::mutex> lock(asking_);
  MPI_Send(&done, 1, MPI_UINT64_T, 0, kAsk, MPI_COMM_WORLD);
  std::uint64_t block = kNone;
  MPI_Request dealt{};
  MPI_Irecv(&block, 1, MPI_UINT64_T, 0, kDealt, MPI_COMM_WORLD, &dealt);
  for (int here = 0; here == 0;) {
    MPI_Test(&dealt, &here, MPI_STATUS_IGNORE);
    if (here == 0) {
      if (stop.load()) {
        MPI_Cancel(&dealt);
        MPI_Wait(&dealt, MPI_STATUS_IGNORE);
        return std::nullopt;
      }
      std::this_thread::sleep_for(kNap);
    }
  }
  return block == kNone ? std::nullopt : std::optional(block);
}

}  // namespace whirl_twin
