// Stable values of a parameter K: those for which a real polynomial in s, whose coefficients are
// polynomials in K, has all its roots left of the imaginary axis.
//
// Roots are continuous in K. The number of them right of the axis can change only where a root goes
// through 0 (A_0 = 0), a pair through the axis (the Hurwitz determinant D_(n-1) = 0; L. Orlando,
// Math. Ann. 71, 1911), or one through infinity (A_n = 0). Between two adjacent such K one exact
// Routh test decides for all: nothing is sampled, no interval is missed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/routh.h"
#include "analysis/symbolic_polynomial.h"

namespace whirl_twin {

/// A K at which the counts may change.
struct StabilityBound {
  Rational below, above;          ///< it lies in (below, above], to 17 digits; both are it if exact
  std::optional<Rational> exact;  ///< where it is a fraction
  std::string closed_form;        ///< "3/2", "1/2 + sqrt(5)/2", or "" where there is none so short
  SymbolicPolynomial of;          ///< it is a root of this, with whole coefficients
  bool root_at_zero = false;
  bool pair_on_axis = false;
  bool degree_falls = false;
  std::optional<RouthResult> there;  ///< of exact ones; none if no polynomial in s remains
  std::optional<double> frequency;   ///< [rad/s], of a pair on the axis

  double value() const { return toDouble(above); }
};

/// The K between two bounds next to each other, or beyond the last; ends left out.
struct StabilityInterval {
  std::optional<std::size_t> from, to;  ///< places in `bounds`; none: without end
  RouthResult routh;
};

struct StabilityRange {
  std::vector<StabilityBound> bounds;        ///< ascending
  std::vector<StabilityInterval> intervals;  ///< one more than bounds
  /// For every K there is a pair s, -s, or a root at 0: it is asymptotically stable for none.
  bool never = false;
};

/// Coefficients highest power of s first. Throws InputError for a polynomial of a degree above
/// kMaxParameterDegree or without s, and ExactBudgetSpent.
StabilityRange stabilityRange(const std::vector<SymbolicPolynomial>& coefficients,
                              ExactBudget& budget);
inline constexpr int kMaxParameterDegree = 16;

/// Pieces of the line of K where it is asymptotically stable, in order: an end belongs to its piece
/// where it is `included` (there the degree drops, and the remaining polynomial is stable).
struct StablePiece {
  std::optional<std::size_t> from, to;  ///< bounds
  bool from_included = false, to_included = false;
};
std::vector<StablePiece> stablePieces(const StabilityRange& range);

}  // namespace whirl_twin
