#include "analysis/floquet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/natural_modes.h"
#include "analysis/stability_margins.h"
#include "integration/dormand_prince_8.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStepAngle = 0.15;  // [rad] of the fastest small motion, in a first step
constexpr int kMinSteps = 32;        // of a period
constexpr int kMaxSteps = 1 << 17;
constexpr int kMaxShots = 12;
constexpr double kClosed = 1.0e-11;      // of the motion: what it may be off or miss by
constexpr double kAgree = 1.0e-11;       // of the largest multiplier, as steps are doubled
constexpr double kFar = 1.0e6;           // units: no motion of interest is that wide
constexpr int kMaxRepeats = 64;          // of the slowest load in a common period
constexpr double kCommensurate = 1e-12;  // of a ratio of frequencies
constexpr double kMinTolerance = 1.0e-10;
constexpr std::array<double, 3> kTimes{0.0, 0.7310585786, 12.98254};  // [s], in no simple ratio

/// A state and the deviations from it: columns (state, transition matrix). [2 n x (1 + 2 n)]
MatrixXd slopeOf(const Dynamics& dynamics, const MatrixXd& x, double time, double speed) {
  const Index n = x.rows() / 2;
  const VectorXd q = x.col(0).head(n);
  const VectorXd v = x.col(0).tail(n);
  const EvaluationPoint<double> at{time, speed * time, speed, 0.0};
  const VectorXd a = dynamics.acceleration(q, v, at);
  const Linearization l = dynamics.linearization(q, v, a, at);
  const auto deviations = x.rightCols(2 * n);
  MatrixXd slope(x.rows(), x.cols());
  slope.topRows(n) = x.bottomRows(n);
  slope.col(0).tail(n) = a;
  const MatrixXd pull = -(l.stiffness + l.circulatory) * deviations.topRows(n) -
                        (l.damping + l.gyroscopic) * deviations.bottomRows(n);
  slope.bottomRightCorner(n, 2 * n) =
      n == 1 ? MatrixXd(pull / l.mass(0, 0)) : MatrixXd(Lu(l.mass).solve(pull));
  return slope;
}

/// The state after a period, and the transition matrix.
MatrixXd afterPeriod(const Dynamics& dynamics, const VectorXd& start, double speed, double period,
                     int steps) {
  using dormand_prince::kA;
  using dormand_prince::kNodes;
  using dormand_prince::kStages;
  using dormand_prince::kWeights;
  const Index size = start.size();
  MatrixXd x(size, 1 + size);
  x << start, MatrixXd::Identity(size, size);
  const double h = period / steps;
  std::array<MatrixXd, kStages> slopes;
  for (int i = 0; i < steps && x.allFinite(); ++i) {
    for (std::size_t k = 0; k < kStages; ++k) {
      MatrixXd stage = x;
      for (std::size_t j = 0; j < k; ++j) {
        if (kA[k][j] != 0.0) {
          stage += (h * kA[k][j]) * slopes[j];
        }
      }
      slopes[k] = slopeOf(dynamics, stage, (i + kNodes[k]) * h, speed);
    }
    for (std::size_t k = 0; k < kStages; ++k) {
      if (kWeights[k] != 0.0) {
        x += (h * kWeights[k]) * slopes[k];
      }
    }
  }
  return x;
}

/// As many as resolve the fastest small motion along the way.
int firstSteps(const Dynamics& dynamics, const SteadyMotion& start, double speed, double period) {
  double fastest = 0.0;
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    const EvaluationPoint<double> at{part * period, speed * part * period, speed, 0.0};
    const VectorXd a = dynamics.acceleration(start.q, start.v, at);
    for (const Complex& root : eigenvalues(dynamics.linearization(start.q, start.v, a, at))) {
      fastest = std::max(fastest, std::abs(root));
    }
  }
  const double steps = std::ceil(period * fastest / kStepAngle);
  return steps < kMaxSteps ? std::max(kMinSteps, static_cast<int>(steps)) : kMaxSteps;
}

