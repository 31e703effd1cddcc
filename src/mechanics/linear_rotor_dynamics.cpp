#include "mechanics/linear_rotor_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "algebra/dense.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

void requireSizes(const RotorDescription& description, const LinearRotor& rotor) {
  const auto n = static_cast<Eigen::Index>(description.coordinates.size());
  const auto refuse = [&](const std::string& what, Eigen::Index size) {
    throw std::logic_error("rotor of " + std::to_string(n) + " coordinates: " + what +
                           " has size " + std::to_string(size));
  };
  const Linearization l = rotor.matrices(0.0);
  for (const Eigen::MatrixXd* m :
       {&l.mass, &l.damping, &l.gyroscopic, &l.stiffness, &l.circulatory}) {
    if (m->rows() != n || m->cols() != n) {
      refuse("a matrix", m->rows());
    }
  }
  if (rotor.load.size() != n) {
    refuse("the load", rotor.load.size());
  }
  for (const ShaftForce& force : rotor.forces) {
    if (force.amplitude.size() != n) {
      refuse("a force", force.amplitude.size());
    }
  }
  for (const Station& station : description.stations) {
    if (station.along_x.size() != n || station.along_y.size() != n) {
      refuse("station " + station.name, station.along_x.size());
    }
  }
}

}  // namespace

LinearRotorDynamics::LinearRotorDynamics(RotorDescription description, LinearRotor rotor)
    : description_(std::move(description)), rotor_(std::move(rotor)) {
  requireSizes(description_, rotor_);
  mass_ = rotor_.matrices(0.0).mass;
  mass_factor_ = Cholesky(mass_);
  if (!mass_factor_.succeeded()) {
    throw InputError("rotor: the mass matrix is not positive definite");
  }
  if (!rotor_.forces.empty()) {
    LinearRotor balanced = rotor_;
    balanced.forces.clear();
    balanced_ = std::make_unique<LinearRotorDynamics>(description_, std::move(balanced));
  }
}

Eigen::VectorXd LinearRotorDynamics::acceleration(const Eigen::VectorXd& q,
                                                  const Eigen::VectorXd& v,
                                                  const EvaluationPoint<double>& at) const {
  return mass_factor_.solve(residualForce(q, v, at));
}

Eigen::VectorXd LinearRotorDynamics::residualForce(const Eigen::VectorXd& q,
                                                   const Eigen::VectorXd& v,
                                                   const EvaluationPoint<double>& at) const {
  const Linearization l = rotor_.matrices(at.speed);
  return rotor_.shaftForce(at.angle, at.speed, at.acceleration) + rotor_.load -
         (l.damping + l.gyroscopic) * v - (l.stiffness + l.circulatory) * q;
}

Eigen::VectorXd LinearRotorDynamics::appliedForce(const Eigen::VectorXd& q,
                                                  const Eigen::VectorXd& v,
                                                  const EvaluationPoint<double>& at) const {
  const Linearization l = rotor_.matrices(at.speed);
  return rotor_.shaftForce(at.angle, at.speed, at.acceleration) - l.damping * v - l.circulatory * q;
}

Eigen::VectorXd LinearRotorDynamics::momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                             const EvaluationPoint<double>& at) const {
  // The Lagrangian of the gyroscopic terms is q'^T G q / 2.
  return mass_ * v + 0.5 * (rotor_.matrices(at.speed).gyroscopic * q);
}

Energies LinearRotorDynamics::energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                       const EvaluationPoint<double>& at) const {
  const Linearization l = rotor_.matrices(at.speed);
  Energies e;
  e.kinetic = 0.5 * v.dot(mass_ * v);
  e.potential = 0.5 * q.dot(l.stiffness * q) - rotor_.load.dot(q);
  e.jacobi = e.kinetic + e.potential;
  e.dissipated_power = v.dot(l.damping * v);
  e.input_power = v.dot(rotor_.shaftForce(at.angle, at.speed, at.acceleration) - l.circulatory * q);
  if (rotor_.speed_dependent && at.acceleration != 0.0) {
    const double step = 1.0e-5 * std::max(1.0, std::fabs(at.speed));
    const Eigen::MatrixXd change =
        rotor_.matrices(at.speed + step).stiffness - rotor_.matrices(at.speed - step).stiffness;
    e.input_power += 0.5 * at.acceleration * q.dot(change * q) / (2.0 * step);
  }
  return e;
}

Linearization LinearRotorDynamics::linearization(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                                 const Eigen::VectorXd&,
                                                 const EvaluationPoint<double>& at) const {
  return rotor_.matrices(at.speed);
}

std::vector<Condition> LinearRotorDynamics::conditions(const Eigen::VectorXd&,
                                                       const Eigen::VectorXd&,
                                                       const Eigen::VectorXd&,
                                                       const EvaluationPoint<double>& at) const {
  const DataSpeeds data = dataSpeeds(rotor_);
  if (std::isinf(data.to)) {
    return {};  // of films alone, too: every shaft starts and ends slower than they carry it
  }
  // The first and the last speed of a table are its own.
  const double inside = std::min(at.speed - data.from, data.to - at.speed);
  const double margin = inside == 0.0 ? std::numeric_limits<double>::min() : inside;
  return {{"speed_of_tables", "rad/s", margin,
           "the speed is outside the tables of bearings and pedestals"}};
}

}  // namespace whirl_twin
