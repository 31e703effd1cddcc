#include "web/web_channels.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "transport/ros_definitions.h"

namespace whirl_twin {

namespace {

constexpr int kMaxInFlight = 64;  // batches

}  // namespace

std::string pictureTopic(const std::string& system) {
  return system + "/picture";
}

WebChannels::WebChannels(WebServer& server, Protocol& protocol, std::string twin_namespace)
    : server_(server),
      protocol_(protocol),
      namespace_(std::move(twin_namespace)),
      encoder_(namespace_) {}

void WebChannels::add(const MessageKind& kind, const std::string& subject, const Json& schema,
                      bool latched) {
  const std::string topic = topicName(kind, subject);
  const RosDefinition& ros = rosDefinitionOf(kind);
  const ChannelId json =
      protocol_.addChannel({topic, "json", kind.type, "jsonschema", schema.dump(), latched});
  channels_[topic] = {json, protocol_.addChannel({namespace_ + "/" + topic, "ros1", ros.type,
                                                  "ros1msg", ros.text, latched})};
}

void WebChannels::addAlerts() {
  const Json schema = {
      {"type", "object"},
      {"properties", {{"alerts", {{"type", "array"}, {"items", messageSchema<state::Alert>()}}}}}};
  add(state::Alert::kKind, "", schema, true);
}

void WebChannels::addForPage(const std::string& topic, bool latched) {
  const ChannelId json =
      protocol_.addChannel({topic, "json", "Page", "jsonschema", R"({"type":"object"})", latched});
  channels_[topic] = {json, json};
}

bool WebChannels::wanted(const std::string& topic) const {
  const auto found = channels_.find(topic);
  return found != channels_.end() &&
         (protocol_.wanted(found->second.json) || protocol_.wanted(found->second.ros));
}

void WebChannels::sendAlerts(const std::vector<state::Alert>& alerts) {
  const Channel& channel = channels_.at(topicName(state::Alert::kKind));
  put(channel.json,
      {{"alerts", listJson(alerts, [](const state::Alert& alert) { return messageJson(alert); })}});
  put(channel.ros, encoder_.encode(alerts, stamp_));
}

void WebChannels::sendForPage(const std::string& topic, const Json& json) {
  if (wanted(topic)) {
    put(channels_.at(topic).json, json);
  }
}

void WebChannels::sendServer(const std::string& silence) {
  const WebCounts& counts = server_.counts();
  sendForPage(kServerTopic, {{"clients", counts.clients.load()},
                             {"sent", counts.sent.load()},
                             {"dropped", counts.dropped.load()},
                             {"refused", counts.refused.load()},
                             {"malformed", counts.malformed.load()},
                             {"silence", silence}});
}

void WebChannels::put(ChannelId channel, const Json& json) {
  out_.push_back({channel, stamp_,
                  std::make_shared<const std::string>(
                      json.dump(-1, ' ', false, Json::error_handler_t::replace))});
}

void WebChannels::put(ChannelId channel, const LittleEndian& bytes) {
  out_.push_back({channel, stamp_,
                  std::make_shared<const std::string>(reinterpret_cast<const char*>(bytes.data()),
                                                      bytes.size())});
}

void WebChannels::flush() {
  if (out_.empty()) {
    return;
  }
  if (in_flight_.load() >= kMaxInFlight) {
    out_.erase(std::remove_if(out_.begin(), out_.end(),
                              [this](const ChannelMessage& message) {
                                return !protocol_.latched(message.channel);
                              }),
               out_.end());
  }
  in_flight_.fetch_add(1);
  server_.post([this, batch = std::move(out_)] {
    protocol_.publish(batch);
    in_flight_.fetch_sub(1);
  });
  out_.clear();
}

}  // namespace whirl_twin
