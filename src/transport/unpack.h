// Decompression of the chunks of a rosbag.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

/// Decompresses `packed`, of compression "none", "bz2" or "lz4" (frames). Returns the error, ""
/// without one; `out` then has the bytes before it. At most `most` bytes are written.
std::string unpack(const std::string& compression, std::vector<std::uint8_t>& packed,
                   std::size_t most, std::vector<std::uint8_t>& out);

}  // namespace whirl_twin
