// Offset and drift of the machine's clock relative to the twin's, from the arrival times of
// messages. No message arrives before it was sent: the smallest delay of each window gives the
// offset, its change from window to window the drift. A constant delay, such as the duration of a
// block, is part of the offset.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace whirl_twin {

class ClockOffsetEstimator {
 public:
  /// A message arrived: `machine` [ns] is the instant of its newest sample on the machine's clock,
  /// `twin` [ns] its arrival on the twin's clock.
  void take(std::int64_t machine, std::int64_t twin);
  /// Restarts, for a machine's clock that has been set. The reference of the offset is kept, but
  /// for clocks that differ by a day or more (a clock that counts from the machine's start): these
  /// get a new one.
  void restart();

  /// [s], machine less twin. For clocks that differ by a day or more, which have different origins,
  /// relative to the first value. NaN: not known yet.
  double offset() const;
  double deviation() const;  ///< [s], of the offset; NaN: not known
  /// [-], seconds that the machine's clock gains per second; NaN: standard deviation above 1e-4, as
  /// with varying delays.
  double drift() const;

 private:
  /// Straight line through the windows.
  struct Line {
    double slope = 0.0;            // [-]
    double deviation = 0.0;        // [s], standard deviation of a window from the line
    double slope_deviation = 0.0;  // [-]
  };
  Line line() const;

  struct Window {
    double middle = 0.0;  // [s], of the twin's clock, since the first message
    double most = 0.0;    // [s], largest of machine less twin, relative to the first value
  };

  std::int64_t first_ = 0;       // [ns], machine less twin
  std::int64_t first_twin_ = 0;  // [ns]
  bool began_ = false;
  std::int64_t window_start_ = 0;                           // [ns]
  double most_ = -std::numeric_limits<double>::infinity();  // [s], in the current window
  std::vector<Window> windows_;                             // the most recent ones
};

}  // namespace whirl_twin
