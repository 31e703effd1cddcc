#include "analysis/linearized_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "analysis/characteristic_polynomial.h"
#include "analysis/equilibria.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

constexpr double kUnit = 1.1102230246251565e-16;  // 2^-53
constexpr double kAlike = 1.0e-13;                // a difference of factors that rounding makes
constexpr double kResidual = 1.0e-13;             // of coefficients, after the last correction
constexpr double kDouble = 1.0e-12;               // of a discriminant that is none
constexpr double kPolish = 1.0e-6;                // of a root: more is no correction
constexpr int kCorrections = 2;

/// s^4 + a s^3 + b s^2 + c s + d.
struct Monic {
  double a, b, c, d;
};

/// (s^2 + p s + q) (s^2 + r s + t).
struct QuadraticFactors {
  double p, q, r, t;
};

/// Each entry of Routh's column times those above it: minors of Hurwitz's matrix.
void judge(const Monic& m, QuarticJudgement& judgement) {
  const double second = m.a * m.b - m.c;
  const double second_error = 4.0 * kUnit * (std::fabs(m.a * m.b) + std::fabs(m.c));
  const double across = m.a * m.a * m.d;
  const double third = second * m.c - across;
  const double third_error =
      std::fabs(m.c) * second_error + 8.0 * kUnit * (std::fabs(second * m.c) + std::fabs(across));
  judgement.sure = m.a != 0.0 && std::fabs(second) > second_error &&
                   std::fabs(third) > third_error && m.d != 0.0;
  const std::array<double, 5> column{1.0, m.a, second * m.a, third * second, m.d};
  for (std::size_t i = 1; i < column.size(); ++i) {
    judgement.right += (column[i] < 0.0) != (column[i - 1] < 0.0) ? 1 : 0;
  }
}

/// The largest real root of y^3 - b y^2 + e y + f.
double largestOfCubic(double b, double e, double f) {
  const double third = b / 3.0;
  const double q = third * third - e / 3.0;
  const double r = third * (third * third - 0.5 * e) - 0.5 * f;
  double y = third;
  // A double root that rounding makes a pair is real.
  if (r * r < q * q * q * (1.0 + kDouble)) {
    const double angle = std::acos(std::clamp(r / std::sqrt(q * q * q), -1.0, 1.0));
    // The largest of the three cosines is that of the smallest angle.
    y += 2.0 * std::sqrt(q) * std::cos(angle / 3.0);
  } else {
    const double root =
        std::copysign(std::cbrt(std::fabs(r) + std::sqrt(std::fmax(0.0, r * r - q * q * q))), r);
    y += root == 0.0 ? 0.0 : root + q / root;
  }
  const double slope = (3.0 * y - 2.0 * b) * y + e;
  const double step = slope == 0.0 ? 0.0 : (((y - b) * y + e) * y + f) / slope;
  // A double root has zero slope: it is unchanged.
  return std::fabs(step) <= kPolish * (std::fabs(b) + std::fabs(y)) ? y - step : y;
}

QuadraticFactors factorsOf(const Monic& m) {
  const double y =
      largestOfCubic(m.b, m.a * m.c - 4.0 * m.d, 4.0 * m.b * m.d - m.a * m.a * m.d - m.c * m.c);
  // (p - r)^2 and (q - t)^2; their product follows from the coefficient of s.
  const double across = m.a * y - 2.0 * m.c;
  double u2 = m.a * m.a - 4.0 * m.b + 4.0 * y;
  double v2 = y * y - 4.0 * m.d;
  const double u_size = m.a * m.a + 4.0 * std::fabs(m.b) + 4.0 * std::fabs(y);
  const double v_size = y * y + 4.0 * std::fabs(m.d);
  u2 = u2 > kAlike * u_size ? u2 : 0.0;
  v2 = v2 > kAlike * v_size ? v2 : 0.0;
  double u = std::sqrt(u2), v = std::sqrt(v2);
  if (u2 * v_size > v2 * u_size) {
    v = across / u;
  } else if (v > 0.0) {
    u = across / v;
  }
  QuadraticFactors f{0.5 * (m.a + u), 0.5 * (y + v), 0.5 * (m.a - u), 0.5 * (y - v)};
  if (std::fabs(f.q) < std::fabs(f.t)) {
    std::swap(f.p, f.r);
    std::swap(f.q, f.t);
  }
  f.t = m.d / f.q;  // the difference may have lost it
  return f;
}

