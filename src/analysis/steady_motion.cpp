#include "analysis/steady_motion.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "analysis/equilibria.h"
#include "analysis/natural_modes.h"

namespace whirl_twin {

namespace {

constexpr int kMaxIterations = 100;
constexpr int kMaxCreeps = 2000;
constexpr double kCreep = 0.05;    // units: the longest step
constexpr double kCrept = 1.0e-9;  // units: there
constexpr double kHeld = 1.0e-9;   // of the load: what no stiffness answers is a load along a drift

/// The steady motions of a system at fixed momenta: unknowns are the shape, then the rates of the
/// driven coordinates, each in its natural unit.
class ReducedSystem {
 public:
  ReducedSystem(const Dynamics& dynamics, const CyclicCoordinates& cyclic,
                const SteadyMotion& start, const Eigen::VectorXd& momenta, double speed)
      : dynamics_(dynamics.atMeanLoad()),
        cyclic_(cyclic),
        momenta_(momenta),
        at_{0.0, 0.0, speed, 0.0},
        unit_(naturalUnits(dynamics)),
        rows_(cyclic.shape) {
    rows_.insert(rows_.end(), cyclic.driven.begin(), cyclic.driven.end());
    for (const Eigen::Index i : cyclic.driven) {
      unit_[i] *= std::max(1.0, std::fabs(start.v[i]));  // a rate, in units of where it starts
    }
  }

  Eigen::Index shapes() const { return static_cast<Eigen::Index>(cyclic_.shape.size()); }

  /// Rates of the conserved coordinates that give the momenta.
  void matchMomenta(SteadyMotion& x) const {
    const auto& c = cyclic_.conserved;
    if (c.empty()) {
      return;
    }
    x.v(c).setZero();
    const Eigen::VectorXd missing = momenta_ - dynamics_.momenta(x.q, x.v, at_);
    const Eigen::MatrixXd mass = dynamics_.massMatrix(x.q, x.v, at_);
    const Eigen::MatrixXd inertia = mass(c, c);
    const Eigen::VectorXd momentum = missing(c);
    const Eigen::VectorXd rates = Ldlt(inertia).solve(momentum);
    x.v(c) = rates;
  }

  /// What pulls, in units.
  Eigen::VectorXd pull(const SteadyMotion& x) const {
    return unit_.cwiseProduct(dynamics_.residualForce(x.q, x.v, at_))(rows_);
  }

  /// - d pull / d unknowns, at constant momenta.
  Eigen::MatrixXd slope(const SteadyMotion& x) const {
    const Linearization full =
        dynamics_.linearization(x.q, x.v, Eigen::VectorXd::Zero(x.q.size()), at_);
    const Linearization l = atFixedMomenta(full, cyclic_);
    const Eigen::Index s = shapes();
    Eigen::MatrixXd all(l.mass.rows(), l.mass.cols());
    all.leftCols(s) = (l.stiffness + l.circulatory).leftCols(s);
    all.rightCols(all.cols() - s) = (l.damping + l.gyroscopic).rightCols(all.cols() - s);
    const Eigen::VectorXd unit = unit_(rows_);
    return unit.asDiagonal() * all * unit.asDiagonal();
  }

  /// Of the shape, in units.
  Eigen::MatrixXd inertia(const SteadyMotion& x) const {
    const Eigen::MatrixXd mass = dynamics_.massMatrix(x.q, x.v, at_);
    const Eigen::VectorXd unit = unit_(cyclic_.shape);
    return unit.asDiagonal() * mass(cyclic_.shape, cyclic_.shape) * unit.asDiagonal();
  }

  void move(const Eigen::VectorXd& by, SteadyMotion& x) const {
    const Eigen::VectorXd unit = unit_(rows_);
    const Eigen::VectorXd step = unit.cwiseProduct(by);
    x.q(cyclic_.shape) += step.head(shapes());
    x.v(cyclic_.driven) += step.tail(step.size() - shapes());
    matchMomenta(x);
  }

