#include "transport/lcm_publisher.h"

#include <utility>

#include "transport/lcm_connection.h"

namespace whirl_twin {

LcmPublisher::LcmPublisher(const std::string& url, std::string prefix)
    : prefix_(std::move(prefix)) {
  if (url.empty()) {
    return;
  }
  try {
    lcm_ = openLcm(url);
  } catch (const LcmNotAvailable& problem) {
    warning_ = std::string(problem.what()) + "; nothing is sent on LCM";
  }
}

LcmPublisher::LcmPublisher(std::shared_ptr<lcm::LCM> lcm, std::string prefix)
    : lcm_(std::move(lcm)), prefix_(std::move(prefix)) {}

void LcmPublisher::send(const std::string& channel) {
  const int failed =
      lcm_->publish(channel, payload_.data(), static_cast<unsigned int>(payload_.size()));
  ++(failed == 0 ? sent_ : failed_);
}

}  // namespace whirl_twin
