#include "transport/ros_topics.h"

namespace whirl_twin {

void RosTopics::publishAlerts(const std::vector<state::Alert>& alerts, std::int64_t stamp) {
  topicsOf<state::Alert>("").state.publish(toRos(alerts, stamp));
}

}  // namespace whirl_twin
