// What a consumer that is too slow for all records leaves out: evenly, one of so many is taken, and
// no more than must be. Left to itself a full ring drops records in bursts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace whirl_twin {

class EvenThinning {
 public:
  /// Of a ring with room for so many records, one at least.
  explicit EvenThinning(std::size_t capacity);

  /// After a record has been consumed, with so many still waiting.
  void consumed(std::size_t waiting) noexcept;
  /// One record of so many is to be taken: a power of two.
  std::int64_t every() const noexcept { return every_; }

 private:
  std::size_t capacity_;
  std::size_t since_look_ = 0;      // records
  std::size_t waiting_before_ = 0;  // at the look before
  int calm_looks_ = 0;
  std::int64_t every_ = 1;
};

}  // namespace whirl_twin
