#include "scene/closed_loop_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "algebra/dense.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/natural_modes.h"
#include "mechanics/held_inputs.h"
#include "scene/controlled_plant.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 100;
constexpr double kMaxStep = 0.5;      // units
constexpr double kThere = 1.0e-10;    // relative to the size of the unknown
constexpr double kBalanced = 1.0e-9;  // relative to the forces in an equation
/// Relative to the terms of an equation, each a slope times an unknown: bound of their rounding.
constexpr double kRounding = 1.0e-13;
constexpr double kRoundingOfUnits = 1.0e-15;  // likewise, for unknowns that are 0

/// A system, with one unknown for each coordinate: its value, or, if the equations do not depend on
/// that, its rate.
struct Part {
  std::size_t system;
  const Dynamics* dynamics;
  Index at;  // index of its first unknown
  VectorXd q, v;
  double speed;
  VectorXd unit;              // scale of each unknown
  std::vector<bool> by_rate;  // the unknown is a rate
};

Index outputsOf(const HoldingLaw& law) {
  return law.law.d.rows();
}

/// Coordinates whose values the control laws measure.
std::set<Index> placesMeasured(const std::vector<HoldingLaw>& laws, std::size_t system,
                               const Dynamics& dynamics) {
  std::set<Index> places;
  for (const HoldingLaw& law : laws) {
    for (const SignalSpec& signal : law.controller->measures) {
      const SignalRow row = rowOf(signal, dynamics);
      for (Index i = 0; signal.system == system && !row.of_rates && i < row.along.size(); ++i) {
        if (row.along[i] != 0.0) {
          places.insert(i);
        }
      }
    }
  }
  return places;
}

Part partOf(const std::vector<HoldingLaw>& laws, std::size_t system, const SystemMotion& motion,
            Index at) {
  const Dynamics& dynamics = *motion.dynamics;
  Part part{system,
            &dynamics,
            at,
            motion.q,
            VectorXd::Zero(motion.q.size()),
            motion.speed,
            naturalUnits(dynamics),
            std::vector<bool>(static_cast<std::size_t>(motion.q.size()))};
  if (dynamics.linear()) {
    part.q.setZero();
    return part;
  }
  const CyclicCoordinates cyclic = cyclicCoordinates(dynamics, motion.speed);
  const std::set<Index> places = placesMeasured(laws, system, dynamics);
  for (const auto* list : {&cyclic.conserved, &cyclic.driven}) {
    for (const Index i : *list) {
      if (places.count(i) == 0) {
        part.by_rate[static_cast<std::size_t>(i)] = true;
        part.v[i] = motion.v[i];
        part.unit[i] *= std::max(1.0, std::fabs(motion.v[i]));
      }
    }
  }
  return part;
}

class Balance {
 public:
  Balance(const std::vector<HoldingLaw>& laws, const SystemMotions& present) : laws_(laws) {
    std::set<std::size_t> systems;
    for (const HoldingLaw& law : laws) {
      for (const SignalSpec& signal : law.controller->measures) {
        systems.insert(signal.system);
      }
      for (const ActedInput& acted : law.controller->acts_on) {
        systems.insert(acted.system);
      }
    }
    for (const std::size_t system : systems) {
      parts_.push_back(partOf(laws, system, present(system), size_));
      size_ += parts_.back().q.size();
    }
    mechanical_ = size_;
    for (const HoldingLaw& law : laws) {
      size_ += law.law.states() + outputsOf(law);
    }
    by_laws_ = VectorXd::Zero(size_ - mechanical_);
    linearize();
  }

  /// One step of Newton's method; false if it is impossible.
  bool step() {
    if (!slope_.allFinite() || !left_.allFinite()) {
      return false;
    }
    // Scales the unknowns by their units, those of control laws by their effect; then the rows by
    // their largest term.
    VectorXd columns(size_);
    for (const Part& part : parts_) {
      columns.segment(part.at, part.unit.size()) = part.unit;
    }
    columns.tail(size_ - mechanical_).setOnes();
    MatrixXd scaled = slope_ * columns.asDiagonal();
    VectorXd rows = largest(scaled.leftCols(mechanical_).transpose());
    for (Index i = mechanical_; i < size_; ++i) {
      columns[i] = largest(rows.asDiagonal() * slope_.col(i))[0];
    }
    scaled = slope_ * columns.asDiagonal();
    rows = largest(scaled.transpose());
    const PivotedQr qr(rows.asDiagonal() * scaled);
    const VectorXd by = qr.solve(-rows.cwiseProduct(left_));
    if (!by.allFinite()) {
      return false;
    }
    double longest = 0.0;  // in units
    last_moved_ = 0.0;
    for (const Part& part : parts_) {
      const auto own = by.segment(part.at, part.unit.size()).cwiseAbs();
      longest = std::max(longest, part.dynamics->linear() ? 0.0 : own.maxCoeff());
      last_moved_ = std::max(last_moved_,
                             own.cwiseProduct(part.unit).cwiseQuotient(sizesOf(part)).maxCoeff());
    }
    move((std::min(1.0, kMaxStep / longest) * by).cwiseProduct(columns));
    linearize();
    return true;
  }

