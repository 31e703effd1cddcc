#include "analysis/polynomial_roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "analysis/routh.h"
#include "messages/input_error.h"

namespace whirl_twin {

double bracketedRoot(const std::function<double(double)>& f, double low, double high, double f_low,
                     double f_high) {
  if (f_low == 0.0) {
    return low;
  }
  if (f_high == 0.0) {
    return high;
  }
  constexpr double kExact = 4.0 * std::numeric_limits<double>::epsilon();
  std::uintmax_t evaluations = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      std::cref(f), low, high, f_low, f_high,
      [](double a, double b) {
        return std::fabs(b - a) <= kExact * std::fmax(std::fabs(a), std::fabs(b));
      },
      evaluations);
  return 0.5 * (below + above);
}

namespace {

using LongReal = long double;
using LongComplex = std::complex<LongReal>;

constexpr LongReal kLongPi = 3.14159265358979323846264338327950288L;
constexpr LongReal kEpsilon = std::numeric_limits<LongReal>::epsilon();
constexpr int kMaxSweeps = 200;  // some ten are enough unless roots are repeated

/// p'/p at z, or nothing left to gain: |p| is down to its own rounding.
struct Evaluation {
  LongComplex logarithmic_derivative;
  bool at_rounding = false;
};

/// Horner's rule. Outside the unit circle it runs on the reversed polynomial q(y) = y^n p(1/y), so
/// that no power overflows: p'/p = y (n - y q'/q).
Evaluation evaluate(const std::vector<LongComplex>& a, const LongComplex& z) {
  const std::size_t degree = a.size() - 1;
  const bool outside = std::norm(z) > 1.0L;
  const LongComplex y = outside ? 1.0L / z : z;
  const LongReal radius = std::abs(y);
  LongComplex value = 0.0L;
  LongComplex slope = 0.0L;
  LongReal size = 0.0L;
  for (std::size_t k = 0; k <= degree; ++k) {
    const LongComplex& coefficient = outside ? a[degree - k] : a[k];
    slope = slope * y + value;
    value = value * y + coefficient;
    size = size * radius + std::abs(coefficient);
  }
  if (std::abs(value) <= kEpsilon * size) {
    return {0.0L, true};
  }
  const LongComplex ratio = slope / value;
  return {outside ? y * (static_cast<LongReal>(degree) - y * ratio) : ratio, false};
}

/// Starting values: the upper convex hull of (k, log|a_k|) has one edge for each group of roots of
/// like modulus; its length is how many and its slope the logarithm of the modulus.
std::vector<LongComplex> startingValues(const std::vector<LongComplex>& a) {
  std::vector<std::size_t> hull;
  const auto slope = [&](std::size_t i, std::size_t k) {
    return (std::log(std::abs(a[k])) - std::log(std::abs(a[i]))) / static_cast<LongReal>(k - i);
  };
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] == LongComplex(0.0L)) {
      continue;
    }
    while (hull.size() >= 2 && slope(hull[hull.size() - 2], hull.back()) <= slope(hull.back(), k)) {
      hull.pop_back();
    }
    hull.push_back(k);
  }
  std::vector<LongComplex> start;
  for (std::size_t edge = 0; edge + 1 < hull.size(); ++edge) {
    const LongReal radius = std::exp(slope(hull[edge], hull[edge + 1]));
    const std::size_t count = hull[edge + 1] - hull[edge];
    for (std::size_t m = 0; m < count; ++m) {
      // 0.7 keeps the set from mirror symmetry, which real roots could not leave.
      start.push_back(std::polar(radius, 2.0L * kLongPi *
                                                 (m / static_cast<LongReal>(count) +
                                                  edge / static_cast<LongReal>(a.size())) +
                                             0.7L));
    }
  }
  return start;
}

