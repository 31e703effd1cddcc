// Dual numbers give exact derivatives of any expression: random expressions against finite
// differences in 50-digit arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "mechanics/gradient.h"
#include "mechanics/lagrangian_dual.h"

namespace whirl_twin {
namespace duals_test {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

// Arguments: q1, q2, their rates v1, v2, and time.
constexpr std::size_t kArguments = 5;
constexpr std::size_t kDof = 2;

struct Operation {
  int kind;
  std::size_t first;
  std::size_t second;
  double constant;
};
constexpr int kKinds = 16;

template <class S>
S apply(const Operation& o, const S& a, const S& b) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  using std::tanh;
  const double c = o.constant;
  switch (o.kind) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    case 2:
      return a * b;
    case 3:
      return a / (2.0 + b * b);
    case 4:
      return c / (1.5 + a * a);
    case 5:
      return sin(a);
    case 6:
      return cos(a);
    case 7:
      return tanh(a);
    case 8:
      return sqrt(1.0 + a * a);
    case 9:
      return -a;
    case 10:
      return a + c;
    case 11:
      return c + a;
    case 12:
      return a - c;
    case 13:
      return c - a;
    case 14:
      return a * c;
    default:
      return a / c;
  }
}

using Expression = std::vector<Operation>;

template <class S>
S evaluate(const Expression& expression, const std::array<S, kArguments>& x) {
  std::vector<S> values(x.begin(), x.end());
  for (const Operation& o : expression) {
    values.push_back(apply(o, values[o.first], values[o.second]));
  }
  // The last few together, so that most of what was computed counts.
  return values.back() + values[values.size() - 2] * values[values.size() - 3];
}

Expression randomExpression(std::mt19937_64& random) {
  std::uniform_real_distribution<double> constant(0.5, 2.0);
  Expression e;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto any = [&] {
      return std::uniform_int_distribution<std::size_t>(0, kArguments + i - 1)(random);
    };
    e.push_back({std::uniform_int_distribution<int>(0, kKinds - 1)(random), any(), any(),
                 constant(random)});
  }
  return e;
}

// Central differences in 50 digits: steps of 1e-12 leave 1e-24 of truncation, 1e-26 of rounding.
struct Differences {
  const Expression& expression;
  std::array<Wide, kArguments> at;
  const Wide step = Wide("1e-12");

  Wide value(std::size_t i, int a, std::size_t j, int b) const {
    std::array<Wide, kArguments> x = at;
    x[i] += a * step;
    x[j] += b * step;
    return evaluate(expression, x);
  }
  double first(std::size_t i) const {
    return static_cast<double>((value(i, 1, i, 0) - value(i, -1, i, 0)) / (2 * step));
  }
  double second(std::size_t i, std::size_t j) const {
    return static_cast<double>(
        (value(i, 1, j, 1) - value(i, 1, j, -1) - value(i, -1, j, 1) + value(i, -1, j, -1)) /
        (4 * step * step));
  }
};

class RandomExpressions : public testing::Test {
 protected:
  // Twelve operations amplify a rounding by the sizes that pass through them; derivatives of large
  // intermediate values may cancel, so errors are measured against the largest derivative.
  static constexpr double kTolerance = 1e-12;

  void forEach(const std::function<void(const Expression&, const std::array<double, kArguments>&,
                                        const Differences&, double largest)>& check) {
    std::mt19937_64 random(1788);
    std::uniform_real_distribution<double> argument(-1.5, 1.5);
    for (int n = 0; n < 400; ++n) {
      const Expression e = randomExpression(random);
      std::array<double, kArguments> x;
      std::array<Wide, kArguments> wide;
      for (std::size_t i = 0; i < kArguments; ++i) {
        wide[i] = x[i] = argument(random);
      }
      const Differences d{e, wide};
      double largest = 1.0;
      for (std::size_t i = 0; i < kArguments; ++i) {
        largest = std::max(largest, std::abs(d.first(i)));
        for (std::size_t j = 0; j <= i; ++j) {
          largest = std::max(largest, std::abs(d.second(i, j)));
        }
      }
      check(e, x, d, largest);
    }
  }
};

TEST_F(RandomExpressions, GradientIsTheGradient) {
  forEach([](const Expression& e, const auto& x, const Differences& d, double largest) {
    using Dual = Gradient<double, kArguments>;
    std::array<Dual, kArguments> dual;
    for (std::size_t i = 0; i < kArguments; ++i) {
      dual[i] = Dual(x[i], i);
    }
    const Dual f = evaluate(e, dual);
    EXPECT_NEAR(f.value, evaluate(e, x), kTolerance * largest);
    for (std::size_t i = 0; i < kArguments; ++i) {
      ASSERT_NEAR(f.slope[i], d.first(i), kTolerance * largest) << "by argument " << i;
    }
  });
}

