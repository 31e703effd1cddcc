#include "transport/lcm_decode.h"

#include <fmt/format.h>

#include <limits>

#include "transport/lcm_converters.h"
#include "transport/payload_layout.h"

namespace whirl_twin {
namespace {

template <class Type>
bool hasFingerprintOf(const void* data, std::size_t size) {
  std::int64_t fingerprint = 0;
  return size >= 8 && __int64_t_decode_array(data, 0, 8, &fingerprint, 1) == 8 &&
         fingerprint == Type::getHash();
}

template <class State>
State decode(const void* data, std::size_t size) {
  using Type = LcmType<State>;
  if (!hasFingerprintOf<Type>(data, size)) {
    throw RejectedMessage(
        fmt::format("expected the fingerprint of {}, found another type", Type::getTypeName()));
  }
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw RejectedMessage(fmt::format("payload: too long: {} bytes", size));
  }
  requireLayout(layoutOf<State>(), data, size);
  Type message;
  if (message.decode(data, 0, static_cast<int>(size)) != static_cast<int>(size)) {
    throw RejectedMessage(fmt::format("payload: not a {}", Type::getTypeName()));
  }
  return fromLcm<State>(message);
}

}  // namespace

Message decodeEvent(const std::string& channel, const void* data, std::size_t size,
                    const std::string& prefix) {
  const auto parsed = parseChannel(channel, prefix);
  std::optional<Message> decoded;
  eachKind([&](auto kind) {
    using State = typename decltype(kind)::State;
    if (parsed && parsed->kind == &State::kKind) {
      const State state = decode<State>(data, size);
      if (channelOf(state, prefix) != channel) {
        throw RejectedMessage(
            fmt::format("a message of channel {} arrived here", channelOf(state, prefix)));
      }
      decoded = state;
    }
  });
  if (!decoded) {
    throw RejectedMessage("not a channel of the twin");
  }
  return std::move(*decoded);
}

bool hasTwinFingerprint(const void* data, std::size_t size) {
  bool found = false;
  eachKind([&](auto kind) {
    found = found || hasFingerprintOf<LcmType<typename decltype(kind)::State>>(data, size);
  });
  return found;
}

std::optional<std::int64_t> seriesStep(const Message& message) {
  return std::visit(
      [](const auto& state) -> std::optional<std::int64_t> {
        using State = std::decay_t<decltype(state)>;
        if constexpr (State::kKind.has(MessageKind::kSeries)) {
          return state.at.step;
        }
        return std::nullopt;
      },
      message);
}

}  // namespace whirl_twin
