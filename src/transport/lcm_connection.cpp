#include "transport/lcm_connection.h"

#include <fmt/format.h>

#include "transport/channels.h"

namespace whirl_twin {

std::shared_ptr<lcm::LCM> openLcm(const std::string& url) {
  auto lcm = std::make_shared<lcm::LCM>(url);
  if (!lcm->good()) {
    const bool multicast = url.compare(0, 5, "udpm:") == 0;
    throw LcmNotAvailable(fmt::format(
        "lcm_url: LCM cannot be opened at '{}'{}", url,
        multicast
            ? " (is there a route for multicast? On one machine: ip link set lo multicast on; "
              "ip route add 224.0.0.0/4 dev lo)"
            : fmt::format("; expected a url such as {}", kDefaultLcmUrl)));
  }
  return lcm;
}

int handleArrived(lcm::LCM& lcm, std::chrono::milliseconds timeout, int most) {
  int handled = 0;
  int wait = static_cast<int>(timeout.count());
  while (handled < most && lcm.handleTimeout(wait) > 0) {
    ++handled;
    wait = 0;
  }
  return handled;
}

}  // namespace whirl_twin