/// From x on to where a period leads back to it; the transition matrix there, in `unit`s. Nothing
/// where Newton's method does not converge.
std::optional<MatrixXd> shoot(const Dynamics& dynamics, const VectorXd& unit, double speed,
                              double period, int steps, VectorXd& x) {
  const Index size = x.size();
  for (int shot = 0; shot <= kMaxShots; ++shot) {
    const MatrixXd after = afterPeriod(dynamics, x, speed, period, steps);
    const VectorXd missed = (after.col(0) - x).cwiseQuotient(unit);
    const MatrixXd transition =
        unit.cwiseInverse().asDiagonal() * after.rightCols(size) * unit.asDiagonal();
    if (!(missed.norm() < kFar) || !transition.allFinite()) {
      return std::nullopt;
    }
    // An unstable motion misses itself by magnified rounding, and next to a multiplier of 1 a
    // rounding of what it misses is much of the motion.
    const MatrixXd slope = transition - MatrixXd::Identity(size, size);
    const VectorXd off = Lu(slope).solve(missed);
    const double allowed = kClosed * (1.0 + x.cwiseQuotient(unit).norm());
    if (missed.norm() <= allowed || off.norm() <= allowed) {
      return transition;
    }
    x -= unit.cwiseProduct(off);
  }
  return std::nullopt;
}

std::vector<Complex> multipliersOf(const MatrixXd& transition) {
  const Eigen::VectorXcd roots = eigenPairs(transition).values;
  std::vector<Complex> all(roots.data(), roots.data() + roots.size());
  std::sort(all.begin(), all.end(), [](const Complex& a, const Complex& b) {
    const double of_a = std::abs(a);
    const double of_b = std::abs(b);
    return of_a != of_b ? of_a > of_b : a.imag() > b.imag();
  });
  return all;
}

/// A common period [s] of these frequencies [rad/s].
std::optional<double> commonPeriod(const std::vector<double>& frequencies) {
  if (frequencies.empty()) {
    return std::nullopt;
  }
  const double slowest = *std::min_element(frequencies.begin(), frequencies.end());
  for (int repeats = 1; repeats <= kMaxRepeats; ++repeats) {
    if (std::all_of(frequencies.begin(), frequencies.end(), [&](double frequency) {
          const double turns = repeats * frequency / slowest;
          return std::fabs(turns - std::round(turns)) <= kCommensurate * turns;
        })) {
      return repeats * kTwoPi / slowest;
    }
  }
  return std::nullopt;
}

/// Do the equations change from one moment to another, at some place?
bool differ(const Dynamics& dynamics, const EvaluationPoint<double>& one,
            const EvaluationPoint<double>& other) {
  const Index n = dynamics.dof();
  const VectorXd q = VectorXd::LinSpaced(n, 0.7, 1.3) * dynamics.naturalLength();
  const VectorXd v = VectorXd::LinSpaced(n, 0.9, -1.7);
  if (!dynamics.linear()) {
    return dynamics.residualForce(q, v, one) != dynamics.residualForce(q, v, other);
  }
  const VectorXd rest = VectorXd::Zero(n);
  const Linearization a = dynamics.linearization(q, v, rest, one);
  const Linearization b = dynamics.linearization(q, v, rest, other);
  return a.mass != b.mass || a.damping != b.damping || a.gyroscopic != b.gyroscopic ||
         a.stiffness != b.stiffness || a.circulatory != b.circulatory;
}

/// The nearest to the unit circle that counts as off it.
double toleranceOf(const PeriodicMotion& motion) {
  return std::max(kMinTolerance, 10.0 * motion.error);
}

}  // namespace

TimeDependence timeDependence(const Dynamics& dynamics, double speed) {
  TimeDependence found;
  if (dynamics.dof() > kMaxPeriodicCoordinates) {
    found.varies = !dynamics.linear() && &dynamics.atMeanLoad() != &dynamics;
    return found;
  }
  const double turning = dynamics.hasShaft() ? speed : 0.0;
  const auto differs = [&](bool with_time, bool with_angle) {
    return std::any_of(kTimes.begin() + 1, kTimes.end(), [&](double time) {
      return differ(dynamics, {0.0, 0.0, turning, 0.0},
                    {with_time ? time : 0.0, with_angle ? time : 0.0, turning, 0.0});
    });
  };
  const bool with_time = differs(true, false);
  const bool with_angle = turning != 0.0 && differs(false, true);
  found.varies = with_time || with_angle;
  const bool whirls = dynamics.isRotor() && !dynamics.linear() && !with_time;
  if (!found.varies || whirls || (!dynamics.linear() && cyclicCoordinates(dynamics, speed).any())) {
    return found;
  }
  std::vector<double> frequencies = with_time ? dynamics.loadFrequencies() : std::vector<double>();
  if (with_time && frequencies.empty()) {
    return found;
  }
  if (with_angle) {
    frequencies.push_back(std::fabs(turning));
  }
  found.period = commonPeriod(frequencies);
  return found;
}

