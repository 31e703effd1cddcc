#include "analysis/routh_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/root_location.h"

namespace whirl_twin {

namespace {

using SymbolicRow = std::vector<SymbolicQuotient>;

/// "2 s^4 + 12 s^2 + 16": a row of the table as the polynomial it stands for.
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
