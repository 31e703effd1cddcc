// How far the machine's clock is from the twin's, and how fast it gains, from when messages arrive:
// none arrives before it was sent, so that the least delay in some time tells, and the way it goes
// from one time to the next. What is always late by the same, a block's length, say, counts as
// offset.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace whirl_twin {

class ClockWatch {
 public:
  /// A message whose newest sample is of an instant [ns] of the machine's clock arrived at one of
  /// the twin's.
  void take(std::int64_t machine, std::int64_t twin);
  /// Begins anew, as where the machine's clock has been set; the offset stays in relation to the
  /// first; but a clock that counts from elsewhere, from the machine's own start, has a new one.
  void restart();

  /// [s], machine less twin. Of clocks that are more than a day apart, which do not count from the
  /// same, less what it was at first. NaN: not known yet.
  double offset() const;
  double deviation() const;  ///< [s], of the offset; NaN: not known
  /// [-], seconds that the machine's clock gains in one; NaN: not known to 1e-4, as where delays
  /// come and go.
  double drift() const;

 private:
  /// Of the windows: the straight line through them.
  struct Line {
    double slope = 0.0;            // [-]
    double deviation = 0.0;        // [s], of a window from the line
    double slope_deviation = 0.0;  // [-]
  };
  Line line() const;

  struct Window {
    double middle = 0.0;  // [s], of the twin's clock, from the first message on
    double most = 0.0;    // [s], machine less twin, less what it was at first
  };

  std::int64_t first_ = 0;       // [ns], machine less twin
  std::int64_t first_twin_ = 0;  // [ns]
  bool began_ = false;
  std::int64_t window_start_ = 0;                           // [ns]
  double most_ = -std::numeric_limits<double>::infinity();  // [s], in the present window
  std::vector<Window> windows_;                             // the last of them
};

}  // namespace whirl_twin
