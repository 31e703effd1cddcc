// The roots of a polynomial by simultaneous iteration (Aberth 1973, Ehrlich 1967) in extended
// precision, started on the radii of the Newton polygon (Bini, Numerical Algorithms 13, 1996), so
// that roots of very different size come out alike: no companion matrix, no overflow.
//
// A simple root is found to the rounding of extended precision times its condition; a root of
// multiplicity m keeps about 1/m of the 19 digits. Where the sign of a real part decides, ask
// routh(), which is exact.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

// A root between two places where a function has opposite signs: algorithm 748 (G. Alefeld, F.
// Potra, Y. Shi, ACM Trans. Math. Software 21, 1995), about ten evaluations where bisection takes
// fifty.

/// f(low) and f(high), given, differ in sign. Exact to a few units in the last place of the root.
double bracketedRoot(const std::function<double(double)>& f, double low, double high, double f_low,
                     double f_high);

/// All roots with their multiplicity, rightmost first (then by falling imaginary part).
/// `coefficients`: highest power first; leading zeros are dropped. Those of a real polynomial are
/// real or exact conjugate pairs; trailing zero coefficients give exact zeros; a non-zero constant
/// has none; a root too large for a double comes out infinite.
/// Throws InputError without a non-zero coefficient or with one that is not finite.
/// Not real-time safe (allocates).
std::vector<std::complex<double>> roots(const std::vector<double>& coefficients);
std::vector<std::complex<double>> roots(const std::vector<std::complex<double>>& coefficients);

// Exact counts of real roots by Sturm's theorem (Sturm 1829; Gantmacher, The Theory of Matrices,
// vol. 2, ch. XV): the Cauchy index of b/a over the whole real line is the loss of sign changes in
// the sequence a, b, -rem(a, b), ... between minus and plus infinity.

/// Exact coefficients entry[j] * scale, scale > 0. Integers without a common factor make exact
/// tables several times faster than rationals do; the scale, rounded, is only for their display.
struct ScaledIntegers {
  std::vector<Integer> entry;
  ScaledFloat scale;
};

/// Without a common factor.
ScaledIntegers scaledIntegers(const std::vector<Rational>& values);

/// Moves the greatest common divisor of the entries into the scale. This and what follows throw
/// ExactBudgetSpent.
void removeCommonFactor(ScaledIntegers& values, ExactBudget& budget);

/// A real polynomial, highest power first, first entry not zero; empty: the zero polynomial.
using ExactPolynomial = ScaledIntegers;

ExactPolynomial derivative(const ExactPolynomial& polynomial);

/// The polynomial without its leading zeros.
ExactPolynomial trimmed(ExactPolynomial polynomial);

/// a, b, -rem(a, b), ... down to the last nonzero element, which is gcd(a, b). deg b < deg a.
std::vector<ExactPolynomial> sturmSequence(ExactPolynomial a, ExactPolynomial b,
                                           ExactBudget& budget);

/// Jumps of b/a from minus to plus infinity, less those from plus to minus, along the real line.
int cauchyIndex(const std::vector<ExactPolynomial>& sturm_sequence);

struct RealRootCount {
  int total = 0;                 ///< with multiplicity
  int largest_multiplicity = 0;  ///< 0 without real roots
};

RealRootCount countRealRoots(ExactPolynomial polynomial, ExactBudget& budget);

}  // namespace whirl_twin
