#include "studies/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSqrt2 = 1.4142135623730951;

/// From low to high; both ends are exact.
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

std::vector<double> Study::valuesAt(std::uint64_t point) const {
  std::vector<double> values;
  const bool by_levels = design.kind == Design::Kind::kGrid || design.kind == Design::Kind::kList ||
                         design.kind == Design::Kind::kOneAtATime;
  if (by_levels) {
    const std::vector<std::optional<std::size_t>> levels = levelsAt(design, point);
    for (std::size_t j = 0; j < vary.size(); ++j) {
      const Distribution& distribution = vary[j].distribution;
      const std::size_t of =
          design.kind == Design::Kind::kList ? distribution.list.size() : design.levels[j];
      values.push_back(levels[j] ? distribution.level(*levels[j], of) : vary[j].nominal);
    }
    return values;
  }
  const std::vector<double> u = quantilesAt(design, seed, point);
  for (std::size_t j = 0; j < vary.size(); ++j) {
    values.push_back(vary[j].distribution.value(u[j]));
  }
  return values;
}

std::string text(const Requirement& requirement, const Study& study) {
  const char* const sign = requirement.is == Requirement::Is::kBelow    ? "<"
                           : requirement.is == Requirement::Is::kAtMost ? "<="
                           : requirement.is == Requirement::Is::kAbove  ? ">"
                                                                        : ">=";
  return fmt::format("{} {} {}", study.measures[requirement.measure].name, sign, requirement.limit);
}

}  // namespace whirl_twin
