// Which requests the web server accepts, against pages of other sites in the same browser (DNS
// rebinding, requests across origins) and against other machines. Pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace whirl_twin {

/// How the server can be reached.
struct WebAccess {
  std::string address = "127.0.0.1";  ///< that it listens on
  std::uint16_t port = 0;
  std::string token;                 ///< required in the URL; "": none
  std::vector<std::string> origins;  ///< of further pages that may connect: "http://localhost:8080"
};

/// Is it an address of this machine that other machines cannot reach?
bool isLoopback(const std::string& address);

/// 128 random bits in hexadecimal. Throws RunFailure.
std::string randomToken();

/// The address of the page, with the token.
std::string urlOf(const WebAccess& access);

/// Each returns why a request is refused, in one sentence; "": it is accepted.
std::string hostFault(const WebAccess& access, std::string_view host);
/// `origin` is "" where a program that is no browser sends none.
std::string originFault(const WebAccess& access, std::string_view host, std::string_view origin);
/// `target` is the path with its query. The time it takes does not depend on the token.
std::string tokenFault(const WebAccess& access, std::string_view target);

/// The first of the client's subprotocols (Sec-WebSocket-Protocol) that the server has; "": none.
std::string subprotocolOf(std::string_view offered);
/// "... must be foxglove.sdk.v1 or foxglove.websocket.v1, found ..."
std::string subprotocolFault(std::string_view offered);

/// A path without its query.
std::string_view pathOf(std::string_view target);

}  // namespace whirl_twin
