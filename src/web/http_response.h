// HTTP responses of the web server, with the headers that restrict what a browser does with them.
// Only web_server.cpp includes it: Boost.Beast takes long to compile.
#pragma once

#include <boost/beast/http.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace whirl_twin {

namespace http = boost::beast::http;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

inline std::string_view viewOf(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

inline Response responseOf(const Request& request, http::status status, const std::string& type,
                           std::string content) {
  Response response(status, request.version());
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy",
               "default-src 'self'; connect-src 'self' ws:; frame-ancestors 'none'; "
               "base-uri 'none'; form-action 'none'");
  response.keep_alive(request.keep_alive());
  response.content_length(content.size());
  if (request.method() != http::verb::head) {
    response.body() = std::move(content);
  }
  return response;
}

/// why: one sentence.
inline Response refusalOf(const Request& request, http::status status, const std::string& why) {
  Response response = responseOf(request, status, "text/plain; charset=utf-8", why + "\n");
  response.keep_alive(false);
  return response;
}

}  // namespace whirl_twin