std::optional<PeriodicMotion> periodicMotionNear(const Dynamics& dynamics, double speed,
                                                 double period, const SteadyMotion& start) {
  const Index n = dynamics.dof();
  VectorXd unit(2 * n);
  unit << naturalUnits(dynamics), naturalUnits(dynamics) * (kTwoPi / period);
  VectorXd x(2 * n);
  x << start.q, start.v;
  int steps = firstSteps(dynamics, start, speed, period);
  std::optional<MatrixXd> coarse = shoot(dynamics, unit, speed, period, steps, x);
  while (coarse && 2 * steps <= kMaxSteps) {
    steps *= 2;
    const std::optional<MatrixXd> fine = shoot(dynamics, unit, speed, period, steps, x);
    if (!fine) {
      break;
    }
    const double error = (*fine - *coarse).norm();
    if (error <= kAgree * fine->norm() || 2 * steps > kMaxSteps) {
      return PeriodicMotion{period, x.head(n), x.tail(n), multipliersOf(*fine), error};
    }
    coarse = fine;
  }
  return std::nullopt;
}

std::vector<Complex> exponentsOf(const PeriodicMotion& motion,
                                 const std::vector<Complex>& mean_roots) {
  const double turn = kTwoPi / motion.period;
  std::vector<Complex> all;
  for (const Complex& multiplier : motion.multipliers) {
    const Complex principal = std::log(multiplier) / motion.period;
    double frequency = principal.imag();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Complex& root : mean_roots) {
      const double there =
          principal.imag() + turn * std::round((root.imag() - principal.imag()) / turn);
      if (std::fabs(there - root.imag()) < nearest) {
        nearest = std::fabs(there - root.imag());
        frequency = there;
      }
    }
    // Of a real one either sign is right.
    all.emplace_back(principal.real(), multiplier.imag() == 0.0 ? std::fabs(frequency) : frequency);
  }
  return all;
}

bool grows(const PeriodicMotion& motion) {
  return std::abs(motion.multipliers.front()) > 1.0 + toleranceOf(motion);
}

Stability stabilityOf(const PeriodicMotion& motion, const std::vector<Complex>& mean_roots) {
  const double tolerance = toleranceOf(motion);
  Stability s;
  double volume = 1.0;
  bool simple = true;
  for (std::size_t i = 0; i < motion.multipliers.size(); ++i) {
    const Complex& multiplier = motion.multipliers[i];
    const double off = std::abs(multiplier) - 1.0;
    ++(off > tolerance ? s.routh.right : off < -tolerance ? s.routh.left : s.routh.imaginary);
    volume *= std::abs(multiplier);
    for (std::size_t k = 0; k < i; ++k) {
      simple = simple && std::abs(multiplier - motion.multipliers[k]) > std::sqrt(tolerance);
    }
  }
  const bool conserves = std::fabs(volume - 1.0) <= tolerance && s.routh.left == s.routh.right;
  s.routh.verdict = s.routh.right > 0        ? Verdict::kUnstable
                    : s.routh.imaginary == 0 ? Verdict::kAsymptoticallyStable
                    : conserves && simple    ? Verdict::kMarginal
                                             : Verdict::kUncertain;
  s.right_by_eigenvalues = s.routh.right;
  s.eigenvalues = exponentsOf(motion, mean_roots);
  std::sort(s.eigenvalues.begin(), s.eigenvalues.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a.imag() < b.imag();
  });
  double growth = -std::numeric_limits<double>::infinity();
  s.damping_ratio = 1.0;
  for (const Complex& root : s.eigenvalues) {
    growth = std::max(growth, root.real());
    if (root != 0.0) {
      s.damping_ratio = std::min(s.damping_ratio, -root.real() / std::abs(root));
    }
    if (root.imag() > 0.0) {
      s.natural_frequencies.push_back(std::abs(root));
      s.damping_ratios.push_back(-root.real() / std::abs(root));
    }
  }
  s.decay_rate = s.routh.verdict == Verdict::kMarginal ? 0.0 : -growth;
  s.log_decrement = logDecrement(s.damping_ratio);
  return s;
}

}  // namespace whirl_twin
