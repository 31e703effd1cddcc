#include "integration/linear_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "integration/dormand_prince_8.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/matrix_exponential.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/velocity_verlet.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

LinearStepMap stepMap(const MatrixXd& dq, const MatrixXd& dv, MatrixXd work) {
  LinearStepMap map;
  map.increment.resize(2 * dq.rows(), dq.cols());
  map.increment << dq, dv;
  map.work = std::move(work);
  return map;
}

/// Matrices beyond the range of doubles: the first step is not finite, and refused.
LinearStepMap outOfRange(const LinearEquation& equation) {
  const double nan = kNaN;
  return {MatrixXd::Constant(2 * equation.dof(), equation.size(), nan),
          MatrixXd::Constant(equation.size(), equation.size(), nan)};
}

/// The power at a stage, as a form of the step's start.
MatrixXd powerAt(const LinearEquation& equation, const MatrixXd& stage) {
  return stage.transpose() * equation.power() * stage;
}

/// Its node is the start, where an input is what it is held at: that works with the rate at the
/// end.
LinearStepMap semiImplicitEuler(const LinearEquation& equation, double h) {
  const MatrixXd dv = h * equation.acceleration();
  MatrixXd work = h * equation.power();
  for (Index k = 0; k < equation.inputs().count(); ++k) {
    if (equation.inputs().isHarmonic(k)) {
      continue;
    }
    const Index input = equation.inputColumn(k);
    const Eigen::RowVectorXd further =
        0.5 * h * equation.inputs().directions().col(k).transpose() * dv;
    work.row(input) += further;
    work.col(input) += further.transpose();
  }
  return stepMap(h * (equation.velocity() + dv), dv, work);
}

LinearStepMap velocityVerlet(const LinearEquation& equation, double h) {
  const MatrixXd start = equation.acceleration();
  const MatrixXd dq = h * (equation.velocity() + 0.5 * h * start);
  const MatrixXd end = equation.stage(dq, h * start, h);
  return stepMap(dq, 0.5 * h * (start + equation.acceleration() * end),
                 0.5 * h * (equation.power() + powerAt(equation, end)));
}

LinearStepMap rungeKutta4(const LinearEquation& equation, double h) {
  const MatrixXd acceleration = equation.acceleration();
  const MatrixXd v1 = equation.velocity();
  const MatrixXd& a1 = acceleration;
  const MatrixXd z2 = equation.stage(0.5 * h * v1, 0.5 * h * a1, 0.5 * h);
  const MatrixXd v2 = v1 * z2;
  const MatrixXd a2 = acceleration * z2;
  const MatrixXd z3 = equation.stage(0.5 * h * v2, 0.5 * h * a2, 0.5 * h);
  const MatrixXd v3 = v1 * z3;
  const MatrixXd a3 = acceleration * z3;
  const MatrixXd z4 = equation.stage(h * v3, h * a3, h);
  return stepMap(h / 6.0 * (v1 + 2.0 * (v2 + v3) + v1 * z4),
                 h / 6.0 * (a1 + 2.0 * (a2 + a3) + acceleration * z4),
                 h / 6.0 *
                     (equation.power() + 2.0 * (powerAt(equation, z2) + powerAt(equation, z3)) +
                      powerAt(equation, z4)));
}

LinearStepMap dormandPrince8(const LinearEquation& equation, double h) {
  using dormand_prince::kA;
  using dormand_prince::kNodes;
  using dormand_prince::kWeights;
  const MatrixXd none = MatrixXd::Zero(equation.dof(), equation.size());
  std::array<MatrixXd, dormand_prince::kStages> rates;
  std::array<MatrixXd, dormand_prince::kStages> accelerations;
  LinearStepMap map = stepMap(none, none, MatrixXd::Zero(equation.size(), equation.size()));
  for (std::size_t k = 0; k < dormand_prince::kStages; ++k) {
    MatrixXd dq = none;
    MatrixXd dv = none;
    for (std::size_t j = 0; j < k; ++j) {
      dq += h * kA[k][j] * rates[j];
      dv += h * kA[k][j] * accelerations[j];
    }
    const MatrixXd stage = equation.stage(dq, dv, h * kNodes[k]);
    rates[k] = equation.velocity() * stage;
    accelerations[k] = equation.acceleration() * stage;
    map.increment.topRows(equation.dof()) += h * kWeights[k] * rates[k];
    map.increment.bottomRows(equation.dof()) += h * kWeights[k] * accelerations[k];
    map.work += h * kWeights[k] * powerAt(equation, stage);
  }
  return map;
}

