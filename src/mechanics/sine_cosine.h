// Sine and cosine of one angle together, inlined into the steps. There each evaluation needs the
// one before it, so it is the delay that counts: no branch, no call, short sums.
//
// The angle is a whole number of 128ths of a turn, whose sine and cosine are in a table, and a
// rest d, |d| <= pi/128, found with three parts of pi (Cody & Waite, Software Manual for the
// Elementary Functions, 1980); the addition theorems with Taylor's series of d do the rest. Errors
// are below 0.75 ulp, and below 1.7 ulp where a value is less than 1/8.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mechanics/force_inline.h"

namespace whirl_twin {

struct SineCosine {
  double sine;
  double cosine;
};

namespace sine_cosine {

/// Sine and cosine at a whole number of parts of a turn, and what their doubles leave out.
struct Entry {
  double sine;
  double cosine;
  double sine_low;
  double cosine_low;
};

inline constexpr std::size_t kParts = 128;

constexpr std::array<Entry, kParts> makeTable() {
  std::array<Entry, kParts> table{};
  constexpr std::size_t kQuarter = kParts / 4;
  for (std::size_t i = 0; i <= kQuarter; ++i) {
    // Taylor's series at up to pi/4, in extended precision where there is one.
    const bool swapped = i > kQuarter / 2;
    const long double x = 3.14159265358979323846264338327950288L / 64.0L *
                          static_cast<long double>(swapped ? kQuarter - i : i);
    long double sine = 0.0L;
    long double cosine = 0.0L;
    long double term = 1.0L;
    for (int power = 0; power < 28; power += 2) {
      cosine += term;
      term *= x / static_cast<long double>(power + 1);
      sine += term;
      term *= -x / static_cast<long double>(power + 2);
    }
    const long double s = swapped ? cosine : sine;
    const long double c = swapped ? sine : cosine;
    const auto high_s = static_cast<double>(s);
    const auto high_c = static_cast<double>(c);
    const auto low_s = static_cast<double>(s - high_s);
    const auto low_c = static_cast<double>(c - high_c);
    table[i] = {high_s, high_c, low_s, low_c};
    table[2 * kQuarter - i] = {high_s, -high_c, low_s, -low_c};
    table[2 * kQuarter + i] = {-high_s, -high_c, -low_s, -low_c};
    table[(4 * kQuarter - i) % kParts] = {-high_s, high_c, -low_s, low_c};
  }
  return table;
}

inline constexpr std::array<Entry, kParts> kTable = makeTable();

/// Beyond, the number of parts times a piece of pi/64 would no longer be exact.
inline constexpr double kLargest = 1.0e5;

// pi/64 in pieces of 31, 32 and 53 bits.
inline constexpr double kPart1 = 1.57079632673412561417e+00 / 32.0;
inline constexpr double kPart2 = 6.07710050630396597660e-11 / 32.0;
inline constexpr double kPart3 = 2.02226624879595063154e-21 / 32.0;
inline constexpr double kPartsPerRadian = 20.371832715762602978;
/// Adding it rounds to a whole number, which is then in the lowest bits.
inline constexpr double kToWhole = 6755399441055744.0;

/// By the C library: for any angle.
[[gnu::noinline, gnu::cold, gnu::const]] inline SineCosine fromLibrary(double x) {
  return {std::sin(x), std::cos(x)};
}

}  // namespace sine_cosine

/// Sine and cosine of x [rad]; NaN for a NaN and for infinities.
WHIRL_TWIN_INLINE SineCosine sineCosine(double x) {
  using namespace sine_cosine;
  const double shifted = x * kPartsPerRadian + kToWhole;
  const double parts = shifted - kToWhole;
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  const Entry& e = kTable[bits % kParts];

  // d + low: the first difference is exact, and so is the error of the second.
  const double first = x - parts * kPart1;
  const double second = parts * kPart2;
  const double d = first - second;
  const double low = ((first - d) - second) - parts * kPart3;

  // sin d = d + d^3 s, cos d = 1 + d^2 c
  const double dd = d * d;
  const double s = (-1.0 / 6.0 + dd * (1.0 / 120.0)) + (dd * dd) * (-1.0 / 5040.0);
  const double c = (-0.5 + dd * (1.0 / 24.0)) + (dd * dd) * (-1.0 / 720.0);
  const double ddd = dd * d;
  SineCosine both{e.sine + ((e.cosine * d + (e.sine_low + e.cosine * low)) +
                            ((e.sine * dd) * c + (e.cosine * ddd) * s)),
                  e.cosine - ((e.sine * d - (e.cosine_low - e.sine * low)) -
                              ((e.cosine * dd) * c - (e.sine * ddd) * s))};
  if (__builtin_expect(!(std::fabs(x) <= kLargest), 0)) {
    both = fromLibrary(x);
  }
  return both;
}

}  // namespace whirl_twin
