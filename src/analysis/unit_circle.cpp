#include "analysis/unit_circle.h"

#include <algorithm>

#include "analysis/root_location.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

/// p (s w + 1), s = 1 or -1, lowest power first.
void timesFactor(std::vector<Rational>& p, int s) {
  p.emplace_back(0);
  for (std::size_t k = p.size() - 1; k > 0; --k) {
    if (s > 0) {
      p[k] += p[k - 1];
    } else {
      p[k] -= p[k - 1];
    }
  }
}

}  // namespace

std::vector<Rational> bilinearTransform(const std::vector<Rational>& polynomial) {
  std::vector<Rational> sum;                 // Horner's scheme in (1 + w) ...
  std::vector<Rational> power{Rational(1)};  // ... and (1 - w)^k
  for (const Rational& coefficient : polynomial) {
    if (sum.empty()) {
      sum.push_back(coefficient);
      continue;
    }
    timesFactor(sum, 1);
    timesFactor(power, -1);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += coefficient * power[k];
    }
  }
  std::reverse(sum.begin(), sum.end());
  return sum;
}

RouthResult routhOfCircle(const std::vector<Rational>& transformed, ExactBudget& budget) {
  RouthResult result = routh(transformed, budget);
  const auto first = std::find_if(transformed.begin(), transformed.end(),
                                  [](const Rational& c) { return c != 0; });
  const auto at_minus_one = static_cast<int>(first - transformed.begin());
  result.imaginary += at_minus_one;
  result.largest_imaginary_multiplicity =
      std::max(result.largest_imaginary_multiplicity, at_minus_one);
  result.verdict = verdictOf(result);
  return result;
}

}  // namespace whirl_twin
