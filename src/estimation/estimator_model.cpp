#include "estimation/estimator_model.h"

#include <cmath>
#include <limits>
#include <utility>

#include "algebra/dense.h"
#include "integration/matrix_exponential.h"
#include "messages/input_error.h"

namespace whirl_twin {

MotionStep::MotionStep(const Eigen::MatrixXd& by_state, double h) : duration(h) {
  const Eigen::Index n = by_state.rows();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomRows(n) = by_state;
  const auto power = [&](double part) {
    Eigen::MatrixXd e = exponentialLessIdentity<Eigen::Dynamic>(part * h * A);
    e.diagonal().array() += 1.0;
    return e;
  };
  states = power(1.0);
  forced = Eigen::MatrixXd::Zero(2 * n, n);
  noise = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (std::size_t k = 0; k < kNode.size(); ++k) {
    const Eigen::MatrixXd rates = power(1.0 - kNode[k]).rightCols(n);
    node[k] = kWeight[k] * h * rates;
    forced += node[k];
    noise.noalias() += kWeight[k] * h * rates * rates.transpose();
  }
}

Eigen::MatrixXd MotionStep::noiseOf(const Eigen::MatrixXd& density) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(states.rows(), states.cols());
  for (std::size_t k = 0; k < kNode.size(); ++k) {
    all += node[k] * density * node[k].transpose() / (kWeight[k] * duration);
  }
  return all;
}

namespace {

/// Step of the finite differences of the numbers; the error is its square.
constexpr double kDifference = 1.0e-3;
/// The system is set up again for numbers further than this from those of its set-up: the error is
/// its square.
constexpr double kNear = 5.0e-4;

/// Regularization width of dry friction with sticking in a filter: the filter linearizes at every
/// step, and a discontinuity has no slope.
constexpr std::pair<const char*, double> kFilterWidths[] = {
    {"coulomb_rate", 1.0e-2}, {"friction_width", 1.0e-3}, {"regularization", 5.0e-3}};

SharedSystem withoutSticking(SharedSystem system) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system->dynamics->dof());
  if (system->dynamics->dryHolds(zero, zero, zero, {}).empty()) {
    return system;
  }
  for (const auto& [name, width] : kFilterWidths) {
    const auto& known = system->model->parameters;
    if (std::any_of(known.begin(), known.end(),
                    [name = name](const ParameterInfo& p) { return p.name == name; })) {
      return system->with({name}, {width}, system->spec.name);
    }
  }
  return system;
}

}  // namespace

double EstimatorParameter::value(double number) const {
  return start * std::exp(number);
}

double EstimatorParameter::deviation(double number, double deviation) const {
  return deviation * std::fabs(value(number));
}

EstimatorModel::EstimatorModel(SharedSystem system, std::vector<EstimatorParameter> parameters)
    : scene_system_(withoutSticking(std::move(system))),
      parameters_(std::move(parameters)),
      dof_(scene_system_->dynamics->dof()),
      now_(variant(scene_system_)) {
  numbers_ = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(parameters_.size()),
                                       std::numeric_limits<double>::infinity());
  if (!parameters_.empty() && !follow(Eigen::VectorXd::Zero(numbers_.size()))) {
    throw InputError(scene_system_->spec.name +
                     ": its parameters cannot be estimated: a small change of one of them makes it "
                     "another kind of system");
  }
}

EstimatorModel::Variant EstimatorModel::variant(SharedSystem system) {
  const std::vector<InputInfo> inputs = system->dynamics->inputs();
  Eigen::MatrixXd directions(system->dynamics->dof(), static_cast<Eigen::Index>(inputs.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    directions.col(static_cast<Eigen::Index>(i)) = inputs[i].direction;
  }
  return {std::move(system), std::move(directions)};
}

EstimatorModel::Variant EstimatorModel::at(const Eigen::VectorXd& numbers) const {
  std::vector<std::string> paths;
  std::vector<double> values;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    paths.push_back(parameters_[i].path);
    values.push_back(parameters_[i].value(numbers[static_cast<Eigen::Index>(i)]));
  }
  return variant(scene_system_->with(paths, values, scene_system_->spec.name));
}

bool EstimatorModel::follow(const Eigen::VectorXd& numbers) {
  if (numbers.size() == 0 || (numbers - numbers_).cwiseAbs().maxCoeff() <= kNear) {
    return true;
  }
  try {
    Variant now = at(numbers);
    std::vector<Variant> more, less;
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const Eigen::VectorXd unit = kDifference * Eigen::VectorXd::Unit(numbers.size(), i);
      more.push_back(at(numbers + unit));
      less.push_back(at(numbers - unit));
    }
    now_ = std::move(now);
    more_ = std::move(more);
    less_ = std::move(less);
    numbers_ = numbers;
    ++version_;
  } catch (const InputError&) {
    return false;
  }
  return true;
}

Eigen::VectorXd EstimatorModel::acceleration(const Variant& variant, const Eigen::VectorXd& q,
                                             const Eigen::VectorXd& v,
                                             const EvaluationPoint<double>& at,
                                             const Eigen::VectorXd& u) const {
  const Dynamics& dynamics = *variant.system->dynamics;
  Eigen::VectorXd a = dynamics.acceleration(q, v, at);
  if (u.size() > 0 && !u.isZero(0.0)) {
    a += Ldlt(dynamics.massMatrix(q, v, at)).solve(variant.inputs * u);
  }
  return a;
}

Eigen::MatrixXd EstimatorModel::byInput(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                        const EvaluationPoint<double>& at) const {
  return Ldlt(system()->dynamics->massMatrix(q, v, at)).solve(now_.inputs);
}

Eigen::VectorXd EstimatorModel::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                             const EvaluationPoint<double>& at,
                                             const Eigen::VectorXd& numbers,
                                             const Eigen::VectorXd& u,
                                             const Eigen::MatrixXd& by_parameter) const {
  Eigen::VectorXd a = acceleration(now_, q, v, at, u);
  if (numbers.size() > 0) {
    a.noalias() += by_parameter * (numbers - numbers_);
  }
  return a;
}

LocalMotion EstimatorModel::about(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const EvaluationPoint<double>& at, const Eigen::VectorXd& numbers,
                                  const Eigen::VectorXd& u) const {
  LocalMotion local;
  local.by_parameter.resize(dof_, numbers.size());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    local.by_parameter.col(i) =
        (acceleration(more_[k], q, v, at, u) - acceleration(less_[k], q, v, at, u)) /
        (2.0 * kDifference);
  }
  local.acceleration = acceleration(q, v, at, numbers, u, local.by_parameter);
  const Linearization l = system()->dynamics->linearization(q, v, local.acceleration, at);
  const Ldlt mass(l.mass);
  local.by_state.resize(dof_, 2 * dof_);
  local.by_state.leftCols(dof_) = -mass.solve(l.stiffness + l.circulatory);
  local.by_state.rightCols(dof_) = -mass.solve(l.damping + l.gyroscopic);
  return local;
}

}  // namespace whirl_twin
