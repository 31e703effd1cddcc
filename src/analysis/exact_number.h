// Exact numbers for the stability table. Every finite double and every decimal number is a
// rational, so a Routh table in rationals has no rounding: a zero in it is a zero.
#pragma once

// GCC 12 wrongly suspects the temporaries of boost::rational once they are inlined.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <cstdint>
#include <string>

#include "messages/input_error.h"

namespace whirl_twin {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

/// An exact complex number, re + j im.
struct ComplexRational {
  Rational re;
  Rational im;
};

/// The exact value of a decimal number such as "0.1", "1e-200" or "-2.5E+3".
/// Throws InputError for anything else: text, nan, inf, an exponent beyond +-5000.
Rational parseRational(const std::string& text);

/// The exact value of "3", "3+2i", "-1e-3-2.5i", "2i", "-i" or the same with j.
/// Throws InputError as parseRational() does.
ComplexRational parseComplex(const std::string& text);

/// What an exact computation may cost, in products of 64-bit words. It is counted, not timed: the
/// same numbers stay within it or leave it on every machine. Some 2e8 of them take a second.
class ExactBudget {
 public:
  explicit ExactBudget(double products) : left_(products) {}
  /// Charges the budget for a step whose cost grows with the square of the length of this number.
  /// Throws ExactBudgetSpent when the budget is exhausted.
  void spendOn(const Integer& number);

 private:
  double left_;
};

/// Of a verdict, by default: a second.
inline constexpr double kMaxExactProducts = 2.0e8;

class ExactBudgetSpent : public RunFailure {
 public:
  ExactBudgetSpent() : RunFailure("the exact numbers become too long") {}
};

/// mantissa * 2^exponent: a rounded number of any size, for the way from exact numbers to double.
struct ScaledFloat {
  long double mantissa = 0.0L;  ///< zero or 1/2 <= |mantissa| < 1
  std::int64_t exponent = 0;
};

ScaledFloat scaledFloat(const Integer& value);
ScaledFloat operator*(const ScaledFloat& a, const ScaledFloat& b);
ScaledFloat operator/(const ScaledFloat& a, const ScaledFloat& b);

/// The nearest double. A value beyond the range of double gives +-DBL_MAX, a non-zero value below
/// it the smallest double of its sign: a sign is never lost.
double toDouble(const ScaledFloat& value);
double toDouble(const Rational& value);

}  // namespace whirl_twin
