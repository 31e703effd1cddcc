#include <algorithm>
#include <limits>

#include "analysis/polynomial_roots.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

bool isZero(const ComplexRational& a) {
  return a.re == 0 && a.im == 0;
}

ComplexRational complexProduct(const ComplexRational& a, const ComplexRational& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/// What makes the leading coefficient real and positive.
ComplexRational leadingFactor(const ComplexRational& leading) {
  if (leading.im == 0) {
    return {leading.re.sign(), 0};
  }
  return {leading.re, -leading.im};
}

}  // namespace

RouthResult routh(const std::vector<ComplexRational>& coefficients) {
  ExactBudget unlimited(std::numeric_limits<double>::infinity());
  return routh(coefficients, unlimited);
}

RouthResult routh(const std::vector<ComplexRational>& coefficients, ExactBudget& budget) {
  const auto [reduced, zeros] = withoutZeroRoots(coefficients, isZero);
  const int degree = static_cast<int>(reduced.size()) - 1;

  // U + jV = p(jx)/j^n, so the coefficient of x^(n-k) is a_k / j^k.
  const ComplexRational factor = leadingFactor(reduced.front());
  const ComplexRational inverse_powers[] = {{1, 0}, {0, -1}, {-1, 0}, {0, 1}};
  std::vector<Rational> real_part;
  std::vector<Rational> imaginary_part;
  for (int k = 0; k <= degree; ++k) {
    const ComplexRational a =
        complexProduct(complexProduct(reduced[k], factor), inverse_powers[k % 4]);
    real_part.push_back(a.re);
    imaginary_part.push_back(a.im);
  }

  // As x runs along the axis, arg p(jx) turns by pi (left - right), which is -pi times the index of
  // V/U. The last element, gcd(U, V), has the roots on the axis and the pairs symmetric to it.
  const std::vector<ExactPolynomial> sequence =
      sturmSequence(scaledIntegers(real_part), trimmed(scaledIntegers(imaginary_part)), budget);
  const int right_less_left = cauchyIndex(sequence);
  const RealRootCount on_axis = countRealRoots(sequence.back(), budget);

  RouthResult result;
  result.right = (degree - on_axis.total + right_less_left) / 2;
  result.left = (degree - on_axis.total - right_less_left) / 2;
  result.imaginary = on_axis.total + zeros;
  result.largest_imaginary_multiplicity = std::max(on_axis.largest_multiplicity, zeros);
  result.verdict = verdictOf(result);
  for (const ExactPolynomial& member : sequence) {
    const double leading = toDouble(scaledFloat(member.entry.front()) * member.scale);
    const bool odd_drop = (reduced.size() - member.entry.size()) % 2 == 1;
    result.first_column.push_back(odd_drop ? -leading : leading);
  }
  return result;
}

}  // namespace whirl_twin