/// Deviation of the product from the quartic, relative to its terms.
std::array<double, 4> residual(const Monic& m, const QuadraticFactors& f) {
  return {m.a - (f.p + f.r), m.b - (f.q + f.t + f.p * f.r), m.c - (f.p * f.t + f.q * f.r),
          m.d - f.q * f.t};
}

/// Newton's method on the factors; no step where they coincide (singular).
void correct(const Monic& m, QuadraticFactors& f) {
  const auto [e1, e2, e3, e4] = residual(m, f);
  const double apart = f.p - f.r;
  const double g = e2 - f.p * e1;
  const double a11 = f.t + f.p * apart - f.q, a12 = -apart, b1 = e3 - f.p * g - f.q * e1;
  const double a21 = f.q * apart, a22 = f.t - f.q, b2 = e4 - f.q * g;
  const double determinant = a11 * a22 - a12 * a21;
  if (std::fabs(determinant) <= kAlike * (std::fabs(a11 * a22) + std::fabs(a12 * a21))) {
    return;
  }
  const double dp = (b1 * a22 - a12 * b2) / determinant;
  const double dq = (a11 * b2 - a21 * b1) / determinant;
  f.p += dp;
  f.q += dq;
  f.r += e1 - dp;
  f.t += g + apart * dp - dq;
}

bool fits(const Monic& m, const QuadraticFactors& f) {
  const std::array<double, 4> off = residual(m, f);
  const std::array<double, 4> terms{
      std::fabs(f.p) + std::fabs(f.r), std::fabs(f.q) + std::fabs(f.t) + std::fabs(f.p * f.r),
      std::fabs(f.p * f.t) + std::fabs(f.q * f.r), std::fabs(f.q * f.t)};
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (!(std::fabs(off[i]) <= kResidual * terms[i])) {
      return false;
    }
  }
  return true;
}

/// Of s^2 + p s + q.
void addRoots(double p, double q, QuarticJudgement& judgement) {
  const double discriminant = 0.25 * p * p - q;
  std::complex<double> right;
  double least;
  double far;
  if (discriminant < 0.0) {
    right = {-0.5 * p, std::sqrt(-discriminant)};
    far = std::sqrt(q);
    least = 0.5 * p / far;
  } else {
    const double larger = -0.5 * p - std::copysign(std::sqrt(discriminant), p);
    const double smaller = larger == 0.0 ? 0.0 : q / larger;
    right = std::max(larger, smaller);
    far = std::max(std::fabs(larger), std::fabs(smaller));
    least = right.real() > 0.0 ? -1.0 : 1.0;
  }
  if (right.real() > judgement.rightmost.real()) {
    judgement.rightmost = right;
  }
  judgement.largest = std::max(judgement.largest, far);
  judgement.damping_ratio = std::min(judgement.damping_ratio, least);
}

}  // namespace

QuarticJudgement judgeQuartic(const std::array<double, 5>& coefficients) noexcept {
  QuarticJudgement judgement;
  const double lead = coefficients[0];
  // s in units of a power of two that makes the last coefficient one: nothing overflows.
  int lead_exponent = 0, last_exponent = 0;
  static_cast<void>(std::frexp(lead, &lead_exponent));
  static_cast<void>(std::frexp(coefficients[4], &last_exponent));
  const int unit = (last_exponent - lead_exponent) / 4;
  const auto scaled = [&](int i) {
    return std::ldexp(coefficients[static_cast<std::size_t>(i)] / lead, -i * unit);
  };
  const Monic m{scaled(1), scaled(2), scaled(3), scaled(4)};
  judge(m, judgement);
  if (!(lead != 0.0 && m.d != 0.0 && std::isfinite(m.a + m.b + m.c + m.d))) {
    judgement.sure = false;
    return judgement;
  }
  QuadraticFactors factors = factorsOf(m);
  for (int i = 0; i < kCorrections; ++i) {
    correct(m, factors);
    factors.t = m.d / factors.q;
  }
  judgement.factored = fits(m, factors);
  judgement.rightmost = {-HUGE_VAL, 0.0};
  judgement.damping_ratio = 1.0;
  addRoots(factors.p, factors.q, judgement);
  addRoots(factors.r, factors.t, judgement);
  const double scale = std::ldexp(1.0, unit);
  judgement.rightmost *= scale;
  judgement.largest *= scale;
  judgement.decay_rate = 0.0 - judgement.rightmost.real();
  return judgement;
}

