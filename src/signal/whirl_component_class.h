// Class of a non-synchronous line, from its dependence on the speed: oil whirl keeps its ratio to
// the speed, whip (and any free vibration) its frequency.
#pragma once

#include <cmath>

namespace whirl_twin {

class WhirlComponentClass {
 public:
  enum class Kind { kUnknown, kKeepsRatio, kKeepsFrequency };

  /// The line at a speed of the shaft, both in rad/s and not 0.
  void take(double frequency, double speed) {
    const double x = std::log(std::fabs(speed));
    const double y = std::log(std::fabs(frequency));
    ++count_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }
  void clear() { *this = {}; }

  /// From the slope of log frequency over log speed: 1 or 0. Unknown where the speeds did not
  /// differ enough, or the slope is neither.
  Kind kind() const {
    constexpr double kMinSpread = 0.02;  // standard deviation of the speeds, of their mean
    constexpr double kClose = 0.3;
    const double variance = count_ > 1.0 ? (xx_ - x_ * x_ / count_) / count_ : 0.0;
    if (!(variance > kMinSpread * kMinSpread)) {
      return Kind::kUnknown;
    }
    const double slope = (xy_ - x_ * y_ / count_) / count_ / variance;
    return std::fabs(slope - 1.0) < kClose ? Kind::kKeepsRatio
           : std::fabs(slope) < kClose     ? Kind::kKeepsFrequency
                                           : Kind::kUnknown;
  }

 private:
  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

}  // namespace whirl_twin