  /// Whether the last step was small and the residual of each equation is small relative to the
  /// forces in it, or to their rounding. (A small change of the coordinates is not sufficient:
  /// currents may still change, as magnetic forces depend on their squares.)
  bool isThere() const {
    if (last_moved_ > kThere) {
      return false;
    }
    VectorXd sizes(size_);
    VectorXd unknowns(size_);
    for (const Part& part : parts_) {
      sizes.segment(part.at, part.unit.size()) = sizesOf(part);
      unknowns.segment(part.at, part.unit.size()) = unknownsOf(part).cwiseAbs();
    }
    sizes.tail(size_ - mechanical_) = unknowns.tail(size_ - mechanical_) = by_laws_.cwiseAbs();
    const MatrixXd slopes = slope_.cwiseAbs();
    const VectorXd allowed = (kBalanced * forces_)
                                 .cwiseMax(kRounding * (slopes * unknowns))
                                 .cwiseMax(kRoundingOfUnits * (slopes * sizes));
    return (left_.cwiseAbs().array() <= allowed.array()).all();
  }

  Held held() const {
    Held held;
    for (const Part& part : parts_) {
      held.motions[part.system] = {part.dynamics, part.q, part.v, part.speed, inputsOf(part)};
    }
    Index at = 0;
    for (const HoldingLaw& law : laws_) {
      held.outputs.push_back(by_laws_.segment(at + law.law.states(), outputsOf(law)));
      at += law.law.states() + outputsOf(law);
    }
    return held;
  }

 private:
  /// 1 over the largest entry of each column; 1 for a zero column.
  static VectorXd largest(const MatrixXd& columns) {
    VectorXd scale(columns.cols());
    for (Index i = 0; i < columns.cols(); ++i) {
      const double most = columns.rows() > 0 ? columns.col(i).cwiseAbs().maxCoeff() : 0.0;
      scale[i] = most > 0.0 ? 1.0 / most : 1.0;
    }
    return scale;
  }

  static VectorXd unknownsOf(const Part& part) {
    VectorXd unknowns = part.q;
    for (Index i = 0; i < unknowns.size(); ++i) {
      if (part.by_rate[static_cast<std::size_t>(i)]) {
        unknowns[i] = part.v[i];
      }
    }
    return unknowns;
  }
  /// Magnitudes of the unknowns, at least one unit.
  static VectorXd sizesOf(const Part& part) {
    return part.unit.cwiseMax(unknownsOf(part).cwiseAbs());
  }

  VectorXd inputsOf(const Part& part) const {
    VectorXd inputs = VectorXd::Zero(static_cast<Index>(part.dynamics->inputs().size()));
    Index at = 0;
    for (const HoldingLaw& law : laws_) {
      at += law.law.states();
      for (const ActedInput& acted : law.controller->acts_on) {
        if (acted.system == part.system) {
          inputs[static_cast<Index>(acted.input)] += by_laws_[at];
        }
        ++at;
      }
    }
    return inputs;
  }

  const Part& partAt(std::size_t system) const {
    return *std::find_if(parts_.begin(), parts_.end(),
                         [&](const Part& part) { return part.system == system; });
  }

  /// The residual and its Jacobian.
  void linearize() {
    slope_ = MatrixXd::Zero(size_, size_);
    left_ = VectorXd::Zero(size_);
    forces_ = VectorXd::Zero(size_);
    for (const Part& part : parts_) {
      linearizeSystem(part);
    }
    Index at = mechanical_;
    for (const HoldingLaw& law : laws_) {
      linearizeLaw(law, at);
      at += law.law.states() + outputsOf(law);
    }
  }

