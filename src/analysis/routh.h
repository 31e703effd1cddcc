// The Routh-Hurwitz test, exact: how many roots of a polynomial lie right of, on and left of the
// imaginary axis, without computing any of them.
//
// Real coefficients: Routh's table (Routh 1877), row_i[j] = row_{i-2}[j+1] - (row_{i-2}[0] /
// row_{i-1}[0]) row_{i-1}[j+1], with both special cases made exact:
//  - a row that begins with m zeros: row += (-1)^m (row shifted left by m) (Benidir and Picinbono,
//    IEEE Trans. Automatic Control 35, 1990); no small number epsilon, which can miscount;
//  - a row of zeros: the derivative of the auxiliary polynomial, the row above, takes its place.
// Complex coefficients (isotropic rotors in z = x + i y): the generalised test of Frank (1946) and
// Bilharz (1944) as the Sturm sequence of Re and Im of p(jx)/j^n.
//
// Not decidable from a polynomial: a repeated imaginary root grows like t^(m-1) unless the
// underlying matrix is semisimple there, as that of an isotropic undamped rotor in x and y.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "analysis/exact_number.h"
#include "messages/input_error.h"

namespace whirl_twin {

// Result of Routh's test of a polynomial (routh.h, routh_table.h), independent of the exact numbers
// of the test.

enum class Verdict : std::uint8_t {
  kAsymptoticallyStable = 0,  ///< every root left of the imaginary axis
  kMarginal,                  ///< none right of it, some on it, all of those simple
  kRepeatedImaginary,         ///< none right of it, a repeated one on it
  kUnstable,                  ///< at least one right of it
  kUncertain                  ///< undecidable from the given numbers; never returned by routh()
};

/// "asymptotically_stable", "marginal", "repeated_imaginary", "unstable" or "uncertain".
const char* name(Verdict verdict);

struct RouthResult {
  Verdict verdict = Verdict::kAsymptoticallyStable;
  int right = 0;
  int imaginary = 0;  ///< every root on the imaginary axis, zeros included
  int left = 0;
  int largest_imaginary_multiplicity = 0;
  /// Real coefficients: the first column of Routh's table of the polynomial divided by its roots at
  /// zero, times -1 if its leading coefficient is negative; its sign changes are the right roots.
  /// Complex ones: the leading coefficients of the Sturm sequence, each times (-1)^(n - degree). In
  /// the regular case (n + 1 entries) their sign changes are the right roots, and for a real
  /// polynomial they are the column above; a shorter column means roots on the axis or in pairs
  /// symmetric to it, or a degree that dropped by more than one.
  std::vector<double> first_column;
};

/// One inequality left > right of the coefficients.
struct RouthCondition {
  std::string name;    ///< "A1 A2 > A0"
  double left = 0.0;   ///< rounded
  double right = 0.0;  ///< rounded
  bool holds = false;  ///< exact
};

/// Roots of a real polynomial, coefficients highest power first; leading zeros are dropped. Exact
/// for the given numbers of any size. A non-zero constant is asymptotically stable. Throws
/// InputError without a non-zero coefficient or with one that is not finite. Not real-time safe
/// (allocates).
RouthResult routh(const std::vector<Rational>& coefficients);
RouthResult routh(const std::vector<double>& coefficients);
/// The same as far as a budget goes: throws ExactBudgetSpent.
RouthResult routh(const std::vector<Rational>& coefficients, ExactBudget& budget);

/// The same for complex coefficients. The sequence is that of the polynomial times -1 if the
/// leading coefficient is real and negative, times its conjugate if it is not real.
RouthResult routh(const std::vector<ComplexRational>& coefficients);
RouthResult routh(const std::vector<ComplexRational>& coefficients, ExactBudget& budget);

// What the real and the complex Routh test share: roots at zero taken out first, the verdict last.

/// The polynomial (highest power first) without leading zeros and without its roots at zero, and
/// how many of those there are. Throws InputError if all coefficients are zero.
template <typename Coefficient, typename IsZero>
std::pair<std::vector<Coefficient>, int> withoutZeroRoots(
    const std::vector<Coefficient>& coefficients, IsZero is_zero) {
  const auto first = std::find_if_not(coefficients.begin(), coefficients.end(), is_zero);
  if (first == coefficients.end()) {
    throw InputError("polynomial: expected at least one coefficient that is not zero, found none");
  }
  const auto last = std::find_if_not(coefficients.rbegin(), coefficients.rend(), is_zero).base();
  return {{first, last}, static_cast<int>(coefficients.end() - last)};
}

/// The verdict that follows from the counts.
Verdict verdictOf(const RouthResult& result);

}  // namespace whirl_twin
