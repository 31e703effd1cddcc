// The way into the real-time loop: a slot that holds the newest value (a command), from one writer
// thread to one reader thread, wait-free on both sides. A value not read in time is overwritten:
// only the newest counts.
//
// A triple buffer: the writer fills its own buffer and exchanges it for the middle one; the reader
// exchanges its own for the middle one when that is fresh. No buffer is ever seen by both.
#pragma once

#include <array>
#include <atomic>
#include <type_traits>

namespace whirl_twin {

template <class T>
class LatestValue {
  static_assert(std::is_nothrow_copy_assignable_v<T>, "a copy must neither allocate nor throw");

 public:
  explicit LatestValue(const T& initial = T{}) : buffers_{initial, initial, initial} {}

  /// Writer: makes `value` the newest. Real-time safe.
  void write(const T& value) noexcept {
    buffers_[writing_] = value;
    writing_ = middle_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }

  /// Reader: copies the newest value out if there is one not read before, and says so; otherwise
  /// leaves `value` as it is. Real-time safe.
  bool read(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) {
      return false;
    }
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & ~kFresh;
    value = buffers_[reading_];
    return true;
  }

 private:
  static constexpr unsigned kFresh = 4;  // beside the index 0..2

  std::array<T, 3> buffers_;
  unsigned writing_ = 0;              // the writer's own
  unsigned reading_ = 1;              // the reader's own
  std::atomic<unsigned> middle_{2U};  // index | kFresh
};

}  // namespace whirl_twin