/// The stages' accelerations solve one linear system.
template <std::size_t stages>
LinearStepMap gaussLegendre(const LinearEquation& equation, double h) {
  using Tableau = gauss_legendre::Tableau<stages>;
  constexpr auto kA = Tableau::kA;
  constexpr auto kAA = gauss_legendre::kAA<stages>;
  constexpr auto kNodes = Tableau::kNodes;
  const Index n = equation.dof();
  const auto rows = [n](std::size_t stage) { return static_cast<Index>(stage) * n; };
  const MatrixXd acceleration = equation.acceleration();
  const MatrixXd velocity = equation.velocity();
  const MatrixXd none = MatrixXd::Zero(n, equation.size());
  MatrixXd matrix = MatrixXd::Identity(rows(stages), rows(stages));
  MatrixXd explicit_part(rows(stages), equation.size());
  for (std::size_t k = 0; k < stages; ++k) {
    for (std::size_t l = 0; l < stages; ++l) {
      matrix.block(rows(k), rows(l), n, n) -=
          h * (kA[k][l] * acceleration.middleCols(n, n) + h * kAA[k][l] * acceleration.leftCols(n));
    }
    explicit_part.middleRows(rows(k), n) =
        acceleration * equation.stage(h * kNodes[k] * velocity, none, h * kNodes[k]);
  }
  const MatrixXd a = Lu(matrix).solve(explicit_part);
  MatrixXd dq = h * velocity;
  MatrixXd dv = none;
  MatrixXd work = MatrixXd::Zero(equation.size(), equation.size());
  for (std::size_t k = 0; k < stages; ++k) {
    dv += h * Tableau::kWeights[k] * a.middleRows(rows(k), n);
    dq += h * h * Tableau::kWeights[k] * (1.0 - kNodes[k]) * a.middleRows(rows(k), n);
    MatrixXd stage_dq = h * kNodes[k] * velocity;
    MatrixXd stage_dv = none;
    for (std::size_t j = 0; j < stages; ++j) {
      stage_dq += h * h * kAA[k][j] * a.middleRows(rows(j), n);
      stage_dv += h * kA[k][j] * a.middleRows(rows(j), n);
    }
    const MatrixXd stage = equation.stage(stage_dq, stage_dv, kNodes[k] * h);
    work += h * Tableau::kWeights[k] * powerAt(equation, stage);
  }
  return stepMap(dq, dv, work);
}

/// In x = L^T q, L L^T = M, rates over the highest frequency, phasors over the deflection they
/// cause: then the norm of h A is that of frequency times step, whatever the units and the masses.
struct ScaledEquation {
  MatrixXd a, power;        // scaled y' = a y, dh/dt = y^T power y
  MatrixXd scale, unscale;  // scaled y = scale y

  explicit ScaledEquation(const LinearEquation& equation);
  bool finite() const { return scale.allFinite() && unscale.allFinite(); }
  LinearStepMap map(const MatrixXd& increment, const MatrixXd& work, Index dof) const {
    return {(unscale * increment * scale).topRows(2 * dof), scale.transpose() * work * scale};
  }
};

