// Finiteness by the bits of the number, so that no compiler flag can reason the check away.
#pragma once

#include <cstdint>
#include <cstring>

namespace whirl_twin {

inline bool isFinite(double x) noexcept {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000ULL;
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return (bits & kExponent) != kExponent;
}

}  // namespace whirl_twin
