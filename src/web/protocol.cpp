#include "web/protocol.h"

#include <fmt/format.h>

#include <algorithm>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxSubscriptions = 1000;  // of a client
constexpr std::size_t kMaxPublished = 100;       // topics of a client

// Opcodes of binary messages.
constexpr char kMessageData = 1, kTime = 2, kServiceResponse = 3;  // to the client
constexpr char kPublished = 1, kServiceRequest = 2;                // from it

/// Little-endian, as the protocol has all numbers.
template <class Number>
void append(std::string& out, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    out += static_cast<char>((number >> (8 * i)) & 0xff);
  }
}

WebMessage answerOf(std::string text, bool binary) {
  return {std::move(text), nullptr, binary, true};
}

}  // namespace

Protocol::Protocol(WebServer& server, WebRequests& requests, std::string name, bool read_only,
                   std::vector<ServiceInfo> services)
    : server_(server),
      requests_(requests),
      name_(std::move(name)),
      read_only_(read_only),
      services_(std::move(services)) {}

Json ChannelInfo::advertisement(ChannelId id) const {
  return {{"id", id},
          {"topic", topic},
          {"encoding", encoding},
          {"schemaName", schema_name},
          {"schema", schema},
          {"schemaEncoding", schema_encoding}};
}

ChannelId Protocol::addChannel(ChannelInfo info) {
  channels_.emplace_back().info = std::move(info);
  return static_cast<ChannelId>(channels_.size() - 1);
}

void Protocol::opened(ClientId id) {
  clients_[id] = {};
  Json capabilities = {"time", "parameters", "parametersSubscribe"};
  if (!read_only_) {
    capabilities.push_back("services");
    capabilities.push_back("clientPublish");
  }
  sendJson(id, {{"op", "serverInfo"},
                {"name", name_},
                {"capabilities", capabilities},
                {"supportedEncodings", {"json"}},
                {"metadata", {{"read_only", read_only_ ? "true" : "false"}}},
                {"sessionId", fmt::format("{}-{}", name_, id)}});
  Json channels = Json::array();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels.push_back(channels_[i].info.advertisement(static_cast<ChannelId>(i)));
  }
  sendJson(id, {{"op", "advertise"}, {"channels", channels}});
  if (read_only_) {
    return;
  }
  sendJson(id, {{"op", "advertiseServices"}, {"services", advertisementOf(services_)}});
}

void Protocol::closed(ClientId id) {
  const auto client = clients_.find(id);
  if (client == clients_.end()) {
    return;
  }
  while (!client->second.subscriptions.empty()) {
    drop(client->second, client->second.subscriptions.begin()->first);
  }
  clients_.erase(client);
}

void Protocol::received(ClientId id, std::string_view message, bool binary) {
  const auto client = clients_.find(id);
  if (client == clients_.end()) {
    return;
  }
  if (binary) {
    if (!message.empty() && message[0] == kServiceRequest) {
      return callService(id, message);
    }
    if (!message.empty() && message[0] == kPublished) {
      return takePublished(id, client->second, message);
    }
    return complain(id, "a binary message must be a published one (1) or a call of a service (2)");
  }
  const std::optional<Json> json = parsedMessage(message);
  if (!json || !json->is_object() || textIn(*json, "op").empty()) {
    return complain(id, "a message must be a JSON object with an `op`");
  }
  take(id, client->second, *json);
}

void Protocol::take(ClientId id, Client& client, const Json& message) {
  const std::string op = textIn(message, "op");
  if (op == "subscribe") {
    subscribe(id, client, message);
  } else if (op == "unsubscribe") {
    unsubscribe(id, client, message);
  } else if (op == "getParameters") {
    sendValues(id, namesIn(message, "parameterNames"), textIn(message, "id"));
  } else if (op == "setParameters") {
    requestParameters(id, message);
  } else if (op == "advertise" && !read_only_) {
    advertise(id, client, message);
  } else if (op == "unadvertise" && !read_only_) {
    for (const Json& channel : listIn(message, "channelIds")) {
      client.published.erase(numberIn(channel).value_or(0));
    }
  } else if (op == "subscribeParameterUpdates" || op == "unsubscribeParameterUpdates") {
    watch(client, message, op[0] == 's');
  } else {
    complain(id, fmt::format("op: {} is not supported", inQuotes(op)));
  }
}

