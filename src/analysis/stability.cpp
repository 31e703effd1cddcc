#include "analysis/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra/dense.h"
#include "analysis/balanced_matrix.h"
#include "analysis/characteristic_polynomial.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/natural_modes.h"
#include "analysis/quadratic_form.h"
#include "analysis/refined_eigenvalues.h"
#include "analysis/routh.h"
#include "analysis/stability_margins.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

/// Real parts below this fraction of the largest eigenvalue are indistinguishable from zero.
constexpr double kRootRounding = 1.0e-14;
constexpr Eigen::Index kMaxIterationsPerRoot = 400;  // a root
/// Rounding of a state matrix and of its eigenvalues, in parts of its norm for each row.
constexpr double kRoundingOfMatrix = 1.0e-13;

void modes(const std::vector<std::complex<double>>& roots, Stability& s) {
  struct Mode {
    double frequency, ratio;
  };
  std::vector<Mode> modes;
  std::vector<double> real;
  for (const auto& root : roots) {
    if (std::abs(root) <= kRootRounding * std::abs(roots.back())) {
      continue;  // a rigid-body motion
    }
    if (root.imag() > 0.0) {
      modes.push_back({std::abs(root), 0.0 - root.real() / std::abs(root)});
    } else if (root.imag() == 0.0) {
      real.push_back(root.real());
    }
  }
  // Overdamped modes: the fastest real root goes with the slowest.
  std::sort(real.begin(), real.end());
  for (std::size_t i = 0; 2 * i + 1 < real.size(); ++i) {
    const double fast = real[i];
    const double slow = real[real.size() - 1 - i];
    if (fast * slow > 0.0) {
      const double frequency = std::sqrt(fast * slow);
      modes.push_back({frequency, -0.5 * (fast + slow) / frequency});
    }
  }
  std::sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    return a.frequency < b.frequency || (a.frequency == b.frequency && a.ratio < b.ratio);
  });
  for (const Mode& mode : modes) {
    s.natural_frequencies.push_back(mode.frequency);
    s.damping_ratios.push_back(mode.ratio);
  }
}

/// Result from the exact polynomial.
struct ExactVerdict {
  std::vector<double> polynomial;
  RouthResult routh;
};

/// Throws ExactBudgetSpent.
ExactVerdict exactVerdict(const Linearization& l, std::size_t zeros) {
  ExactVerdict exact;
  ExactBudget budget(kMaxExactProducts);
  std::vector<Rational> polynomial = characteristicPolynomial(l);
  polynomial.resize(polynomial.size() - zeros);  // these last coefficients are exactly zero
  for (const Rational& c : polynomial) {
    exact.polynomial.push_back(toDouble(c));
  }
  exact.routh = routh(polynomial, budget);
  if (exact.routh.verdict == Verdict::kRepeatedImaginary) {
    std::vector<Rational> minimal = minimalPolynomial(l);
    minimal.resize(minimal.size() - (zeros > 0 ? 1 : 0));  // they are one simple root there
    if (routh(minimal, budget).verdict == Verdict::kMarginal) {
      exact.routh.verdict = Verdict::kMarginal;
    }
  }
  return exact;
}

/// Caches the last result: a system's equilibria, its operating point, its threshold and its
/// critical speeds are computed in turn, and each starts with the same matrices at rest.
void judgeExactly(const Linearization& l, std::size_t zeros, Stability& s) {
  struct Judged {
    Eigen::MatrixXd matrices;  // M, C, G, K, N side by side
    std::size_t zeros;
    ExactVerdict exact;
  };
  thread_local std::optional<Judged> last;
  const Eigen::Index n = l.mass.rows();
  Eigen::MatrixXd matrices(n, 5 * n);
  matrices << l.mass, l.damping, l.gyroscopic, l.stiffness, l.circulatory;
  if (!last || last->zeros != zeros || last->matrices.rows() != n || last->matrices != matrices) {
    last = Judged{std::move(matrices), zeros, exactVerdict(l, zeros)};
  }
  s.polynomial = last->exact.polynomial;
  s.routh = last->exact.routh;
}

struct StateMatrix {
  Eigen::MatrixXd matrix;
  double conditioning;  ///< of the mass, 1 / rcond: by which rounding grows
};

/// Without the zero of each of the last `zeros` coordinates.
StateMatrix stateMatrixWithoutZeros(const Linearization& l, std::size_t zeros) {
  const Eigen::Index n = l.mass.rows();
  const Eigen::Index places = n - static_cast<Eigen::Index>(zeros);  // that matter
  const Lu mass(l.mass);
  const Eigen::MatrixXd by_q = mass.solve(l.stiffness + l.circulatory);
  const Eigen::MatrixXd by_v = mass.solve(l.damping + l.gyroscopic);
  // Rates in units of the highest frequency, a power of two: balanced and free of rounding.
  const double stiffest = std::sqrt(by_q.cwiseAbs().maxCoeff());
  const double scale = stiffest > 0.0 ? std::exp2(std::round(std::log2(stiffest))) : 1.0;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(places + n, places + n);
  a.block(0, places, places, places).diagonal().setConstant(scale);
  a.bottomLeftCorner(n, places) = -by_q.leftCols(places) / scale;
  a.bottomRightCorner(n, n) = -by_v;
  return {std::move(a), 1.0 / mass.rcond()};
}

