#include "analysis/whirl_modes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/dense.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/flexibility_form.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/stability_margins.h"
#include "analysis/unstable_root_bound.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double kRepeatedWhirl = 1.0e-7;   // of an eigenvalue: nearer ones are one
constexpr double kStandsStill = 1.0e-6;     // of the widest orbit
constexpr double kZero = 1.0e-13;           // of the largest eigenvalue: rounding
constexpr double kWhirlRounding = 1.0e-12;  // of the largest: a real part that may be rounding

/// Eigenvalues and the upper half, the displacement, of the eigenvectors.
struct RotorEigenPairs {
  VectorXcd values;
  MatrixXcd shapes;
  double inverse_error = 0.0;  ///< [s], of 1/s: of those of the flexibility form; else 0

  /// Of s [1/s], a part of which `rounding` is of the largest or, of the flexibility form, of s.
  double doubt(const Complex& s, double rounding, double largest) const {
    return inverse_error > 0.0 ? std::max(rounding * std::abs(s),
                                          std::min(inverse_error * std::norm(s), std::abs(s)))
                               : rounding * largest;
  }
};

/// Of the state matrix: of a rotor with rigid-body motions, or on springs that push.
RotorEigenPairs stateEigenPairs(const Linearization& l) {
  const Index n = l.mass.rows();
  const Lu mass(l.mass);
  const MatrixXd by_q = mass.solve(l.stiffness + l.circulatory);
  // Rates in units of the highest frequency, a power of two: balanced and free of rounding.
  const double stiffest = std::sqrt(by_q.cwiseAbs().maxCoeff());
  const double scale = stiffest > 0.0 ? std::exp2(std::round(std::log2(stiffest))) : 1.0;
  MatrixXd a = MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).diagonal().setConstant(scale);
  a.bottomLeftCorner(n, n) = -by_q / scale;
  a.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  const EigenPairs solver = eigenPairs(a);
  if (!solver.succeeded) {
    throw RunFailure("the eigenvalues of the rotor cannot be computed");
  }
  return {solver.values, solver.vectors.topRows(n)};
}

/// The `count` smallest are zero but for rounding, which of a drift is the root of it.
void setToZero(std::size_t count, VectorXcd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(values[a]) < std::abs(values[b]); });
  order.resize(std::min(count, order.size()));
  for (const Index i : order) {
    values[i] = 0.0;
  }
}

RotorEigenPairs rotorEigenPairs(const Linearization& l) {
  const CyclicCoordinates rigid = rigidBodyMotions(l);
  if (!rigid.any()) {
    if (const auto found = flexibilityPairs(l)) {
      return {found->values, found->shapes, found->error};
    }
  }
  RotorEigenPairs pairs = stateEigenPairs(l);
  if (rigid.any()) {
    setToZero(zeroEigenvalues(l, rigid), pairs.values);
  }
  return pairs;
}

/// -Re s [1/s] of a whirl without circulatory forces, from what its damping takes out of it:
/// s^2 m + s (c + i g) + k = 0 times conj(s). Zero without damping, and where the rounding of the
/// shape is all that damping meets.
double decayOf(const Linearization& l, const Complex& s, const VectorXcd& shape) {
  const auto form = [&](const MatrixXd& m) { return shape.dot(m.cast<Complex>() * shape).real(); };
  const double squared = std::norm(s);
  const double decay =
      form(l.damping) * squared / (form(l.mass) * squared + std::max(0.0, form(l.stiffness)));
  return decay > kNoDamping * std::abs(s) ? decay : 0.0;
}

void separateRepeated(std::vector<WhirlMode>& modes, const std::vector<Station>& stations) {
  for (std::size_t first = 0; first < modes.size();) {
    std::size_t end = first + 1;
    while (end < modes.size() && std::abs(modes[end].eigenvalue - modes[end - 1].eigenvalue) <=
                                     kRepeatedWhirl * std::abs(modes[end].eigenvalue)) {
      ++end;
    }
    if (end - first > 1) {
      MatrixXcd shapes(modes[first].shape.size(), static_cast<Index>(end - first));
      for (std::size_t i = first; i < end; ++i) {
        shapes.col(static_cast<Index>(i - first)) = modes[i].shape;
      }
      shapes = separatedByDirection(shapes, stations);
      for (std::size_t i = first; i < end; ++i) {
        modes[i].shape = shapes.col(static_cast<Index>(end - 1 - i));  // backward first
      }
    }
    first = end;
  }
}

/// Sorts the modes, separates coincident shapes and normalises them.
void finish(WhirlModes& all, const std::vector<Station>& stations) {
  std::sort(all.modes.begin(), all.modes.end(), [](const WhirlMode& a, const WhirlMode& b) {
    return a.eigenvalue.imag() < b.eigenvalue.imag();
  });
  std::sort(all.real_roots.begin(), all.real_roots.end());
  separateRepeated(all.modes, stations);
  for (WhirlMode& mode : all.modes) {
    normalise(mode, stations);
  }
}

}  // namespace