namespace {

constexpr double kGrowth = 1.0e-9;  // or decay, of the largest eigenvalue: no rounding
constexpr double kClear = 1.0e-5;   // likewise, whatever a quartic's coefficients have lost
constexpr double kGrowthRounding = 1.0e-15;  // of the largest eigenvalue: no growth

/// The characteristic quartic of two coordinates.
std::array<double, 5> quarticOf(const Linearization& l) {
  const Eigen::Matrix2d m = l.mass, c = l.damping + l.gyroscopic, k = l.stiffness + l.circulatory;
  const auto determinant = [](double m11, double c11, double k11, double m22, double c22,
                              double k22) {
    return std::array<double, 5>{m11 * m22, m11 * c22 + c11 * m22,
                                 m11 * k22 + c11 * c22 + k11 * m22, c11 * k22 + k11 * c22,
                                 k11 * k22};
  };
  std::array<double, 5> quartic = determinant(m(0, 0), c(0, 0), k(0, 0), m(1, 1), c(1, 1), k(1, 1));
  const std::array<double, 5> across =
      determinant(m(0, 1), c(0, 1), k(0, 1), m(1, 0), c(1, 0), k(1, 0));
  for (std::size_t i = 0; i < quartic.size(); ++i) {
    quartic[i] -= across[i];
  }
  return quartic;
}

/// The fastest growth of a deviation, relative to the largest eigenvalue: to some digits where it
/// is far from none.
double growth(const LinearizedMotion& motion) {
  if (motion.matrices.mass.rows() == 2 && motion.zeros == 0) {
    const QuarticJudgement quick = judgeQuartic(quarticOf(motion.matrices));
    const double found = quick.rightmost.real() / quick.largest;
    if (quick.factored && quick.sure && std::fabs(found) > kClear &&
        (found > 0.0) == (quick.right > 0)) {
      return found;
    }
  }
  const auto roots = eigenvalues(motion.matrices, motion.zeros);
  const auto fastest = std::max_element(
      roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return roots.back() == 0.0 ? 0.0 : fastest->real() / std::abs(roots.back());
}

}  // namespace

std::optional<LinearizedMotion> linearizedMotionAbout(const Dynamics& dynamics,
                                                      const CyclicCoordinates& cyclic,
                                                      const SteadyMotion& motion, double speed,
                                                      const std::optional<PeriodicMotion>& near) {
  const Linearization l = linearizationAbout(dynamics, motion.q, motion.v, speed);
  LinearizedMotion small = cyclic.any()
                               ? LinearizedMotion{atFixedMomenta(l, cyclic), cyclic.driven.size()}
                               : LinearizedMotion{l, 0};
  if (const auto period = timeDependence(dynamics, speed).period) {
    small.periodic = periodicMotionNear(dynamics, speed, *period,
                                        near ? SteadyMotion{near->q, near->v} : motion);
    if (!small.periodic) {
      return std::nullopt;
    }
  }
  return small;
}

std::complex<double> fastestGrowing(const LinearizedMotion& motion) {
  if (motion.matrices.mass.rows() == 0) {
    return 0.0;
  }
  const auto roots = motion.periodic ? exponentsOf(*motion.periodic, eigenvalues(motion.matrices))
                                     : eigenvalues(motion.matrices, motion.zeros);
  return *std::max_element(roots.begin(), roots.end(),
                           [](const auto& a, const auto& b) { return a.real() < b.real(); });
}

bool surelyUnstable(const LinearizedMotion& motion) {
  if (motion.periodic) {
    return grows(*motion.periodic);
  }
  return motion.matrices.mass.rows() > 0 && !cannotGrow(motion.matrices) &&
         growth(motion) > kGrowth;
}

bool GrowthTest::unstable(const LinearizedMotion& motion) {
  if (motion.periodic) {
    return grows(*motion.periodic);
  }
  if (motion.matrices.mass.rows() == 0) {
    return false;
  }
  const double fastest = growth(motion);
  if (std::fabs(fastest) > kGrowth) {
    return fastest > 0.0;
  }
  const Linearization& l = motion.matrices;
  if (l.mass.rows() <= most_exact_ && !budget_spent_) {
    try {
      return routh(characteristicPolynomial(l), budget_).verdict == Verdict::kUnstable;
    } catch (const ExactBudgetSpent&) {
      budget_spent_ = true;
    }
  }
  return !cannotGrow(l) && fastest > kGrowthRounding;
}

}  // namespace whirl_twin