  /// [m], margin to each bound of a rotor; empty for other systems.
  Eigen::VectorXd room(const SteadyMotion& x) const {
    const std::vector<Condition> bounds =
        dynamics_.isRotor() ? dynamics_.conditions(x.q, x.v, Eigen::VectorXd::Zero(x.q.size()), at_)
                            : std::vector<Condition>{};
    Eigen::VectorXd room(static_cast<Eigen::Index>(bounds.size()));
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      room[static_cast<Eigen::Index>(i)] = bounds[i].margin;
    }
    return room;
  }

  /// The shape, then the driven rates, in units.
  Eigen::VectorXd unknowns(const SteadyMotion& x) const {
    Eigen::VectorXd y(static_cast<Eigen::Index>(rows_.size()));
    y << x.q.cwiseQuotient(unit_)(cyclic_.shape), x.v.cwiseQuotient(unit_)(cyclic_.driven);
    return y;
  }
  /// Size of the unknowns in units.
  double size(const SteadyMotion& x) const {
    return std::hypot(x.q.cwiseQuotient(unit_)(cyclic_.shape).norm(),
                      x.v.cwiseQuotient(unit_)(cyclic_.driven).norm());
  }

  /// A force that is large here [in units]: the inertia times the accelerations in play.
  double largeForce(const SteadyMotion& start, double speed) const {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(start.q.size());
    return dynamics_.massMatrix(start.q, rest, at_).norm() *
           std::max(speed * speed, dynamics_.acceleration(start.q, rest, at_).norm());
  }

 private:
  const Dynamics& dynamics_;
  const CyclicCoordinates& cyclic_;
  const Eigen::VectorXd& momenta_;
  EvaluationPoint<double> at_;
  Eigen::VectorXd unit_;
  CyclicCoordinates::Places rows_;
};

/// Equilibrium of a linear system under its constant loads, K q = load; nothing where they act
/// along a motion without stiffness. (By least squares: K is singular there.)
std::optional<SteadyMotion> deflection(const Dynamics& dynamics, double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
  const Dynamics& mean = dynamics.atMeanLoad();
  const Eigen::VectorXd load = mean.residualForce(zero, zero, at);
  if (load.norm() == 0.0) {
    return SteadyMotion{zero, zero};
  }
  const Linearization l = mean.linearization(zero, zero, zero, at);
  const CyclicCoordinates rigid = rigidBodyMotions(l);
  const Eigen::MatrixXd along =
      (l.stiffness + l.circulatory) * rigid.basis(Eigen::all, rigid.shape);
  Eigen::VectorXd rows(along.rows());  // each in units of its largest entry
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const double largest = along.cols() > 0 ? along.row(i).cwiseAbs().maxCoeff() : 0.0;
    rows[i] = largest > 0.0 ? 1.0 / largest : 1.0;
  }
  const Eigen::MatrixXd slope = rows.asDiagonal() * along;
  const Eigen::VectorXd pull = rows.cwiseProduct(load);
  if (rigid.any()) {
    const PivotedQr qr(slope);
    const Eigen::VectorXd by_shape = qr.solve(pull);
    if (!((slope * by_shape - pull).norm() <= kHeld * pull.norm())) {
      return std::nullopt;
    }
    return SteadyMotion{rigid.basis(Eigen::all, rigid.shape) * by_shape, zero};
  }
  return SteadyMotion{Lu(slope).solve(pull), zero};
}

/// Within the bounds of a rotor, from a start within them.
std::optional<SteadyMotion> withinBounds(const ReducedSystem& system, const SteadyMotion& start) {
  const Eigen::VectorXd first = system.unknowns(start);
  const auto placeOf = [&](const Eigen::VectorXd& y) {
    SteadyMotion x = start;
    system.move(y - first, x);
    return x;
  };
  const RestProblem problem{
      [&](const Eigen::VectorXd& y) { return system.pull(placeOf(y)); },
      [&](const Eigen::VectorXd& y, const Eigen::VectorXd& pull) {
        return Eigen::VectorXd(PivotedQr(system.slope(placeOf(y))).solve(pull));
      },
      [&](const Eigen::VectorXd& y) { return system.room(placeOf(y)); }};
  const auto rest = restWithinBounds(problem, first);
  return rest ? std::optional<SteadyMotion>(placeOf(*rest)) : std::nullopt;
}

}  // namespace

