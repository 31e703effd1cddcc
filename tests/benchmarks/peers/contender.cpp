#include "contender.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin::comparison {

std::vector<double> tolerances() {
  std::vector<double> all;
  for (int half_decades = 4; half_decades <= 26; ++half_decades) {
    all.push_back(std::pow(10.0, -0.5 * half_decades));
  }
  return all;
}

std::vector<double> stepCounts() {
  std::vector<double> all;
  for (double count = 1.0; count < 1.0e5;
       count = std::max(count + 1.0, std::round(1.125 * count))) {
    all.push_back(count);
  }
  return all;
}

}  // namespace whirl_twin::comparison
