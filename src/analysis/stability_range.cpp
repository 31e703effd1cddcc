#include "analysis/stability_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/polynomial_roots.h"
#include "analysis/routh.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Coefficients = std::vector<SymbolicPolynomial>;

const Rational kDigits("1000000000000000000");  // what 17 of them take

/// det H_(n-1), H_ij = A_(n - 2j + i) (1-based), by fraction-free elimination (E. Bareiss, Math.
/// Comp. 22, 1968).
SymbolicPolynomial hurwitzDeterminant(const Coefficients& a, ExactBudget& budget) {
  const int n = static_cast<int>(a.size()) - 1;
  const int size = n - 1;
  std::vector<Coefficients> h(static_cast<std::size_t>(std::max(size, 0)),
                              Coefficients(static_cast<std::size_t>(std::max(size, 0))));
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      const int place = 2 * (j + 1) - (i + 1);  // in `a`
      if (place >= 0 && place <= n) {
        h[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            a[static_cast<std::size_t>(place)];
      }
    }
  }
  SymbolicPolynomial before = Rational(1);
  SymbolicPolynomial determinant = Rational(1);
  for (std::size_t k = 0; k < h.size(); ++k) {
    const auto pivot = std::find_if(h.begin() + static_cast<std::ptrdiff_t>(k), h.end(),
                                    [&](const Coefficients& row) { return !row[k].zero(); });
    if (pivot == h.end()) {
      return {};
    }
    std::iter_swap(pivot,
                   h.begin() + static_cast<std::ptrdiff_t>(k));  // the sign is of no interest
    for (std::size_t i = k + 1; i < h.size(); ++i) {
      for (std::size_t j = k + 1; j < h.size(); ++j) {
        h[i][j] = divided(h[k][k] * h[i][j] - h[i][k] * h[k][j], before).first;
        for (const Rational& entry : h[i][j].entry) {
          budget.spendOn(numerator(entry));
        }
      }
    }
    before = h[k][k];
    determinant = before;
  }
  return determinant;
}

/// The real roots of a polynomial without repeated ones, by Sturm's theorem.
class RealRoots {
 public:
  RealRoots(const SymbolicPolynomial& square_free, ExactBudget& budget) : polynomial_(square_free) {
    if (polynomial_.constant()) {
      return;
    }
    const std::vector<Rational> falling(polynomial_.entry.rbegin(), polynomial_.entry.rend());
    const ExactPolynomial whole = scaledIntegers(falling);
    for (const ExactPolynomial& member : sturmSequence(whole, derivative(whole), budget)) {
      std::vector<Rational> rising(member.entry.rbegin(), member.entry.rend());
      sequence_.push_back(SymbolicPolynomial(std::move(rising)));
    }
    leading_ = abs(whole.entry.front());
  }

  const SymbolicPolynomial& polynomial() const { return polynomial_; }
  /// In (below, above].
  int count(const Rational& below, const Rational& above) const {
    return changes(below) - changes(above);
  }
  /// Bounds ascending, each alone in its (below, above].
  std::vector<StabilityBound> isolated() const {
    std::vector<StabilityBound> found;
    if (sequence_.empty()) {
      return found;
    }
    Rational largest = 0;
    for (const Rational& entry : polynomial_.entry) {
      largest = std::max(largest, Rational(abs(entry)));
    }
    const Rational beyond = 1 + largest / abs(polynomial_.entry.back());
    split(-beyond, beyond, found);
    return found;
  }
  /// Bisects the interval of the root.
  void halve(StabilityBound& root) const {
    const Rational middle = (root.below + root.above) / 2;
    (count(root.below, middle) == 1 ? root.above : root.below) = middle;
  }
  /// To 17 digits; rational roots are identified exactly. One with a denominator up to the leading
  /// coefficient L is alone among those in an interval narrower than 1/L^2, and the simplest.
  void refine(StabilityBound& root) const {
    const Rational narrow(Integer(1), Integer(2 * leading_ * leading_));
    const auto wide = [&] {
      const Rational width = root.above - root.below;
      const Rational size = std::max(Rational(abs(root.above)), Rational(abs(root.below)));
      return width > narrow || width * kDigits > size || polynomial_.at(root.below) == 0;
    };
    while (wide()) {
      if (polynomial_.at(root.above) == 0) {
        break;
      }
      halve(root);
    }
    const Rational simplest =
        polynomial_.at(root.above) == 0 ? root.above : simplestIn(root.below, root.above);
    if (polynomial_.at(simplest) == 0) {
      root.exact = root.below = root.above = simplest;
    }
  }

