// The way out of the real-time loop: a ring of records, each a fixed number of doubles, from one
// producer thread to one consumer thread, wait-free on both sides. When the consumer is behind,
// the newest record is dropped and counted; the producer never waits.
//
// Built on boost::lockfree::spsc_queue<double>, whose push(pointer, n) copies what fits and then
// publishes it with one store of the write index. The room for a whole record is checked first, and
// it can only grow meanwhile (only the producer fills it), so a record is never split; the same
// holds for pop the other way round.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace whirl_twin {

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
