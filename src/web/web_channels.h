// The channels of a twin: each message as JSON under its name, for the page and scripts, and in
// ROS's serialization below the twin's namespace, as on ROS and in recordings, for viewers. A
// message is converted only where a client receives it. Channels are added before the server
// starts; then all is of one thread, which waits for no client.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messages/message.h"
#include "reports/live_lines.h"
#include "transport/channels.h"
#include "transport/ros_encode.h"
#include "web/message_schema.h"
#include "web/protocol.h"

namespace whirl_twin {

inline constexpr const char* kSceneTopic = "scene";
inline constexpr const char* kServerTopic = "server";
std::string pictureTopic(const std::string& system);

class WebChannels {
 public:
  /// twin_namespace: "/twin". The referenced objects must outlive it.
  WebChannels(WebServer& server, Protocol& protocol, std::string twin_namespace);

  template <class State>
  void add(const std::string& subject = "",
           bool latched = State::kKind.has(MessageKind::kLatched)) {
    add(State::kKind, subject, messageSchema<State>(), latched);
  }
  void addAlerts();
  /// What only the page reads: JSON objects.
  void addForPage(const std::string& topic, bool latched);

  /// Does a client receive a topic in any encoding?
  bool wanted(const std::string& topic) const;

  /// [ns], of the following messages.
  void setStamp(std::int64_t stamp) { stamp_ = stamp; }
  std::int64_t stamp() const { return stamp_; }
  template <class State>
  void send(const State& state) {
    const auto found = channels_.find(topicOf(state));
    if (found == channels_.end()) {
      return;
    }
    if (protocol_.wanted(found->second.json)) {
      put(found->second.json, messageJson(state));
    }
    if (protocol_.wanted(found->second.ros)) {
      put(found->second.ros, encoder_.encode(state));
    }
  }
  void sendAlerts(const std::vector<state::Alert>& alerts);
  void sendForPage(const std::string& topic, const Json& json);
  /// Counts of the server. silence: why there are no current alarms, or "".
  void sendServer(const std::string& silence);

  /// Passes the messages to the server's thread. Where that is far behind, only those of latched
  /// channels.
  void flush();

 private:
  struct Channel {
    ChannelId json = 0, ros = 0;  ///< the same one where there is no other encoding
  };

  void add(const MessageKind& kind, const std::string& subject, const Json& schema, bool latched);
  void put(ChannelId channel, const Json& json);
  void put(ChannelId channel, const LittleEndian& bytes);

  WebServer& server_;
  Protocol& protocol_;
  std::string namespace_;
  RosEncoder encoder_;
  std::map<std::string, Channel> channels_;  // by topic, without the namespace
  std::vector<ChannelMessage> out_;
  std::atomic<int> in_flight_{0};  // batches that the server has not taken
  std::int64_t stamp_ = 0;
};

}  // namespace whirl_twin