 private:
  int changes(const Rational& x) const {
    int count = 0;
    int before = 0;
    for (const SymbolicPolynomial& member : sequence_) {
      const int sign = member.at(x).sign();
      count += sign * before < 0 ? 1 : 0;
      before = sign == 0 ? before : sign;
    }
    return count;
  }
  void split(const Rational& below, const Rational& above,
             std::vector<StabilityBound>& found) const {
    const int inside = count(below, above);
    if (inside == 1) {
      StabilityBound root;
      root.below = below;
      root.above = above;
      found.push_back(root);
    } else if (inside > 1) {
      const Rational middle = (below + above) / 2;
      split(below, middle, found);
      split(middle, above, found);
    }
  }
  static Rational floorOf(const Rational& x) {
    const Rational whole = Integer(numerator(x) / denominator(x));  // towards zero
    return x < whole ? Rational(whole - 1) : whole;
  }
  /// The fraction of smallest denominator in [below, above] (Stern-Brocot).
  static Rational simplestIn(const Rational& below, const Rational& above) {
    if (below <= 0 && above >= 0) {
      return 0;
    }
    if (above < 0) {
      return -simplestIn(-above, -below);
    }
    const Rational whole = floorOf(below);
    if (below == whole) {
      return below;
    }
    if (above >= Rational(whole + 1)) {
      return whole + 1;
    }
    return whole + 1 / simplestIn(1 / Rational(above - whole), 1 / Rational(below - whole));
  }

  SymbolicPolynomial polynomial_;
  std::vector<SymbolicPolynomial> sequence_;
  Integer leading_ = 1;
};

std::vector<Rational> at(const Coefficients& coefficients, const Rational& k) {
  std::vector<Rational> values;
  values.reserve(coefficients.size());
  for (const SymbolicPolynomial& one : coefficients) {
    values.push_back(one.at(k));
  }
  return values;
}

/// "sqrt(5)/2", "2 sqrt(3)" of factor sqrt(whole).
std::string rootText(const Rational& factor, const Integer& whole) {
  const Integer above = numerator(factor);
  return (above == 1 ? "" : above.str() + " ") + "sqrt(" + whole.str() + ")" +
         (denominator(factor) == 1 ? "" : "/" + denominator(factor).str());
}

/// The root of a quadratic a K^2 + b K + c that lies at `value`.
std::string quadraticText(const SymbolicPolynomial& q, double value) {
  const Rational middle = -q.entry[1] / Rational(2 * q.entry[2]);
  const Rational square = middle * middle - q.entry[0] / q.entry[2];  // of half their distance
  Integer whole = numerator(square) * denominator(square);  // sqrt(whole)/denominator is the half
  Rational factor(Integer(1), Integer(denominator(square)));
  for (int p = 2; p < 1000; ++p) {
    while (whole % (p * p) == 0) {
      whole /= p * p;
      factor *= p;
    }
  }
  const std::string root = rootText(factor, whole);
  const bool upper = value > toDouble(middle);
  if (middle == 0) {
    return upper ? root : "-" + root;
  }
  return text(middle) + (upper ? " + " : " - ") + root;
}

/// The imaginary part of the roots nearest to the axis, without zeros.
std::optional<double> frequencyOnAxis(const Coefficients& coefficients, const Rational& k) {
  std::vector<double> values;
  for (const Rational& value : at(coefficients, k)) {
    values.push_back(toDouble(value));
  }
  std::optional<std::complex<double>> nearest;
  for (const std::complex<double>& root : roots(values)) {
    const bool swings = root.imag() > 1.0e-9 * std::abs(root);
    if (swings && (!nearest || std::fabs(root.real()) < std::fabs(nearest->real()))) {
      nearest = root;
    }
  }
  // Two real roots s, -s are a pair, too, but not on the axis.
  return nearest && std::fabs(nearest->real()) <= 1.0e-6 * std::abs(*nearest)
             ? std::optional<double>(nearest->imag())
             : std::nullopt;
}

struct BoundaryFactors {
  SymbolicPolynomial leading, last, pair;
};

/// The event at the bound, and the polynomial that it is a root of.
void explain(StabilityBound& bound, const BoundaryFactors& factors,
             const Coefficients& coefficients, const std::vector<Rational>& fractions,
             ExactBudget& budget) {
  const auto vanishes = [&](const SymbolicPolynomial& factor) {
    if (factor.zero()) {
      return false;  // for every K: not specific to this one
    }
    if (bound.exact) {
      return factor.at(*bound.exact) == 0;
    }
    return RealRoots(squareFree(factor), budget).count(bound.below, bound.above) > 0;
  };
  for (const auto& [factor, flag] : {std::pair{&factors.leading, &bound.degree_falls},
                                     {&factors.last, &bound.root_at_zero},
                                     {&factors.pair, &bound.pair_on_axis}}) {
    *flag = vanishes(*factor);
    if (*flag && (bound.of.zero() || factor->degree() < bound.of.degree())) {
      bound.of = squareFree(*factor);
    }
  }
  for (const Rational& fraction : fractions) {  // its own roots are no fractions
    if (!bound.exact && bound.of.at(fraction) == 0) {
      bound.of = divided(bound.of, SymbolicPolynomial(std::vector<Rational>{-fraction, 1})).first;
    }
  }
  if (bound.exact) {
    bound.closed_form = bound.exact->str();
    const std::vector<Rational> there = at(coefficients, *bound.exact);
    if (std::any_of(there.begin(), there.end(), [](const Rational& a) { return a != 0; })) {
      bound.there = routh(there, budget);
    }
  } else if (bound.of.degree() == 2) {
    bound.closed_form = quadraticText(bound.of, bound.value());
  }
  bound.of = SymbolicQuotient(bound.of).numerator;  // whole coefficients
  if (bound.pair_on_axis && (!bound.exact || bound.there)) {
    bound.frequency = frequencyOnAxis(coefficients, bound.above);
  }
}

