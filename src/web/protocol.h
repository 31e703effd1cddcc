// Foxglove's WebSocket protocol (subprotocols foxglove.websocket.v1 and foxglove.sdk.v1, the same
// under two names): channels, subscriptions, parameters, services, and inputs that clients publish.
// All of it belongs to the server's thread, except where noted.
//
// https://github.com/foxglove/ws-protocol
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/commands.h"
#include "reports/output.h"
#include "web/client_message.h"
#include "web/web_server.h"

namespace whirl_twin {

using ChannelId = std::uint32_t;

struct ChannelInfo {
  std::string topic;
  std::string encoding;  ///< of its messages: "json" or "ros1"
  std::string schema_name, schema_encoding, schema;
  bool latched = false;  ///< who subscribes gets the newest message, and loses none

  Json advertisement(ChannelId id) const;
};

/// A message on a channel.
struct ChannelMessage {
  ChannelId channel = 0;
  std::int64_t stamp = 0;  ///< [ns]
  std::shared_ptr<const std::string> content;
};

/// A parameter that clients may set: "SYSTEM/PATH".
using ParameterValue = std::pair<std::string, double>;

/// What clients request; called by the server's thread, must not wait. The answer comes by
/// answerParameters() or answerService(), which are posted to that thread. Each returns whether the
/// request was accepted; false: too many wait.
class WebRequests {
 public:
  virtual ~WebRequests() = default;
  virtual bool setParameters(ClientId client, std::vector<ParameterValue> values,
                             std::string id) = 0;
  virtual bool callService(ClientId client, std::size_t service, std::uint32_t call,
                           Json request) = 0;
  /// Inputs of a system, published by a client; complain() where they are invalid.
  virtual bool setInputs(ClientId client, state::InputCommand inputs) = 0;
};

class Protocol : public WebClients {
 public:
  /// name: of the server, shown by clients.
  Protocol(WebServer& server, WebRequests& requests, std::string name, bool read_only,
           std::vector<ServiceInfo> services);

  // Before the server starts.

  ChannelId addChannel(ChannelInfo info);
  void setParameter(const ParameterValue& value) { parameters_[value.first] = value.second; }

  // Any thread.

  bool latched(ChannelId channel) const { return channels_[channel].info.latched; }
  /// Has the channel a subscriber, or is it latched?
  bool wanted(ChannelId channel) const {
    return latched(channel) || channels_[channel].subscribers.load(std::memory_order_relaxed) > 0;
  }

  // The server's thread.

  void publish(const std::vector<ChannelMessage>& messages);
  /// Simulated time [ns], to all clients.
  void publishTime(std::int64_t stamp);
  /// The twin reports values, as after a change by another client.
  void updateParameters(const std::vector<ParameterValue>& values);
  /// why: "" where all are set. The client receives the values that there are then.
  void answerParameters(ClientId client, const std::vector<ParameterValue>& requested,
                        const std::string& id, const std::string& why);
  /// why: "" with an answer, else the reason of a failure.
  void answerService(ClientId client, std::size_t service, std::uint32_t call, const Json& answer,
                     const std::string& why);
  /// An error, as the status of the client.
  void complain(ClientId id, const std::string& why);

  void opened(ClientId client) override;
  void received(ClientId client, std::string_view message, bool binary) override;
  void closed(ClientId client) override;

 private:
  struct Channel {
    ChannelInfo info;
    std::optional<ChannelMessage> newest;
    std::atomic<int> subscribers{0};
  };
  struct Client {
    std::map<std::uint32_t, ChannelId> subscriptions;    ///< by the client's number
    std::multimap<ChannelId, std::uint32_t> by_channel;  ///< the same
    std::map<std::uint32_t, std::string> published;      ///< topics, by the client's number
    std::set<std::string> watched;                       ///< parameters
    bool watches_all = false;
  };

  void take(ClientId id, Client& client, const Json& message);
  void subscribe(ClientId id, Client& client, const Json& message);
  void unsubscribe(ClientId id, Client& client, const Json& message);
  void drop(Client& client, std::uint32_t subscription);
  void advertise(ClientId id, Client& client, const Json& message);
  void takePublished(ClientId id, const Client& client, std::string_view message);
  void watch(Client& client, const Json& message, bool on);
  void requestParameters(ClientId id, const Json& message);
  void callService(ClientId id, std::string_view message);
  void deliver(ClientId id, std::uint32_t subscription, const ChannelMessage& message);
  void sendJson(ClientId id, const Json& json);
  void sendValues(ClientId id, const std::vector<std::string>& names, const std::string& request);
  Json values(const std::vector<std::string>& names) const;

  WebServer& server_;
  WebRequests& requests_;
  std::string name_;
  bool read_only_;
  std::vector<ServiceInfo> services_;
  std::deque<Channel> channels_;  // constant once the server has started
  std::map<std::string, double> parameters_;
  std::map<ClientId, Client> clients_;
};

}  // namespace whirl_twin
