// Polynomials in one symbol with exact coefficients, and their quotients: what the entries of
// Routh's table are when a coefficient has a parameter in it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

/// entry[k] of the k-th power; the last is not zero; none: the zero polynomial.
struct SymbolicPolynomial {
  std::vector<Rational> entry;

  SymbolicPolynomial() = default;
  SymbolicPolynomial(const Rational& constant);
  explicit SymbolicPolynomial(std::vector<Rational> entries);

  bool zero() const { return entry.empty(); }
  bool constant() const { return entry.size() <= 1; }
  int degree() const { return static_cast<int>(entry.size()) - 1; }  ///< -1 of zero
  Rational at(const Rational& x) const;
};

SymbolicPolynomial operator+(const SymbolicPolynomial& a, const SymbolicPolynomial& b);
SymbolicPolynomial operator-(const SymbolicPolynomial& a, const SymbolicPolynomial& b);
SymbolicPolynomial operator*(const SymbolicPolynomial& a, const SymbolicPolynomial& b);
bool operator==(const SymbolicPolynomial& a, const SymbolicPolynomial& b);
/// Quotient and remainder; the divisor is not zero.
std::pair<SymbolicPolynomial, SymbolicPolynomial> divided(const SymbolicPolynomial& a,
                                                          const SymbolicPolynomial& b);
/// With the leading coefficient 1; zero of two zeros.
SymbolicPolynomial greatestCommonDivisor(SymbolicPolynomial a, SymbolicPolynomial b);
SymbolicPolynomial derivative(const SymbolicPolynomial& polynomial);
/// Every root once.
SymbolicPolynomial squareFree(const SymbolicPolynomial& polynomial);

/// "2 K^2 - 3 K + 1" of whole coefficients; fractions as "3/2 K".
std::string text(const SymbolicPolynomial& polynomial, const std::string& symbol);
/// "3/2"; a number that is too long for that as "1.23457e+10".
std::string text(const Rational& number);

/// Sums, differences and products of decimal numbers and the symbol, powers of it, brackets, and
/// quotients by numbers: "2K", "(K + 1)/3", "0.5*K^2 - 1/3". `symbol` "": numbers only. Throws
/// InputError.
SymbolicPolynomial parseSymbolic(const std::string& text, const std::string& symbol);

/// numerator / denominator without a common factor, the denominator's leading coefficient positive
/// and all coefficients of both whole, without a common factor either.
struct SymbolicQuotient {
  SymbolicPolynomial numerator, denominator = Rational(1);

  SymbolicQuotient() = default;
  SymbolicQuotient(const SymbolicPolynomial& whole);
  /// The denominator is not zero.
  SymbolicQuotient(const SymbolicPolynomial& above, const SymbolicPolynomial& below);

  bool zero() const { return numerator.zero(); }
};

SymbolicQuotient operator+(const SymbolicQuotient& a, const SymbolicQuotient& b);
SymbolicQuotient operator-(const SymbolicQuotient& a, const SymbolicQuotient& b);
SymbolicQuotient operator*(const SymbolicQuotient& a, const SymbolicQuotient& b);
SymbolicQuotient operator/(const SymbolicQuotient& a, const SymbolicQuotient& b);

/// "(6 - K)/2" with what is constant as a number.
std::string text(const SymbolicQuotient& quotient, const std::string& symbol);

}  // namespace whirl_twin