std::optional<WhirlModes> lowestWhirlModes(const BandedLinearization& at_speed,
                                           const std::vector<Station>& stations,
                                           std::size_t count) {
  const auto found = lowestRoots(pencilOf(at_speed), 2 * count);
  if (!found) {
    return std::nullopt;
  }
  const bool cannot_grow = unstableRootBound(at_speed) == 0.0;
  WhirlModes all;
  for (const RefinedEigenpair& root : found->roots) {
    const Complex s = root.value;
    if (std::fabs(s.imag()) <= kZero * std::abs(s)) {
      all.real_roots.push_back(s.real());
    } else if (s.imag() > 0.0) {
      WhirlMode mode;
      mode.eigenvalue = s;
      mode.shape = root.shape;
      if (cannot_grow && std::fabs(s.real()) <= kDoubtfulRealPart * std::abs(s)) {
        const double decay = decayByEnergy(at_speed, root);
        mode.eigenvalue = {decay > kNoDamping * std::abs(s) ? -decay : 0.0, s.imag()};
      }
      all.modes.push_back(mode);
    }
  }
  finish(all, stations);
  return all;
}

bool isWhirl(const WhirlMode& mode) {
  return mode.dampingRatio() <= kMaxWhirlDamping && mode.dampingRatio() > -kMaxWhirlGrowth;
}

double WhirlMode::logDecrement() const {
  return whirl_twin::logDecrement(dampingRatio());
}

void normalise(WhirlMode& mode, const std::vector<Station>& stations) {
  mode.orbits = orbitsOf(mode.shape, stations);
  const auto widest =
      std::max_element(mode.orbits.begin(), mode.orbits.end(),
                       [](const Orbit& a, const Orbit& b) { return a.major() < b.major(); });
  Complex factor = 1.0 / mode.shape.norm();
  if (widest != mode.orbits.end() && widest->major() > 0.0) {
    // At the instant t = 0 f and b point the same way.
    const double turn = widest->backward == 0.0 ? -std::arg(widest->forward)
                        : widest->forward == 0.0
                            ? std::arg(widest->backward)
                            : 0.5 * (std::arg(widest->backward) - std::arg(widest->forward));
    factor = std::polar(1.0 / widest->major(), turn);
  }
  mode.shape *= factor;
  mode.orbits = orbitsOf(mode.shape, stations);
  mode.whirl = whirlOf(mode.orbits);
}

std::vector<Orbit> orbitsOf(const VectorXcd& shape, const std::vector<Station>& stations) {
  std::vector<Orbit> orbits;
  orbits.reserve(stations.size());
  for (const Station& station : stations) {
    orbits.emplace_back(station.along_x.cast<Complex>().dot(shape),
                        station.along_y.cast<Complex>().dot(shape));
  }
  return orbits;
}

Whirl whirlOf(const std::vector<Orbit>& orbits) {
  double widest = 0.0;
  for (const Orbit& orbit : orbits) {
    widest = std::max(widest, orbit.major());
  }
  bool forward = false;
  bool backward = false;
  for (const Orbit& orbit : orbits) {
    if (orbit.major() > kStandsStill * widest) {
      forward = forward || orbit.direction() == Whirl::kForward;
      backward = backward || orbit.direction() == Whirl::kBackward;
    }
  }
  return forward && backward ? Whirl::kMixed
         : forward           ? Whirl::kForward
         : backward          ? Whirl::kBackward
                             : Whirl::kStraight;
}

MatrixXcd separatedByDirection(const MatrixXcd& shapes, const std::vector<Station>& stations) {
  const Index count = shapes.cols();
  // sum |f|^2 - |b|^2 over the stations, on vectors of one size over the whole rotor.
  const MatrixXcd basis = orthonormalBasis(shapes);
  MatrixXcd excess = MatrixXcd::Zero(count, count);
  for (const Station& station : stations) {
    const Eigen::RowVectorXcd x = station.along_x.transpose().cast<Complex>() * basis;
    const Eigen::RowVectorXcd y = station.along_y.transpose().cast<Complex>() * basis;
    const Eigen::RowVectorXcd forward = 0.5 * (x + Complex(0.0, 1.0) * y);
    const Eigen::RowVectorXcd backward = 0.5 * (x - Complex(0.0, 1.0) * y);
    excess += forward.adjoint() * forward - backward.adjoint() * backward;
  }
  const auto solver = hermitianModes(excess);
  return (basis * solver.vectors).rowwise().reverse();
}

WhirlModes whirlModes(const Linearization& at_speed, const std::vector<Station>& stations) {
  const RotorEigenPairs pairs = rotorEigenPairs(at_speed);
  const double largest = pairs.values.cwiseAbs().maxCoeff();
  const bool undamped = at_speed.damping.isZero(0.0);
  const bool bounded = cannotGrow(at_speed);
  WhirlModes all;
  for (Index i = 0; i < pairs.values.size(); ++i) {
    const Complex s = pairs.values[i];
    const double zero = pairs.doubt(s, kZero, largest);
    if (s.imag() > zero) {
      WhirlMode mode;
      mode.eigenvalue = s;
      mode.shape = pairs.shapes.col(i);
      if (bounded && (undamped || std::fabs(s.real()) <= pairs.doubt(s, kWhirlRounding, largest))) {
        mode.eigenvalue = {-decayOf(at_speed, s, mode.shape), s.imag()};
      }
      all.modes.push_back(mode);
    } else if (std::fabs(s.imag()) <= zero) {
      all.real_roots.push_back(s.real());
    }
  }
  finish(all, stations);
  return all;
}

WhirlModes whirlModes(const LinearRotor& rotor, const std::vector<Station>& stations,
                      double speed) {
  return whirlModes(rotor.matrices(speed), stations);
}

}  // namespace whirl_twin
