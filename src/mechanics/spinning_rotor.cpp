#include "mechanics/spinning_rotor.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

#include "algebra/dense.h"
#include "mechanics/gradient.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What an unbalance takes of the polar inertia, at most: s^T M^-1 s over all angles.
double carriedInertia(const Eigen::VectorXcd& unbalance, const MatrixXd& mass) {
  MatrixXd both(unbalance.size(), 2);
  both << unbalance.real(), unbalance.imag();
  const Eigen::Matrix2d carried = both.transpose() * Cholesky(mass).solve(both);
  const double half = 0.5 * (carried(0, 0) - carried(1, 1));
  return 0.5 * (carried(0, 0) + carried(1, 1)) + std::hypot(half, carried(0, 1));
}

VectorXd withSpin(const VectorXd& x, double spin) {
  VectorXd all(x.size() + 1);
  all << x, spin;
  return all;
}

VectorXd whirl(const VectorXd& x) {
  return x.head(x.size() - 1);
}

EvaluationPoint<double> shaftOf(const VectorXd& q, const VectorXd& v, double acceleration,
                                const EvaluationPoint<double>& at) {
  return {at.time, q[q.size() - 1], v[v.size() - 1], acceleration};
}

constexpr double kSpeedStep = 1.0e-4;  // of the speed, of differences
constexpr double kPlaceStep = 1.0e-9;  // [m] and [m/s]: far below any clearance and sliding

}  // namespace

Eigen::VectorXcd unbalanceOf(const LinearRotor& rotor) {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(rotor.dof());
  for (const ShaftForce& force : rotor.forces) {
    if (force.harmonic != 1 || !force.inertial) {
      throw std::logic_error("a spin that is free has unbalances to carry and nothing else");
    }
    sum += force.amplitude;
  }
  return sum;
}

SpinningRotor::SpinningRotor(std::shared_ptr<const Dynamics> held, std::vector<LocalForce> forces,
                             SpinCoupling coupling)
    : held_(std::move(held)),
      forces_(std::move(forces)),
      coupling_(std::move(coupling)),
      unbalance_(unbalanceOf(held_->linearRotor())) {
  const VectorXd zero = VectorXd::Zero(held_->dof());
  mass_ = held_->massMatrix(zero, zero, {});
  if (!(carriedInertia(unbalance_, mass_) < coupling_.polar_inertia)) {
    throw InputError("with a motor the polar inertia must be greater than that of the unbalances");
  }
  const Dynamics& balanced = held_->atMeanLoad();
  if (&balanced != held_.get()) {
    balanced_ = std::make_unique<SpinningRotor>(std::shared_ptr<const Dynamics>(held_, &balanced),
                                                forces_, coupling_);
  }
}

VectorXd SpinningRotor::lever(double angle) const {
  return (std::polar(1.0, angle) * Complex(0.0, 1.0) * unbalance_).real();
}

VectorXd SpinningRotor::leverTurn(double angle) const {
  return -(std::polar(1.0, angle) * unbalance_).real();
}

double SpinningRotor::localMoment(const VectorXd& x, const VectorXd& r, double speed) const {
  double sum = 0.0;
  for (const LocalForce& force : forces_) {
    sum += force.law->moment(stateOf(force, x, r, speed));
  }
  return sum;
}

/// All on the spin but that of the unbalance.
double SpinningRotor::torque(const VectorXd& x, const VectorXd& r, double speed) const {
  return coupling_.motor.torque(speed) - coupling_.motor.drag * speed +
         x.dot(coupling_.circulatory * r) - speed * x.dot(coupling_.resistance * x) +
         localMoment(x, r, speed);
}

std::vector<CoordinateInfo> SpinningRotor::coordinates() const {
  std::vector<CoordinateInfo> all = held_->coordinates();
  all.push_back({"spin", "rad", "of the shaft, in the direction of its motor"});
  return all;
}

std::vector<InputInfo> SpinningRotor::inputs() const {
  std::vector<InputInfo> all = held_->inputs();
  for (InputInfo& input : all) {
    input.direction = withSpin(input.direction, 0.0);
  }
  all.push_back(
      {"torque", "N m", VectorXd::Unit(dof(), dof() - 1), "on the shaft, besides the motor's"});
  return all;
}

std::vector<Station> SpinningRotor::turned(std::vector<Station> places) {
  for (Station& place : places) {
    place.along_x = withSpin(place.along_x, 0.0);
    place.along_y = withSpin(place.along_y, 0.0);
  }
  return places;
}

VectorXd SpinningRotor::residualForce(const VectorXd& q, const VectorXd& v,
                                      const EvaluationPoint<double>& at) const {
  const EvaluationPoint<double> shaft = shaftOf(q, v, 0.0, at);
  const VectorXd x = whirl(q);
  const VectorXd r = whirl(v);
  return withSpin(held_->residualForce(x, r, shaft), torque(x, r, shaft.speed));
}

MatrixXd SpinningRotor::massMatrix(const VectorXd& q, const VectorXd&,
                                   const EvaluationPoint<double>&) const {
  const Index n = held_->dof();
  MatrixXd mass(n + 1, n + 1);
  mass.topLeftCorner(n, n) = mass_;
  mass.topRightCorner(n, 1) = lever(q[n]);
  mass.bottomLeftCorner(1, n) = mass.topRightCorner(n, 1).transpose();
  mass(n, n) = coupling_.polar_inertia;
  return mass;
}

VectorXd SpinningRotor::acceleration(const VectorXd& q, const VectorXd& v,
                                     const EvaluationPoint<double>& at) const {
  return Cholesky(massMatrix(q, v, at)).solve(residualForce(q, v, at));
}

