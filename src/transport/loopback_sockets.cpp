// What the documents call loopback is loopback: sockets of the libraries that our programs use stay
// on this machine where that was asked for. liblcm sends by the routing table whatever its ttl is,
// so that a network that comes up while a twin runs receives it; roscpp's XML-RPC server listens on
// all interfaces even where ROS_IP is 127.0.0.1, so that anybody on the network may end a node.
// Both make their sockets in functions of their own: bind() and setsockopt() of the programs that
// this is linked into do what those leave out, for their own sockets and for no others.
//
//   IP_MULTICAST_TTL 0      the socket sends by the loopback interface
//   IP_ADD_MEMBERSHIP       in the group on the loopback interface, too: without a member there the
//                           kernel drops what arrives by it
//   bind() of TCP to any    to 127.0.0.1 while ROS_HOSTNAME, or without it ROS_IP, is loopback
//   address

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace whirl_twin {

namespace {

/// By the system call itself: the functions below replace those of the C library.
long set(int socket, int level, int name, const void* value, socklen_t size) {
  return ::syscall(SYS_setsockopt, socket, level, name, value, size);
}

in_addr loopback() {
  in_addr address{};
  address.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// Of a byte or an int, in any order of bytes.
bool isZero(const void* value, socklen_t size) {
  constexpr char kZero[sizeof(int)] = {};
  return size > 0 && size <= sizeof kZero && std::memcmp(value, kZero, size) == 0;
}

bool rosIsOnLoopback() {
  const char* host = std::getenv("ROS_HOSTNAME");
  host = host != nullptr && *host != '\0' ? host : std::getenv("ROS_IP");
  return host != nullptr && (std::strcmp(host, "localhost") == 0 || std::strcmp(host, "::1") == 0 ||
                             std::strncmp(host, "127.", 4) == 0);
}

bool isStream(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_STREAM;
}

}  // namespace

}  // namespace whirl_twin

extern "C" {

int setsockopt(int socket, int level, int name, const void* value, socklen_t size) noexcept {
  using namespace whirl_twin;
  const int done = static_cast<int>(set(socket, level, name, value, size));
  const int why = errno;
  // What fails besides changes nothing: without the interface nothing is sent by it either.
  if (level == IPPROTO_IP && name == IP_MULTICAST_TTL && done == 0 && isZero(value, size)) {
    const in_addr interface = loopback();
    set(socket, IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface);
  } else if (level == IPPROTO_IP && name == IP_ADD_MEMBERSHIP && size == sizeof(ip_mreq)) {
    ip_mreq membership{};
    std::memcpy(&membership, value, sizeof membership);
    membership.imr_interface = loopback();
    set(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
  }
  errno = why;
  return done;
}

int bind(int socket, const sockaddr* address, socklen_t size) noexcept {
  using namespace whirl_twin;
  sockaddr_storage own{};
  if (address == nullptr || size > sizeof own || !isStream(socket) || !rosIsOnLoopback()) {
    return static_cast<int>(::syscall(SYS_bind, socket, address, size));
  }
  std::memcpy(&own, address, size);
  auto* const four = reinterpret_cast<sockaddr_in*>(&own);
  auto* const six = reinterpret_cast<sockaddr_in6*>(&own);
  if (own.ss_family == AF_INET && four->sin_addr.s_addr == htonl(INADDR_ANY)) {
    four->sin_addr = loopback();
  } else if (own.ss_family == AF_INET6 && IN6_IS_ADDR_UNSPECIFIED(&six->sin6_addr)) {
    six->sin6_addr = in6addr_loopback;
  }
  return static_cast<int>(::syscall(SYS_bind, socket, &own, size));
}

}  // extern "C"
