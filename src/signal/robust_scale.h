// A standard deviation of which the few that are wild decide nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace whirl_twin {

/// The standard deviation for which seven of eight of the first `count` deviates, without sign, are
/// as small as they are; those after them are not read. Half of them (the median) would not see a
/// clock whose steps are nearly a part of the period: most are then off by the same.
template <std::size_t N>
double robustScale(std::array<double, N> deviates, std::size_t count) {
  constexpr double kSevenOfEight = 1.534;  // standard deviations of a normal distribution
  const auto place = static_cast<std::ptrdiff_t>(count * 7 / 8);
  std::nth_element(deviates.begin(), deviates.begin() + place,
                   deviates.begin() + static_cast<std::ptrdiff_t>(count));
  return deviates[static_cast<std::size_t>(place)] / kSevenOfEight;
}

}  // namespace whirl_twin
