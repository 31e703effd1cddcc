#include "analysis/routh_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "messages/refusal.h"

namespace whirl_twin {

namespace {

RouthCondition condition(const std::string& name, const Rational& left, const Rational& right) {
  return {name, toDouble(left), toDouble(right), left > right};
}

}  // namespace

std::vector<RouthCondition> routhConditions(const std::vector<Rational>& coefficients) {
  const auto first = std::find_if(coefficients.begin(), coefficients.end(),
                                  [](const Rational& c) { return c != 0; });
  const auto degree = coefficients.end() - first - 1;
  if (degree < kLeastConditionDegree || degree > kMostConditionDegree) {
    throw Refusal(
        fmt::format("Routh's conditions: expected a polynomial of degree {} to {}, found {}",
                    kLeastConditionDegree, kMostConditionDegree,
                    degree < 0 ? "zero" : fmt::format("degree {}", degree)));
  }
  std::vector<RouthCondition> conditions;
  std::vector<Rational> a;  // A_0 ... A_(n - 1)
  for (auto c = coefficients.end() - 1; c != first; --c) {
    conditions.push_back(condition(fmt::format("A{} > 0", a.size()), *c / *first, 0));
    a.push_back(*c / *first);
  }
  if (degree == 3) {
    conditions.push_back(condition("A1 A2 > A0", a[1] * a[2], a[0]));
  } else if (degree == 4) {
    conditions.push_back(condition("A1 A2 A3 > A1^2 + A3^2 A0", a[1] * a[2] * a[3],
                                   a[1] * a[1] + a[3] * a[3] * a[0]));
  } else if (degree == 5) {
    const Rational cross = a[1] * a[4] - a[0];
    conditions.push_back(condition("A3 A4 > A2", a[3] * a[4], a[2]));
    conditions.push_back(condition("(A3 A4 - A2)(A1 A2 - A0 A3) > (A1 A4 - A0)^2",
                                   (a[3] * a[4] - a[2]) * (a[1] * a[2] - a[0] * a[3]),
                                   cross * cross));
  } else if (degree == 6) {
    const Rational b1 = a[4] * a[5] - a[3];
    const Rational b2 = a[2] * a[5] - a[1];
    const Rational b3 = a[0] * a[5];
    const Rational cross = a[1] * b1 - a[5] * b3;
    conditions.push_back(
        condition("A3 b1 > A5 b2, b1 = A4 A5 - A3, b2 = A2 A5 - A1", a[3] * b1, a[5] * b2));
    conditions.push_back(condition("(A3 b1 - A5 b2)(A1 b2 - A3 b3) > (A1 b1 - A5 b3)^2, b3 = A0 A5",
                                   (a[3] * b1 - a[5] * b2) * (a[1] * b2 - a[3] * b3),
                                   cross * cross));
  }
  return conditions;
}

std::vector<RouthCondition> routhConditions(const std::vector<double>& coefficients) {
  std::vector<Rational> exact;
  for (const double c : coefficients) {
    if (!std::isfinite(c)) {
      throw Refusal(fmt::format("Routh's conditions: expected finite coefficients, found {}", c));
    }
    exact.emplace_back(c);
  }
  return routhConditions(exact);
}

}  // namespace whirl_twin
