// Uniform decimation for a consumer too slow for all records: it receives one record in n, with the
// smallest n possible. Without it a full ring drops records in bursts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace whirl_twin {

class EvenThinning {
 public:
  /// `capacity`: of the ring, in records, at least one.
  explicit EvenThinning(std::size_t capacity);

  /// To be called after a record was consumed, with the number of those still waiting.
  void consumed(std::size_t waiting) noexcept;
  /// One record in so many is to be used: a power of two.
  std::int64_t every() const noexcept { return every_; }

 private:
  std::size_t capacity_;
  std::size_t since_look_ = 0;      // records
  std::size_t waiting_before_ = 0;  // at the previous poll
  int calm_looks_ = 0;
  std::int64_t every_ = 1;
};

}  // namespace whirl_twin
