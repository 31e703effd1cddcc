#include "analysis/routh_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/routh.h"
#include "messages/input_error.h"

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
  if (degree < kMinConditionDegree || degree > kMaxConditionDegree) {
    throw InputError(
        fmt::format("Routh's conditions: expected a polynomial of degree {} to {}, found {}",
                    kMinConditionDegree, kMaxConditionDegree,
                    degree < 0 ? "the zero polynomial" : fmt::format("degree {}", degree)));
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
      throw InputError(
          fmt::format("Routh's conditions: expected finite coefficients, found {}", c));
    }
    exact.emplace_back(c);
  }
  return routhConditions(exact);
}

namespace {

using SymbolicRow = std::vector<SymbolicQuotient>;

/// "2 s^4 + 12 s^2 + 16": a row of the table as a polynomial.
std::string polynomialOf(const SymbolicRow& row, int degree, const std::string& symbol) {
  std::string out;
  for (std::size_t j = 0; j < row.size(); ++j) {
    const int power = degree - 2 * static_cast<int>(j);
    if (row[j].zero() || power < 0) {
      continue;
    }
    std::string entry = text(row[j], symbol);
    const bool number = row[j].numerator.constant() && row[j].denominator.constant();
    const bool minus = number && entry.front() == '-';
    entry = minus ? entry.substr(1) : entry;
    entry = number ? entry : "(" + entry + ")";
    out += out.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
    out += entry == "1" && power > 0 ? "" : entry + (power > 0 ? " " : "");
    out += power == 0 ? "" : power == 1 ? "s" : fmt::format("s^{}", power);
  }
  return out;
}

SymbolicRow symbolicRowBelow(const SymbolicRow& upper, const SymbolicRow& lower) {
  const SymbolicQuotient ratio = upper.front() / lower.front();
  SymbolicRow row;
  for (std::size_t j = 1; j < upper.size(); ++j) {
    row.push_back(j < lower.size() ? upper[j] - ratio * lower[j] : upper[j]);
  }
  return row;
}

/// The derivative of the polynomial above, of the given degree.
std::string replaceZeroRow(SymbolicRow& row, const SymbolicRow& above, int degree,
                           const std::string& symbol) {
  row.clear();
  for (int j = 0; 2 * j < degree; ++j) {
    row.push_back(above[static_cast<std::size_t>(j)] *
                  SymbolicQuotient(SymbolicPolynomial(Rational(degree - 2 * j))));
  }
  return fmt::format(
      "all zero: the row above is a factor, {}, with roots in pairs s, -s; its derivative {} "
      "replaces the row",
      polynomialOf(above, degree, symbol), polynomialOf(row, degree - 1, symbol));
}

/// The row plus (-1)^m times itself, m places to the left: that is, times 1 + (-s^2)^m, which is
/// positive on the axis (Benidir and Picinbono 1990).
std::string fillSymbolicZeros(SymbolicRow& row, std::size_t m) {
  for (std::size_t j = 0; j + m < row.size(); ++j) {
    row[j] = m % 2 == 0 ? row[j] + row[j + m] : row[j] - row[j + m];
  }
  return fmt::format(
      "begins with {}: {} itself, {} to the left, which changes no count, instead of a small "
      "epsilon",
      m == 1 ? "a zero" : fmt::format("{} zeros", m), m % 2 == 0 ? "plus" : "minus",
      m == 1 ? "one place" : fmt::format("{} places", m));
}

}  // namespace

RouthTable routhTable(const std::vector<SymbolicPolynomial>& coefficients,
                      const std::string& symbol) {
  const auto [reduced, zeros] =
      withoutZeroRoots(coefficients, [](const SymbolicPolynomial& a) { return a.zero(); });
  const bool turned = reduced.front().constant() && reduced.front().at(0) < 0;
  SymbolicRow upper;
  SymbolicRow lower;
  for (std::size_t i = 0; i < reduced.size(); ++i) {
    (i % 2 == 0 ? upper : lower)
        .push_back(turned ? Rational(-1) * reduced[i] : SymbolicPolynomial(reduced[i]));
  }
  const int degree = static_cast<int>(reduced.size()) - 1;
  RouthTable table;
  table.zero_roots = zeros;
  table.rows.push_back({degree, upper, turned ? "all signs changed" : ""});
  for (int power = degree - 1; power >= 0; --power) {
    const auto zero = [](const SymbolicQuotient& entry) { return entry.zero(); };
    const auto leading = static_cast<std::size_t>(
        std::find_if_not(lower.begin(), lower.end(), zero) - lower.begin());
    std::string note;
    if (leading == lower.size()) {
      note = replaceZeroRow(lower, upper, power + 1, symbol);
    } else if (leading > 0) {
      note = fillSymbolicZeros(lower, leading);
    }
    table.rows.push_back({power, lower, note});
    SymbolicRow next = symbolicRowBelow(upper, lower);
    upper = std::exchange(lower, std::move(next));
  }
  return table;
}

}  // namespace whirl_twin
