#include "messages/checksum.h"

#include <boost/crc.hpp>

namespace whirl_twin {

std::uint32_t crc32c(const void* data, std::size_t size, std::uint32_t before) {
  constexpr std::uint32_t kAll = 0xffffffffU;
  // A reflected CRC starts with the bits in reverse order.
  std::uint32_t begin = 0;
  for (unsigned bit = 0; bit < 32; ++bit) {
    begin |= (((before ^ kAll) >> bit) & 1U) << (31U - bit);
  }
  boost::crc_optimal<32, 0x1edc6f41, kAll, kAll, true, true> crc(begin);
  crc.process_bytes(data, size);
  return crc.checksum();
}

}  // namespace whirl_twin
