// HTTP and WebSocket server: the files of a page, and messages to and from its clients. One thread
// does all input and output. It knows nothing of the twin.
//
// A client that reads too slowly loses messages, which are counted; no one waits for it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include "web/request_check.h"

namespace whirl_twin {

using ClientId = std::uint64_t;

struct WebLimits {
  std::size_t clients = 8;              ///< by WebSocket
  std::size_t connections = 32;         ///< all
  std::size_t message = 65'536;         ///< [bytes], from a client
  std::size_t queue = 4 * 1024 * 1024;  ///< [bytes], of states that wait for a client
};

/// A file of the page.
struct WebFile {
  std::string type;  ///< MIME
  std::string content;
};
/// By path: "/", "/page.js".
using WebFiles = std::map<std::string, WebFile>;

/// A message to a client.
struct WebMessage {
  std::string head;                         ///< before the body, of this client
  std::shared_ptr<const std::string> body;  ///< common to all clients; may be null
  bool binary = false;
  /// Must not be lost, as an answer or the newest alerts: it may use as much again as the queue of
  /// a client, which is disconnected where that is full, too.
  bool kept = false;

  /// [bytes], that it takes while it waits.
  std::size_t size() const { return sizeof(WebMessage) + head.size() + (body ? body->size() : 0); }
};

/// Counts since the start. Any thread.
struct WebCounts {
  std::atomic<std::uint64_t> clients{0};    ///< connected now
  std::atomic<std::uint64_t> sent{0};       ///< messages
  std::atomic<std::uint64_t> dropped{0};    ///< messages that a slow client lost
  std::atomic<std::uint64_t> refused{0};    ///< requests: Host, Origin, token, subprotocol, limits
  std::atomic<std::uint64_t> malformed{0};  ///< frames or requests that break a protocol
};

/// What happens to clients. Called by the server's thread; must not wait or throw.
class WebClients {
 public:
  virtual ~WebClients() = default;
  virtual void opened(ClientId client) = 0;
  virtual void received(ClientId client, std::string_view message, bool binary) = 0;
  virtual void closed(ClientId client) = 0;
};

class WebServer {
 public:
  /// Binds the address; port 0: any free one. Throws RunFailure if it cannot, as for a port in use,
  /// InputError for an address that is none.
  WebServer(WebAccess access, const WebLimits& limits, WebFiles files);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// With the port.
  const WebAccess& access() const { return access_; }
  /// `clients` must outlive stop().
  void start(WebClients& clients);
  /// Closes all connections and joins the thread. Waits a moment for clients to notice.
  void stop();

  // Any thread.

  /// Runs a function in the server's thread; not after stop().
  void post(std::function<void()> task);
  const WebCounts& counts() const { return counts_; }

  // The server's thread.

  /// False: the client is gone, or lost the message.
  bool send(ClientId client, WebMessage message);
  void disconnect(ClientId client);

 private:
  class Io;
  class Connection;
  class WebSocket;
  friend class Io;
  friend class Connection;
  friend class WebSocket;

  WebAccess access_;
  WebLimits limits_;
  WebFiles files_;
  WebCounts counts_;
  WebClients* clients_ = nullptr;
  std::size_t connections_ = 0;  // by HTTP; of the server's thread
  std::unique_ptr<Io> io_;
  std::thread thread_;
};

}  // namespace whirl_twin
