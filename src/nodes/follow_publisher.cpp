#include "nodes/follow_publisher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transport/master_watch.h"

namespace whirl_twin {

FollowPublisher::FollowPublisher(Twin& twin, std::shared_ptr<SystemGenerations> generations,
                                 const std::vector<std::string>& sources, ros::NodeHandle node,
                                 LcmPublisher lcm, state::SceneText scene)
    : observer_(twin, std::move(generations)),
      orders_(twin),
      states_(twin, EnsembleObserver(twin), node, std::move(lcm)),
      scene_(std::move(scene)) {
  for (const SystemSpec& system : twin.scene().systems) {
    states_.advertise<state::FollowState>(system.name);
  }
  for (const std::string& source : sources) {
    states_.advertise<state::Measurement>(source);
  }
  scene_.at.stamp = stampNow();
  states_.tell(scene_);
}

void FollowPublisher::publish(const double* record) {
  observer_.observe(record);
  orders_.take(record, observer_);
  observer_.setStamp(stamp_);
  states_.publish(observer_, !observer_.tellsOnlyChange());
  if (orders_.dueAt(observer_.step())) {
    states_.publishOrders(observer_, orders_);
  }
}

void FollowPublisher::tellAgain() {
  states_.tellAgain(scene_);
  states_.republishParameters();
}

void FollowPublisher::publish(state::FollowState state) {
  state.at.stamp = stamp_;
  states_.tell(state);
  published_[state.system] = state;
}

void FollowPublisher::publishSilence(double silent, double step_seconds) {
  for (const auto& [system, last] : published_) {
    state::FollowState state = last;
    state.at.time += silent;
    state.at.step += std::llround(silent / step_seconds);
    state.at.stamp += std::llround(1.0e9 * silent);
    std::fill(state.channel_status.begin(), state.channel_status.end(),
              static_cast<std::uint8_t>(state::ChannelStatus::kSilent));
    std::fill(state.residual.begin(), state.residual.end(), state::FollowState::kNone);
    states_.tell(state);
  }
  send();
}

}  // namespace whirl_twin
