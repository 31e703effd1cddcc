// Scalar type of one system of a batch.
//
// Compilers vectorize a loop over the batch with energies written for this number type: no branch,
// no table, no call. Sine and cosine are polynomials of the remainder of the angle by half turns,
// reduced with two parts of pi (Cody & Waite, Software Manual for the Elementary Functions, 1980).
// Their errors are below 3.5e-16 while |x| < 3e6 rad, with fused products or without, and below
// those of x rounded to a double beyond, up to 1e15 rad: farther out a double holds no angle.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "mechanics/force_inline.h"

namespace whirl_twin {

struct BatchReal {
  double x = 0.0;

  BatchReal() = default;
  WHIRL_TWIN_INLINE BatchReal(double value) : x(value) {}  // NOLINT: a constant is a number

  friend WHIRL_TWIN_INLINE BatchReal operator+(BatchReal a, BatchReal b) { return a.x + b.x; }
  friend WHIRL_TWIN_INLINE BatchReal operator-(BatchReal a, BatchReal b) { return a.x - b.x; }
  friend WHIRL_TWIN_INLINE BatchReal operator*(BatchReal a, BatchReal b) { return a.x * b.x; }
  friend WHIRL_TWIN_INLINE BatchReal operator/(BatchReal a, BatchReal b) { return a.x / b.x; }
  friend WHIRL_TWIN_INLINE BatchReal operator-(BatchReal a) { return -a.x; }
  friend WHIRL_TWIN_INLINE bool operator<(BatchReal a, double b) { return a.x < b; }
  friend WHIRL_TWIN_INLINE bool operator>(BatchReal a, double b) { return a.x > b; }
};

namespace member_number {

// pi in pieces of 33 and 53 bits, and polynomials in the square of the rest, |rest| <= pi/2, of
// least largest error: of (sin d - d) / d^3 and of (cos d - 1 + d^2 / 2) / d^4.
inline constexpr double kPi1 = 3.14159265346825122834;
inline constexpr double kPi2 = 1.21542010130123852e-10;
inline constexpr double kHalfTurnsPerRadian = 0.318309886183790672;
/// Adding it rounds to a whole number, which is then in the lowest bits.
inline constexpr double kToWhole = 6755399441055744.0;

struct Rest {
  double d, square;
  std::uint64_t sign;  ///< of both values
};

WHIRL_TWIN_INLINE Rest rest(double x) {
  const double shifted = x * kHalfTurnsPerRadian + kToWhole;
  const double halves = shifted - kToWhole;
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  // The first product is exact up to 2^20 half turns, and so is its difference; the second is
  // rounded to 1e-20: d is rounded once.
  const double d = (x - halves * kPi1) - halves * kPi2;
  return {d, d * d, bits << 63};
}
WHIRL_TWIN_INLINE double withSign(double value, std::uint64_t sign) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  bits ^= sign;
  std::memcpy(&value, &bits, sizeof bits);
  return value;
}

}  // namespace member_number

WHIRL_TWIN_INLINE BatchReal sin(BatchReal angle) {
  const member_number::Rest rest = member_number::rest(angle.x);
  const double z = rest.square;
  const double beyond =
      -0.16666666666666666 +
      z * (0.008333333333333316 +
           z * (-0.00019841269841254974 +
                z * (2.7557319219163234e-06 +
                     z * (-2.5052107616996182e-08 +
                          z * (1.6058977312464087e-10 +
                               z * (-7.643970296798561e-13 + z * 2.731444766986256e-15))))));
  return member_number::withSign(rest.d + (rest.d * z) * beyond, rest.sign);
}

WHIRL_TWIN_INLINE BatchReal cos(BatchReal angle) {
  const member_number::Rest rest = member_number::rest(angle.x);
  const double z = rest.square;
  const double beyond =
      0.04166666666666666 +
      z * (-0.0013888888888884767 +
           z * (2.480158729891355e-05 +
                z * (-2.7557318573366175e-07 +
                     z * (2.0876681558867395e-09 +
                          z * (-1.1466252259718463e-11 + z * 4.6464359591122414e-14)))));
  return member_number::withSign(1.0 - (0.5 * z - (z * z) * beyond), rest.sign);
}

WHIRL_TWIN_INLINE BatchReal sqrt(BatchReal a) {
  return std::sqrt(a.x);
}

}  // namespace whirl_twin
