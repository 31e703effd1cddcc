// Exact counts of real roots by Sturm's theorem (Sturm 1829; Gantmacher, The Theory of Matrices,
// vol. 2, ch. XV): the Cauchy index of b/a over the whole real line is the loss of sign changes in
// the sequence a, b, -rem(a, b), ... between minus and plus infinity.
#pragma once

#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

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

/// a, b, -rem(a, b), ... down to the last member that is not zero, which is gcd(a, b). deg b < deg
/// a.
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
