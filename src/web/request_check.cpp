#include "web/request_check.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr std::array<const char*, 2> kSubprotocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
constexpr std::string_view kTokenKey = "token=";

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return out;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// An address as a URL has it: IPv6 in brackets.
std::string inUrl(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

/// The values of the header Host that name this server.
std::vector<std::string> hostsOf(const WebAccess& access) {
  std::vector<std::string> names;
  for (const std::string& name : {std::string("localhost"), std::string("127.0.0.1"),
                                  std::string("[::1]"), inUrl(access.address)}) {
    names.push_back(fmt::format("{}:{}", lower(name), access.port));
  }
  return names;
}

bool isIn(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Compares all bytes of `given`, whichever differ.
bool sameSecret(std::string_view given, std::string_view secret) {
  unsigned char difference = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    difference = static_cast<unsigned char>(
        difference |
        (static_cast<unsigned char>(given[i]) ^
         static_cast<unsigned char>(secret[i % std::max<std::size_t>(1, secret.size())])));
  }
  return difference == 0;
}

}  // namespace

bool isLoopback(const std::string& address) {
  return address == "::1" || address == "localhost" || address.compare(0, 4, "127.") == 0;
}

std::string randomToken() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw RunFailure("no random numbers for the token");
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    token += fmt::format("{:02x}", byte);
  }
  return token;
}

std::string urlOf(const WebAccess& access) {
  return fmt::format("http://{}:{}/{}", inUrl(access.address), access.port,
                     access.token.empty() ? "" : "?token=" + access.token);
}

std::string hostFault(const WebAccess& access, std::string_view host) {
  // A token is not known to a page of another site: then any name of this machine will do.
  if (!access.token.empty() || isIn(hostsOf(access), lower(host))) {
    return "";
  }
  return fmt::format("Host: must be localhost, 127.0.0.1 or [::1] with port {}, found {}",
                     access.port, inQuotes(std::string(host)));
}

std::string originFault(const WebAccess& access, std::string_view host, std::string_view origin) {
  if (origin.empty() || isIn(access.origins, std::string(origin))) {
    return "";
  }
  const std::string page = lower(origin);
  for (const std::string& own : hostsOf(access)) {
    if (page == "http://" + own) {
      return "";
    }
  }
  if (!access.token.empty() && page == "http://" + lower(host)) {
    return "";
  }
  return fmt::format("Origin: must be the page of this server, found {}; --origin allows another",
                     inQuotes(std::string(origin)));
}

std::string tokenFault(const WebAccess& access, std::string_view target) {
  if (access.token.empty()) {
    return "";
  }
  std::string_view given;
  std::string_view query = target.substr(pathOf(target).size());
  while (!query.empty()) {
    query.remove_prefix(1);  // ? or &
    const std::string_view part = query.substr(0, query.find('&'));
    if (part.substr(0, kTokenKey.size()) == kTokenKey) {
      given = part.substr(kTokenKey.size());
    }
    query.remove_prefix(part.size());
  }
  return sameSecret(given, access.token)
             ? ""
             : "token: must be the one in the address that the server printed";
}

std::string subprotocolOf(std::string_view offered) {
  while (!offered.empty()) {
    const std::size_t end = std::min(offered.find(','), offered.size());
    const std::string_view one = trimmed(offered.substr(0, end));
    for (const char* known : kSubprotocols) {
      if (one == known) {
        return known;
      }
    }
    offered.remove_prefix(std::min(end + 1, offered.size()));
  }
  return "";
}

std::string subprotocolFault(std::string_view offered) {
  return fmt::format("Sec-WebSocket-Protocol: must be {} or {}, found {}", kSubprotocols[0],
                     kSubprotocols[1],
                     offered.empty() ? "nothing" : inQuotes(std::string(offered)));
}

std::string_view pathOf(std::string_view target) {
  return target.substr(0, target.find('?'));
}

}  // namespace whirl_twin
