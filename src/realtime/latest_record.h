// The newest of a series of records, from one producer thread to one consumer thread, wait-free on
// both sides: what the consumer has not taken in time is replaced, never waited for. Three rooms
// (triple buffering): one is written, one is read, and one is between, exchanged in one operation.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whirl_twin {

class LatestRecord {
 public:
  /// Of `size` doubles.
  explicit LatestRecord(std::size_t size) {
    for (std::vector<double>& room : rooms_) {
      room.resize(size);
    }
  }

  // Real-time safe.

  /// Producer: where the next record is written.
  double* room() noexcept { return rooms_[written_].data(); }
  /// Producer: room() is the newest record from now on.
  void publish() noexcept {
    written_ = between_.exchange(written_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }

  /// Consumer: copies the newest record out; false if it has been taken.
  bool take(double* record) noexcept {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) {
      return false;
    }
    read_ = between_.exchange(read_, std::memory_order_acq_rel) & ~kFresh;
    std::copy(rooms_[read_].begin(), rooms_[read_].end(), record);
    return true;
  }

 private:
  static constexpr unsigned kFresh = 4;  // beside the number of a room

  std::array<std::vector<double>, 3> rooms_;
  unsigned written_ = 0;
  unsigned read_ = 1;
  std::atomic<unsigned> between_{2};
};

}  // namespace whirl_twin
