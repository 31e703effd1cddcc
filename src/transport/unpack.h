// What a chunk of a rosbag is compressed with, undone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

/// The bytes behind `packed`, by compression "none", "bz2" or "lz4" (frames). Returns what is
/// wrong,
/// "" if nothing; `out` then has what came before it. At most `most` bytes are made.
std::string unpack(const std::string& compression, std::vector<std::uint8_t>& packed,
                   std::size_t most, std::vector<std::uint8_t>& out);

}  // namespace whirl_twin
