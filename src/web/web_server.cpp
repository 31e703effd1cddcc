#include "web/web_server.h"

#include <fmt/format.h>

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "messages/input_error.h"
#include "web/http_response.h"

namespace whirl_twin {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;

constexpr auto kRequestTime = std::chrono::seconds(30);
constexpr auto kGoodbye = std::chrono::milliseconds(200);
constexpr auto kAcceptAgain = std::chrono::milliseconds(100);
constexpr std::uint32_t kHeaderLimit = 8192;  // bytes
constexpr std::uint64_t kBodyLimit = 1024;    // bytes; no request needs one

}  // namespace

/// Sockets and timers, apart from the header.
class WebServer::Io {
 public:
  Io() : acceptor(context), retry(context), goodbye(context) {}

  asio::io_context context{1};
  Tcp::acceptor acceptor;
  asio::steady_timer retry, goodbye;
  std::map<ClientId, std::shared_ptr<WebSocket>> sockets;
  ClientId last = 0;

  void accept(WebServer& server);
};

/// A client by WebSocket.
class WebServer::WebSocket : public std::enable_shared_from_this<WebServer::WebSocket> {
 public:
  WebSocket(WebServer& server, beast::tcp_stream stream, ClientId id)
      : server_(server), stream_(std::move(stream)), id_(id) {}

  void start(const Request& request, const std::string& subprotocol) {
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.set_option(
        websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, subprotocol);
        }));
    stream_.read_message_max(server_.limits_.message);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](Error error) {
      if (error) {
        return self->end(error);
      }
      self->open_ = true;
      self->server_.clients_->opened(self->id_);
      self->read();
    });
  }

  bool send(WebMessage message) {
    const std::size_t limit = (message.kept ? 2 : 1) * server_.limits_.queue;
    if (ended_ || closing_) {
      return false;
    }
    if (waiting_bytes_ + message.size() > limit) {
      ++server_.counts_.dropped;
      if (message.kept) {  // without it, the client would show what is not so
        disconnect();
      }
      return false;
    }
    waiting_bytes_ += message.size();
    waiting_.push_back(std::move(message));
    if (open_ && !writing_) {
      write();
    }
    return true;
  }

  void close() {
    if (open_ && !closing_) {
      closing_ = true;
      stream_.async_close(websocket::close_code::going_away,
                          [self = shared_from_this()](Error) { self->disconnect(); });
    } else {
      disconnect();
    }
  }

  void disconnect() {
    Error ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

 private:
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
      if (error) {
        return self->end(error);
      }
      const auto data = self->buffer_.cdata();
      self->server_.clients_->received(self->id_,
                                       {static_cast<const char*>(data.data()), data.size()},
                                       self->stream_.got_binary());
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void write() {
    writing_ = true;
    const WebMessage& next = waiting_.front();
    const std::array<asio::const_buffer, 2> parts{
        asio::buffer(next.head), next.body ? asio::buffer(*next.body) : asio::const_buffer()};
    stream_.binary(next.binary);
    stream_.async_write(parts, [self = shared_from_this()](Error error, std::size_t) {
      self->writing_ = false;
      if (error) {
        return;  // the read in progress ends, too
      }
      ++self->server_.counts_.sent;
      self->waiting_bytes_ -= self->waiting_.front().size();
      self->waiting_.pop_front();
      if (!self->waiting_.empty() && !self->closing_) {
        self->write();
      }
    });
  }

  void end(const Error& error) {
    if (std::exchange(ended_, true)) {
      return;
    }
    const bool ordinary = error == websocket::error::closed || error == asio::error::eof ||
                          error == asio::error::connection_reset ||
                          error == asio::error::operation_aborted ||
                          error == asio::error::bad_descriptor ||
                          error == asio::error::broken_pipe || error == beast::error::timeout;
    server_.counts_.malformed += ordinary ? 0 : 1;
    disconnect();
    server_.io_->sockets.erase(id_);
    server_.counts_.clients = server_.io_->sockets.size();
    if (open_) {
      server_.clients_->closed(id_);
    }
  }

  WebServer& server_;
  websocket::stream<beast::tcp_stream> stream_;
  ClientId id_;
  beast::flat_buffer buffer_;
  std::deque<WebMessage> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool open_ = false, writing_ = false, closing_ = false, ended_ = false;
};