  void linearizeSystem(const Part& part) {
    const Index n = part.q.size();
    const Dynamics& mean = part.dynamics->atMeanLoad();
    const EvaluationPoint<double> moment{0.0, 0.0, part.speed, 0.0};
    const HeldInputs held = heldInputs(*part.dynamics, part.q, inputsOf(part));
    const Linearization l = mean.linearization(part.q, part.v, VectorXd::Zero(n), moment);
    const VectorXd own = mean.residualForce(part.q, part.v, moment);
    left_.segment(part.at, n) = own + held.force;
    forces_.segment(part.at, n) = own.cwiseAbs() + held.force.cwiseAbs();
    const MatrixXd by_place = -(l.stiffness + l.circulatory + held.stiffness);
    const MatrixXd by_rate = -(l.damping + l.gyroscopic);
    for (Index i = 0; i < n; ++i) {
      slope_.block(part.at, part.at + i, n, 1) =
          part.by_rate[static_cast<std::size_t>(i)] ? by_rate.col(i) : by_place.col(i);
    }
    Index at = mechanical_;
    for (const HoldingLaw& law : laws_) {
      at += law.law.states();
      for (const ActedInput& acted : law.controller->acts_on) {
        if (acted.system == part.system) {
          slope_.block(part.at, at, n, 1) = held.by_input.col(static_cast<Index>(acted.input));
        }
        ++at;
      }
    }
  }

  /// x = a x + b (y - setpoint), u = c x + d (y - setpoint).
  void linearizeLaw(const HoldingLaw& law, Index at) {
    const DiscreteStateSpace& l = law.law;
    const Index states = l.states();
    const Index outputs = outputsOf(law);
    const auto measured = static_cast<Index>(law.controller->measures.size());
    VectorXd y(measured);
    MatrixXd by_unknowns = MatrixXd::Zero(measured, mechanical_);
    for (Index i = 0; i < measured; ++i) {
      const SignalSpec& signal = law.controller->measures[static_cast<std::size_t>(i)];
      const Part& part = partAt(signal.system);
      const SignalRow row = rowOf(signal, *part.dynamics);
      y[i] = row.along.dot(row.of_rates ? part.v : part.q) -
             (law.setpoint.empty() ? 0.0 : law.setpoint[static_cast<std::size_t>(i)]);
      for (Index k = 0; k < row.along.size(); ++k) {
        if (part.by_rate[static_cast<std::size_t>(k)] == row.of_rates) {
          by_unknowns(i, part.at + k) = row.along[k];
        }
      }
    }
    const Index own = at - mechanical_;
    const VectorXd x = by_laws_.segment(own, states);
    left_.segment(at, states) = l.a * x - x + l.b * y;
    left_.segment(at + states, outputs) =
        l.c * x + l.d * y - by_laws_.segment(own + states, outputs);
    slope_.block(at, 0, states, mechanical_) = l.b * by_unknowns;
    slope_.block(at, at, states, states) = l.a - MatrixXd::Identity(states, states);
    slope_.block(at + states, 0, outputs, mechanical_) = l.d * by_unknowns;
    slope_.block(at + states, at, outputs, states) = l.c;
    slope_.block(at + states, at + states, outputs, outputs).diagonal().setConstant(-1.0);
  }

  void move(const VectorXd& by) {
    for (Part& part : parts_) {
      for (Index i = 0; i < part.q.size(); ++i) {
        (part.by_rate[static_cast<std::size_t>(i)] ? part.v : part.q)[i] += by[part.at + i];
      }
    }
    by_laws_ += by.tail(size_ - mechanical_);
  }

  const std::vector<HoldingLaw>& laws_;
  std::vector<Part> parts_;
  Index size_ = 0;
  Index mechanical_ = 0;  // number of unknowns of systems, which come first
  VectorXd by_laws_;      // of each control law: states, then outputs
  MatrixXd slope_;
  VectorXd left_;
  VectorXd forces_;          // sum of the force magnitudes, by equation
  double last_moved_ = 0.0;  // largest relative change in the last step
};

}  // namespace

std::optional<Held> closedLoopEquilibria(const std::vector<HoldingLaw>& laws,
                                         const SystemMotions& present) {
  Balance balance(laws, present);
  for (int i = 0; i < kMaxIterations; ++i) {
    if (i > 0 && balance.isThere()) {
      balance.step();  // reduces the error to rounding
      return balance.held();
    }
    if (!balance.step()) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace whirl_twin
