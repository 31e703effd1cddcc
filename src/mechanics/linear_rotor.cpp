#include "mechanics/linear_rotor.h"

#include <cmath>
#include <complex>
#include <stdexcept>

#include "algebra/constants.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

/// Amplitude of the synchronous force, and the constant force, at rest in q = 0.
struct ForceAtRest {
  Eigen::VectorXcd turning;
  Eigen::VectorXd steady;
};

ForceAtRest forceAtRest(const Dynamics& dynamics, double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  const auto at = [&](double angle) {
    return dynamics.residualForce(zero, zero, {0.0, angle, speed, 0.0});
  };
  const Eigen::VectorXd ahead = at(0.0);
  const Eigen::VectorXd behind = at(kPi);
  const Eigen::VectorXd steady = 0.5 * (ahead + behind);
  const Eigen::VectorXd aside = at(0.5 * kPi) - steady;
  return {(0.5 * (ahead - behind)).cast<Complex>() - Complex(0.0, 1.0) * aside.cast<Complex>(),
          steady};
}

}  // namespace

Eigen::VectorXd LinearRotor::shaftForce(double angle, double speed, double acceleration) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(dof());
  for (const ShaftForce& force : forces) {
    const Complex turn = std::polar(1.0, force.harmonic * angle);
    const Complex factor = force.inertial ? Complex(speed * speed, -acceleration) * turn : turn;
    sum += (factor * force.amplitude).real();
  }
  return sum;
}

Eigen::VectorXcd LinearRotor::synchronousForce(double speed) const {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(dof());
  for (const ShaftForce& force : forces) {
    if (force.harmonic == 1) {
      sum += (force.inertial ? speed * speed : 1.0) * force.amplitude;
    }
  }
  return sum;
}

LinearRotor Dynamics::linearRotor() const {
  const bool alternates = !hasShaft() && &atMeanLoad() != this;
  if (!linear() || alternates) {
    throw std::logic_error(model() + " is not a linear rotor");
  }
  LinearRotor rotor;
  rotor.matrices = [this](double speed) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dof());
    return linearization(zero, zero, zero, {0.0, 0.0, speed, 0.0});
  };
  rotor.speed_dependent = speedDependent();
  const ForceAtRest standing = forceAtRest(*this, 0.0);
  const ForceAtRest turning = forceAtRest(*this, 1.0);
  rotor.load = standing.steady;
  const Eigen::VectorXcd inertial = turning.turning - standing.turning;
  if ((inertial.array() != 0.0).any()) {
    rotor.forces.push_back({inertial, 1, true});
  }
  if ((standing.turning.array() != 0.0).any()) {
    rotor.forces.push_back({standing.turning, 1, false});
  }
  return rotor;
}

}  // namespace whirl_twin