std::optional<SteadyMotion> steadyMotionNear(const Dynamics& dynamics,
                                             const CyclicCoordinates& cyclic,
                                             const SteadyMotion& start,
                                             const Eigen::VectorXd& momenta, double speed) {
  const Eigen::Index n = dynamics.dof();
  SteadyMotion x{start.q, Eigen::VectorXd::Zero(n)};
  if (dynamics.linear()) {
    return deflection(dynamics, speed);
  }
  for (const Eigen::Index i : cyclic.driven) {
    x.v[i] = start.v[i] != 0.0 ? start.v[i] : 1.0;  // where rest is no steady motion
  }
  const ReducedSystem system(dynamics, cyclic, x, momenta, speed);
  system.matchMomenta(x);
  if (cyclic.shape.empty() && cyclic.driven.empty()) {  // fully determined by its momenta
    return x;
  }
  if (system.room(x).size() > 0) {
    return withinBounds(system, x);
  }
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::MatrixXd slope = system.slope(x);
    const Eigen::VectorXd pull = system.pull(x);
    const Eigen::VectorXd correction = PivotedQr(slope).solve(pull);
    const double size = correction.norm();
    if (!std::isfinite(size)) {
      return std::nullopt;
    }
    system.move(correction * std::min(1.0, 1.0 / std::max(size, 1.0e-300)), x);
    if (size < 1.0e-14 * (1.0 + system.size(x))) {
      // A residual force without stiffness remains where a coordinate is free to run away.
      const bool held = (pull - slope * correction).norm() <= 1.0e-9 * slope.norm();
      return held ? std::optional<SteadyMotion>(x) : std::nullopt;
    }
  }
  // Where an equilibrium branches Newton's method is slow: near is good enough if nothing pulls.
  return system.pull(x).norm() <= 1.0e-12 * system.largeForce(start, speed)
             ? std::optional<SteadyMotion>(x)
             : std::nullopt;
}

std::optional<SteadyMotion> creepsTo(const Dynamics& dynamics, const CyclicCoordinates& cyclic,
                                     const SteadyMotion& start, const Eigen::VectorXd& momenta,
                                     double speed) {
  if (dynamics.linear() || !cyclic.driven.empty() || cyclic.shape.empty()) {
    return std::nullopt;
  }
  SteadyMotion x{start.q, Eigen::VectorXd::Zero(dynamics.dof())};
  const ReducedSystem system(dynamics, cyclic, x, momenta, speed);
  system.matchMomenta(x);
  double time = 0.0;  // of a step; from the second on
  for (int i = 0; i < kMaxCreeps; ++i) {
    const Eigen::VectorXd pull = system.pull(x);
    const Eigen::MatrixXd slope = system.slope(x);
    const Eigen::MatrixXd inertia = system.inertia(x);
    if (!pull.allFinite() || !slope.allFinite() || pull.norm() == 0.0) {
      return x;
    }
    if (time == 0.0) {
      time = kCreep * inertia.norm() / pull.norm();
    }
    // M x' = pull, implicit: a step that is not downhill on its whole way is halved.
    const Eigen::MatrixXd step = inertia / time + slope;
    const bool downhill = Cholesky(0.5 * (step + step.transpose())).succeeded();
    const Eigen::VectorXd by = downhill ? Eigen::VectorXd(Lu(step).solve(pull)) : pull;
    if (!downhill || !(by.norm() <= kCreep)) {
      time *= 0.5;
      continue;
    }
    system.move(by, x);
    if (by.norm() <= kCrept && time * slope.norm() > inertia.norm()) {
      return x;
    }
    time *= 1.5;
  }
  return x;
}

}  // namespace whirl_twin
