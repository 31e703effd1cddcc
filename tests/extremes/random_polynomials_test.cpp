// Routh's test on random polynomials with known roots: a hundred thousand in full length, a
// thousand otherwise. The roots are drawn, which determines all expected results; coefficients
// follow exactly, from whole numbers.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "../analysis/reference_polynomials.h"
#include "analysis/routh.h"
#include "analysis/stability.h"
#include "measured.h"

namespace whirl_twin {
namespace random_polynomials_test {

using Polynomial = std::vector<Rational>;

constexpr int kHighest = 16;         // degree
constexpr double kBudget = 2.0e8;    // products, as the monitor's verdict has them
constexpr double kUncertain = 0.02;  // part of all of them

/// Known properties of a polynomial by construction.
struct Known {
  Polynomial coefficients{1};
  int right = 0, imaginary = 0, left = 0;
  int multiplicity = 0;  ///< the largest on the imaginary axis
};

class RandomRoots {
 public:
  explicit RandomRoots(unsigned seed) : random_(seed) {}

  /// Real roots n/d and pairs n/d +- i m/d, whole numbers up to 200: of one polynomial they lie on
  /// the axis, a hundredth from it, or far from it, and may be repeated.
  Known next() {
    Known known;
    std::map<std::pair<int, int>, int> on_axis;
    const int degree = 1 + below(kHighest);
    const int margin = below(3);  // roots on the axis: none, some, many
    while (size(known) < degree) {
      const bool pair = size(known) + 2 <= degree && below(3) != 0;
      const int again = size(known) + 2 * (pair ? 2 : 1) <= degree && below(12) == 0 ? 2 : 1;
      const int d = 1 + below(100);
      const int n = margin > 0 && below(margin == 1 ? 8 : 3) == 0 ? 0 : signed_();
      const int m = 1 + below(200);
      for (int i = 0; i < again; ++i) {
        add(known, n, m, d, pair);
        if (n == 0) {
          const int g = pair ? std::gcd(m, d) : 1;
          const int times = ++on_axis[pair ? std::pair(m / g, d / g) : std::pair(0, 1)];
          known.multiplicity = std::max(known.multiplicity, times);
        }
      }
    }
    // A scale and a sign leave the roots where they are.
    const Rational scale(below(2) == 0 ? -1 - below(1000) : 1 + below(1000), 1 + below(1000));
    for (Rational& coefficient : known.coefficients) {
      coefficient *= scale;
    }
    return known;
  }

 private:
  static int size(const Known& known) { return static_cast<int>(known.coefficients.size()) - 1; }
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  int signed_() { return (below(3) == 0 ? 1 : -1) * (1 + below(200)); }

  /// s - n/d, or (s - n/d)^2 + (m/d)^2.
  static void add(Known& known, int n, int m, int d, bool pair) {
    const Rational re(n, d);
    known.coefficients = product<Rational>(
        known.coefficients, pair ? Polynomial{1, -2 * re, re * re + Rational(m, d) * Rational(m, d)}
                                 : Polynomial{1, -re});
    (n > 0 ? known.right : n == 0 ? known.imaginary : known.left) += pair ? 2 : 1;
  }

