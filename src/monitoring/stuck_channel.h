// A channel of measurement that is stuck: it moved, in every sample, and from one to the next no
// digit changes any more.
//
// What is told apart from it: a motion that dies away (its steps shrink to the last digit before
// they stop), a machine at rest, a resolution so coarse that samples are often alike (it has not
// moved in every sample), a rate of sampling that keeps step with the motion (likewise). So a
// channel that repeated itself now and then before it got stuck is not told.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl_twin {

class StuckChannel {
 public:
  void take(double value) {
    if (value == last_) {
      if (alike_++ == 0) {
        in_motion_ = moves_ >= kMoves && std::max(newest_, older_) >= kCoarse * smallest_ &&
                     std::max(newest_, older_) >= kFine * (std::fabs(value) + newest_);
      }
      moves_ = 0;
      return;
    }
    const double step = std::fabs(value - last_);
    last_ = value;
    alike_ = 0;
    in_motion_ = false;
    if (std::isfinite(step)) {
      ++moves_;
      older_ = std::exchange(newest_, step);
      smallest_ = std::min(smallest_, step);
    }
  }
  bool stuck() const { return in_motion_ && alike_ >= kAlike; }

 private:
  static constexpr int kMoves = 8;         ///< samples that it has moved in
  static constexpr int kAlike = 20;        ///< samples that are the same, besides the first
  static constexpr double kCoarse = 4.0;   ///< times the resolution, as far as it has shown
  static constexpr double kFine = 1.0e-7;  ///< of the value: a motion that has died away is slower

  double last_ = std::numeric_limits<double>::quiet_NaN();
  int moves_ = 0;  ///< in a row
  int alike_ = 0;  ///< in a row
  bool in_motion_ = false;
  double newest_ = 0.0, older_ = 0.0;  ///< steps, the last two
  double smallest_ = std::numeric_limits<double>::infinity();
};

}  // namespace whirl_twin