void Protocol::subscribe(ClientId id, Client& client, const Json& message) {
  for (const Json& one : listIn(message, "subscriptions")) {
    const auto subscription = one.is_object() ? numberIn(one, "id") : std::nullopt;
    const auto channel = one.is_object() ? numberIn(one, "channelId") : std::nullopt;
    if (!subscription || !channel || *channel >= channels_.size()) {
      complain(id, "subscribe: must be {id, channelId} of an advertised channel");
      continue;
    }
    if (client.subscriptions.count(*subscription) > 0 ||
        client.subscriptions.size() >= kMaxSubscriptions) {
      complain(id, fmt::format("subscribe: id {} is in use, or there are more than {}",
                               *subscription, kMaxSubscriptions));
      continue;
    }
    client.subscriptions[*subscription] = *channel;
    client.by_channel.emplace(*channel, *subscription);
    channels_[*channel].subscribers.fetch_add(1, std::memory_order_relaxed);
    if (channels_[*channel].newest) {
      deliver(id, *subscription, *channels_[*channel].newest);
    }
  }
}

void Protocol::unsubscribe(ClientId id, Client& client, const Json& message) {
  for (const Json& one : listIn(message, "subscriptionIds")) {
    const auto subscription = numberIn(one);
    if (!subscription || client.subscriptions.count(*subscription) == 0) {
      complain(id, "unsubscribe: must be the id of a subscription");
      continue;
    }
    drop(client, *subscription);
  }
}

void Protocol::drop(Client& client, std::uint32_t subscription) {
  const ChannelId channel = client.subscriptions[subscription];
  const auto [first, last] = client.by_channel.equal_range(channel);
  client.by_channel.erase(
      std::find_if(first, last, [&](const auto& one) { return one.second == subscription; }));
  client.subscriptions.erase(subscription);
  channels_[channel].subscribers.fetch_sub(1, std::memory_order_relaxed);
}

/// Topics that the client will publish: the inputs of systems.
void Protocol::advertise(ClientId id, Client& client, const Json& message) {
  for (const Json& one : listIn(message, "channels")) {
    const auto channel = one.is_object() ? numberIn(one, "id") : std::nullopt;
    const std::string topic = one.is_object() ? textIn(one, "topic") : "";
    if (!channel || textIn(one, "encoding") != "json" || inputsOf(topic).empty() ||
        client.published.size() >= kMaxPublished) {
      complain(id,
               fmt::format("advertise: must be {{id, topic, encoding}} of a topic SYSTEM/inputs "
                           "in JSON, at most {} of them, found {}",
                           kMaxPublished, inQuotes(topic)));
      continue;
    }
    client.published[*channel] = topic;
  }
}

void Protocol::takePublished(ClientId id, const Client& client, std::string_view message) {
  constexpr std::size_t kHead = 5;
  const auto topic =
      message.size() < kHead ? client.published.end() : client.published.find(numberAt(message, 1));
  if (topic == client.published.end()) {
    return complain(id, "a published message must be of an advertised channel");
  }
  const std::optional<Json> json = parsedMessage(message.substr(kHead));
  state::InputCommand inputs;
  std::string why = readInputs(json.value_or(Json()), inputs);
  inputs.system = inputsOf(topic->second);
  if (why.empty() && !requests_.setInputs(id, std::move(inputs))) {
    why = "too many requests wait: try again";
  }
  if (!why.empty()) {
    complain(id, topic->second + ": " + why);
  }
}

void Protocol::watch(Client& client, const Json& message, bool on) {
  const std::vector<std::string> names = namesIn(message, "parameterNames");
  if (names.empty()) {
    client.watches_all = on;
    client.watched.clear();
  }
  for (const std::string& name : names) {
    if (parameters_.count(name) > 0) {
      on ? static_cast<void>(client.watched.insert(name))
         : static_cast<void>(client.watched.erase(name));
    }
  }
}

