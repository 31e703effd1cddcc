// Decodes LCM events of untrusted senders.
//
// LCM's generated decoders do not check the lengths they read (a string length of INT_MIN makes
// them read 2 GB beyond the payload, an array length of 2^31 - 1 makes them allocate that much), so
// the payload is validated against its layout before it is decoded. LCM events carry no checksum: a
// flipped bit inside a measured value is not detected here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "transport/channels.h"

namespace whirl_twin {

/// Decodes an event of a channel whose kind parseChannel() knows. Throws RejectedMessage if the
/// payload has another type, is corrupt, fails the validation of fromLcm(), or belongs to a
/// different system, drive or source than its channel.
Message decodeEvent(const std::string& channel, const void* data, std::size_t size,
                    const std::string& prefix = kDefaultLcmPrefix);

/// Whether the payload begins with the fingerprint of a type of the twin.
bool hasTwinFingerprint(const void* data, std::size_t size);

/// The step of a message of a series, see MessageKind::kSeries.
std::optional<std::int64_t> seriesStep(const Message& message);

}  // namespace whirl_twin
