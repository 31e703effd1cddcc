// Output of the real-time loop: a ring buffer of records, each a fixed number of doubles, from one
// producer thread to one consumer thread, wait-free on both sides. When the consumer is behind,
// the newest record is dropped and counted; the producer never waits.
//
// Built on boost::lockfree::spsc_queue<double>, whose push(pointer, n) copies what fits and then
// publishes it with one store of the write index. The space for a whole record is checked first,
// and it can only grow meanwhile (only the producer fills it), so a record is never split; the
// converse holds for pop.
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
// both sides: a record that was not read in time is replaced. Triple buffering: one buffer is
// written, one is read, and one is between, exchanged in one atomic operation.

class LatestRecord {
 public:
  /// Of `size` doubles.
  explicit LatestRecord(std::size_t size) {
    for (std::vector<double>& room : rooms_) {
      room.resize(size);
    }
  }

  // Real-time safe.

  /// Producer: the buffer of the next record.
  double* room() noexcept { return rooms_[written_].data(); }
  /// Producer: room() becomes the newest record.
  void publish() noexcept {
    written_ = between_.exchange(written_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }

  /// Consumer: copies the newest record out; false if it was already read.
  bool take(double* record) noexcept {
    if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) {
      return false;
    }
    read_ = between_.exchange(read_, std::memory_order_acq_rel) & ~kFresh;
    std::copy(rooms_[read_].begin(), rooms_[read_].end(), record);
    return true;
  }

 private:
  static constexpr unsigned kFresh = 4;  // flag bit beside the buffer index

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

  /// Producer: copies recordSize() doubles in; false, and counted, if the ring is full. Real-time
  /// safe.
  bool push(const double* record) noexcept;

  /// Producer: is there space for so many records? Real-time safe.
  bool hasRoomFor(std::size_t records) const noexcept;

  /// Consumer: copies the oldest record out; false when there is none. Real-time safe.
  bool pop(double* record) noexcept;

  /// Consumer: number of waiting records.
  std::size_t waiting() const noexcept;

  std::size_t capacity() const noexcept { return capacity_; }

  /// Records dropped because the ring was full. Any thread.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  std::size_t recordSize() const noexcept { return record_size_; }

 private:
  struct Values;  ///< the queue: its headers are large, and every controller includes this file

  std::size_t record_size_;
  std::size_t capacity_;
  std::unique_ptr<Values> values_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace whirl_twin
