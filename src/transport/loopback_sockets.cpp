// Restricts sockets of libraries to the loopback interface if the configuration requests it. liblcm
// sends by the routing table whatever its ttl is, so that a network that comes up while a twin runs
// would receive its messages; roscpp's XML-RPC server listens on all interfaces even with
// ROS_IP=127.0.0.1, so that any host on the network could shut down a node. Both libraries create
// their sockets internally: bind() and setsockopt(), interposed in the programs that link this
// file, add what is missing, for these sockets only.
//
//   IP_MULTICAST_TTL 0      the socket sends by the loopback interface
//   IP_ADD_MEMBERSHIP       also joins the group on the loopback interface: without a member there
//                           the kernel drops what arrives by it
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

/// Calls the kernel directly: the functions below replace those of the C library.
long set(int socket, int level, int name, const void* value, socklen_t size) {
  return ::syscall(SYS_setsockopt, socket, level, name, value, size);
}

in_addr loopback() {
  in_addr address{};
  address.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// For a value of 1 byte or an int, in either byte order.
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
  // Failures of the following calls are ignored: without the loopback interface nothing is sent by
  // it.
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