ScaledEquation::ScaledEquation(const LinearEquation& equation) {
  const LinearModel& model = equation.model();
  const Index n = equation.dof();
  const Index size = equation.size();
  const Cholesky mass(model.mass);
  const MatrixXd to_q = mass.solveUpper(MatrixXd::Identity(n, n));  // q = to_q x
  const MatrixXd stiffness = to_q.transpose() * (model.stiffness + model.circulatory) * to_q;
  const MatrixXd damping = to_q.transpose() * (model.damping + model.gyroscopic) * to_q;
  const MatrixXd forcing = to_q.transpose() * equation.forcing();
  const double rate = powerOfTwo(std::sqrt(stiffness.cwiseAbs().maxCoeff()));

  scale = MatrixXd::Zero(size, size);
  unscale = MatrixXd::Zero(size, size);
  scale.topLeftCorner(n, n) = mass.lower().transpose();
  unscale.topLeftCorner(n, n) = to_q;
  scale.block(n, n, n, n) = scale.topLeftCorner(n, n) / rate;
  unscale.block(n, n, n, n) = rate * to_q;
  a = MatrixXd::Zero(size, size);
  a.block(0, n, n, n).diagonal().setConstant(rate);
  a.block(n, 0, n, n) = -stiffness / rate;
  a.block(n, n, n, n) = -damping;
  for (Index k = 0; k < forcing.cols() / 2; ++k) {
    const Index phasor = 2 * n + 2 * k;
    const auto columns = forcing.middleCols(2 * k, 2);
    const double deflection = powerOfTwo(columns.cwiseAbs().maxCoeff() / (rate * rate));
    const Eigen::Matrix2d generator = equation.generator(k);
    // What drives the other without being driven is a slope, and counts in the highest frequency.
    const bool slope = generator(0, 1) != 0.0 && generator(1, 0) == 0.0;
    const Eigen::Vector2d sizes(deflection, slope ? deflection / rate : deflection);
    scale.diagonal().segment(phasor, 2) = sizes;
    unscale.diagonal().segment(phasor, 2) = sizes.cwiseInverse();
    a.block(n, phasor, n, 2) = columns * sizes.cwiseInverse().asDiagonal() / rate;
    a.block(phasor, phasor, 2, 2) =
        sizes.asDiagonal() * generator * sizes.cwiseInverse().asDiagonal();
  }
  power = unscale.transpose() * equation.power() * unscale;
}

LinearStepMap exponential(const LinearEquation& equation, double h) {
  const ScaledEquation scaled(equation);
  if (!(h * scaled.a).allFinite() || !scaled.finite()) {
    return outOfRange(equation);
  }
  return scaled.map(exponentialLessIdentity<Eigen::Dynamic>(MatrixXd(h * scaled.a)),
                    quadraticIntegral<Eigen::Dynamic>(scaled.a, scaled.power, h), equation.dof());
}

using Method = LinearStepMap (*)(const LinearEquation&, double);

const std::vector<std::pair<std::string, Method>>& methods() {
  static const std::vector<std::pair<std::string, Method>> all{
      {SemiImplicitEuler::kName, semiImplicitEuler},
      {VelocityVerlet::kName, velocityVerlet},
      {RungeKutta4::kName, rungeKutta4},
      {DormandPrince8::kName, dormandPrince8},
      {ImplicitMidpoint<1>::kName, gaussLegendre<1>},
      {GaussLegendre4<1>::kName, gaussLegendre<2>},
      {GaussLegendre6<1>::kName, gaussLegendre<3>},
      {Exponential<1>::kName, exponential}};
  return all;
}

}  // namespace

LinearEquation::LinearEquation(const LinearModel& model, const AppliedInputs& inputs)
    : model_(model), inputs_(inputs) {
  for (const HarmonicForce& force : model.forces) {
    const double frequency = std::fabs(force.frequency);
    if (std::find(frequencies_.begin(), frequencies_.end(), frequency) == frequencies_.end()) {
      frequencies_.push_back(frequency);
    }
  }
  const auto phasors = static_cast<Index>(frequencies_.size());
  forcing_.setZero(dof(), 2 * (phasors + inputs.count()));
  for (Index k = 0; k < inputs.count(); ++k) {
    forcing_.col(2 * (phasors + k)) = inputs.directions().col(k);
  }
  for (const HarmonicForce& force : model.forces) {
    const double frequency = std::fabs(force.frequency);
    const double phase = force.frequency < 0.0 ? -force.phase : force.phase;
    const auto place = std::find(frequencies_.begin(), frequencies_.end(), frequency);
    const Index column = 2 * (place - frequencies_.begin());
    forcing_.col(column) += std::cos(phase) * force.amplitude;
    forcing_.col(column + 1) -= std::sin(phase) * force.amplitude;
  }
}