/// How near the axis is to the eigenvalues of a matrix: an upper bound of the smallest change of
/// the matrix that brings one of them onto it.
double distanceToAxis(const Eigen::MatrixXd& a,
                      const std::vector<std::complex<double>>& eigenvalues) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& root : eigenvalues) {
    Eigen::MatrixXcd shifted = a;
    shifted.diagonal().array() -= std::complex<double>(0.0, root.imag());
    nearest = std::fmin(nearest, singularValues(shifted).minCoeff());
  }
  return nearest;
}

bool positiveDefinite(const Eigen::MatrixXd& m) {
  const Cholesky llt(m);
  return llt.succeeded() && llt.lower().diagonal().cwiseAbs2().minCoeff() >
                                kRootRounding * m.diagonal().cwiseAbs().maxCoeff();
}

/// Without damping, a motion at a constant rate that nothing resists: the zero eigenvalue of a
/// rigid-body mode is defective unless gyroscopic forces hold it.
bool driftsFreely(const Linearization& l) {
  const Eigen::MatrixXd free = rigidBodyModes(l.stiffness);
  if (free.cols() == 0) {
    return false;
  }
  const Eigen::MatrixXd held = free.transpose() * l.gyroscopic * free;
  return PivotedQr(held).rank() < held.rows();
}

/// Nothing grows, by the definiteness of the matrices: what rounding put right of the axis is on
/// it.
void judgeByEnergy(const Linearization& l, std::size_t zeros, Stability& s) {
  s.routh.imaginary += s.routh.right;
  s.routh.right = 0;
  if (l.damping.isZero(0.0)) {
    s.routh.imaginary += s.routh.left;
    s.routh.left = 0;
    s.routh.verdict =
        zeros == 0 && driftsFreely(l) ? Verdict::kRepeatedImaginary : Verdict::kMarginal;
  } else if (s.routh.verdict == Verdict::kUnstable) {
    s.routh.verdict = Verdict::kUncertain;
  }
}

void judgeByDefiniteness(const Linearization& l, Stability& s) {
  const double small =
      kRootRounding * static_cast<double>(l.mass.rows()) * std::abs(s.eigenvalues.back());
  for (const auto& root : s.eigenvalues) {
    ++(root.real() > small    ? s.routh.right
       : root.real() < -small ? s.routh.left
                              : s.routh.imaginary);
  }
  s.routh.verdict = s.routh.right > 0       ? Verdict::kUnstable
                    : s.routh.imaginary > 0 ? Verdict::kUncertain
                                            : Verdict::kAsymptoticallyStable;
  if (!l.circulatory.isZero(0.0) || !positiveDefinite(l.stiffness)) {
    return;
  }
  const auto all = static_cast<int>(s.eigenvalues.size());
  if (positiveDefinite(l.damping)) {
    s.routh.verdict = Verdict::kAsymptoticallyStable;
    s.routh.right = s.routh.imaginary = 0;
    s.routh.left = all;
  }
}

/// Decay and damping by the eigenvalues; kUncertain where they are below their rounding.
void setMargins(Stability& s) {
  double rightmost = -std::numeric_limits<double>::infinity();
  double ratio = std::numeric_limits<double>::quiet_NaN();
  const double largest = std::abs(s.eigenvalues.back());
  for (const auto& root : s.eigenvalues) {
    rightmost = std::max(rightmost, root.real());
    if (std::abs(root) > kRootRounding * largest) {
      ratio = std::fmin(ratio, -root.real() / std::abs(root));
    }
  }
  const bool on_axis =
      s.routh.verdict == Verdict::kMarginal || s.routh.verdict == Verdict::kRepeatedImaginary;
  if (!on_axis && std::fabs(rightmost) < kRootRounding * largest) {
    s.routh.verdict = Verdict::kUncertain;
  }
  s.decay_rate = on_axis ? 0.0 : -rightmost;
  s.damping_ratio = on_axis && !std::isnan(ratio) ? 0.0 : ratio;
  s.log_decrement = logDecrement(s.damping_ratio);
}

/// By rising |s|, then Im.
void sortByModulus(std::vector<std::complex<double>>& roots) {
  std::sort(roots.begin(), roots.end(), [](const auto& x, const auto& y) {
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    return ax != ay ? ax < ay : x.imag() < y.imag();
  });
}

struct Solved {
  Eigen::MatrixXd matrix;
  double norm = 0.0;  ///< [1/s], of the balanced matrix
  std::vector<std::complex<double>> roots;
};

