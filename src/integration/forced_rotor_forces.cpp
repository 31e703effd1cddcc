// Of a step with local forces (forced_rotor_step.h): Newton's method for the forces that are those
// of the places which they lead to.
#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "integration/forced_rotor_step.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxNewtonSteps = 50;
constexpr double kMinShare = 1.0e-3;
constexpr double kSame = 1.0e-13;   // of what forces are differences of
constexpr double kWell = 0.05;      // of what was left before
constexpr double kNearly = 1.0e-9;  // enough where rounding leaves no more
constexpr double kLastRoom = 0.1;   // a pole's pull, or a film's, grows without bound there

}  // namespace

/// The laws' forces at places; false where one has none.
bool ForcedRotorStep::pushes(const VectorXd& at, VectorXd& out) noexcept {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const double* place = at.data() + 4 * i;
    LocalState& state = states_[i];
    state.place = {place[0], place[1]};
    state.rate = {place[2], place[3]};
    NodalForce push;
    if (!forces_[i % forces_.size()].law->push(state, push)) {
      return false;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto row = static_cast<Index>(2 * i + axis);
      out[row] = push.force[axis];
      sizes_[row] = push.size;
    }
  }
  return true;
}

/// Slopes of the laws at the places of moved_, and the Jacobian of residual_ in its factors.
void ForcedRotorStep::linearize(const MatrixXd& response) noexcept {
  const Index n = unknowns();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    const Index place = 2 * row;
    const LocalSlopes slopes = forces_[i % forces_.size()].law->slopes(states_[i]);
    for (Index axis = 0; axis < 2; ++axis) {
      slopes_.row(row + axis) << -slopes.stiffness(axis, 0), -slopes.stiffness(axis, 1),
          -slopes.damping(axis, 0), -slopes.damping(axis, 1);
      rounding_[row + axis] = 0.0;
      for (Index j = 0; j < 4; ++j) {
        rounding_[row + axis] += std::fabs(slopes_(row + axis, j) * moved_[place + j]);
      }
    }
    for (Index column = 0; column < n; ++column) {
      for (Index axis = 0; axis < 2; ++axis) {
        double sum = 0.0;
        for (Index j = 0; j < 4; ++j) {
          sum += slopes_(row + axis, j) * response(place + j, column);
        }
        jacobian_(row + axis, column) = sum;
      }
    }
  }
  jacobian_.diagonal().array() -= 1.0;
  factor();
}

/// By Gauss' elimination with pivots, in place: factors below the diagonal, pivots inverted on it.
void ForcedRotorStep::factor() noexcept {
  const Index n = unknowns();
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i) {
      pivot = std::fabs(jacobian_(i, k)) > std::fabs(jacobian_(pivot, k)) ? i : pivot;
    }
    pivots_[static_cast<std::size_t>(k)] = pivot;
    if (pivot != k) {
      for (Index j = 0; j < n; ++j) {
        std::swap(jacobian_(k, j), jacobian_(pivot, j));
      }
    }
    jacobian_(k, k) = 1.0 / jacobian_(k, k);
    for (Index i = k + 1; i < n; ++i) {
      jacobian_(i, k) *= jacobian_(k, k);
    }
    for (Index j = k + 1; j < n; ++j) {
      const double above = jacobian_(k, j);
      for (Index i = k + 1; i < n; ++i) {
        jacobian_(i, j) -= jacobian_(i, k) * above;
      }
    }
  }
}

/// change_ = jacobian_^-1 change_.
void ForcedRotorStep::substitute() noexcept {
  const Index n = unknowns();
  for (Index k = 0; k < n; ++k) {
    std::swap(change_[k], change_[pivots_[static_cast<std::size_t>(k)]]);
  }
  for (Index k = 0; k < n; ++k) {
    for (Index i = k + 1; i < n; ++i) {
      change_[i] -= jacobian_(i, k) * change_[k];
    }
  }
  for (Index k = n; k-- > 0;) {
    change_[k] *= jacobian_(k, k);
    for (Index i = 0; i < k; ++i) {
      change_[i] -= jacobian_(i, k) * change_[k];
    }
  }
}