  std::mt19937 random_;
};

Verdict verdictOf(const Known& known) {
  return known.right > 0          ? Verdict::kUnstable
         : known.multiplicity > 1 ? Verdict::kRepeatedImaginary
         : known.imaginary > 0    ? Verdict::kMarginal
                                  : Verdict::kAsymptoticallyStable;
}

TEST(RandomPolynomials, RouthCountsTheRootsThatAreKnown) {
  const auto count = static_cast<int>(runOf(1000, 100000));
  RandomRoots roots(20260001);
  int wrong = 0;
  int uncertain = 0;
  std::map<Verdict, int> met;
  for (int i = 0; i < count; ++i) {
    const Known known = roots.next();
    ++met[verdictOf(known)];
    try {
      ExactBudget budget(kBudget);
      const RouthResult result = routh(known.coefficients, budget);
      const bool right = result.right == known.right && result.imaginary == known.imaginary &&
                         result.left == known.left &&
                         result.largest_imaginary_multiplicity == known.multiplicity &&
                         result.verdict == verdictOf(known);
      wrong += right ? 0 : 1;
    } catch (const ExactBudgetSpent&) {
      ++uncertain;
    }
  }
  expectWithin(0.0, wrong, fmt::format("wrong of {} random polynomials to degree 16", count));
  expectWithin(kUncertain, uncertain / static_cast<double>(count), "uncertain, part of them");
  for (const Verdict verdict : {Verdict::kAsymptoticallyStable, Verdict::kMarginal,
                                Verdict::kRepeatedImaginary, Verdict::kUnstable}) {
    EXPECT_GT(met[verdict], count / 100) << "no " << name(verdict) << " among them to tell of";
  }
}

/// A system of so many modes that are known, in coordinates that mix them: M = P^T P, C = P^T c P
/// and K = P^T k P, all whole numbers, with P made of whole-number row operations.
struct KnownSystem {
  Linearization matrices;
  int right = 0, imaginary = 0, left = 0;
  Verdict verdict = Verdict::kAsymptoticallyStable;
};

KnownSystem systemOf(int dof, std::mt19937& random) {
  const auto below = [&random](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  KnownSystem known;
  Eigen::VectorXd c(dof);
  Eigen::VectorXd k(dof);
  bool drifts = false;
  const bool calm = below(2) == 0;  // nothing grows
  const bool near_axis = below(2) == 0;
  for (int mode = 0; mode < dof; ++mode) {
    const int n = below(4) == 0 ? 0 : (calm || below(4) != 0 ? -1 : 1) * (1 + below(20));
    const int m = below(12) == 0 ? 0 : 1 + below(near_axis ? 100000 : 100);
    c[mode] = -2.0 * n;
    k[mode] = 1.0 * n * n + 1.0 * m * m;
    (n > 0 ? known.right : n == 0 ? known.imaginary : known.left) += 2;
    drifts = drifts || (n == 0 && m == 0);  // s^2 = 0 of one mode: it grows like time
  }
  // A pair of roots on the axis twice, of two modes, has both its vectors and does not grow.
  known.verdict = known.right > 0       ? Verdict::kUnstable
                  : drifts              ? Verdict::kRepeatedImaginary
                  : known.imaginary > 0 ? Verdict::kMarginal
                                        : Verdict::kAsymptoticallyStable;
  Eigen::MatrixXd p = Eigen::MatrixXd::Identity(dof, dof);
  for (int operation = 0; dof > 1 && operation < 2 * dof; ++operation) {
    const int row = below(dof);
    const int other = (row + 1 + below(dof - 1)) % dof;
    p.row(row) += (below(2) == 0 ? -1.0 : 1.0) * p.row(other);
  }
  known.matrices.mass = p.transpose() * p;
  known.matrices.damping = p.transpose() * c.asDiagonal() * p;
  known.matrices.stiffness = p.transpose() * k.asDiagonal() * p;
  known.matrices.gyroscopic = known.matrices.circulatory = Eigen::MatrixXd::Zero(dof, dof);
  return known;
}

TEST(RandomPolynomials, TheVerdictOnASystemIsThatOfTheModesItWasMadeOf) {
  const auto count = static_cast<int>(runOf(200, 10000));
  std::mt19937 random(20260002);
  int wrong = 0;
  int uncertain = 0;
  std::map<Verdict, int> met;
  for (int i = 0; i < count; ++i) {
    const KnownSystem known = systemOf(1 + i % 8, random);
    ++met[known.verdict];
    const Stability result = stability(known.matrices);
    if (result.routh.verdict == Verdict::kUncertain) {
      ++uncertain;
    } else {
      const bool right =
          result.routh.verdict == known.verdict && result.routh.right == known.right &&
          result.routh.imaginary == known.imaginary && result.routh.left == known.left;
      wrong += right ? 0 : 1;
    }
  }
  expectWithin(0.0, wrong, fmt::format("wrong of {} systems of one to eight known modes", count));
  expectWithin(kUncertain, uncertain / static_cast<double>(count), "uncertain, part of them");
  for (const Verdict verdict : {Verdict::kAsymptoticallyStable, Verdict::kMarginal,
                                Verdict::kRepeatedImaginary, Verdict::kUnstable}) {
    EXPECT_GT(met[verdict], count / 50) << "no " << name(verdict) << " among them to tell of";
  }
}

}  // namespace random_polynomials_test
}  // namespace whirl_twin
