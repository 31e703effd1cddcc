// A count of what should not happen, for diagnostics that say so and recover when it is over.
#pragma once

#include <cstdint>

namespace whirl_twin {

class RisingCount {
 public:
  /// The count is `now` at `time` [s, a clock that nobody sets]; whether it rose within the last
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
