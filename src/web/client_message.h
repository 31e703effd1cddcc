// Reads what clients send: JSON with members that may be missing or of another type, and requests
// of services. Pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/commands.h"
#include "reports/output.h"

namespace whirl_twin {

struct ServiceInfo {
  std::string name;
  std::string meaning;
  /// Fields of a request with their JSON types: {"drive", "string"}. All are required.
  std::vector<std::pair<std::string, std::string>> fields;
};

/// A text that must be JSON; nothing: it is not, or nested too deeply.
std::optional<Json> parsedMessage(std::string_view text);

/// Members of an object; "", an empty list or nothing where they are missing or of another type.
std::string textIn(const Json& message, const char* key);
const Json& listIn(const Json& message, const char* key);
std::vector<std::string> namesIn(const Json& message, const char* key);
std::optional<std::uint32_t> numberIn(const Json& message, const char* key);
/// A number that may be an id; nothing if it is none.
std::optional<std::uint32_t> numberIn(const Json& json);

/// Little-endian, at an offset at least 4 bytes before the end.
std::uint32_t numberAt(std::string_view message, std::size_t at);

/// The system of a topic "SYSTEM/inputs", with or without a namespace before it; "" for any other.
std::string inputsOf(const std::string& topic);
/// Reads {"input": [names], "value": [numbers], "duration": s}, whose values are checked later.
/// Returns why it is not that, or "".
std::string readInputs(const Json& message, state::InputCommand& inputs);

/// Services as the protocol advertises them; the id is the index.
Json advertisementOf(const std::vector<ServiceInfo>& services);
/// Why a request does not have the fields of its service, or "".
std::string requestFault(const ServiceInfo& service, const Json& request);

}  // namespace whirl_twin
