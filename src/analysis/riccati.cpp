#include "analysis/riccati.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "algebra/dense.h"
#include "integration/matrix_exponential.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kMaxRiccatiDoublings = 60;
/// A Cayley transform whose parameter is as near as this to an eigenvalue loses too many digits.
constexpr double kSingularShift = 1e-8;
/// Below this residual of the closed loop's motion further doublings do not change the solution.
constexpr double kGone = 1e-18;
/// Newton steps that remove the rounding of the doublings.
constexpr int kMaxRefinements = 6;

/// X = A' X (I + G X)^-1 A + H, and its dual: what doubling takes and gives.
struct Doubling {
  MatrixXd a, g, h;
};

MatrixXd symmetric(const MatrixXd& m) {
  return 0.5 * (m + m.transpose());
}

bool finite(const MatrixXd& m) {
  return m.allFinite();
}

[[noreturn]] void noSolution() {
  throw RunFailure(
      "Riccati equation: no stabilizing gain: an unstable state is not controllable or has no "
      "weight");
}

void checkCost(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost) {
  const Index n = a.rows();
  const Index m = b.cols();
  const bool fits = a.cols() == n && b.rows() == n && cost.state.rows() == n &&
                    cost.state.cols() == n && cost.input.rows() == m && cost.input.cols() == m &&
                    (cost.cross.size() == 0 || (cost.cross.rows() == n && cost.cross.cols() == m));
  if (!fits) {
    throw std::logic_error("Riccati equation: the sizes of the matrices do not match");
  }
  if (!finite(a) || !finite(b) || !finite(cost.state) || !finite(cost.input) ||
      !finite(cost.cross)) {
    throw InputError("Riccati equation: all matrices must be finite");
  }
}

MatrixXd crossOf(const QuadraticCost& cost) {
  return cost.cross.size() > 0 ? cost.cross
                               : MatrixXd(MatrixXd::Zero(cost.state.rows(), cost.input.rows()));
}

Cholesky inverseOf(const MatrixXd& input_cost) {
  Cholesky factors(input_cost);
  if (input_cost.size() > 0 && !factors.succeeded()) {
    throw InputError("Riccati equation: the input weights r must be positive definite (all > 0)");
  }
  return factors;
}

/// The stabilising solution of the sampled equation without a cross term.
MatrixXd doubled(Doubling d) {
  const MatrixXd identity = MatrixXd::Identity(d.a.rows(), d.a.cols());
  for (int i = 0; i < kMaxRiccatiDoublings; ++i) {
    const Lu w(identity + d.g * d.h);
    const MatrixXd wa = w.solve(d.a);
    const MatrixXd wg = w.solve(d.g);
    const MatrixXd gained = symmetric(d.a.transpose() * d.h * wa);
    d.g += symmetric(d.a * wg * d.a.transpose());
    d.h += gained;
    d.a = (d.a * wa).eval();
    if (!finite(d.a) || !finite(d.g) || !finite(d.h)) {
      noSolution();
    }
    if (d.a.cwiseAbs().sum() < kGone) {
      return d.h;
    }
  }
  noSolution();
}

/// |det|^(1/rows), without overflow.
double meanSize(const MatrixXd& m) {
  const Lu lu(m);
  return std::exp(lu.pivots().cwiseAbs().array().log().mean());
}

/// The continuous equation A' X + X A - X G X + Q = 0 as a sampled one of the same solution. The
/// closed loop's eigenvalues s become (s + p) / (s - p): fastest gone with p amid their sizes.
Doubling transformed(const MatrixXd& a, const MatrixXd& g, const MatrixXd& q) {
  const Index n = a.rows();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << a, -g, -q, -a.transpose();
  double p = meanSize(hamiltonian);
  if (!(p > 0.0) || !std::isfinite(p)) {
    noSolution();  // an eigenvalue 0 of the closed loop
  }
  constexpr int kTries = 12;
  for (int i = 0; i < kTries; ++i, p *= 1.3) {
    const Lu shifted(a - p * identity);
    if (!(shifted.rcond() > kSingularShift)) {
      continue;
    }
    const MatrixXd inverse = shifted.inverse();
    const Lu w(a.transpose() - p * identity + q * inverse * g);
    const MatrixXd by_w = w.inverse();
    return {identity + 2.0 * p * by_w.transpose(), symmetric(2.0 * p * inverse * g * by_w),
            symmetric(2.0 * p * by_w * q * inverse)};
  }
  noSolution();
}

/// E = A' E A + rest, every eigenvalue of A inside the unit circle (R. Smith, SIAM J. Applied
/// Mathematics 16 (1968) 198).
MatrixXd summed(MatrixXd a, MatrixXd rest) {
  for (int i = 0; i < kMaxRiccatiDoublings; ++i) {
    rest += symmetric(a.transpose() * rest * a);
    a = (a * a).eval();
    if (!finite(a) || !finite(rest)) {
      break;
    }
    if (a.cwiseAbs().sum() < kGone) {
      return rest;
    }
  }
  noSolution();
}