std::vector<LongComplex> aberthRoots(const std::vector<LongComplex>& a) {
  std::vector<LongComplex> z = startingValues(a);
  std::vector<bool> found(z.size(), false);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (found[i]) {
        continue;
      }
      const Evaluation p = evaluate(a, z[i]);
      if (p.at_rounding) {
        found[i] = true;
        continue;
      }
      LongComplex repulsion = 0.0L;
      for (std::size_t j = 0; j < z.size(); ++j) {
        if (z[j] != z[i]) {
          repulsion += 1.0L / (z[i] - z[j]);
        }
      }
      // At a balance point of the two, where no step is defined, move on a little.
      const LongComplex pull = p.logarithmic_derivative - repulsion;
      const LongComplex step = pull == LongComplex(0.0L) ? 0.1L * z[i] : 1.0L / pull;
      z[i] -= step;
      found[i] = std::abs(step) <= kEpsilon * std::abs(z[i]);
    }
    if (std::find(found.begin(), found.end(), false) == found.end()) {
      break;
    }
  }
  return z;
}

/// The roots of a real polynomial come in conjugate pairs: pairs each with the nearest mirror image
/// (its own, if the root is real) and takes the mean of the two.
void pairConjugates(std::vector<LongComplex>& z) {
  for (std::size_t i = 0; i < z.size();) {
    const auto mirrored_distance = [&](const LongComplex& other) {
      return std::abs(z[i] - std::conj(other));
    };
    std::size_t partner = i;
    for (std::size_t j = i + 1; j < z.size(); ++j) {
      if (mirrored_distance(z[j]) < mirrored_distance(z[partner])) {
        partner = j;
      }
    }
    const LongComplex mean = 0.5L * (z[i] + std::conj(z[partner]));
    z[i] = mean;
    if (partner == i) {
      ++i;
    } else {
      std::swap(z[i + 1], z[partner]);
      z[i + 1] = std::conj(mean);
      i += 2;
    }
  }
}

template <typename Coefficient>
std::vector<std::complex<double>> sortedRoots(const std::vector<Coefficient>& coefficients,
                                              bool conjugate_pairs) {
  std::vector<LongComplex> wide;
  for (const std::complex<double> coefficient : coefficients) {
    if (!std::isfinite(coefficient.real()) || !std::isfinite(coefficient.imag())) {
      throw InputError(fmt::format(
          "polynomial: coefficient {} of {} must be a finite number, found {}{:+}i",
          wide.size() + 1, coefficients.size(), coefficient.real(), coefficient.imag()));
    }
    wide.emplace_back(coefficient);
  }
  const auto [reduced, zeros] =
      withoutZeroRoots(wide, [](const LongComplex& a) { return a == LongComplex(0.0L); });
  std::vector<LongComplex> z = aberthRoots(reduced);
  if (conjugate_pairs) {
    pairConjugates(z);
  }
  z.resize(z.size() + zeros, 0.0L);
  std::sort(z.begin(), z.end(), [](const LongComplex& a, const LongComplex& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
  });
  return {z.begin(), z.end()};
}

}  // namespace

std::vector<std::complex<double>> roots(const std::vector<double>& coefficients) {
  return sortedRoots(coefficients, true);
}

std::vector<std::complex<double>> roots(const std::vector<std::complex<double>>& coefficients) {
  return sortedRoots(coefficients, false);
}