/// The last ones are kept: equilibria, operating point, verdict and searches begin with the same.
const Solved& solved(const Linearization& l, std::size_t zeros) {
  thread_local Solved last;
  Eigen::MatrixXd a = stateMatrixWithoutZeros(l, zeros).matrix;
  if (last.matrix.rows() == a.rows() && last.matrix == a) {
    return last;
  }
  // After balancing the low ones are up to three digits more accurate.
  const Eigen::MatrixXd even = balanced(a);
  // Overdamped motions together with slow ones need more iterations than Eigen's limit.
  const EigenPairs solver = eigenvalues(even, kMaxIterationsPerRoot * a.rows());
  if (!solver.succeeded) {
    throw RunFailure("the eigenvalues of the linearized system cannot be computed");
  }
  const Eigen::VectorXcd& values = solver.values;
  std::vector<std::complex<double>> roots(values.data(), values.data() + values.size());
  sortByModulus(roots);
  last = {std::move(a), even.norm(), std::move(roots)};
  return last;
}

/// eigenvalues(), with the digits that these lack.
std::vector<std::complex<double>> refinedEigenvalues(const Linearization& l, std::size_t zeros) {
  const Solved& of = solved(l, zeros);
  std::vector<std::complex<double>> roots = of.roots;
  refineEigenvalues(l, of.norm, roots);
  sortByModulus(roots);
  return roots;
}

/// Stability by the lowest eigenvalues, and by the proof for the others.
void judgeLowest(const LowestEigenvalues& lowest, Stability& s) {
  s.eigenvalues = lowest.roots;
  s.omitted = lowest.omitted;
  for (const auto& root : s.eigenvalues) {
    ++(root.real() > 0.0 ? s.routh.right : root.real() < 0.0 ? s.routh.left : s.routh.imaginary);
  }
  s.right_by_eigenvalues = s.routh.right;
  s.routh.verdict = s.routh.right > 0          ? Verdict::kUnstable
                    : !lowest.omitted_are_sure ? Verdict::kUncertain
                    : s.routh.imaginary == 0   ? Verdict::kAsymptoticallyStable
                    : lowest.undamped          ? Verdict::kMarginal
                                               : Verdict::kUncertain;
}

}  // namespace

bool cannotGrow(const Linearization& l) {
  return l.circulatory.isZero(0.0) &&
         definiteness(l.stiffness, "stiffness") != Definiteness::kIndefinite &&
         definiteness(l.damping, "damping") != Definiteness::kIndefinite;
}

int rightByEigenvalues(const Linearization& l, std::size_t zeros,
                       const std::vector<std::complex<double>>& eigenvalues, int by_routh) {
  const auto right = static_cast<int>(std::count_if(eigenvalues.begin(), eigenvalues.end(),
                                                    [](const auto& s) { return s.real() > 0.0; }));
  if (right == by_routh) {
    return right;
  }
  const auto [a, conditioning] = stateMatrixWithoutZeros(l, zeros);
  const double rounding =
      kRoundingOfMatrix * static_cast<double>(a.rows()) * a.norm() * conditioning;
  return distanceToAxis(a, eigenvalues) > rounding ? right : by_routh;
}

std::vector<std::complex<double>> eigenvalues(const Linearization& l) {
  return eigenvalues(l, 0);
}

std::vector<std::complex<double>> eigenvalues(const Linearization& l, std::size_t zeros) {
  return solved(l, zeros).roots;
}

Stability stability(const Linearization& linearization) {
  return stability(linearization, 0);
}

Stability stability(const Linearization& linearization, std::size_t zeros,
                    std::size_t reported_modes) {
  Stability s;
  if (linearization.mass.rows() > kMaxCompleteCoordinates && zeros == 0 &&
      reported_modes < static_cast<std::size_t>(linearization.mass.rows())) {
    if (const auto lowest = lowestEigenvalues(banded(linearization), reported_modes)) {
      judgeLowest(*lowest, s);
      modes(s.eigenvalues, s);
      setMargins(s);
      return s;
    }
  }
  s.eigenvalues = refinedEigenvalues(linearization, zeros);
  const bool bounded_energy = cannotGrow(linearization);
  if (bounded_energy && linearization.damping.isZero(0.0)) {
    for (std::complex<double>& root : s.eigenvalues) {
      root = {0.0, root.imag()};  // the rest is rounding
    }
  }
  modes(s.eigenvalues, s);
  bool judged = false;
  if (linearization.mass.rows() <= kMaxExactCoordinates) {
    try {
      judgeExactly(linearization, zeros, s);
      judged = true;
    } catch (const ExactBudgetSpent&) {
      s.routh = {};
    }
  }
  if (!judged) {
    judgeByDefiniteness(linearization, s);
  }
  if (bounded_energy && (!judged || s.routh.right > 0)) {
    judgeByEnergy(linearization, zeros, s);
  }

  s.right_by_eigenvalues =
      judged ? rightByEigenvalues(linearization, zeros, s.eigenvalues, s.routh.right)
             : s.routh.right;
  setMargins(s);
  return s;
}

}  // namespace whirl_twin
