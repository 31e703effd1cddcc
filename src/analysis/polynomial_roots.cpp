#include "analysis/polynomial_roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/root_location.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

using LongReal = long double;
using LongComplex = std::complex<LongReal>;

constexpr LongReal kLongPi = 3.14159265358979323846264338327950288L;
constexpr LongReal kEpsilon = std::numeric_limits<LongReal>::epsilon();
constexpr int kMostSweeps = 200;  // some ten are enough unless roots are repeated

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
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
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
      throw Refusal(fmt::format(
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

}  // namespace whirl_twin
