// Order tracking of a twin's rotors at their published stations, from every record: in the
// publisher's thread, not in the real-time thread.
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
  /// The twin must outlive it.
  explicit OrderObserver(const Twin& twin);

  /// The next record; must be called for every one, also for those the observer skips. The observer
  /// must have this one, or an earlier one with the same parameters.
  void take(const double* record, const Observer& observer);
  bool empty() const { return followed_.empty(); }  ///< no rotor
  /// Orders are published at this step, for which the observer needs its record.
  bool dueAt(std::int64_t step) const;

  /// Calls the function (subject, make) for the stations of these systems that are due at the
  /// observer's step; make() returns the OrderState. None for a stopped system.
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
  std::int64_t period_;  // steps between publications
};

}  // namespace whirl_twin
