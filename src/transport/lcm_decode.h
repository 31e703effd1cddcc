// The bytes of an LCM event -> a state, with nothing taken on trust.
//
// LCM's generated decoders believe the lengths they read (a string length of INT_MIN makes them
// read 2 GB beyond the payload, an array length of 2^31 - 1 makes them allocate that much), so the
// payload is walked by its layout before it is decoded. LCM events carry no checksum: a changed bit
// inside a measured value is a different value, and is not noticed here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "messages/alert.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin {

/// Whatever one event of the twin can say.
using TwinState = std::variant<state::WhirlState, state::PendulumState, state::DriveState,
                               state::MotorState, state::EnsembleState, state::StabilityMargin,
                               state::ParameterChange, state::Alert>;

/// Decodes an event of a channel for which parseChannel() knows a kind. Throws RejectedMessage if
/// the payload is of another type, is damaged, does not hold what fromLcm() asks for, or names
/// another system or drive than its channel does.
TwinState decodeEvent(const std::string& channel, const void* data, std::size_t size);

/// Whether the payload begins with the fingerprint of one of the twin's types.
bool hasTwinFingerprint(const void* data, std::size_t size);

/// The step of a whirl, pendulum, drive or motor state, of which a channel carries every n-th
/// without a hole; nothing for stability margins, parameters and alerts, which are sent when there
/// is news, and for ensembles, of which the newest is sent.
std::optional<std::int64_t> seriesStep(const TwinState& state);

/// The channel on which a state belongs.
std::string channelOf(const state::WhirlState& whirl);
std::string channelOf(const state::PendulumState& pendulum);
std::string channelOf(const state::DriveState& drive);
std::string channelOf(const state::MotorState& motor);
std::string channelOf(const state::EnsembleState& ensemble);
std::string channelOf(const state::StabilityMargin& margin);
std::string channelOf(const state::ParameterChange& change);
std::string channelOf(const state::Alert& alert);

}  // namespace whirl_twin