TEST_F(RandomExpressions, GradientOfAGradientHasTheSecondDerivatives) {
  forEach([](const Expression& e, const auto& x, const Differences& d, double largest) {
    using Inner = Gradient<double, kArguments>;
    using Outer = Gradient<Inner, kArguments>;
    std::array<Outer, kArguments> dual;
    for (std::size_t i = 0; i < kArguments; ++i) {
      dual[i] = Outer(Inner(x[i], i), i);
    }
    const Outer f = evaluate(e, dual);
    for (std::size_t i = 0; i < kArguments; ++i) {
      for (std::size_t j = 0; j < kArguments; ++j) {
        ASSERT_NEAR(f.slope[i].slope[j], d.second(i, j), kTolerance * largest) << i << ", " << j;
      }
    }
  });
}

TEST_F(RandomExpressions, LagrangianDualHasWhatTheEulerLagrangeEquationsAsk) {
  forEach([](const Expression& e, const auto& x, const Differences& d, double largest) {
    using Dual = LagrangianDual<double, kDof>;
    std::array<Dual, kArguments> dual;
    for (std::size_t j = 0; j < kDof; ++j) {
      dual[j] = Dual::coordinate(x[j], x[kDof + j], j);
      dual[kDof + j] = Dual::velocity(x[kDof + j], j);
    }
    constexpr std::size_t kTime = 2 * kDof;
    dual[kTime] = Dual::known(x[kTime], 1.0);
    const Dual f = evaluate(e, dual);
    const double tolerance = 10.0 * kTolerance * largest;  // sums of a handful of derivatives
    const double v[kDof] = {x[kDof], x[kDof + 1]};
    EXPECT_NEAR(f.value, evaluate(e, x), tolerance);
    ASSERT_NEAR(f.rate, v[0] * d.first(0) + v[1] * d.first(1) + d.first(kTime), tolerance);
    ASSERT_NEAR(f.by_t, d.first(kTime), tolerance);
    for (std::size_t j = 0; j < kDof; ++j) {
      ASSERT_NEAR(f.by_q[j], d.first(j), tolerance);
      ASSERT_NEAR(f.by_v[j], d.first(kDof + j), tolerance);
      ASSERT_NEAR(
          f.by_v_rate[j],
          v[0] * d.second(kDof + j, 0) + v[1] * d.second(kDof + j, 1) + d.second(kDof + j, kTime),
          tolerance);
      for (std::size_t k = 0; k <= j; ++k) {
        ASSERT_NEAR(f.by_vv[j * (j + 1) / 2 + k], d.second(kDof + j, kDof + k), tolerance);
      }
    }
  });
}

struct Elementary {
  const char* name;
  Jet<double> (*jet)(const double&);
  double (*value)(double);
  double (*slope)(double);
  double (*curvature)(double);
};

void PrintTo(const Elementary& f, std::ostream* out) {
  *out << f.name;
}

double sine(double x) {
  return std::sin(x);
}
double cosine(double x) {
  return std::cos(x);
}
double minusSine(double x) {
  return -std::sin(x);
}
double minusCosine(double x) {
  return -std::cos(x);
}

class ElementaryFunction : public testing::TestWithParam<Elementary> {};

TEST_P(ElementaryFunction, HasItsValueSlopeAndCurvature) {
  const Elementary& f = GetParam();
  for (const double x : {1e-3, 0.1, 0.7, 1.0, 2.0, 5.0}) {
    const Jet<double> jet = f.jet(x);
    EXPECT_DOUBLE_EQ(jet.value, f.value(x));
    // tanh' = 1 - tanh^2 cancels near 1: rounding of 1, not of the slope.
    EXPECT_NEAR(jet.slope, f.slope(x), 1e-15 * (1.0 + std::abs(f.slope(x))));
    EXPECT_NEAR(jet.curvature, f.curvature(x), 1e-15 * (1.0 + std::abs(f.curvature(x))));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Duals, ElementaryFunction,
    testing::Values(
        Elementary{"sin", sinJet<double>, sine, cosine, minusSine},
        Elementary{"cos", cosJet<double>, cosine, minusSine, minusCosine},
        Elementary{"sqrt", sqrtJet<double>, [](double x) { return std::sqrt(x); },
                   [](double x) { return 0.5 * std::pow(x, -0.5); },
                   [](double x) { return -0.25 * std::pow(x, -1.5); }},
        Elementary{"tanh", tanhJet<double>, [](double x) { return std::tanh(x); },
                   [](double x) { return std::pow(std::cosh(x), -2.0); },
                   [](double x) { return -2.0 * std::tanh(x) * std::pow(std::cosh(x), -2.0); }},
        Elementary{"reciprocal", reciprocalJet<double>, [](double x) { return 1.0 / x; },
                   [](double x) { return -std::pow(x, -2.0); },
                   [](double x) { return 2.0 * std::pow(x, -3.0); }}),
    [](const auto& test) { return test.param.name; });

}  // namespace duals_test
}  // namespace whirl_twin
