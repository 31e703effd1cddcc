// CRC-32C against the vectors of RFC 3720, B.4, and its value of "123456789" (Castagnoli's).
#include "messages/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace whirl_twin {
namespace checksum_test {

std::uint32_t of(const std::string& bytes, std::uint32_t before = 0) {
  return crc32c(bytes.data(), bytes.size(), before);
}

TEST(Crc32c, IsThatOfRfc3720) {
  std::string rising, falling;
  for (int i = 0; i < 32; ++i) {
    rising += static_cast<char>(i);
    falling += static_cast<char>(31 - i);
  }
  EXPECT_EQ(of(""), 0U);
  EXPECT_EQ(of("123456789"), 0xe3069283U);
  EXPECT_EQ(of(std::string(32, '\0')), 0x8a9136aaU);
  EXPECT_EQ(of(std::string(32, '\xff')), 0x62a8ab43U);
  EXPECT_EQ(of(rising), 0x46dd794eU);
  EXPECT_EQ(of(falling), 0x113fdb5cU);
}

TEST(Crc32c, GoesOnBehindWhatWasBefore) {
  const std::string text = "a twin that is put back goes on";
  for (std::size_t at = 0; at <= text.size(); ++at) {
    EXPECT_EQ(of(text.substr(at), of(text.substr(0, at))), of(text)) << at;
  }
}

}  // namespace checksum_test
}  // namespace whirl_twin
