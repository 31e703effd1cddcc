#include "nodes/lockstep_listeners.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "transport/ros_topics.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kLockstepQueue = 1000;
constexpr const char* kTopic = "lockstep";
constexpr double kPatience = 0.3;  // s, time to acknowledge before a node is reported and checked
const ros::WallDuration kLookPeriod(0.1);

double steadySeconds() {
  return ros::SteadyTime::now().toSec();
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Lockstep::Settings lockstepSettings(std::string names, int ahead, double timeout,
                                    std::int64_t every) {
  Lockstep::Settings settings;
  settings.ahead = ahead;
  settings.timeout = timeout;
  settings.every = every;
  std::replace(names.begin(), names.end(), ',', ' ');
  std::istringstream words(names);
  std::string word;
  while (words >> word) {
    std::string fault;
    if (!ros::names::validate(word, fault)) {
      throw InputError(
          fmt::format("lockstep: must be names of nodes, found {}", whirl_twin::inQuotes(word)));
    }
    const std::string name = ros::names::resolve(word);
    if (std::count(settings.who.begin(), settings.who.end(), name) > 0) {
      throw InputError(fmt::format("lockstep: duplicate {}", name));
    }
    settings.who.push_back(name);
  }
  return settings;
}

LockstepListeners::LockstepListeners(LiveTwin& live, ros::NodeHandle node,
                                     const Lockstep::Settings& settings)
    : live_(live), lockstep_(live.gate(), settings, live.stepCount()) {
  if (!on()) {
    return;
  }
  node.setCallbackQueue(&queue_);
  const boost::function<void(const Number&)> callback = [this](const Number& event) {
    take(event);
  };
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const Number&>(kTopic, kLockstepQueue, callback);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  acknowledgements_ = node.subscribe(options);
  thread_.start();
}

LockstepListeners::~LockstepListeners() {
  thread_.stop();
}

void LockstepListeners::take(const Number& event) {
  if (!lockstep_.acknowledge(event.getPublisherName(), event.getConstMessage()->data,
                             steadySeconds())) {
    strays_.fetch_add(1, std::memory_order_relaxed);
  }
}

void LockstepListeners::published(std::int64_t step, bool restarted) {
  if (on()) {
    lockstep_.published(step, restarted, steadySeconds());
  }
}

std::string LockstepListeners::waitsFor() const {
  return joined(lockstep_.gathers() ? lockstep_.missing()
                                    : lockstep_.waitsFor(steadySeconds(), kPatience));
}

/// Nodes that publish acknowledgements by the master's registration; none until all of them are
/// connected.
std::vector<std::string> LockstepListeners::acknowledging() const {
  XmlRpc::XmlRpcValue request, response, all;
  request[0] = ros::this_node::getName();
  std::vector<std::string> nodes;
  if (!ros::master::execute("getSystemState", request, response, all, false)) {
    return nodes;
  }
  // NOLINTBEGIN(modernize-loop-convert): XmlRpcValue iterates structs only.
  XmlRpc::XmlRpcValue& published = all[0];  // [[topic, [node, ...]], ...]
  for (int i = 0; i < published.size(); ++i) {
    if (std::string(published[i][0]) == acknowledgements_.getTopic()) {
      for (int k = 0; k < published[i][1].size(); ++k) {
        nodes.push_back(published[i][1][k]);
      }
    }
  }
  // NOLINTEND(modernize-loop-convert)
  if (acknowledgements_.getNumPublishers() < nodes.size()) {
    nodes.clear();
  }
  return nodes;
}

/// A node counts as present if it receives the next state and can acknowledge it, in two successive
/// polls: a connection takes a moment to be established at both ends. A node with none of its
/// earlier connections has restarted.
void LockstepListeners::see() {
  std::map<std::string, std::set<int>> links;
  for (const std::string& node : acknowledging()) {
    links[node];
  }
  std::vector<std::string> topics;
  ros::this_node::getAdvertisedTopics(topics);
  for (const std::string& topic : topics) {
    for (const TopicLink& link : linksOf(topic)) {
      const auto place = links.find(link.node);
      if (place != links.end() && topic != "/rosout") {
        place->second.insert(link.id);
      }
    }
  }
  for (const std::string& who : lockstep_.settings().who) {
    const std::set<int>& now_there = links[who];
    std::set<int>& before = seen_[who];
    const bool kept =
        std::any_of(before.begin(), before.end(), [&](int id) { return now_there.count(id) > 0; });
    lockstep_.see(who, kept, steadySeconds());
    before = now_there;
  }
}

void LockstepListeners::watch() {
  if (!on() || ros::SteadyTime::now() < next_look_) {
    return;
  }
  next_look_ = ros::SteadyTime::now() + kLookPeriod;
  if (lockstep_.gathers() || !lockstep_.waitsFor(steadySeconds(), kPatience).empty() ||
      !lockstep_.leftOut().empty()) {
    see();
  }
  const std::vector<std::string> overdue = lockstep_.overdue(steadySeconds());
  if (!overdue.empty()) {
    live_.pause();
    for (int i = 0; live_.pausing() && i < 1000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    lockstep_.leaveOut(overdue);
    ROS_ERROR(
        "lockstep: paused at step %ld: no acknowledgement for %g s by %s; ~resume continues "
        "without",
        static_cast<long>(live_.stepCount()), lockstep_.settings().timeout,
        joined(overdue).c_str());
  }
  tellNews();
}

void LockstepListeners::tellNews() {
  const std::string waits = lockstep_.gathers() ? waitsFor() : "";
  const std::string out = joined(lockstep_.leftOut());
  const std::string news = !waits.empty()
                               ? fmt::format("waiting for {} to subscribe, and to publish {}",
                                             waits, acknowledgements_.getTopic())
                           : !out.empty() ? fmt::format("continues without {}", out)
                                          : "all nodes are in step";
  if (news != logged_) {
    ROS_INFO("lockstep: %s", news.c_str());
    logged_ = news;
  }
}

void LockstepListeners::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (!on()) {
    return;
  }
  if (const std::string waits = waitsFor(); !waits.empty()) {
    status.mergeSummary(DiagnosticStatus::WARN, "lockstep: waiting for " + waits);
  }
  if (const std::string out = joined(lockstep_.leftOut()); !out.empty()) {
    status.mergeSummary(live_.paused() ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN,
                        "lockstep: no acknowledgement by " + out);
  }
  status.add("lockstep with", joined(lockstep_.settings().who));
  status.add("unexpected acknowledgements", strays_.load(std::memory_order_relaxed));
}

}  // namespace whirl_twin
