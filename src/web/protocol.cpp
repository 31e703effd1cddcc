#include "web/protocol.h"

#include <fmt/format.h>

#include <algorithm>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxSubscriptions = 1000;  // of a client
constexpr int kMaxDepth = 16;                    // of nested JSON

// Opcodes of binary messages.
constexpr char kMessageData = 1, kTime = 2, kServiceResponse = 3;  // to the client
constexpr char kServiceRequest = 2;                                // from it

/// Little-endian, as the protocol has all numbers.
template <class Number>
void append(std::string& out, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    out += static_cast<char>((number >> (8 * i)) & 0xff);
  }
}

std::uint32_t numberAt(std::string_view message, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(message[at + i])) << (8 * i);
  }
  return number;
}

WebMessage answerOf(std::string text, bool binary) {
  return {std::move(text), nullptr, binary, true};
}

/// A client's text, which must be JSON; nothing: it is not, or nested too deeply.
std::optional<Json> parsed(std::string_view text) {
  bool deep = false;
  const auto limit = [&deep](int depth, Json::parse_event_t, Json&) {
    deep = deep || depth > kMaxDepth;
    return !deep;
  };
  Json json = Json::parse(text.begin(), text.end(), limit, false);
  return json.is_discarded() || deep ? std::nullopt : std::optional<Json>(std::move(json));
}

std::string textIn(const Json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() && found->is_string() ? found->get<std::string>() : "";
}

/// A member that must be a list; an empty one where it is none.
const Json& listIn(const Json& message, const char* key) {
  static const Json kEmpty = Json::array();
  const auto found = message.find(key);
  return found != message.end() && found->is_array() ? *found : kEmpty;
}

std::optional<std::uint32_t> numberIn(const Json& json) {
  return json.is_number_unsigned() && json.get<std::uint64_t>() <= UINT32_MAX
             ? std::optional<std::uint32_t>(json.get<std::uint32_t>())
             : std::nullopt;
}
std::optional<std::uint32_t> numberIn(const Json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() ? numberIn(*found) : std::nullopt;
}

std::vector<std::string> namesIn(const Json& message, const char* key) {
  std::vector<std::string> names;
  for (const Json& name : listIn(message, key)) {
    if (name.is_string()) {
      names.push_back(name.get<std::string>());
    }
  }
  return names;
}

Json schemaOf(const std::vector<std::pair<std::string, std::string>>& fields) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  for (const auto& [name, type] : fields) {
    schema["properties"][name] = {{"type", type}};
    schema["required"].push_back(name);
  }
  return schema;
}

/// Why a request does not have the fields of its service, or "".
std::string requestFault(const ServiceInfo& service, const Json& request) {
  if (!request.is_object()) {
    return service.name + ": the request must be a JSON object";
  }
  for (const auto& [name, type] : service.fields) {
    const auto found = request.find(name);
    const bool fits = found != request.end() && (type == "string"    ? found->is_string()
                                                 : type == "integer" ? found->is_number_unsigned()
                                                                     : found->is_number());
    if (!fits) {
      return fmt::format(
          "{}: {}: must be {}, found {}", service.name, name,
          type == "integer" ? "a whole number >= 0" : "a " + type,
          found == request.end() ? "nothing" : printable(found->dump(-1, ' ', true)));
    }
  }
  return "";
}

}  // namespace

Protocol::Protocol(WebServer& server, WebRequests& requests, std::string name, bool read_only,
                   std::vector<ServiceInfo> services)
    : server_(server),
      requests_(requests),
      name_(std::move(name)),
      read_only_(read_only),
      services_(std::move(services)) {}

ChannelId Protocol::addChannel(const std::string& topic, const std::string& schema_name,
                               const std::string& schema, bool latched) {
  Channel& channel = channels_.emplace_back();
  channel.topic = topic;
  channel.schema_name = schema_name;
  channel.schema = schema;
  channel.latched = latched;
  return static_cast<ChannelId>(channels_.size() - 1);
}

void Protocol::opened(ClientId id) {
  clients_[id] = {};
  Json capabilities = {"time", "parameters", "parametersSubscribe"};
  if (!read_only_) {
    capabilities.push_back("services");
  }
  sendJson(id, {{"op", "serverInfo"},
                {"name", name_},
                {"capabilities", capabilities},
                {"supportedEncodings", {"json"}},
                {"metadata", {{"read_only", read_only_ ? "true" : "false"}}},
                {"sessionId", fmt::format("{}-{}", name_, id)}});
  Json channels = Json::array();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels.push_back({{"id", i},
                        {"topic", channels_[i].topic},
                        {"encoding", "json"},
                        {"schemaName", channels_[i].schema_name},
                        {"schema", channels_[i].schema},
                        {"schemaEncoding", "jsonschema"}});
  }
  sendJson(id, {{"op", "advertise"}, {"channels", channels}});
  if (read_only_) {
    return;
  }
  Json services = Json::array();
  for (std::size_t i = 0; i < services_.size(); ++i) {
    const Json answer = schemaOf({{"success", "boolean"}, {"message", "string"}});
    const auto part = [&](const char* suffix, const Json& schema) {
      return Json{{"encoding", "json"},
                  {"schemaName", services_[i].name + suffix},
                  {"schemaEncoding", "jsonschema"},
                  {"schema", schema.dump()}};
    };
    services.push_back({{"id", i},
                        {"name", services_[i].name},
                        {"type", services_[i].name},
                        {"request", part("_request", schemaOf(services_[i].fields))},
                        {"response", part("_response", answer)}});
  }
  sendJson(id, {{"op", "advertiseServices"}, {"services", services}});
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
    return complain(id, "a binary message must be a call of a service (2)");
  }
  const std::optional<Json> json = parsed(message);
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
  std::vector<std::string> names;
  std::string why = read_only_ ? "the server is read-only: no parameter can be set" : "";
  for (const Json& one : listIn(message, "parameters")) {
    const std::string name = one.is_object() ? textIn(one, "name") : "";
    const auto value = one.is_object() ? one.find("value") : one.end();
    names.push_back(name);
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
    } else if (why.empty()) {
      values.emplace_back(name, value->get<double>());
    }
  }
  const std::string request = textIn(message, "id");
  if (why.empty() && !requests_.setParameters(id, values, request)) {
    why = "too many requests wait: try again";
  }
  if (!why.empty()) {
    answerParameters(id, {}, names, request, why);
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
  std::optional<Json> request = parsed(message.substr(kHead + length));
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
    if (channel.latched) {
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
  out.body = message.json;
  out.binary = true;
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

void Protocol::answerParameters(ClientId client, const std::vector<ParameterValue>& set,
                                const std::vector<std::string>& names, const std::string& id,
                                const std::string& why) {
  for (const auto& [name, value] : set) {
    parameters_[name] = value;
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