/// A' E + E A + rest = 0, every eigenvalue of A left of the imaginary axis.
MatrixXd integrated(const MatrixXd& a, const MatrixXd& rest) {
  const double p = meanSize(a);
  const MatrixXd shift = p * MatrixXd::Identity(a.rows(), a.cols());
  const MatrixXd m = Lu(a - shift).inverse();
  return summed((a + shift) * m, symmetric(2.0 * p * m.transpose() * rest * m));
}

/// The cost of a sample, or its rate, under u = -gain x.
MatrixXd costOf(const QuadraticCost& cost, const MatrixXd& cross, const MatrixXd& gain) {
  const MatrixXd crossed = cross * gain;
  return symmetric(cost.state) - crossed - crossed.transpose() +
         symmetric(gain.transpose() * cost.input * gain);
}

/// Newton's method on X (D. Kleinman, IEEE Trans. Automatic Control 13 (1968) 114; G. Hewer, 16
/// (1971) 382). gain(X), and correction(X, gain) of what it costs.
template <class Gain, class Correction>
Regulator refinedRegulator(MatrixXd x, const Gain& gain, const Correction& correction) {
  for (int i = 0; i < kMaxRefinements; ++i) {
    const MatrixXd change = correction(x, gain(x));
    x += change;
    if (change.norm() <= std::numeric_limits<double>::epsilon() * x.norm()) {
      break;
    }
  }
  return {gain(x), x};
}

}  // namespace

Regulator continuousRegulator(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost) {
  checkCost(a, b, cost);
  const Cholesky input = inverseOf(cost.input);
  const MatrixXd cross = crossOf(cost);
  if (a.rows() == 0) {
    return {MatrixXd(b.cols(), 0), MatrixXd(0, 0)};
  }
  const MatrixXd by_cross = input.solve(cross.transpose());
  const MatrixXd g = symmetric(b * input.solve(b.transpose()));
  const MatrixXd q = symmetric(cost.state - cross * by_cross);
  return refinedRegulator(
      doubled(transformed(a - b * by_cross, g, q)),
      [&](const MatrixXd& x) -> MatrixXd {
        return input.solve(b.transpose() * x + cross.transpose());
      },
      [&](const MatrixXd& x, const MatrixXd& gain) {
        const MatrixXd closed = a - b * gain;
        const MatrixXd by_closed = x * closed;
        return integrated(closed, by_closed + by_closed.transpose() + costOf(cost, cross, gain));
      });
}

Regulator discreteRegulator(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost) {
  checkCost(a, b, cost);
  const Cholesky input = inverseOf(cost.input);
  const MatrixXd cross = crossOf(cost);
  const MatrixXd by_cross = input.solve(cross.transpose());
  return refinedRegulator(
      doubled({a - b * by_cross, symmetric(b * input.solve(b.transpose())),
               symmetric(cost.state - cross * by_cross)}),
      [&](const MatrixXd& x) -> MatrixXd {
        return inverseOf(symmetric(cost.input + b.transpose() * x * b))
            .solve(b.transpose() * x * a + cross.transpose());
      },
      [&](const MatrixXd& x, const MatrixXd& gain) {
        const MatrixXd closed = a - b * gain;
        return summed(closed,
                      symmetric(closed.transpose() * x * closed) - x + costOf(cost, cross, gain));
      });
}

SampledPlant sampledPlant(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost,
                          double period) {
  checkCost(a, b, cost);
  if (!(period > 0.0) || !std::isfinite(period)) {
    throw InputError(fmt::format("sampled plant: expected a period [s] > 0, found {}", period));
  }
  const Index n = a.rows();
  const Index m = b.cols();
  // States and held inputs together, as one free motion.
  MatrixXd held = MatrixXd::Zero(n + m, n + m);
  held.topRows(n) << a, b;
  MatrixXd weight(n + m, n + m);
  const MatrixXd cross = crossOf(cost);
  weight << symmetric(cost.state), cross, cross.transpose(), symmetric(cost.input);
  const MatrixXd along = quadraticIntegral<Eigen::Dynamic>(held, weight, period);
  const MatrixXd e = exponentialLessIdentity<Eigen::Dynamic>(MatrixXd(period * held));
  return {MatrixXd::Identity(n, n) + e.topLeftCorner(n, n),
          e.topRightCorner(n, m),
          {symmetric(along.topLeftCorner(n, n)), symmetric(along.bottomRightCorner(m, m)),
           along.topRightCorner(n, m)}};
}

Regulator sampledRegulator(const MatrixXd& a, const MatrixXd& b, const QuadraticCost& cost,
                           double period) {
  const SampledPlant plant = sampledPlant(a, b, cost, period);
  return discreteRegulator(plant.a, plant.b, plant.cost);
}

Estimator continuousEstimator(const MatrixXd& a, const MatrixXd& c, const MatrixXd& process,
                              const MatrixXd& measurement) {
  const Regulator dual = continuousRegulator(a.transpose(), c.transpose(), {process, measurement});
  return {dual.gain.transpose(), dual.cost};
}

Estimator discreteEstimator(const MatrixXd& a, const MatrixXd& c, const MatrixXd& process,
                            const MatrixXd& measurement) {
  const MatrixXd before =
      discreteRegulator(a.transpose(), c.transpose(), {process, measurement}).cost;
  const Cholesky innovation(c * before * c.transpose() + measurement);
  return {innovation.solve(c * before).transpose(), before};
}

}  // namespace whirl_twin
