#include "web/client_message.h"

#include <fmt/format.h>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr int kMaxDepth = 16;  // of nested JSON

Json schemaOf(const std::vector<std::pair<std::string, std::string>>& fields) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  for (const auto& [name, type] : fields) {
    schema["properties"][name] = {{"type", type}};
    schema["required"].push_back(name);
  }
  return schema;
}

}  // namespace

std::uint32_t numberAt(std::string_view message, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(message[at + i])) << (8 * i);
  }
  return number;
}

std::optional<Json> parsedMessage(std::string_view text) {
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

std::string inputsOf(const std::string& topic) {
  static const std::string kEnd = "/inputs";
  if (topic.size() <= kEnd.size() ||
      topic.compare(topic.size() - kEnd.size(), std::string::npos, kEnd) != 0) {
    return "";
  }
  const std::string before = topic.substr(0, topic.size() - kEnd.size());
  return before.substr(before.find_last_of('/') + 1);
}

std::string readInputs(const Json& message, state::InputCommand& inputs) {
  constexpr const char* kForm =
      R"(must be {"input": [names], "value": [a number each], "duration": s})";
  if (!message.is_object()) {
    return kForm;
  }
  inputs.input = namesIn(message, "input");
  for (const Json& value : listIn(message, "value")) {
    if (value.is_number()) {
      inputs.value.push_back(value.get<double>());
    }
  }
  const auto duration = message.find("duration");
  if (inputs.input.empty() || inputs.input.size() != listIn(message, "input").size() ||
      inputs.value.size() != inputs.input.size() || duration == message.end() ||
      !duration->is_number()) {
    return kForm;
  }
  inputs.duration = duration->get<double>();
  return "";
}

Json advertisementOf(const std::vector<ServiceInfo>& services) {
  const Json answer = schemaOf({{"success", "boolean"}, {"message", "string"}});
  Json all = Json::array();
  for (const ServiceInfo& service : services) {
    const auto part = [&](const char* suffix, const Json& schema) {
      return Json{{"encoding", "json"},
                  {"schemaName", service.name + suffix},
                  {"schemaEncoding", "jsonschema"},
                  {"schema", schema.dump()}};
    };
    all.push_back({{"id", all.size()},
                   {"name", service.name},
                   {"type", service.name},
                   {"request", part("_request", schemaOf(service.fields))},
                   {"response", part("_response", answer)}});
  }
  return all;
}

}  // namespace whirl_twin
