// Serializes a message of the twin as the ROS message of its kind, without ROS.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messages/message.h"
#include "transport/little_endian.h"
#include "transport/recording_writer.h"

namespace whirl_twin {

struct RosDefinition;

/// Of the ROS message of a kind.
const RosDefinition& rosDefinitionOf(const MessageKind& kind);

class RosEncoder {
 public:
  /// Topics are below a namespace such as "/twin".
  explicit RosEncoder(std::string twin_namespace) : namespace_(std::move(twin_namespace)) {}

  /// The same bytes as ROS's serialization of toRos(message). An alert becomes the complete list of
  /// active alerts, as on ROS. Valid until the next call.
  const LittleEndian& encode(const Message& message);
  /// The list of active alerts, in this order; stamp: [ns], of the instant that it holds at.
  const LittleEndian& encode(const std::vector<state::Alert>& alerts, std::int64_t stamp);
  /// The topic of the latest encoded message.
  const RecordedTopic& topic() const { return *topic_; }

 private:
  template <class State>
  void put(const State& state);
  void put(const state::Alert& alert);
  void go(const MessageKind& kind, const std::string& topic);

  std::string namespace_;
  std::map<std::string, RecordedTopic> topics_;
  const RecordedTopic* topic_ = nullptr;
  LittleEndian bytes_;
  std::map<std::uint32_t, state::Alert> active_;  ///< alerts by id
  double last_alert_ = 0.0;                       ///< [s], simulated
};

}  // namespace whirl_twin
