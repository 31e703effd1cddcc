// What happens to alerts, on LCM and in the node's log. LCM latches nothing and loses what it
// likes: the alerts that stand are told again every few seconds.
#pragma once

#include <vector>

#include "messages/alert.h"
#include "transport/lcm_publisher.h"

namespace whirl_twin {

class AlertEvents {
 public:
  explicit AlertEvents(LcmPublisher& lcm) : lcm_(lcm) {}

  void tell(const state::Alert& event);
  /// Those that stand, where it is time for it; now [s] is of a clock that nobody sets.
  void tellAgain(const std::vector<state::Alert>& active, double now);

 private:
  LcmPublisher& lcm_;
  double newest_ = 0.0;  // [s], simulated, of the events told
  double next_ = 0.0;    // [s]
};

}  // namespace whirl_twin
