#include "transport/lcm_publisher.h"

#include "transport/lcm_connection.h"
#include "transport/lcm_converters.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

LcmPublisher::LcmPublisher(const std::string& url) {
  if (url.empty()) {
    return;
  }
  try {
    lcm_ = openLcm(url);
  } catch (const LcmNotAvailable& problem) {
    warning_ = std::string(problem.what()) + "; nothing is sent on LCM";
  }
}

template <class State>
void LcmPublisher::send(const State& state) {
  if (!lcm_) {
    return;
  }
  const auto message = toLcm(state);
  ++(lcm_->publish(channelOf(state), &message) == 0 ? sent_ : failed_);
}

void LcmPublisher::publish(const state::WhirlState& whirl) {
  send(whirl);
}

void LcmPublisher::publish(const state::PendulumState& pendulum) {
  send(pendulum);
}

void LcmPublisher::publish(const state::DriveState& drive) {
  send(drive);
}

void LcmPublisher::publish(const state::MotorState& motor) {
  send(motor);
}

void LcmPublisher::publish(const state::EnsembleState& ensemble) {
  send(ensemble);
}

void LcmPublisher::publish(const state::StabilityMargin& margin) {
  send(margin);
}

void LcmPublisher::publish(const state::ParameterChange& change) {
  send(change);
}

void LcmPublisher::publish(const state::Alert& alert) {
  send(alert);
}

}  // namespace whirl_twin