VectorXd SpinningRotor::appliedForce(const VectorXd& q, const VectorXd& v,
                                     const EvaluationPoint<double>& at) const {
  const EvaluationPoint<double> shaft = shaftOf(q, v, 0.0, at);
  const VectorXd x = whirl(q);
  const VectorXd r = whirl(v);
  const VectorXd of_unbalance = -shaft.speed * shaft.speed * leverTurn(shaft.angle);
  return withSpin(held_->appliedForce(x, r, shaft) - of_unbalance, torque(x, r, shaft.speed));
}

VectorXd SpinningRotor::momenta(const VectorXd& q, const VectorXd& v,
                                const EvaluationPoint<double>& at) const {
  const EvaluationPoint<double> shaft = shaftOf(q, v, 0.0, at);
  const VectorXd s = lever(shaft.angle);
  return withSpin(held_->momenta(whirl(q), whirl(v), shaft) + shaft.speed * s,
                  coupling_.polar_inertia * shaft.speed + s.dot(whirl(v)));
}

Energies SpinningRotor::energies(const VectorXd& q, const VectorXd& v,
                                 const EvaluationPoint<double>& at) const {
  const VectorXd x = whirl(q);
  const VectorXd r = whirl(v);
  const Index n = x.size();
  const EvaluationPoint<double> shaft = shaftOf(q, v, acceleration(q, v, at)[n], at);
  const double w = shaft.speed;
  const VectorXd s = lever(shaft.angle);
  const double turning = r.dot(coupling_.circulatory * x);
  Energies e = held_->energies(x, r, shaft);
  e.kinetic += 0.5 * coupling_.polar_inertia * w * w + w * s.dot(r);
  e.jacobi = e.kinetic + e.potential;
  e.dissipated_power +=
      2.0 * w * turning + w * w * x.dot(coupling_.resistance * x) + coupling_.motor.drag * w * w;
  // The rotor at prescribed speed includes the power of the shaft; here that is internal.
  const VectorXd from_shaft = -shaft.acceleration * s - w * w * leverTurn(shaft.angle);
  e.input_power +=
      w * turning - r.dot(from_shaft) + w * (coupling_.motor.torque(w) + localMoment(x, r, w));
  return e;
}

Linearization SpinningRotor::linearization(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                           const EvaluationPoint<double>& at) const {
  const Index n = held_->dof();
  const VectorXd x = whirl(q);
  const VectorXd r = whirl(v);
  const EvaluationPoint<double> shaft = shaftOf(q, v, a[n], at);
  const double w = shaft.speed;
  const VectorXd s = lever(shaft.angle);
  const VectorXd turn = leverTurn(shaft.angle);
  const Linearization l = held_->linearization(x, r, whirl(a), shaft);

  // By rows and columns of all coordinates: the forces' change with positions, and with rates.
  MatrixXd by_place = MatrixXd::Zero(n + 1, n + 1);
  MatrixXd by_rate = MatrixXd::Zero(n + 1, n + 1);
  by_place.topLeftCorner(n, n) = l.stiffness + l.circulatory;
  by_rate.topLeftCorner(n, n) = l.damping + l.gyroscopic;
  by_place.topRightCorner(n, 1) = a[n] * turn - w * w * s;
  by_place(n, n) = turn.dot(whirl(a));
  by_place.bottomLeftCorner(1, n) =
      (2.0 * w * (coupling_.resistance * x) - coupling_.circulatory * r).transpose();
  by_rate.bottomLeftCorner(1, n) = -(coupling_.circulatory.transpose() * x).transpose();
  const double step = kSpeedStep * std::max(1.0, std::fabs(w));
  const auto pushed = [&](double speed) {
    return held_->residualForce(x, r, {shaft.time, shaft.angle, speed, shaft.acceleration});
  };
  by_rate.topRightCorner(n, 1) = (pushed(w - step) - pushed(w + step)) / (2.0 * step);
  const Gradient<double, 1> motor = coupling_.motor.torque(Gradient<double, 1>(w, 0));
  by_rate(n, n) = coupling_.motor.drag - motor.slope[0] + x.dot(coupling_.resistance * x) -
                  (localMoment(x, r, w + step) - localMoment(x, r, w - step)) / (2.0 * step);
  for (const LocalForce& force : forces_) {
    LocalState here = stateOf(force, x, r, w);
    const auto slope = [&](double& number) {
      const double middle = number;
      number = middle + kPlaceStep;
      const double above = force.law->moment(here);
      number = middle - kPlaceStep;
      const double below = force.law->moment(here);
      number = middle;
      return (above - below) / (2.0 * kPlaceStep);
    };
    by_place.bottomLeftCorner(1, n) -=
        (slope(here.place[0]) * force.along_x + slope(here.place[1]) * force.along_y).transpose();
    by_rate.bottomLeftCorner(1, n) -=
        (slope(here.rate[0]) * force.along_x + slope(here.rate[1]) * force.along_y).transpose();
  }
  const auto half = [](const MatrixXd& m, double sign) -> MatrixXd {
    return 0.5 * (m + sign * m.transpose());
  };
  return {massMatrix(q, v, at), half(by_rate, 1.0), half(by_rate, -1.0), half(by_place, 1.0),
          half(by_place, -1.0)};
}

std::vector<Condition> SpinningRotor::conditions(const VectorXd& q, const VectorXd& v,
                                                 const VectorXd& a,
                                                 const EvaluationPoint<double>& at) const {
  return held_->conditions(whirl(q), whirl(v), whirl(a), shaftOf(q, v, a[a.size() - 1], at));
}

Sketch SpinningRotor::sketch(const VectorXd& q, const EvaluationPoint<double>& at) const {
  return held_->sketch(whirl(q), {at.time, q[q.size() - 1], at.speed, at.acceleration});
}

}  // namespace whirl_twin
