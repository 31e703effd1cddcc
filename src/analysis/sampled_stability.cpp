#include "analysis/sampled_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "algebra/dense.h"
#include "analysis/balanced_matrix.h"
#include "analysis/characteristic_polynomial.h"
#include "analysis/delayed_matrix.h"
#include "analysis/routh.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

/// p (s w + 1), s = 1 or -1, lowest power first.
void timesFactor(std::vector<Rational>& p, int s) {
  p.emplace_back(0);
  for (std::size_t k = p.size() - 1; k > 0; --k) {
    if (s > 0) {
      p[k] += p[k - 1];
    } else {
      p[k] -= p[k - 1];
    }
  }
}

}  // namespace

std::vector<Rational> bilinearTransform(const std::vector<Rational>& polynomial) {
  std::vector<Rational> sum;                 // Horner's scheme in (1 + w) ...
  std::vector<Rational> power{Rational(1)};  // ... and (1 - w)^k
  for (const Rational& coefficient : polynomial) {
    if (sum.empty()) {
      sum.push_back(coefficient);
      continue;
    }
    timesFactor(sum, 1);
    timesFactor(power, -1);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += coefficient * power[k];
    }
  }
  std::reverse(sum.begin(), sum.end());
  return sum;
}

RouthResult routhOfCircle(const std::vector<Rational>& transformed, ExactBudget& budget) {
  RouthResult result = routh(transformed, budget);
  const auto first = std::find_if(transformed.begin(), transformed.end(),
                                  [](const Rational& c) { return c != 0; });
  const auto at_minus_one = static_cast<int>(first - transformed.begin());
  result.imaginary += at_minus_one;
  result.largest_imaginary_multiplicity =
      std::max(result.largest_imaginary_multiplicity, at_minus_one);
  result.verdict = verdictOf(result);
  return result;
}

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

/// Minimal polynomials cost more than characteristic ones.
constexpr Eigen::Index kMaxStatesOfMinimal = 12;
/// Of a transition, relative to its norm, for each factor of the product of samples.
constexpr double kTransitionRounding = 16.0 * std::numeric_limits<double>::epsilon();
/// Eigenvalues so far inside the circle are not brought to it by rounding.
constexpr double kFarInside = 0.5;
constexpr Eigen::Index kMaxIterationsPerEigenvalue = 400;  // an eigenvalue

/// Of the polynomial without the roots z = 1 of standing directions; throws ExactBudgetSpent.
RouthResult exactRouth(const MatrixXd& transition, int standing) {
  ExactBudget budget(kMaxExactProducts);
  std::vector<Rational> polynomial =
      bilinearTransform(characteristicPolynomial(transition, budget));
  polynomial.resize(polynomial.size() - static_cast<std::size_t>(standing));
  RouthResult result = routhOfCircle(polynomial, budget);
  if (standing > 0 && polynomial.back() == 0) {
    // A neutral direction with drift: more roots than directions (defective eigenvalue 1).
    result.largest_imaginary_multiplicity = std::max(result.largest_imaginary_multiplicity, 2);
    if (result.right == 0) {
      result.verdict = Verdict::kRepeatedImaginary;
    }
  } else if (result.verdict == Verdict::kRepeatedImaginary && standing == 0 &&
             transition.rows() <= kMaxStatesOfMinimal &&
             routhOfCircle(bilinearTransform(minimalPolynomial(transition)), budget).verdict ==
                 Verdict::kMarginal) {
    result.verdict = Verdict::kMarginal;
  }
  return result;
}

std::vector<Complex> sortedEigenvalues(const MatrixXd& a) {
  const EigenPairs solver = eigenvalues(a, kMaxIterationsPerEigenvalue * a.rows());
  if (!solver.succeeded) {
    throw RunFailure("sampled loop: the eigenvalues cannot be computed");
  }
  const Eigen::VectorXcd& values = solver.values;
  std::vector<Complex> roots(values.data(), values.data() + values.size());
  std::sort(roots.begin(), roots.end(), [](const Complex& x, const Complex& y) {
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    return ax != ay ? ax > ay : x.imag() < y.imag();
  });
  return roots;
}

/// The smallest change of the matrix that brings an eigenvalue to this place of the circle: a
/// singular value of a - z I. `standing` of them are 0 at z = 1.
double distanceTo(const Complex& z, const MatrixXd& a, int standing) {
  Eigen::MatrixXcd shifted = a;
  shifted.diagonal().array() -= z;
  const Eigen::VectorXd values = singularValues(shifted);
  const Eigen::Index smallest = a.rows() - 1 - (z == 1.0 ? standing : 0);
  return smallest < 0 ? std::numeric_limits<double>::infinity() : values[smallest];
}

