// Round numbers, for the scale factors of pictures.
#pragma once

#include <cmath>

namespace whirl_twin {

/// The largest of ... 0.5, 1, 2, 5, 10 ... that is not above `number` (> 0).
inline double roundDown125(double number) {
  const double decade = std::pow(10.0, std::floor(std::log10(number)));
  // 5 * 0.1 is not 0.5 to the last bit: a number of the series itself must not fall to the next.
  const double digit = number / decade * (1.0 + 1e-12);
  return (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0) * decade;
}

}  // namespace whirl_twin
