#include "nodes/lcm_bridge.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace whirl_twin {

NewestStates::NewestStates(std::chrono::microseconds period,
                           std::function<void(const Message&)> tell,
                           std::function<std::int64_t()> now)
    : period_(period), tell_(std::move(tell)), now_(std::move(now)), published_at_(now_()) {}

void NewestStates::take(const Message& message, std::int64_t arrived) {
  std::visit(
      [&](const auto& state) {
        using State = std::decay_t<decltype(state)>;
        if (period_.count() == 0 || !State::kKind.has(MessageKind::kSeries)) {
          tellAll();
          return tell(message, arrived);
        }
        const auto [place, is_new] =
            kept_.insert_or_assign({&State::kKind, subjectOf(state)}, Kept{message, arrived});
        left_out_ += is_new ? 0 : 1;
      },
      message);
}

void NewestStates::tellDue() {
  if (now_() - published_at_ >= period_.count()) {
    tellAll();
    published_at_ = now_();
  }
}

std::chrono::microseconds NewestStates::nextDue(std::chrono::microseconds longest) const {
  const std::chrono::microseconds left(published_at_ + period_.count() - now_());
  return kept_.empty() ? longest : std::clamp(left, std::chrono::microseconds(1), longest);
}

void NewestStates::tellAll() {
  for (const auto& [whose, kept] : kept_) {
    tell(kept.message, kept.arrived);
  }
  kept_.clear();
}

void NewestStates::tell(const Message& message, std::int64_t arrived) {
  tell_(message);
  latency_.add(1000 * (now_() - arrived));
}

namespace {

/// Messages queued for a slow subscriber: 100 s at 1 kHz, 10 s of a log played ten times faster.
constexpr std::uint32_t kQueueSize = 100000;
const ros::WallDuration kConnectTimeout(2.0);
const ros::WallDuration kConnectPoll(0.001);

/// Number of nodes subscribed to a topic by the master's registration; 0 without a master.
std::size_t subscribersOf(const std::string& topic) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;  // [publishers, subscribers, services], each [[topic, [nodes]], ...]
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, payload, false)) {
    return 0;
  }
  auto& subscribed = payload[1];
  // NOLINTNEXTLINE(modernize-loop-convert): XmlRpcValue iterates structs only.
  for (int i = 0; i < subscribed.size(); ++i) {
    if (static_cast<std::string&>(subscribed[i][0]) == topic) {
      return static_cast<std::size_t>(subscribed[i][1].size());
    }
  }
  return 0;
}

void awaitSubscribers(const ros::Publisher& publisher) {
  const std::size_t expected = subscribersOf(publisher.getTopic());
  const ros::WallTime deadline = ros::WallTime::now() + kConnectTimeout;
  while (publisher.getNumSubscribers() < expected && ros::ok()) {
    if (ros::WallTime::now() > deadline) {
      ROS_WARN("%s: %zu nodes have subscribed, only %u are connected; continuing",
               publisher.getTopic().c_str(), expected, publisher.getNumSubscribers());
      return;
    }
    kConnectPoll.sleep();
  }
}

/// Most severe first, then the oldest.
bool isMoreUrgent(const state::Alert& a, const state::Alert& b) {
  if (a.severity != b.severity) {
    return a.severity > b.severity;
  }
  return a.raised_time != b.raised_time ? a.raised_time < b.raised_time : a.id < b.id;
}

}  // namespace

LcmBridge::LcmBridge(const ros::NodeHandle& twin, bool derived)
    : topics_(twin, kQueueSize, awaitSubscribers) {
  if (derived) {
    topics_.publishAlerts({}, 0);
  }
}

void LcmBridge::publish(const Message& message) {
  std::visit([this](const auto& state) { publishState(state); }, message);
}

void LcmBridge::publishState(const state::Alert& alert) {
  if (alert.time < last_alert_time_) {
    active_alerts_.clear();  // the log or the twin has restarted
  }
  last_alert_time_ = alert.time;
  if (alert.raised) {
    active_alerts_[alert.id] = alert;
  } else {
    active_alerts_.erase(alert.id);
  }
  std::vector<state::Alert> list;
  for (const auto& [id, active] : active_alerts_) {
    list.push_back(active);
  }
  std::sort(list.begin(), list.end(), isMoreUrgent);
  topics_.publishAlerts(list, alert.stamp);
}

}  // namespace whirl_twin
