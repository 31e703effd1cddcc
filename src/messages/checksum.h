// FNV-1a (Fowler, Noll & Vo): tells bytes from other bytes by accident, and keeps no secret.
#pragma once

#include <cstddef>
#include <cstdint>

namespace whirl_twin {

inline constexpr std::uint64_t kNoChecksum = 14695981039346656037U;

/// Of bytes, behind those that `before` is of.
inline std::uint64_t checksum(const void* data, std::size_t size,
                              std::uint64_t before = kNoChecksum) noexcept {
  const auto* const bytes = static_cast<const unsigned char*>(data);
  std::uint64_t sum = before;
  for (std::size_t i = 0; i < size; ++i) {
    sum = (sum ^ bytes[i]) * 1099511628211U;
  }
  return sum;
}

}  // namespace whirl_twin