/// Eigenvalues that rounding can not take across the circle, and those it can.
struct Sides {
  int outside = 0, near = 0, inside = 0;
};

Sides sides(const MatrixXd& a, std::vector<Complex> eigenvalues, int standing, double rounding) {
  Sides sides;
  for (int i = 0; i < standing && !eigenvalues.empty(); ++i) {
    eigenvalues.erase(std::min_element(
        eigenvalues.begin(), eigenvalues.end(),
        [](const Complex& x, const Complex& y) { return std::abs(x - 1.0) < std::abs(y - 1.0); }));
  }
  for (const Complex& z : eigenvalues) {
    const double size = std::abs(z);
    const bool near = size > kFarInside && !(distanceTo(z / size, a, standing) > rounding);
    ++(near ? sides.near : size > 1.0 ? sides.outside : sides.inside);
  }
  return sides;
}

/// Of a loop with long delays.
SampledStability delayedStability(const DelayedMatrix& matrix, int standing) {
  const std::optional<LeadingRoots> leading = leadingRoots(matrix);
  if (!leading) {
    throw RunFailure(
        "sampled loop: the eigenvalues cannot be separated, because the delays are too long");
  }
  SampledStability result;
  result.eigenvalues = leading->roots;
  result.spectral_radius = leading->roots.empty() ? 0.0 : std::abs(leading->roots.front());
  result.routh.right = leading->outside;
  result.routh.imaginary = std::max(leading->near, standing);
  result.routh.left =
      static_cast<int>(matrix.states()) - result.routh.right - result.routh.imaginary;
  result.routh.largest_imaginary_multiplicity = standing > 0 ? 1 : 0;
  const bool stays = standing == 1 && leading->near == 1;
  result.verdict = result.routh.verdict = leading->outside > 0 ? Verdict::kUnstable
                                          : stays              ? Verdict::kMarginal
                                          : result.routh.imaginary > 0
                                              ? Verdict::kUncertain
                                              : Verdict::kAsymptoticallyStable;
  return result;
}

}  // namespace

SampledStability sampledStability(const SampledLoop& loop) {
  SampledStability result;
  if (!loop.transition.allFinite()) {
    throw RunFailure("sampled loop: the transition matrix exceeds the range of a double");
  }
  if (loop.transition.size() == 0) {
    result.verdict = Verdict::kAsymptoticallyStable;
    result.exact = true;
    return result;
  }
  const DelayedMatrix delayed(loop.transition);
  if (isMostlyDelays(delayed)) {
    return delayedStability(delayed, loop.standing);
  }
  const MatrixXd a = balanced(loop.transition);
  result.eigenvalues = sortedEigenvalues(a);
  result.spectral_radius = std::abs(result.eigenvalues.front());
  const int samples = std::accumulate(loop.samples.begin(), loop.samples.end(), 0);
  const Sides by_eigenvalues =
      sides(a, result.eigenvalues, loop.standing, kTransitionRounding * samples * a.norm());
  if (a.rows() <= kMaxExactStates) {
    try {
      result.routh = exactRouth(a, loop.standing);
      result.exact = true;
    } catch (const ExactBudgetSpent&) {
      result.routh = {};
    }
  }
  if (!result.exact) {
    result.routh.right = by_eigenvalues.outside;
    result.routh.imaginary = by_eigenvalues.near;
    result.routh.left = by_eigenvalues.inside;
    result.routh.verdict = by_eigenvalues.outside > 0 ? Verdict::kUnstable
                           : by_eigenvalues.near > 0  ? Verdict::kUncertain
                                                      : Verdict::kAsymptoticallyStable;
  }
  RouthResult& routh = result.routh;
  const bool agreed = by_eigenvalues.outside > 0
                          ? routh.right > 0
                          : routh.right == 0 && by_eigenvalues.near <= routh.imaginary;
  routh.imaginary += loop.standing;
  routh.largest_imaginary_multiplicity =
      std::max(routh.largest_imaginary_multiplicity, loop.standing > 0 ? 1 : 0);
  if (loop.standing > 0 && routh.verdict == Verdict::kAsymptoticallyStable) {
    routh.verdict = Verdict::kMarginal;
  }
  result.verdict = agreed ? routh.verdict : Verdict::kUncertain;
  return result;
}

}  // namespace whirl_twin
