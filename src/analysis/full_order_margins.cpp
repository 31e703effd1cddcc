#include "analysis/full_order_margins.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/cyclic_coordinates.h"
#include "analysis/equilibria.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/stability.h"
#include "analysis/stability_margins.h"
#include "mechanics/locally_forced_rotor.h"
#include "mechanics/spinning_rotor.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::VectorXd;

constexpr double kRigidEigenvalue = 1e-14;  // of the largest eigenvalue: a motion as a rigid body

LocalState stateAt(const LocalForce& force, const VectorXd& q, double speed) {
  LocalState at;
  at.place = {force.along_x.dot(q), force.along_y.dot(q)};
  at.speed = speed;
  return at;
}

/// About rest in q.
BandedLinearization linearizationAt(const FullOrderRotor& rotor, const VectorXd& q, double speed) {
  BandedLinearization l = rotor.assembly->bandedMatrices(speed);
  for (const LocalForce& force : rotor.forces) {
    const LocalSlopes s = force.law->slopes(stateAt(force, q, speed));
    const Eigen::Matrix2d& k = s.stiffness;
    const Eigen::Matrix2d& c = s.damping;
    Eigen::MatrixXd place(q.size(), 2);
    place << force.along_x, force.along_y;
    addBearing({k(0, 0), k(0, 1), k(1, 0), k(1, 1), c(0, 0), c(0, 1), c(1, 0), c(1, 1)}, place, l);
  }
  return l;
}

/// The equilibrium near q, else that at the end of the path from the line of its bearings; nothing
/// where its films do not carry the load.
std::optional<VectorXd> unreducedEquilibriumNear(const FullOrderRotor& rotor, const VectorXd& q,
                                                 double speed) {
  if (rotor.forces.empty()) {
    return q;
  }
  const BandedMatrix<double> linear = rotor.assembly->bandedMatrices(speed).byPlace();
  const auto pull = [&](const VectorXd& place) {
    VectorXd left = rotor.assembly->load() - linear.times(place).col(0);
    for (const LocalForce& force : rotor.forces) {
      NodalForce push;
      if (!force.law->push(stateAt(force, place, speed), push)) {
        push.force.fill(std::numeric_limits<double>::quiet_NaN());
      }
      left += push.force[0] * force.along_x + push.force[1] * force.along_y;
    }
    return left;
  };
  const auto step = [&](const VectorXd& place, const VectorXd& left) {
    const BandedLU<double> slope(linearizationAt(rotor, place, speed).byPlace());
    return VectorXd(slope.solve(left));
  };
  const auto room = [&](const VectorXd& place) {
    VectorXd all(static_cast<Eigen::Index>(rotor.forces.size()));
    for (std::size_t i = 0; i < rotor.forces.size(); ++i) {
      const LocalForce& force = rotor.forces[i];
      all[static_cast<Eigen::Index>(i)] =
          force.law->room({force.along_x.dot(place), force.along_y.dot(place)});
    }
    return all;
  };
  const RestProblem problem{pull, step, room};
  const auto rest = restWithinBounds(problem, q);
  return rest ? rest : restWithinBounds(problem, VectorXd::Zero(q.size()));
}

/// Of those with |s| up to `reach`, of the lowest at least, and of those that grow if there are.
RotorMargins marginsOf(const std::vector<Complex>& roots, double reach, bool grows) {
  RotorMargins margins;
  margins.grows = grows;
  double rightmost = -std::numeric_limits<double>::infinity();
  double ratio = std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Complex& s : roots) {
    largest = std::max(largest, std::abs(s));
    lowest = std::min(lowest, std::abs(s));
  }
  reach = std::max(reach, lowest);
  for (const Complex& s : roots) {
    if (std::abs(s) <= reach || (grows && s.real() > 0.0)) {
      rightmost = std::max(rightmost, s.real());
      if (std::abs(s) > kRigidEigenvalue * largest) {
        ratio = std::fmin(ratio, -s.real() / std::abs(s));
      }
    }
  }
  margins.decay_rate = -rightmost;
  margins.log_decrement = logDecrement(ratio);
  return margins;
}

RotorMargins marginsOf(const Linearization& l, double reach) {
  const Stability s = reducedStability(l, rigidBodyMotions(l), kAllModes);
  return marginsOf(s.eigenvalues, reach, s.routh.right > 0);
}

RotorMargins marginsOf(const BandedLinearization& l, double reach) {
  auto found = eigenvaluesWithin(l, reach);
  if (found && found->roots.empty()) {
    found = lowestEigenvalues(l, 1);
  }
  if (found && (found->omitted_are_sure || l.size() > kMaxCompleteCoordinates)) {
    const bool grows = std::any_of(found->roots.begin(), found->roots.end(),
                                   [](const Complex& s) { return s.real() > 0.0; });
    return marginsOf(found->roots, reach, grows);
  }
  return marginsOf(Linearization{l.mass.dense(), l.damping.dense(), l.gyroscopic.dense(),
                                 l.stiffness.dense(), l.circulatory.dense()},
                   reach);
}

}  // namespace

std::optional<FullOrderMargins> FullOrderMargins::of(std::shared_ptr<const Dynamics> dynamics) {
  const auto* const spinning = dynamic_cast<const SpinningRotor*>(dynamics.get());
  const Dynamics& held = spinning != nullptr ? spinning->held() : *dynamics;
  const bool rotor = held.isRotor() && held.hasShaft();
  if (!rotor || !(held.linear() || dynamic_cast<const LocallyForcedRotor*>(&held) != nullptr)) {
    return std::nullopt;
  }
  FullOrderMargins margins(std::move(dynamics), held);
  return margins.rotor_ ? std::optional<FullOrderMargins>(std::move(margins)) : std::nullopt;
}

FullOrderMargins::FullOrderMargins(std::shared_ptr<const Dynamics> dynamics, const Dynamics& held)
    : dynamics_(std::move(dynamics)), held_(&held) {
  const LinearRotor rotor = held.linearRotor();
  highest_speed_ = rotor.highest_speed;
  if (const auto* const assembled = rotor.matrices.target<AssembledMatrices>()) {
    rotor_ = assembled->unreduced;
  }
}

Eigen::Index FullOrderMargins::amplitudes() const {
  return rotor_->shapes.cols();
}

ReducedMargins FullOrderMargins::at(const VectorXd& q, double speed) const {
  const VectorXd amplitudes = q.head(this->amplitudes());
  const VectorXd zero = VectorXd::Zero(amplitudes.size());
  ReducedMargins margins;
  margins.reduced = marginsOf(linearizationAtRest(*held_, amplitudes, speed),
                              std::numeric_limits<double>::infinity());
  const auto rest = unreducedEquilibriumNear(*rotor_, rotor_->shapes * amplitudes, speed);
  if (!rest) {
    throw RunFailure(
        "the full-order rotor has no equilibrium in its oil films, although the reduced-order one "
        "has");
  }
  margins.unreduced =
      marginsOf(linearizationAt(*rotor_, *rest, speed), std::max(highest_speed_, std::fabs(speed)));
  return margins;
}

}  // namespace whirl_twin