void Protocol::requestParameters(ClientId id, const Json& message) {
  std::vector<ParameterValue> values;
  std::string why = read_only_ ? "the server is read-only: no parameter can be set" : "";
  for (const Json& one : listIn(message, "parameters")) {
    const std::string name = one.is_object() ? textIn(one, "name") : "";
    const auto value = one.is_object() ? one.find("value") : one.end();
    values.emplace_back(name,
                        value != one.end() && value->is_number() ? value->get<double>() : 0.0);
    if (why.empty() && parameters_.count(name) == 0) {
      std::vector<std::string> known;
      for (const auto& [other, unused] : parameters_) {
        known.push_back(other);
      }
      const std::string near = nearestName(name, known);
      why = fmt::format("name: must be a parameter of the twin, found {}{}", inQuotes(name),
                        near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
    } else if (why.empty() && (value == one.end() || !value->is_number())) {
      why = fmt::format("{}: must be a number, found {}", name,
                        value == one.end() ? "nothing" : printable(value->dump(-1, ' ', true)));
    }
  }
  const std::string request = textIn(message, "id");
  if (why.empty() && !requests_.setParameters(id, values, request)) {
    why = "too many requests wait: try again";
  }
  if (!why.empty()) {
    answerParameters(id, values, request, why);
  }
}

void Protocol::callService(ClientId id, std::string_view message) {
  constexpr std::size_t kHead = 13;
  if (message.size() < kHead) {
    return complain(id, "a call of a service must have at least 13 bytes");
  }
  const std::uint32_t service = numberAt(message, 1);
  const std::uint32_t call = numberAt(message, 5);
  const std::uint32_t length = numberAt(message, 9);
  const auto fail = [&](const std::string& why) { answerService(id, service, call, {}, why); };
  if (read_only_) {
    return fail("the server is read-only: it has no services");
  }
  if (service >= services_.size() || length > message.size() - kHead ||
      message.substr(kHead, length) != "json") {
    return fail("a call must be of an advertised service, in the encoding json");
  }
  std::optional<Json> request = parsedMessage(message.substr(kHead + length));
  const std::string why = requestFault(services_[service], request.value_or(Json()));
  if (!why.empty()) {
    return fail(why);
  }
  if (!requests_.callService(id, service, call, std::move(*request))) {
    fail("too many requests wait: try again");
  }
}

void Protocol::publish(const std::vector<ChannelMessage>& messages) {
  for (const ChannelMessage& message : messages) {
    Channel& channel = channels_[message.channel];
    if (channel.info.latched) {
      channel.newest = message;
    }
  }
  for (const auto& [id, client] : clients_) {
    for (const ChannelMessage& message : messages) {
      const auto [first, last] = client.by_channel.equal_range(message.channel);
      for (auto one = first; one != last; ++one) {
        deliver(id, one->second, message);
      }
    }
  }
}

void Protocol::deliver(ClientId id, std::uint32_t subscription, const ChannelMessage& message) {
  WebMessage out;
  out.head += kMessageData;
  append(out.head, subscription);
  append(out.head, static_cast<std::uint64_t>(message.stamp));
  out.body = message.content;
  out.binary = true;
  out.kept = latched(message.channel);
  server_.send(id, std::move(out));
}

void Protocol::publishTime(std::int64_t stamp) {
  for (const auto& [id, client] : clients_) {
    WebMessage out;
    out.head += kTime;
    append(out.head, static_cast<std::uint64_t>(stamp));
    out.binary = true;
    server_.send(id, std::move(out));
  }
}

void Protocol::updateParameters(const std::vector<ParameterValue>& values) {
  for (const auto& [name, value] : values) {
    parameters_[name] = value;
  }
  for (const auto& [id, client] : clients_) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) {
      if (client.watches_all || client.watched.count(name) > 0) {
        names.push_back(name);
      }
    }
    if (!names.empty()) {
      sendValues(id, names, "");
    }
  }
}

void Protocol::answerParameters(ClientId client, const std::vector<ParameterValue>& requested,
                                const std::string& id, const std::string& why) {
  std::vector<std::string> names;
  for (const auto& [name, value] : requested) {
    names.push_back(name);
    if (why.empty()) {
      parameters_[name] = value;
    }
  }
  if (!why.empty()) {
    complain(client, why);
  }
  if (!id.empty() && !names.empty()) {
    sendValues(client, names, id);
  }
}

void Protocol::answerService(ClientId client, std::size_t service, std::uint32_t call,
                             const Json& answer, const std::string& why) {
  if (!why.empty()) {
    return sendJson(
        client,
        {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", why}});
  }
  constexpr std::string_view kEncoding = "json";
  std::string out;
  out += kServiceResponse;
  append(out, static_cast<std::uint32_t>(service));
  append(out, call);
  append(out, static_cast<std::uint32_t>(kEncoding.size()));
  out += kEncoding;
  out += answer.dump();
  server_.send(client, answerOf(std::move(out), true));
}

void Protocol::sendJson(ClientId id, const Json& json) {
  server_.send(id, answerOf(json.dump(-1, ' ', false, Json::error_handler_t::replace), false));
}

void Protocol::complain(ClientId id, const std::string& why) {
  constexpr int kError = 2;
  sendJson(id, {{"op", "status"}, {"level", kError}, {"message", why}});
}

Json Protocol::values(const std::vector<std::string>& names) const {
  Json values = Json::array();
  const auto add = [&values](const std::string& name, double value) {
    values.push_back({{"name", name}, {"value", value}, {"type", "float64"}});
  };
  if (names.empty()) {
    for (const auto& [name, value] : parameters_) {
      add(name, value);
    }
  }
  for (const std::string& name : names) {
    const auto found = parameters_.find(name);
    if (found != parameters_.end()) {
      add(name, found->second);
    }
  }
  return values;
}

void Protocol::sendValues(ClientId id, const std::vector<std::string>& names,
                          const std::string& request) {
  Json answer = {{"op", "parameterValues"}, {"parameters", values(names)}};
  if (!request.empty()) {
    answer["id"] = request;
  }
  sendJson(id, answer);
}

}  // namespace whirl_twin