Index LinearEquation::inputColumn(Index k) const {
  return 2 * (dof() + static_cast<Index>(frequencies_.size()) + k);
}

Eigen::Matrix2d LinearEquation::generator(Index pair) const {
  const auto phasors = static_cast<Index>(frequencies_.size());
  if (pair >= phasors) {
    return inputs_.generator(pair - phasors, 1.0);
  }
  const double frequency = frequencies_[static_cast<std::size_t>(pair)];
  Eigen::Matrix2d g;
  g << 0.0, -frequency, frequency, 0.0;
  return g;
}

MatrixXd LinearEquation::velocity() const {
  MatrixXd selection = MatrixXd::Zero(dof(), size());
  selection.middleCols(dof(), dof()).setIdentity();
  return selection;
}

MatrixXd LinearEquation::acceleration() const {
  MatrixXd force(dof(), size());
  force << -(model_.stiffness + model_.circulatory), -(model_.damping + model_.gyroscopic),
      forcing_;
  return Cholesky(model_.mass).solve(force);
}

MatrixXd LinearEquation::power() const {
  const Index n = dof();
  MatrixXd s = MatrixXd::Zero(size(), size());
  s.block(n, n, n, n) = -model_.damping;
  s.block(n, 0, n, n) = -0.5 * model_.circulatory;
  s.block(n, 2 * n, n, forcing_.cols()) = 0.5 * forcing_;
  s.block(0, n, n, n) = s.block(n, 0, n, n).transpose();
  s.block(2 * n, n, forcing_.cols(), n) = s.block(n, 2 * n, n, forcing_.cols()).transpose();
  return s;
}

MatrixXd LinearEquation::stage(const MatrixXd& dq, const MatrixXd& dv, double offset) const {
  MatrixXd z = MatrixXd::Identity(size(), size());
  z.topRows(dof()) += dq;
  z.middleRows(dof(), dof()) += dv;
  for (Index k = 0; k < forcing_.cols() / 2; ++k) {
    const Eigen::Matrix2d g = generator(k);
    const double c = std::cos(g(1, 0) * offset);
    const double s = std::sin(g(1, 0) * offset);
    auto pair = z.block<2, 2>(2 * (dof() + k), 2 * (dof() + k));
    if (g(1, 0) == 0.0) {
      const double decay = -g(1, 1);
      pair(0, 1) = g(0, 1) * (decay == 0.0 ? offset : -std::expm1(-decay * offset) / decay);
      pair(1, 1) = std::exp(-decay * offset);
    } else {
      pair << c, -s, s, c;
    }
  }
  return z;
}

std::vector<LinearStepMap> exactParts(const LinearEquation& equation, std::int64_t longest) {
  const ScaledEquation scaled(equation);
  const double nanosecond = 1e-9;
  const bool finite = equation.acceleration().allFinite() && scaled.finite();
  std::vector<LinearStepMap> parts;
  MatrixXd e = exponentialLessIdentity<Eigen::Dynamic>(MatrixXd(nanosecond * scaled.a));
  MatrixXd w = quadraticIntegral<Eigen::Dynamic>(scaled.a, scaled.power, nanosecond);
  for (std::int64_t length = 1; length <= longest; length *= 2) {
    parts.push_back(finite ? scaled.map(e, w, equation.dof()) : outOfRange(equation));
    twiceAsLong<Eigen::Dynamic>(e, w);
  }
  return parts;
}

const std::vector<std::string>& linearMethodNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& method : methods()) {
      all.push_back(method.first);
    }
    return all;
  }();
  return names;
}

LinearStepMap linearStepMap(const LinearEquation& equation, const std::string& method, double h) {
  const auto found = std::find_if(methods().begin(), methods().end(),
                                  [&](const auto& entry) { return entry.first == method; });
  if (found == methods().end()) {
    throw std::logic_error("unknown integrator of linear systems: " + method);
  }
  return equation.acceleration().allFinite() ? found->second(equation, h) : outOfRange(equation);
}

}  // namespace whirl_twin
