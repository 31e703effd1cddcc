#include "mechanics/linear_dynamics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

void requireSizes(const LinearModel& model) {
  const auto n = static_cast<Eigen::Index>(model.coordinates.size());
  for (const Eigen::MatrixXd* matrix :
       {&model.mass, &model.damping, &model.gyroscopic, &model.stiffness, &model.circulatory}) {
    if (matrix->rows() != n || matrix->cols() != n) {
      throw std::logic_error("linear system of " + std::to_string(n) +
                             " coordinates: a matrix is " + std::to_string(matrix->rows()) + " x " +
                             std::to_string(matrix->cols()));
    }
  }
  for (const HarmonicForce& force : model.forces) {
    if (force.amplitude.size() != n) {
      throw std::logic_error("linear system of " + std::to_string(n) +
                             " coordinates: a force has " + std::to_string(force.amplitude.size()) +
                             " components");
    }
  }
}

/// Rigid-body modes are excluded: they have no static deflection.
double largestDeflection(const LinearModel& model) {
  const Eigen::MatrixXd stiffness = model.stiffness + model.circulatory;
  double largest = 0.0;
  for (const HarmonicForce& force : model.forces) {
    largest = std::max(largest, leastSquares(stiffness, force.amplitude).lpNorm<Eigen::Infinity>());
  }
  return largest > 0.0 && std::isfinite(largest) ? largest : 1.0;
}

}  // namespace

LinearDynamics::LinearDynamics(LinearModel model) : model_(std::move(model)) {
  requireSizes(model_);
  mass_ = Cholesky(model_.mass);
  if (!mass_.succeeded()) {
    throw InputError("linear system: the mass matrix is not positive definite");
  }
  natural_length_ = largestDeflection(model_);
  LinearModel mean = model_;
  mean.forces.clear();
  for (const HarmonicForce& force : model_.forces) {
    if (force.frequency == 0.0) {
      mean.forces.push_back(force);
    }
  }
  if (mean.forces.size() < model_.forces.size()) {
    at_mean_load_ = std::make_unique<LinearDynamics>(std::move(mean));
  }
}

Eigen::VectorXd LinearDynamics::force(double time) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(dof());
  for (const HarmonicForce& f : model_.forces) {
    sum += f.amplitude * std::cos(f.frequency * time + f.phase);
  }
  return sum;
}

Eigen::VectorXd LinearDynamics::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                             const EvaluationPoint<double>& at) const {
  return mass_.solve(residualForce(q, v, at));
}

Eigen::VectorXd LinearDynamics::residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                              const EvaluationPoint<double>& at) const {
  return appliedForce(q, v, at) - model_.gyroscopic * v - model_.stiffness * q;
}

Eigen::VectorXd LinearDynamics::appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                             const EvaluationPoint<double>& at) const {
  return force(at.time) - model_.damping * v - model_.circulatory * q;
}

Eigen::VectorXd LinearDynamics::momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                        const EvaluationPoint<double>&) const {
  // The Lagrangian of the gyroscopic terms is q'^T G q / 2.
  return model_.mass * v + 0.5 * (model_.gyroscopic * q);
}

Energies LinearDynamics::energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const EvaluationPoint<double>& at) const {
  Energies e;
  e.kinetic = 0.5 * v.dot(model_.mass * v);
  e.potential = 0.5 * q.dot(model_.stiffness * q);
  e.jacobi = e.kinetic + e.potential;
  e.dissipated_power = v.dot(model_.damping * v);
  e.input_power = v.dot(force(at.time) - model_.circulatory * q);
  return e;
}

Linearization LinearDynamics::linearization(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                            const Eigen::VectorXd&,
                                            const EvaluationPoint<double>&) const {
  return {model_.mass, model_.damping, model_.gyroscopic, model_.stiffness, model_.circulatory};
}

}  // namespace whirl_twin