/// A K strictly between two bounds next to each other, or beyond.
Rational between(StabilityBound* lower, StabilityBound* upper, const RealRoots& all) {
  if (lower == nullptr || upper == nullptr) {
    return lower != nullptr   ? Rational(lower->above + 1)
           : upper != nullptr ? Rational(upper->below - 1)
                              : Rational(0);
  }
  while (true) {
    const Rational middle = (lower->above + upper->below) / 2;
    if (middle > lower->above && middle <= upper->below) {
      return middle;
    }
    if (middle == lower->above && all.polynomial().at(middle) != 0) {
      return middle;
    }
    all.halve(*upper);
  }
}

}  // namespace

StabilityRange stabilityRange(const std::vector<SymbolicPolynomial>& coefficients,
                              ExactBudget& budget) {
  const auto first = std::find_if_not(coefficients.begin(), coefficients.end(),
                                      [](const SymbolicPolynomial& a) { return a.zero(); });
  const Coefficients a(first, coefficients.end());
  const int degree = static_cast<int>(a.size()) - 1;
  if (degree < 1 || degree > kMaxParameterDegree) {
    throw InputError(fmt::format(
        "coefficients: expected a polynomial of degree 1 to {} in s, found {}", kMaxParameterDegree,
        degree < 0 ? std::string("only coefficients that are zero")
                   : fmt::format("degree {}", degree)));
  }
  const BoundaryFactors factors{a.front(), a.back(), hurwitzDeterminant(a, budget)};
  StabilityRange range;
  range.never = factors.last.zero() || factors.pair.zero();
  SymbolicPolynomial product = factors.leading;
  for (const SymbolicPolynomial* factor : {&factors.last, &factors.pair}) {
    product = factor->zero() ? product : product * *factor;
  }
  const RealRoots roots(squareFree(product), budget);
  range.bounds = roots.isolated();
  std::vector<Rational> fractions;
  for (StabilityBound& bound : range.bounds) {
    roots.refine(bound);
    if (bound.exact) {
      fractions.push_back(*bound.exact);
    }
  }
  for (StabilityBound& bound : range.bounds) {
    explain(bound, factors, a, fractions, budget);
  }
  for (std::size_t i = 0; i <= range.bounds.size(); ++i) {
    StabilityInterval interval;
    StabilityBound* const lower = i > 0 ? &range.bounds[i - 1] : nullptr;
    StabilityBound* const upper = i < range.bounds.size() ? &range.bounds[i] : nullptr;
    if (lower != nullptr) {
      interval.from = i - 1;
    }
    if (upper != nullptr) {
      interval.to = i;
    }
    interval.routh = routh(at(a, between(lower, upper, roots)), budget);
    range.intervals.push_back(interval);
  }
  return range;
}

std::vector<StablePiece> stablePieces(const StabilityRange& range) {
  const auto stable = [&](std::size_t interval) {
    return range.intervals[interval].routh.verdict == Verdict::kAsymptoticallyStable;
  };
  // One root leaves through infinity; the others stay where the intervals beside have them.
  const auto included = [&](std::size_t bound) {
    const StabilityBound& b = range.bounds[bound];
    return b.degree_falls && !b.root_at_zero && !b.pair_on_axis &&
           (b.there ? b.there->verdict == Verdict::kAsymptoticallyStable
                    : !b.exact && (stable(bound) || stable(bound + 1)));
  };
  std::vector<StablePiece> pieces;
  for (std::size_t i = 0; i < range.intervals.size(); ++i) {
    if (!stable(i)) {
      continue;
    }
    const StabilityInterval& interval = range.intervals[i];
    if (!pieces.empty() && pieces.back().to == interval.from && interval.from &&
        included(*interval.from)) {
      pieces.back().to = interval.to;
    } else {
      pieces.push_back(
          {interval.from, interval.to, interval.from && included(*interval.from), false});
    }
    pieces.back().to_included = interval.to && included(*interval.to);
  }
  return pieces;
}

}  // namespace whirl_twin