namespace {

/// Moves the greatest common divisor of the entries into the scale.
void divideByCommonFactor(ScaledIntegers& values) {
  Integer factor = 0;
  for (const Integer& entry : values.entry) {
    factor = gcd(factor, entry);
  }
  if (factor > 1) {
    for (Integer& entry : values.entry) {
      entry /= factor;
    }
    values.scale = values.scale * scaledFloat(factor);
  }
}

ExactPolynomial negatedRemainder(ExactPolynomial dividend, const ExactPolynomial& divisor,
                                 ExactBudget& budget) {
  const Integer pivot = abs(divisor.entry.front());
  while (dividend.entry.size() >= divisor.entry.size()) {
    // |pivot| times the dividend, less the multiple of the divisor that cancels its first entry.
    const Integer across =
        divisor.entry.front() > 0 ? dividend.entry.front() : -dividend.entry.front();
    for (std::size_t i = 1; i < dividend.entry.size(); ++i) {
      dividend.entry[i] *= pivot;
      if (i < divisor.entry.size()) {
        dividend.entry[i] -= across * divisor.entry[i];
      }
    }
    dividend.scale = dividend.scale / scaledFloat(pivot);
    dividend.entry.front() = 0;
    dividend = trimmed(std::move(dividend));
    removeCommonFactor(dividend, budget);
  }
  for (Integer& coefficient : dividend.entry) {
    coefficient = -coefficient;
  }
  return dividend;
}

/// Sign changes of the sequence at plus (direction 1) or minus (direction -1) infinity.
int signChanges(const std::vector<ExactPolynomial>& sequence, int direction) {
  int changes = 0;
  int previous = 0;
  for (const ExactPolynomial& member : sequence) {
    const bool odd_degree = member.entry.size() % 2 == 0;
    const int sign = member.entry.front().sign() * (odd_degree ? direction : 1);
    changes += sign * previous < 0 ? 1 : 0;
    previous = sign;
  }
  return changes;
}

}  // namespace

ScaledIntegers scaledIntegers(const std::vector<Rational>& values) {
  Integer common_denominator = 1;
  for (const Rational& value : values) {
    common_denominator *= denominator(value) / gcd(common_denominator, denominator(value));
  }
  ScaledIntegers result;
  for (const Rational& value : values) {
    result.entry.push_back(numerator(value) * (common_denominator / denominator(value)));
  }
  result.scale = scaledFloat(1) / scaledFloat(common_denominator);
  divideByCommonFactor(result);
  return result;
}

void removeCommonFactor(ScaledIntegers& values, ExactBudget& budget) {
  for (const Integer& entry : values.entry) {
    budget.spendOn(entry);
  }
  divideByCommonFactor(values);
}

ExactPolynomial derivative(const ExactPolynomial& polynomial) {
  ExactPolynomial result;
  result.scale = polynomial.scale;
  for (std::size_t i = 0; i + 1 < polynomial.entry.size(); ++i) {
    result.entry.push_back(polynomial.entry[i] * (polynomial.entry.size() - 1 - i));
  }
  return result;
}

ExactPolynomial trimmed(ExactPolynomial polynomial) {
  polynomial.entry.erase(polynomial.entry.begin(),
                         std::find_if(polynomial.entry.begin(), polynomial.entry.end(),
                                      [](const Integer& entry) { return entry != 0; }));
  return polynomial;
}

std::vector<ExactPolynomial> sturmSequence(ExactPolynomial a, ExactPolynomial b,
                                           ExactBudget& budget) {
  std::vector<ExactPolynomial> sequence;
  while (!b.entry.empty()) {
    ExactPolynomial next = negatedRemainder(a, b, budget);
    sequence.push_back(std::move(a));
    a = std::move(b);
    b = std::move(next);
  }
  sequence.push_back(std::move(a));
  return sequence;
}

int cauchyIndex(const std::vector<ExactPolynomial>& sturm_sequence) {
  return signChanges(sturm_sequence, -1) - signChanges(sturm_sequence, 1);
}

RealRootCount countRealRoots(ExactPolynomial polynomial, ExactBudget& budget) {
  // The index of p'/p is the number of distinct real roots; gcd(p, p') has each of them once less.
  RealRootCount count;
  while (polynomial.entry.size() > 1) {
    std::vector<ExactPolynomial> sequence =
        sturmSequence(polynomial, derivative(polynomial), budget);
    const int distinct = cauchyIndex(sequence);
    if (distinct == 0) {
      break;
    }
    count.total += distinct;
    ++count.largest_multiplicity;
    polynomial = std::move(sequence.back());
  }
  return count;
}

}  // namespace whirl_twin
