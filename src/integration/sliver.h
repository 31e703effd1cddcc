// Rounding limits of step lengths.
#pragma once

#include <cmath>
#include <cstdint>

namespace whirl_twin {

/// Parts of a step shorter than this share of it are not worth a step.
inline constexpr double kSliver = 1.0e-12;

/// Of an offset [s]; a thousandth is rounding.
inline std::int64_t wholeNanoseconds(double offset) noexcept {
  return static_cast<std::int64_t>(std::floor(offset * 1e9 + 1e-3));
}

}  // namespace whirl_twin
