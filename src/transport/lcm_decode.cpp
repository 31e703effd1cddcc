#include "transport/lcm_decode.h"

#include <fmt/format.h>

#include <limits>

#include "transport/channels.h"
#include "transport/lcm_converters.h"
#include "transport/payload_layout.h"

namespace whirl_twin {
namespace {

template <class Message>
bool hasFingerprintOf(const void* data, std::size_t size) {
  std::int64_t fingerprint = 0;
  return size >= 8 && __int64_t_decode_array(data, 0, 8, &fingerprint, 1) == 8 &&
         fingerprint == Message::getHash();
}

template <class Message>
TwinState decode(const std::string& channel, const void* data, std::size_t size) {
  if (!hasFingerprintOf<Message>(data, size)) {
    throw RejectedMessage(
        fmt::format("expected the fingerprint of {}, found another type", Message::getTypeName()));
  }
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw RejectedMessage(fmt::format("payload: too long: {} bytes", size));
  }
  requireLayout(kPayloadLayout<Message>, data, size);
  Message message;
  if (message.decode(data, 0, static_cast<int>(size)) != static_cast<int>(size)) {
    throw RejectedMessage(fmt::format("payload: not a {}", Message::getTypeName()));
  }
  const auto state = fromLcm(message);
  if (channelOf(state) != channel) {
    throw RejectedMessage(fmt::format("a state of channel {} arrived here", channelOf(state)));
  }
  return state;
}

}  // namespace

TwinState decodeEvent(const std::string& channel, const void* data, std::size_t size) {
  const auto parsed = parseChannel(channel);
  if (!parsed) {
    throw RejectedMessage("not a channel of the twin");
  }
  switch (parsed->kind) {
    case ChannelKind::kWhirl:
      return decode<whirl_state_t>(channel, data, size);
    case ChannelKind::kPendulum:
      return decode<pendulum_state_t>(channel, data, size);
    case ChannelKind::kStability:
      return decode<stability_margin_t>(channel, data, size);
    case ChannelKind::kParameter:
      return decode<parameter_change_t>(channel, data, size);
    case ChannelKind::kEnsemble:
      return decode<ensemble_state_t>(channel, data, size);
    case ChannelKind::kDrive:
      return decode<drive_state_t>(channel, data, size);
    case ChannelKind::kMotor:
      return decode<motor_state_t>(channel, data, size);
    case ChannelKind::kAlerts:
      return decode<alert_t>(channel, data, size);
  }
  throw RejectedMessage("not a channel of the twin");
}

bool hasTwinFingerprint(const void* data, std::size_t size) {
  return hasFingerprintOf<whirl_state_t>(data, size) ||
         hasFingerprintOf<pendulum_state_t>(data, size) ||
         hasFingerprintOf<drive_state_t>(data, size) ||
         hasFingerprintOf<stability_margin_t>(data, size) ||
         hasFingerprintOf<motor_state_t>(data, size) ||
         hasFingerprintOf<ensemble_state_t>(data, size) ||
         hasFingerprintOf<parameter_change_t>(data, size) || hasFingerprintOf<alert_t>(data, size);
}

std::optional<std::int64_t> seriesStep(const TwinState& state) {
  if (const auto* whirl = std::get_if<state::WhirlState>(&state)) {
    return whirl->at.step;
  }
  if (const auto* pendulum = std::get_if<state::PendulumState>(&state)) {
    return pendulum->at.step;
  }
  if (const auto* drive = std::get_if<state::DriveState>(&state)) {
    return drive->at.step;
  }
  if (const auto* motor = std::get_if<state::MotorState>(&state)) {
    return motor->at.step;
  }
  return std::nullopt;
}

std::string channelOf(const state::WhirlState& whirl) {
  return channelName(ChannelKind::kWhirl, whirl.system);
}

std::string channelOf(const state::PendulumState& pendulum) {
  return channelName(ChannelKind::kPendulum, pendulum.system);
}

std::string channelOf(const state::DriveState& drive) {
  return channelName(ChannelKind::kDrive, drive.drive);
}

std::string channelOf(const state::MotorState& motor) {
  return channelName(ChannelKind::kMotor, motor.drive);
}

std::string channelOf(const state::EnsembleState& ensemble) {
  return channelName(ChannelKind::kEnsemble, ensemble.system);
}

std::string channelOf(const state::StabilityMargin& margin) {
  return channelName(ChannelKind::kStability, margin.system);
}

std::string channelOf(const state::ParameterChange& change) {
  return channelName(ChannelKind::kParameter, change.system);
}

std::string channelOf(const state::Alert&) {
  return channelName(ChannelKind::kAlerts);
}

}  // namespace whirl_twin
