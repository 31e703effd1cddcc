// The bytes of an LCM event -> a message, with nothing taken on trust.
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

#include "transport/channels.h"

namespace whirl_twin {

/// Decodes an event of a channel for which parseChannel() knows a kind. Throws RejectedMessage if
/// the payload is of another type, is damaged, does not hold what fromLcm() asks for, or is about
/// another system, drive or source than its channel.
Message decodeEvent(const std::string& channel, const void* data, std::size_t size,
                    const std::string& prefix = kDefaultLcmPrefix);

/// Whether the payload begins with the fingerprint of one of the twin's types.
bool hasTwinFingerprint(const void* data, std::size_t size);

/// The step of a message of a series, see MessageKind::kSeries.
std::optional<std::int64_t> seriesStep(const Message& message);

}  // namespace whirl_twin
