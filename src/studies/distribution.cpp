#include "studies/distribution.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSqrt2 = 1.4142135623730951;

/// From low to high, either met exactly.
double between(double low, double high, double u) {
  return std::clamp(low + u * (high - low), low, high);
}

}  // namespace

double Distribution::value(double u) const {
  switch (kind) {
    case Kind::kUniform:
      return between(low, high, u);
    case Kind::kLogUniform:
      return std::clamp(std::exp(between(std::log(low), std::log(high), u)), low, high);
    case Kind::kNormal:
      return mean - deviation * kSqrt2 * boost::math::erfc_inv(2.0 * u);
    default:
      return list[std::min(static_cast<std::size_t>(u * static_cast<double>(list.size())),
                           list.size() - 1)];
  }
}

double Distribution::level(std::size_t k, std::size_t n) const {
  const auto of = static_cast<double>(n);
  if (kind == Kind::kList) {
    return list[k];
  }
  if (kind == Kind::kNormal || n == 1) {
    return value((static_cast<double>(k) + 0.5) / of);
  }
  return k + 1 == n ? high : value(static_cast<double>(k) / (of - 1.0));
}

std::size_t Distribution::levels(std::size_t n) const {
  return kind == Kind::kList ? list.size() : n;
}

double Distribution::smallest() const {
  switch (kind) {
    case Kind::kNormal:
      return -kInfinity;
    case Kind::kList:
      return *std::min_element(list.begin(), list.end());
    default:
      return low;
  }
}

double Distribution::largest() const {
  switch (kind) {
    case Kind::kNormal:
      return kInfinity;
    case Kind::kList:
      return *std::max_element(list.begin(), list.end());
    default:
      return high;
  }
}

}  // namespace whirl_twin
