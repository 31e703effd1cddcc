#include "transport/lcm_connection.h"

#include <fmt/format.h>
#include <poll.h>

#include <ctime>

#include "transport/channels.h"

namespace whirl_twin {

std::shared_ptr<lcm::LCM> openLcm(const std::string& url) {
  auto lcm = std::make_shared<lcm::LCM>(url);
  if (!lcm->good()) {
    const bool multicast = url.compare(0, 5, "udpm:") == 0;
    throw LcmNotAvailable(fmt::format(
        "lcm_url: LCM cannot be opened at '{}'{}", url,
        multicast ? " (check the multicast route; on one machine: ip link set lo multicast on; "
                    "ip route add 224.0.0.0/4 dev lo)"
                  : fmt::format("; must be a URL such as {}", kDefaultLcmUrl)));
  }
  return lcm;
}

int handleArrived(lcm::LCM& lcm, std::chrono::microseconds timeout, int most) {
  // LCM's timeout has a resolution of 1 ms.
  pollfd arrival{lcm.getFileno(), POLLIN, 0};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec wait{static_cast<std::time_t>(seconds.count()),
                      static_cast<long>(1000 * (timeout - seconds).count())};
  if (timeout.count() > 0 && ppoll(&arrival, 1, &wait, nullptr) <= 0) {
    return 0;
  }
  int handled = 0;
  while (handled < most && lcm.handleTimeout(0) > 0) {
    ++handled;
  }
  return handled;
}

}  // namespace whirl_twin
