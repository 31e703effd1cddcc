// Checksums of bytes: a CRC for data that is read back after writing, which detects changed bits
// and truncation, and a fingerprint for comparison only. Neither is cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>

namespace whirl_twin {

/// CRC-32C (Castagnoli, IEEE Trans. Comm. 41, 1993; RFC 3720) of bytes that follow those with the
/// checksum `before`. Detects every burst of up to 32 changed bits.
std::uint32_t crc32c(const void* data, std::size_t size, std::uint32_t before = 0);

inline constexpr std::uint64_t kNoFingerprint = 14695981039346656037U;

/// FNV-1a (Fowler, Noll & Vo) of bytes that follow those with the fingerprint `before`.
inline std::uint64_t fingerprint(const void* data, std::size_t size,
                                 std::uint64_t before = kNoFingerprint) noexcept {
  const auto* const bytes = static_cast<const unsigned char*>(data);
  std::uint64_t sum = before;
  for (std::size_t i = 0; i < size; ++i) {
    sum = (sum ^ bytes[i]) * 1099511628211U;
  }
  return sum;
}

}  // namespace whirl_twin
