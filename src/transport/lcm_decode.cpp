#include "transport/lcm_decode.h"

#include <fmt/format.h>

#include "transport/earlier_forms.h"
#include "transport/lcm_converters.h"
#include "transport/payload_layout.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kHead = 8;

template <class State>
bool hasFingerprintOf(const void* data, std::size_t size) {
  return hasFingerprint(static_cast<std::uint64_t>(LcmType<State>::getHash()), data, size);
}

/// The earlier form that the payload has by its fingerprint; null for a current one or another
/// type.
template <class State>
const EarlierForm* earlierFormOf(const void* data, std::size_t size) {
  for (const EarlierForm& form : kEarlierForms<State>) {
    if (hasFingerprint(form.fingerprint, data, size)) {
      return &form;
    }
  }
  return nullptr;
}

/// Converts a payload in an earlier form to the current one, with defaults in the later fields.
template <class State>
std::vector<std::uint8_t> inTodaysForm(const EarlierForm& form, const void* data,
                                       std::size_t size) {
  const std::string& today = layoutOf<State>();
  requireLayout(today.substr(0, today.size() - form.later.size()), data, size);
  std::vector<std::uint8_t> unset;
  encode(State{}, unset);
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  std::vector<std::uint8_t> payload(unset.begin(), unset.begin() + kHead);
  payload.insert(payload.end(), bytes + kHead, bytes + size);
  payload.insert(payload.end(), unset.end() - static_cast<std::ptrdiff_t>(sizeUnset(form.later)),
                 unset.end());
  return payload;
}

template <class State>
State decode(const void* data, std::size_t size) {
  const EarlierForm* form = size > kMaxLcmPayload ? nullptr : earlierFormOf<State>(data, size);
  if (form != nullptr) {
    const std::vector<std::uint8_t> payload = inTodaysForm<State>(*form, data, size);
    return decode<State>(payload.data(), payload.size());
  }
  return fromLcm<State>(decodePayload<LcmType<State>>(layoutOf<State>(), data, size));
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
        throw RejectedMessage(fmt::format("expected a message of another channel, found one of {}",
                                          channelOf(state, prefix)));
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