/// A client by HTTP, which may become one by WebSocket.
class WebServer::Connection : public std::enable_shared_from_this<WebServer::Connection> {
 public:
  Connection(WebServer& server, Tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    ++server_.connections_;
  }
  ~Connection() { --server_.connections_; }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kHeaderLimit);
    parser_->body_limit(kBodyLimit);
    stream_.expires_after(kRequestTime);
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
          if (error) {
            const bool ordinary =
                error == http::error::end_of_stream || error == beast::error::timeout ||
                error == asio::error::operation_aborted || error == asio::error::connection_reset;
            self->server_.counts_.malformed += ordinary ? 0 : 1;
            return self->disconnect();
          }
          self->answer();
        });
  }

  void disconnect() {
    Error ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

 private:
  void answer() {
    const Request& request = parser_->get();
    const std::string_view target = viewOf(request.target());
    const std::string_view host = viewOf(request[http::field::host]);
    const bool page = pathOf(target) == "/";
    const bool upgrade = websocket::is_upgrade(request);
    if (std::string why = hostFault(server_.access_, host); !why.empty()) {
      return refuse(http::status::forbidden, why);
    }
    if (std::string why = originFault(server_.access_, host, viewOf(request[http::field::origin]));
        !why.empty()) {
      return refuse(http::status::forbidden, why);
    }
    if (page || upgrade) {  // the other files contain nothing about a twin
      if (std::string why = tokenFault(server_.access_, target); !why.empty()) {
        return refuse(http::status::forbidden, why);
      }
    }
    if (upgrade) {
      return toWebSocket(request);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return refuse(http::status::method_not_allowed, "method: must be GET or HEAD");
    }
    const auto file = server_.files_.find(std::string(pathOf(target)));
    if (file == server_.files_.end()) {
      return write(refusalOf(request, http::status::not_found, "no such file"));
    }
    write(responseOf(request, http::status::ok, file->second.type, file->second.content));
  }

  void toWebSocket(const Request& request) {
    const std::string_view offered = viewOf(request[http::field::sec_websocket_protocol]);
    const std::string subprotocol = subprotocolOf(offered);
    if (subprotocol.empty()) {
      return refuse(http::status::bad_request, subprotocolFault(offered));
    }
    if (server_.io_->sockets.size() >= server_.limits_.clients) {
      return refuse(
          http::status::service_unavailable,
          fmt::format("the server has its {} clients; close one of them", server_.limits_.clients));
    }
    const ClientId id = ++server_.io_->last;
    const auto socket = std::make_shared<WebSocket>(server_, std::move(stream_), id);
    server_.io_->sockets[id] = socket;
    server_.counts_.clients = server_.io_->sockets.size();
    socket->start(request, subprotocol);
  }

  void refuse(http::status status, const std::string& why) {
    ++server_.counts_.refused;
    write(refusalOf(parser_->get(), status, why));
  }

  void write(Response response) {
    response_ = std::move(response);
    http::async_write(stream_, response_, [self = shared_from_this()](Error error, std::size_t) {
      if (error || !self->response_.keep_alive()) {
        return self->disconnect();
      }
      self->read();
    });
  }

  WebServer& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
};

void WebServer::Io::accept(WebServer& server) {
  acceptor.async_accept([this, &server](Error error, Tcp::socket socket) {
    if (!acceptor.is_open()) {
      return;
    }
    if (error) {  // as too many open files: it may succeed later
      retry.expires_after(kAcceptAgain);
      return retry.async_wait([this, &server](Error ended) {
        if (!ended) {
          accept(server);
        }
      });
    }
    Error ignored;
    socket.set_option(Tcp::no_delay(true), ignored);  // an answer must not wait for an ACK
    if (server.connections_ + sockets.size() < server.limits_.connections) {
      std::make_shared<Connection>(server, std::move(socket))->read();
    } else {
      ++server.counts_.refused;  // the socket closes
    }
    accept(server);
  });
}

WebServer::WebServer(WebAccess access, const WebLimits& limits, WebFiles files)
    : access_(std::move(access)),
      limits_(limits),
      files_(std::move(files)),
      io_(std::make_unique<Io>()) {
  Error error;
  const std::string literal = access_.address == "localhost" ? "127.0.0.1" : access_.address;
  const auto address = asio::ip::make_address(literal, error);
  if (error) {
    throw InputError(fmt::format("address: must be an IP address, found '{}'", access_.address));
  }
  const Tcp::endpoint endpoint(address, access_.port);
  try {
    io_->acceptor.open(endpoint.protocol());
    io_->acceptor.set_option(Tcp::acceptor::reuse_address(true));
    io_->acceptor.bind(endpoint);
    io_->acceptor.listen();
  } catch (const boost::system::system_error& failure) {
    throw RunFailure(failure.code() == asio::error::address_in_use
                         ? fmt::format("port: {} is in use on {}; 0 takes any free one",
                                       access_.port, access_.address)
                         : fmt::format("address: cannot listen on {} port {}: {}", access_.address,
                                       access_.port, failure.code().message()));
  }
  access_.port = io_->acceptor.local_endpoint().port();
}

WebServer::~WebServer() {
  stop();
}

void WebServer::start(WebClients& clients) {
  clients_ = &clients;
  io_->accept(*this);
  thread_ = std::thread([this] { io_->context.run(); });
}

void WebServer::stop() {
  if (!thread_.joinable()) {
    return;
  }
  post([this] {
    Error ignored;
    io_->acceptor.close(ignored);
    io_->retry.cancel();
    for (const auto& [id, socket] : std::map(io_->sockets)) {
      socket->close();
    }
    io_->goodbye.expires_after(kGoodbye);
    io_->goodbye.async_wait([this](Error) { io_->context.stop(); });
  });
  thread_.join();
}

void WebServer::post(std::function<void()> task) {
  asio::post(io_->context, std::move(task));
}

bool WebServer::send(ClientId client, WebMessage message) {
  const auto found = io_->sockets.find(client);
  return found != io_->sockets.end() && found->second->send(std::move(message));
}

void WebServer::disconnect(ClientId client) {
  const auto found = io_->sockets.find(client);
  if (found != io_->sockets.end()) {
    found->second->disconnect();
  }
}

}  // namespace whirl_twin
