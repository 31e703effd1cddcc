// Follows the orders of a twin's rotors, each where its whirl is published, from every record: on
// the side of the publisher, not in the real-time thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "messages/order_state.h"
#include "signal/order_filter.h"
#include "twin/observer.h"

namespace whirl_twin {

class OrderObserver {
 public:
  /// The twin outlives it.
  explicit OrderObserver(const Twin& twin);

  /// Takes the next record: every one, also those that the observer need not see. The observer has
  /// seen this one, or one before of the same parameters.
  void take(const double* record, const Observer& observer);
  bool empty() const { return followed_.empty(); }  ///< there is no rotor
  /// At this step orders are told, and the observer has to have seen its record.
  bool dueAt(std::int64_t step) const;

  /// tell(subject, make) for the stations of these systems whose turn it is at the observer's step;
  /// make() is the OrderState. Of a system that has stopped there are none.
  template <class Tell>
  void tell(const Observer& observer, const std::vector<std::size_t>& systems, Tell&& tell) const {
    for (const Followed* followed : turnOf(observer)) {
      if (std::find(systems.begin(), systems.end(), followed->system) == systems.end()) {
        continue;
      }
      tell(observer.stations(followed->system)[followed->station],
           [&observer, followed] { return orderState(observer, *followed); });
    }
  }

 private:
  struct Followed {
    std::size_t system;
    std::size_t station;
    OrderFilter filter;
  };

  static state::OrderState orderState(const Observer& observer, const Followed& followed);
  std::vector<const Followed*> turnOf(const Observer& observer) const;

  std::vector<Followed> followed_;
  std::int64_t period_;  // steps from one telling to the next
};

}  // namespace whirl_twin
