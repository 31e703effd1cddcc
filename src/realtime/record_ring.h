// The way out of the real-time loop: a ring of records, each a fixed number of doubles, from one
// producer thread to one consumer thread, wait-free on both sides. When the consumer is behind,
// the newest record is dropped and counted; the producer never waits.
//
// Built on boost::lockfree::spsc_queue<double>, whose push(pointer, n) copies what fits and then
// publishes it with one store of the write index. The room for a whole record is checked first, and
// it can only grow meanwhile (only the producer fills it), so a record is never split; the same
// holds for pop the other way round.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace whirl_twin {

// The newest of a series of records, from one producer thread to one consumer thread, wait-free on
// both sides: what the consumer has not taken in time is replaced, never waited for. Three rooms
// (triple buffering): one is written, one is read, and one is between, exchanged in one operation.

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

class RecordRing {
 public:
  /// `record_size` [doubles] and `capacity_records` are at least 1, else std::logic_error.
  RecordRing(std::size_t record_size, std::size_t capacity_records);
  ~RecordRing();
  RecordRing(const RecordRing&) = delete;
  RecordRing& operator=(const RecordRing&) = delete;

  /// Producer: copies recordSize() doubles in; false, and counted, when there is no room for them.
  /// Real-time safe.
  bool push(const double* record) noexcept;

  /// Producer: is there room for so many records? Real-time safe.
  bool hasRoomFor(std::size_t records) const noexcept;

  /// Consumer: copies the oldest record out; false when there is none. Real-time safe.
  bool pop(double* record) noexcept;

  /// Consumer: records that wait for it.
  std::size_t waiting() const noexcept;

  std::size_t capacity() const noexcept { return capacity_; }

  /// Records that found no room. Any thread.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  std::size_t recordSize() const noexcept { return record_size_; }

 private:
  struct Values;  ///< the queue: its headers are long, and these are read with every controller

  std::size_t record_size_;
  std::size_t capacity_;
  std::unique_ptr<Values> values_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace whirl_twin