/// The largest part of residual_ in its size.
double ForcedRotorStep::relativeResidual() const noexcept {
  double largest = 0.0;
  for (Index i = 0; i < unknowns(); ++i) {
    const double off = std::fabs(residual_[i]);
    if (!(off <= std::numeric_limits<double>::max())) {
      return kInfinity;
    }
    largest = off > 0.0 ? std::max(largest, off / (sizes_[i] + rounding_[i])) : largest;
  }
  return largest;
}

/// forced_ as given; computes the resulting motion and the forces there. False: outside the
/// clearance.
bool ForcedRotorStep::look(const MatrixXd& response) noexcept {
  residual_ = forced_ - given_;
  moved_ = places_;
  moved_.noalias() += response * residual_;
  if (!pushes(moved_, law_)) {
    return false;
  }
  residual_ = law_ - forced_;
  return true;
}

/// The forces forced_ that are those of the places that they lead to, places_ + response * (forced_
/// - given_), from forced_ on.
StepStatus ForcedRotorStep::solve(const MatrixXd& response) noexcept {
  StepStatus status = newton(response);
  if (status != StepStatus::kOk) {
    // From the other side: where the rotor goes without them.
    forced_.setZero();
    status = newton(response);
  }
  return status == StepStatus::kNotConverged && nearlyTouches() ? StepStatus::kNoGap : status;
}

/// With the factors of the last linearization as long as they lead on well.
StepStatus ForcedRotorStep::newton(const MatrixXd& response) noexcept {
  if (!look(response)) {
    return StepStatus::kNoGap;
  }
  bool fresh = false;
  double before = kInfinity;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const double off = relativeResidual();
    if (off <= kSame || (fresh && off <= kNearly && off >= 0.5 * before)) {
      return StepStatus::kOk;
    }
    fresh = !(off <= kWell * before);
    if (fresh) {
      linearize(response);
    }
    before = off;
    const double size = residual_.norm();
    change_ = -residual_;
    substitute();
    start_ = forced_;
    // The first share of it that leads nearer, else that which leads nearest: at a kink the way
    // down may lead up first.
    double best = 0.0;
    double least = kInfinity;
    double share = 1.0;
    for (; least >= size && share >= (fresh ? kMinShare : 1.0); share *= 0.5) {
      forced_ = start_ + share * change_;
      if (look(response) && residual_.norm() < least) {
        least = residual_.norm();
        best = share;
      }
    }
    if (best == 2.0 * share) {
      continue;
    }
    if (best == 0.0 && fresh) {
      return StepStatus::kNoGap;
    }
    forced_ = start_ + best * change_;
    look(response);
  }
  return StepStatus::kNotConverged;
}

bool ForcedRotorStep::nearlyTouches() const noexcept {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const NodalForceLaw& law = *forces_[i % forces_.size()].law;
    const auto place = static_cast<Index>(4 * i);
    if (law.room({moved_[place], moved_[place + 1]}) <
        kLastRoom * law.room(Eigen::Vector2d::Zero())) {
      return true;
    }
  }
  return false;
}

/// After begin(), with places_ and given_ of the step: the forces, extrapolated from their
/// linearization at the start of the step. The extrapolation is bounded for any stiffness.
void ForcedRotorStep::predict(const MatrixXd& response) noexcept {
  linearize(response);
  residual_ = forced_ - given_;
  moved_ -= places_;
  moved_.noalias() -= response * residual_;
  for (Index i = 0; i < unknowns(); ++i) {
    const Index place = i / 2 * 4;
    change_[i] = 0.0;
    for (Index j = 0; j < 4; ++j) {
      change_[i] += slopes_(i, j) * moved_[place + j];
    }
  }
  substitute();
  forced_ += change_;
}

}  // namespace whirl_twin
