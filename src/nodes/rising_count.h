// Detects a recent increase of an error count, for diagnostics that recover afterwards.
#pragma once

#include <cstdint>

namespace whirl_twin {

class RisingCount {
 public:
  /// The count is `now` at `time` [s, a monotonic clock]; returns whether it rose within the last
  /// ten seconds.
  bool roseLately(std::uint64_t now, double time) {
    if (now > count_) {
      rose_ = time;
    }
    count_ = now;
    return time - rose_ < kLately;
  }

 private:
  static constexpr double kLately = 10.0;  // s

  std::uint64_t count_ = 0;
  double rose_ = -1.0e9;  // [s]
};

}  // namespace whirl_twin
