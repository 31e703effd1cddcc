// ROS publishers, each on its topic below the namespace of the twin.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "transport/batched_publisher.h"
#include "transport/channels.h"
#include "transport/ros_converters.h"

namespace whirl_twin {

/// A connection to a topic of this node; a restarted node has a different one.
struct TopicLink {
  int id;
  std::string node;
};

std::vector<TopicLink> linksOf(const std::string& topic);
/// Names of the nodes connected to a topic of this node.
std::vector<std::string> listenersOf(const std::string& topic);

class RosTopics {
 public:
  /// advertised: called after each new topic that publish() had to advertise.
  RosTopics(
      ros::NodeHandle twin, std::uint32_t queue,
      std::function<void(const ros::Publisher&)> advertised = [](const ros::Publisher&) {})
      : twin_(std::move(twin)), queue_(queue), advertised_(std::move(advertised)) {}

  /// Advertises the topics of a kind for a system, drive or source.
  template <class State>
  void advertise(const std::string& subject = "") {
    topicsOf<State>(subject);
  }

  /// Whether the topic has subscribers, or is latched.
  template <class State>
  bool wanted(const std::string& subject = "") {
    const Topics& topics = topicsOf<State>(subject);
    return State::kKind.has(MessageKind::kLatched) || topics.state.getNumSubscribers() > 0 ||
           (topics.joint_states && topics.joint_states.getNumSubscribers() > 0);
  }

  /// From now on messages are queued until send(), except those of latched topics.
  void collect() { collecting_ = true; }
  /// Sends the queued messages.
  void send();

  /// Publishes to the subscribers; advertises the topic first if necessary.
  template <class State>
  void publish(const State& state) {
    static_assert(!std::is_same_v<State, state::Alert>, "alerts go in lists");
    const std::string subject = subjectOf(state);
    const bool is_new = topics_[&State::kKind].count(subject) == 0;
    Topics& topics = topicsOf<State>(subject);
    if (!topics.state) {
      return;
    }
    if (is_new) {
      advertised_(topics.state);
    }
    if constexpr (State::kKind.has(MessageKind::kLatched)) {
      topics.state.publish(toRos(state));
    } else if (topics.state.getNumSubscribers() > 0) {
      publishCounted(topics.state, toRos(state), topics.states);
    }
    if constexpr (State::kKind.has(MessageKind::kJointStates)) {
      if (is_new && topics.joint_states) {
        advertised_(topics.joint_states);
      }
      if (topics.joint_states.getNumSubscribers() > 0) {
        publishCounted(topics.joint_states, toJointState(state), topics.joint_state_list);
      }
    }
  }

  /// Messages that slow subscribers have missed, over all topics, and the topic of the last of
  /// them; latched topics, which are slow, are not counted.
  std::uint64_t lost() const { return lost_; }
  const std::string& lostLast() const { return lost_last_; }

  /// The complete list of active alerts, stamped with the instant [ns] it holds at.
  void publishAlerts(const std::vector<state::Alert>& alerts, std::int64_t stamp);

 private:
  struct Topics {
    explicit Topics(std::uint32_t queue) : states(queue), joint_state_list(queue) {}
    ros::Publisher state;  // null during the shutdown of ROS
    ros::Publisher joint_states;
    BatchedPublisher states;
    BatchedPublisher joint_state_list;
  };

  template <class RosMessage>
  void publishCounted(const ros::Publisher& publisher, const RosMessage& message,
                      BatchedPublisher& messages) {
    messages.add(message);
    if (!collecting_ || messages.full()) {
      send(publisher, messages);
      wakeSender();
    }
  }
  void send(const ros::Publisher& publisher, BatchedPublisher& messages);

  template <class State>
  Topics& topicsOf(const std::string& subject) {
    const auto [place, is_new] = topics_[&State::kKind].try_emplace(subject, queue_);
    if (is_new) {
      using Type =
          std::conditional_t<std::is_same_v<State, state::Alert>, AlertArray, RosType<State>>;
      const std::string topic = topicName(State::kKind, subject);
      if constexpr (State::kKind.has(MessageKind::kLatched)) {
        place->second.state = twin_.advertise<Type>(topic, queue_, true);
      } else {
        auto options = withoutHeader<Type>(topic, queue_);
        place->second.state = twin_.advertise(options);
      }
      if constexpr (State::kKind.has(MessageKind::kJointStates)) {
        auto options = withoutHeader<sensor_msgs::JointState>(subject + "/joint_states", queue_);
        place->second.joint_states = twin_.advertise(options);
      }
    }
    return place->second;
  }

  ros::NodeHandle twin_;
  std::uint32_t queue_;  // messages queued for a slow subscriber
  std::function<void(const ros::Publisher&)> advertised_;
  std::map<const MessageKind*, std::map<std::string, Topics>> topics_;
  bool collecting_ = false;
  std::uint64_t lost_ = 0;
  std::string lost_last_;  // a topic
};

}  // namespace whirl_twin
