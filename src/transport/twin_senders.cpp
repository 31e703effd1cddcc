#include "transport/twin_senders.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/filter.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "transport/lcm_connection.h"

namespace whirl_twin {

namespace {

constexpr const char* kScheme = "udpm://";
constexpr const char* kAddress = "239.255.76.67";  // LCM's default
constexpr std::uint16_t kPort = 7667;

// A short LCM message: a magic number, a sequence number, the zero-terminated channel, the payload.
constexpr std::uint32_t kShortMessageMagic = 0x4c433032;  // LC02
constexpr std::size_t kBeforeChannel = 8;                 // bytes
constexpr std::size_t kMaxDatagram = 65536;               // bytes of a datagram
constexpr std::uint32_t kUdpHeader = 8;                   // bytes, counted by the filter

std::optional<sockaddr_in> addressOf(const std::string& url) {
  if (url.compare(0, std::strlen(kScheme), kScheme) != 0) {
    return std::nullopt;
  }
  const std::string network =
      url.substr(std::strlen(kScheme), url.find('?') - std::strlen(kScheme));
  const std::size_t colon = network.find(':');
  const std::string host = network.substr(0, colon);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(kPort);
  if (colon != std::string::npos) {
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::strtoul(network.c_str() + colon + 1, nullptr, 10)));
  }
  if (inet_pton(AF_INET, host.empty() ? kAddress : host.c_str(), &address.sin_addr) != 1) {
    return std::nullopt;
  }
  return address;
}

/// BPF filter that accepts short LCM messages of this channel only.
std::vector<sock_filter> filterFor(const std::string& channel) {
  std::vector<sock_filter> program;
  const auto require = [&program](std::uint16_t size, std::uint32_t at, std::uint32_t value) {
    program.push_back(BPF_STMT(BPF_LD | BPF_ABS | size, at));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, 0));
  };
  require(BPF_W, kUdpHeader, kShortMessageMagic);
  for (std::size_t i = 0; i <= channel.size(); ++i) {  // with the terminating zero
    require(BPF_B, static_cast<std::uint32_t>(kUdpHeader + kBeforeChannel + i),
            static_cast<unsigned char>(channel.c_str()[i]));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, kMaxDatagram));
  return program;
}

}  // namespace

bool ChannelListener::canListenTo(const std::string& url) {
  return addressOf(url).has_value();
}

ChannelListener::ChannelListener(const std::string& url, const std::string& channel)
    : head_(kBeforeChannel + channel.size() + 1),
      socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
      datagram_(kMaxDatagram) {
  const auto address = addressOf(url);
  std::vector<sock_filter> program = filterFor(channel);
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  const int on = 1;
  ip_mreq group{};
  group.imr_multiaddr = address.value().sin_addr;
  const auto set = [this](int level, int option, const auto& value) {
    return setsockopt(socket_, level, option, &value, sizeof value) == 0;
  };
  // The filter is attached before datagrams of other channels can arrive.
  if (!(socket_ >= 0 && set(SOL_SOCKET, SO_ATTACH_FILTER, filter) &&
        set(SOL_SOCKET, SO_REUSEADDR, on) &&
        bind(socket_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) == 0 &&
        set(IPPROTO_IP, IP_ADD_MEMBERSHIP, group))) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) {
      close(socket_);
    }
    throw LcmNotAvailable(fmt::format("{} cannot be received at '{}': {}", channel, url, why));
  }
}

ChannelListener::~ChannelListener() {
  close(socket_);
}

std::optional<std::vector<std::uint8_t>> ChannelListener::next() {
  const ssize_t size = recv(socket_, datagram_.data(), datagram_.size(), MSG_DONTWAIT);
  if (size < static_cast<ssize_t>(head_)) {
    return std::nullopt;
  }
  return std::vector<std::uint8_t>(datagram_.begin() + static_cast<std::ptrdiff_t>(head_),
                                   datagram_.begin() + size);
}

namespace {

/// [s] Timeout of a sender: some periods of its statistics.
constexpr double kMemory = 5.0;
/// A restarted twin may overlap with the one that ends, which gives one alternation.
constexpr std::size_t kTurns = 3;
constexpr std::size_t kMaxSenders = 64;  // at a time

}  // namespace

TwinSenders::TwinSenders(std::string where, std::string remedy)
    : where_(std::move(where)), remedy_(std::move(remedy)) {}

void TwinSenders::take(const state::LoopStatistics& loop, double now) {
  if (loop.started == 0) {
    return;  // an earlier form, without the start of the run
  }
  while (!returns_.empty() && now - returns_.front() > kMemory) {
    returns_.pop_front();
  }
  for (auto one = heard_.begin(); one != heard_.end();) {
    one = now - one->second > kMemory ? heard_.erase(one) : std::next(one);
  }
  const Run run{loop.started, loop.sender};
  const bool known = heard_.count(run) > 0;
  if (!known && heard_.size() >= kMaxSenders) {
    return;
  }
  if (known && run != last_ && returns_.size() < kMaxSenders) {
    returns_.push_back(now);
  }
  heard_[run] = now;
  last_ = run;
}

std::string TwinSenders::trouble(double now) const {
  const auto turns = std::count_if(returns_.begin(), returns_.end(),
                                   [now](double at) { return now - at <= kMemory; });
  if (static_cast<std::size_t>(turns) < kTurns) {
    return "";
  }
  std::vector<std::string> names;
  for (const auto& [run, at] : heard_) {
    if (now - at <= kMemory) {
      names.push_back(run.second.empty() ? "a publisher without a name" : run.second);
    }
  }
  return fmt::format("{} twins on {}: {}; {}", names.size(), where_, fmt::join(names, " and "),
                     remedy_);
}

}  // namespace whirl_twin
