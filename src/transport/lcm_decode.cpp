#include "transport/lcm_decode.h"

#include <fmt/format.h>

#include <limits>

#include "transport/earlier_forms.h"
#include "transport/lcm_encode.h"
#include "transport/payload_layout.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kFingerprintSize = 8;
/// No message is near this, so that a few fields more fit an int, too.
constexpr std::size_t kLongestPayload = std::numeric_limits<int>::max() / 2;

bool hasFingerprint(std::uint64_t expected, const void* data, std::size_t size) {
  std::int64_t fingerprint = 0;
  return size >= kFingerprintSize &&
         __int64_t_decode_array(data, 0, kFingerprintSize, &fingerprint, 1) == kFingerprintSize &&
         static_cast<std::uint64_t>(fingerprint) == expected;
}

template <class State>
bool hasFingerprintOf(const void* data, std::size_t size) {
  return hasFingerprint(static_cast<std::uint64_t>(LcmType<State>::getHash()), data, size);
}

/// The earlier form that the payload begins like; null for one of today's, or of another type.
template <class State>
const EarlierForm* earlierFormOf(const void* data, std::size_t size) {
  for (const EarlierForm& form : kEarlierForms<State>) {
    if (hasFingerprint(form.fingerprint, data, size)) {
      return &form;
    }
  }
  return nullptr;
}

/// A payload in an earlier form as it would be today, the later fields as nothing has set them.
template <class State>
std::vector<std::uint8_t> inTodaysForm(const EarlierForm& form, const void* data,
                                       std::size_t size) {
  const std::string& today = layoutOf<State>();
  requireLayout(today.substr(0, today.size() - form.later.size()), data, size);
  std::vector<std::uint8_t> unset;
  encode(State{}, unset);
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  std::vector<std::uint8_t> payload(unset.begin(), unset.begin() + kFingerprintSize);
  payload.insert(payload.end(), bytes + kFingerprintSize, bytes + size);
  payload.insert(payload.end(), unset.end() - static_cast<std::ptrdiff_t>(sizeUnset(form.later)),
                 unset.end());
  return payload;
}

template <class State>
State decode(const void* data, std::size_t size) {
  using Type = LcmType<State>;
  if (size > kLongestPayload) {
    throw RejectedMessage(fmt::format("payload: too long: {} bytes", size));
  }
  if (const EarlierForm* form = earlierFormOf<State>(data, size)) {
    const std::vector<std::uint8_t> payload = inTodaysForm<State>(*form, data, size);
    return decode<State>(payload.data(), payload.size());
  }
  if (!hasFingerprintOf<State>(data, size)) {
    throw RejectedMessage(
        fmt::format("expected the fingerprint of {}, found another type", Type::getTypeName()));
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
    using State = typename decltype(kind)::State;
    found = found || hasFingerprintOf<State>(data, size) || earlierFormOf<State>(data, size);
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
