// The order in which the states of one source arrive. Datagrams come late, twice or garbled, and a
// source that begins anew is not told from that by a single one of them: what is out of step is not
// believed, unless nothing else comes for half a second.
#pragma once

#include <optional>

namespace whirl_twin {

class SourceClock {
 public:
  enum class Order {
    kInStep,     ///< the next state of its source
    kOutOfStep,  ///< older than the newest, the same again, or far in the future
    kFollowed,   ///< out of step, as all have been for so long that these are the states now
  };

  /// A state that holds at time [s, simulated] arrived at wall_time [s]; pace: simulated time
  /// beside wall time, as far as it is known to go faster.
  Order take(double time, double wall_time, double pace = 1.0);
  /// The next state is one from soon after `time` on: the source has said that it begins there.
  void restartAt(double time, double wall_time);

 private:
  struct Arrival {
    double time;       ///< [s], simulated
    double wall_time;  ///< [s]
  };
  std::optional<Arrival> newest_;
  std::optional<Arrival> other_;  ///< newest of those out of step, in a row
  double other_since_ = 0.0;      ///< [s], wall time of the first of them
};

}  // namespace whirl_twin
