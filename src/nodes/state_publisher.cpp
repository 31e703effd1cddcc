#include "nodes/state_publisher.h"

#include <rosgraph_msgs/Clock.h>

#include <utility>

namespace whirl_twin {

namespace {

constexpr std::uint32_t kStateQueue = 2000;  // two seconds at 1 kHz

/// Publishes to ROS and to LCM, which has no latched topics.
struct StepSink {
  RosTopics& topics;
  LcmPublisher& lcm;

  template <class Make>
  void operator()(const std::string& subject, Make make) {
    using State = decltype(make());
    const bool wanted = topics.wanted<State>(subject);
    if (!wanted && !lcm.on()) {
      return;
    }
    const State state = make();
    lcm.publish(state);
    if (wanted) {
      topics.publish(state);
    }
  }
  void change(const state::ParameterChange& change) {
    topics.publish(change);
    lcm.publish(change);
  }
  void again(const state::ParameterChange& change) { lcm.publish(change); }
};

}  // namespace

StatePublisher::StatePublisher(const Twin& twin, EnsembleObserver ensembles, ros::NodeHandle node,
                               LcmPublisher lcm, std::int64_t clock_period)
    : twin_(twin),
      messages_(twin.built()),
      ensembles_(std::move(ensembles)),
      topics_(node, kStateQueue),
      lcm_(std::move(lcm)),
      clock_period_(clock_period),
      last_clock_(-clock_period) {
  topics_.collect();
  messages_.announce([this](auto kind, const std::string& subject) {
    using State = typename decltype(kind)::State;
    requireChannelFits(channelName(State::kKind, subject, lcm_.prefix()));
    topics_.advertise<State>(subject);
  });
  topics_.advertise<state::LoopStatistics>();
  topics_.advertise<state::SceneText>();
  if (clock_period > 0) {
    clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  }
}

void StatePublisher::publish(const Observer& observer, bool all) {
  messages_.tell(observer, all, StepSink{topics_, lcm_});
  const std::int64_t time = observer.instant().stamp;
  if (all && clock_ && time - last_clock_ >= clock_period_) {
    publishClock(observer);
    last_clock_ = time;
  }
}

void StatePublisher::republishParameters() {
  messages_.tellAgain(StepSink{topics_, lcm_});
}

void StatePublisher::publishEnsembles(const Observer& observer) {
  const auto take = [this](std::size_t system, const state::Instant& now,
                           state::EnsembleState& ensemble) {
    const std::string& name = twin_.systems()[system]->spec.name;
    return (lcm_.on() || topics_.wanted<state::EnsembleState>(name)) &&
           ensembles_.take(system, now, ensemble);
  };
  messages_.tellEnsembles(observer, take, StepSink{topics_, lcm_});
}

void StatePublisher::publishOrders(const Observer& observer, const OrderObserver& orders) {
  messages_.tellOrders(observer, orders, StepSink{topics_, lcm_});
}

void StatePublisher::publishClock(const Observer& observer) {
  rosgraph_msgs::Clock message;
  message.clock.fromNSec(static_cast<std::uint64_t>(observer.instant().stamp));
  clock_.publish(message);
}

}  // namespace whirl_twin
