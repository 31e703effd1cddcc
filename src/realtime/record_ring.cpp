#include "realtime/record_ring.h"

#include <boost/lockfree/spsc_queue.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace whirl_twin {
namespace {

std::size_t doublesNeeded(std::size_t record_size, std::size_t capacity_records) {
  if (record_size == 0 || capacity_records == 0) {
    throw std::logic_error(
        "record ring: expected a record size of at least 1 double and a capacity of at least 1 "
        "record, found " +
        std::to_string(record_size) + " and " + std::to_string(capacity_records));
  }
  if (capacity_records > std::numeric_limits<std::size_t>::max() / sizeof(double) / record_size) {
    throw std::logic_error("record ring: " + std::to_string(capacity_records) + " records of " +
                           std::to_string(record_size) + " doubles exceed the memory");
  }
  return record_size * capacity_records;
}

}  // namespace

struct RecordRing::Values : boost::lockfree::spsc_queue<double> {
  using spsc_queue::spsc_queue;
};

RecordRing::RecordRing(std::size_t record_size, std::size_t capacity_records)
    : record_size_(record_size),
      capacity_(capacity_records),
      values_(std::make_unique<Values>(doublesNeeded(record_size, capacity_records))) {}

RecordRing::~RecordRing() = default;

bool RecordRing::push(const double* record) noexcept {
  if (values_->write_available() < record_size_) {
    // Only this thread writes the count; the atomic store prevents data races with readers.
    dropped_.store(dropped() + 1, std::memory_order_relaxed);
    return false;
  }
  values_->push(record, record_size_);
  return true;
}

bool RecordRing::hasRoomFor(std::size_t records) const noexcept {
  return values_->write_available() / record_size_ >= records;
}

bool RecordRing::pop(double* record) noexcept {
  if (values_->read_available() < record_size_) {
    return false;
  }
  values_->pop(record, record_size_);
  return true;
}

std::size_t RecordRing::waiting() const noexcept {
  return values_->read_available() / record_size_;
}

}  // namespace whirl_twin
