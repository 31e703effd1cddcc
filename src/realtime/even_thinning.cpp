#include "realtime/even_thinning.h"

#include <algorithm>

namespace whirl_twin {

namespace {

constexpr std::size_t kLooks = 8;           // polls while a full ring of records passes
constexpr int kCalmLooks = 16;              // after which a higher rate is tried: two full rings
constexpr std::int64_t kMaxLeftOut = 4096;  // one record in so many still shows the course

}  // namespace

EvenThinning::EvenThinning(std::size_t capacity) : capacity_(capacity) {}

void EvenThinning::consumed(std::size_t waiting) noexcept {
  if (++since_look_ < std::max<std::size_t>(1, capacity_ / kLooks)) {
    return;
  }
  since_look_ = 0;
  if (waiting > capacity_ / 2) {
    calm_looks_ = 0;
    if (waiting >= waiting_before_) {  // the present decimation is not enough
      every_ = std::min(2 * every_, kMaxLeftOut);
    }
  } else if (waiting > capacity_ / 16) {
    calm_looks_ = 0;
  } else if (++calm_looks_ >= kCalmLooks) {
    calm_looks_ = 0;
    every_ = std::max<std::int64_t>(1, every_ / 2);
  }
  waiting_before_ = waiting;
}

}  // namespace whirl_twin
