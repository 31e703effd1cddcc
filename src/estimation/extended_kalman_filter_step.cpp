// Time update of the filter: propagation of motion and covariance.
#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "estimation/extended_kalman_filter.h"

namespace whirl_twin {

namespace {

/// Largest angle of the shaft per step of a linear system: relative error 1^6/2e6 of the force.
constexpr double kMaxTurn = 1.0;  // rad
/// For matrices that change with speed: relative speed difference within which steps are shared.
constexpr double kSameSpeed = 1.0e-3;
/// From sample to sample: beyond it the shaft's speed has diverged, and a vibration is not
/// resolved.
constexpr std::int64_t kMaxSubsteps = 10'000;
/// Bounds the noise of synchronous forces on a shaft at standstill.
constexpr double kMaxPeriod = 1.0;  // s

/// Turns x + i y by an angle.
void turn(Eigen::VectorXd& state, Eigen::Index at, double cosine, double sine) {
  const double x = state[at], y = state[at + 1];
  state[at] = cosine * x - sine * y;
  state[at + 1] = sine * x + cosine * y;
}

}  // namespace

/// Sub-steps of at most the longest step, split at the breakpoints of the inputs; the last one ends
/// there.
std::vector<ShaftInstant> ExtendedKalmanFilter::partsOf(const ShaftInstant& there) const {
  const ShaftPath path(now_, there, to_twin_);
  const std::int64_t all = there.time - now_.time;
  const double turns = std::fmin(std::fabs(path.turned()) / kMaxTurn, kMaxSubsteps);
  const std::int64_t parts = std::min(kMaxSubsteps, model_.system()->dynamics->linear()
                                                        ? static_cast<std::int64_t>(turns) + 1
                                                        : (all + longest_ - 1) / longest_);
  std::vector<std::int64_t> times;
  for (std::int64_t k = 1; k < parts; ++k) {
    times.push_back(now_.time + all / parts * k);
  }
  for (const std::optional<EstimatorInput>& input : measured_inputs_) {
    if (input) {
      input->addCorners(now_.time, there.time, times);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<ShaftInstant> instants;
  for (const std::int64_t time : times) {
    instants.push_back(path.instantAt(time));
  }
  instants.push_back(there);
  return instants;
}

/// The inputs are set to its start.
ShaftPath ExtendedKalmanFilter::pathBetween(const ShaftInstant& from, const ShaftInstant& to) {
  inputs_.begin(from.time + to_twin_);
  return {from, to, to_twin_};
}

/// Sets the rotation of unbalances and run-outs, by an angle [rad].
void ExtendedKalmanFilter::setTurning(double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (Eigen::Index i = unbalance_; i < offset_; i += 2) {
    transition_.block<2, 2>(i, i) << cosine, -sine, sine, cosine;
  }
}

/// Turns unbalances and run-outs by an angle [rad] at once; the motion is unchanged.
void ExtendedKalmanFilter::turnWhatTurns(double angle) {
  const Eigen::Index all = filter_.size();
  transition_.setIdentity(all, all);
  setTurning(angle);
  noise_.setZero(all, all);
  filter_.state() = transition_ * filter_.state();
  filter_.propagate(transition_, noise_);
}

void ExtendedKalmanFilter::resume(const ShaftInstant& there) {
  const ShaftPath path = pathBetween(now_, there);
  if (!held_) {
    model_.follow(numbers());
  }
  if (!stations_.empty()) {
    const Ldlt mass(model_.system()->dynamics->massMatrix(q(), v(), path.at(0.0)));
    station_directions_.resize(n_, 2 * static_cast<Eigen::Index>(stations_.size()));
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(2 * i);
      station_directions_.col(k) = mass.solve(stations_[i].along_x);
      station_directions_.col(k + 1) = mass.solve(stations_[i].along_y);
    }
  }
  Eigen::VectorXd next = moved(filter_.state(), path);
  const Eigen::VectorXd middle = 0.5 * (filter_.state() + next);
  const bool linear = model_.system()->dynamics->linear();
  MotionStep about;  // linearized about its middle, if nonlinear
  if (!linear || m_ > 0) {
    const LocalMotion local = model_.about(middle.head(n_), middle.segment(n_, n_), path.at(0.5),
                                           numbers(), inputsAt(path, 0.5));
    by_parameter_ = local.by_parameter;
    if (linear) {
      // For a shaft that accelerates, the stored step is slightly out of date: correction to first
      // order.
      const KeptStep& kept = stepFor(path);
      next.head(2 * n_) +=
          kept.step.forced * ((local.by_state - kept.by_state) * middle.head(2 * n_));
    } else {
      about = MotionStep(local.by_state, path.duration());
    }
  }
  spread(linear ? stepFor(path).step : about, path);
  filter_.state() = next;
  now_ = there;
}

Eigen::VectorXd ExtendedKalmanFilter::inputsAt(const ShaftPath& path, double part) const {
  const double offset = part * path.duration();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measured_inputs_.size()));
  for (std::size_t i = 0; i < measured_inputs_.size(); ++i) {
    const std::optional<EstimatorInput>& measured = measured_inputs_[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (measured && measured->known()) {
      u[k] = measured->at(path.from(), offset);
    } else if (i < inputs_.count() && inputs_.acts(i)) {
      u[k] = inputs_.value(i, offset);
    }
  }
  return u;
}

/// The state at the end of the path.
Eigen::VectorXd ExtendedKalmanFilter::moved(const Eigen::VectorXd& state, const ShaftPath& path) {
  const Eigen::VectorXd now = numbers();
  const auto acceleration = [&](double part, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    Eigen::VectorXd a =
        model_.acceleration(q, v, path.at(part), now, inputsAt(path, part), by_parameter_);
    if (!stations_.empty()) {
      a += unbalanceColumns(path, part) * state.segment(unbalance_, run_out_ - unbalance_);
    }
    return a;
  };
  const Eigen::VectorXd y = state.head(2 * n_);
  Eigen::VectorXd next = state;
  if (model_.system()->dynamics->linear()) {
    const MotionStep& step = stepFor(path).step;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n_);
    next.head(2 * n_).noalias() = step.states * y;
    for (std::size_t k = 0; k < MotionStep::kNode.size(); ++k) {
      next.head(2 * n_).noalias() += step.node[k] * acceleration(MotionStep::kNode[k], zero, zero);
    }
  } else {
    const double h = path.duration();
    const auto rate = [&](double part, const Eigen::VectorXd& at) {
      Eigen::VectorXd f(2 * n_);
      f.head(n_) = at.tail(n_);
      f.tail(n_) = acceleration(part, at.head(n_), at.tail(n_));
      return f;
    };
    const Eigen::VectorXd k1 = rate(0.0, y);
    const Eigen::VectorXd k2 = rate(0.5, y + 0.5 * h * k1);
    const Eigen::VectorXd k3 = rate(0.5, y + 0.5 * h * k2);
    const Eigen::VectorXd k4 = rate(1.0, y + h * k3);
    next.head(2 * n_) += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  for (Eigen::Index i = unbalance_; i < offset_; i += 2) {
    turn(next, i, std::cos(path.turned()), std::sin(path.turned()));
  }
  return next;
}

/// Of a linear system; a stored step of the same duration and nearly the same speed is reused.
const ExtendedKalmanFilter::KeptStep& ExtendedKalmanFilter::stepFor(const ShaftPath& path) {
  const EvaluationPoint<double> middle = path.at(0.5);
  for (const KeptStep& kept : steps_) {
    if (kept.step.duration == path.duration() && kept.version == model_.version() &&
        std::fabs(middle.speed - kept.speed) <= kSameSpeed * std::fabs(kept.speed)) {
      return kept;
    }
  }
  next_step_ = (next_step_ + 1) % steps_.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n_);
  const LocalMotion local = model_.about(zero, zero, middle, numbers(), inputsAt(path, 0.5));
  steps_[next_step_] = {MotionStep(local.by_state, path.duration()), middle.speed, local.by_state,
                        model_.version()};
  return steps_[next_step_];
}

Eigen::MatrixXd ExtendedKalmanFilter::unbalanceColumns(const ShaftPath& path, double part) const {
  const EvaluationPoint<double> moment = path.at(part);
  const double cosine = std::cos(moment.angle - path.startAngle());
  const double sine = std::sin(moment.angle - path.startAngle());
  // Factor (w^2 - i a) e^(i turn) for x + i y.
  const double w2 = moment.speed * moment.speed, a = moment.acceleration;
  Eigen::Matrix2d load;
  load(0, 0) = w2 * cosine + a * sine;
  load(1, 0) = w2 * sine - a * cosine;
  load(0, 1) = -load(1, 0);
  load(1, 1) = load(0, 0);
  Eigen::MatrixXd columns(n_, station_directions_.cols());
  for (Eigen::Index i = 0; i < columns.cols(); i += 2) {
    columns.middleCols<2>(i).noalias() = station_directions_.middleCols<2>(i) * load;
  }
  return columns;
}

void ExtendedKalmanFilter::spread(const MotionStep& step, const ShaftPath& path) {
  const Eigen::Index all = filter_.size(), s = 2 * n_;
  const double h = path.duration();
  transition_.setIdentity(all, all);
  transition_.topLeftCorner(s, s) = step.states;
  transition_.block(0, s, s, m_).noalias() = step.forced * by_parameter_;
  for (std::size_t k = 0; k < MotionStep::kNode.size() && !stations_.empty(); ++k) {
    transition_.block(0, unbalance_, s, run_out_ - unbalance_).noalias() +=
        step.node[k] * unbalanceColumns(path, MotionStep::kNode[k]);
  }
  setTurning(path.turned());
  noise_.setZero(all, all);
  noise_.topLeftCorner(s, s) = settings_.disturbance * settings_.disturbance * step.noise;
  Eigen::MatrixXd unknown = inputNoise(path);
  if (by_probes_) {
    unknown += turningNoise(path);
  }
  if (!unknown.isZero(0.0)) {
    noise_.topLeftCorner(s, s) += step.noiseOf(unknown);
  }
  for (Eigen::Index i = 0; i < m_; ++i) {
    const EstimatorNumber& number = settings_.parameters[static_cast<std::size_t>(i)].number;
    // No random walk beyond the initial uncertainty: without information on a parameter its
    // covariance does not wind up.
    if (filter_.deviation(s + i) < number.deviation) {
      noise_(s + i, s + i) = number.walk * number.walk * h;
    }
  }
  const double walk = settings_.unbalance.walk;
  if (walk > 0.0) {
    // A random walk within the step acts for part of it: 1/2 of the rate and 1/3 of the
    // displacement due to a constant force.
    const Eigen::Index unbalances = run_out_ - unbalance_;
    auto acted = noise_.block(0, unbalance_, s, unbalances);
    acted = walk * walk * h * transition_.block(0, unbalance_, s, unbalances);
    acted.topRows(n_) /= 3.0;
    acted.bottomRows(n_) /= 2.0;
    noise_.block(unbalance_, 0, unbalances, s) = acted.transpose();
    noise_.diagonal().segment(unbalance_, unbalances).setConstant(walk * walk * h);
  }
  filter_.propagate(transition_, noise_);
  if (by_probes_) {
    filter_.separate(unbalance_, offset_ - unbalance_);
  }
}

/// White noise [n x n, (m/s^2)^2/Hz] equivalent to synchronous forces at an unknown angle, each
/// constant for a turn. The factor 2: the assumed angle is as uncertain as the true one.
Eigen::MatrixXd ExtendedKalmanFilter::turningNoise(const ShaftPath& path) {
  constexpr Eigen::Index kAngles = 4;
  EvaluationPoint<double> moment = path.at(0.5);
  Eigen::VectorXd turned = filter_.state();
  Eigen::MatrixXd a(n_, kAngles);
  for (Eigen::Index k = 0; k < kAngles; ++k) {
    a.col(k) = model_.acceleration(q(), v(), moment, numbers(), inputsAt(path, 0.5), by_parameter_);
    if (!stations_.empty()) {
      a.col(k) += unbalanceColumns(path, 0.5) * turned.segment(unbalance_, run_out_ - unbalance_);
    }
    moment.angle += ShaftAngle::kTurn / kAngles;
    for (Eigen::Index i = unbalance_; i < run_out_; i += 2) {
      turn(turned, i, 0.0, 1.0);
    }
  }
  a.colwise() -= a.rowwise().mean().eval();
  const double period = std::min(ShaftAngle::kTurn / std::fabs(moment.speed), kMaxPeriod);
  return 2.0 * period / kAngles * a * a.transpose();
}

/// White accelerations due to the noise of measured inputs [n x n, (m/s^2)^2/Hz].
Eigen::MatrixXd ExtendedKalmanFilter::inputNoise(const ShaftPath& path) const {
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(n_, n_);
  Eigen::MatrixXd by_input;
  for (std::size_t i = 0; i < measured_inputs_.size(); ++i) {
    const double density = measured_inputs_[i] ? measured_inputs_[i]->noiseDensity() : 0.0;
    if (density > 0.0) {
      if (by_input.size() == 0) {
        by_input = model_.byInput(q(), v(), path.at(0.5));
      }
      const auto column = by_input.col(static_cast<Eigen::Index>(i));
      noise += density * column * column.transpose();
    }
  }
  return noise;
}

}  // namespace whirl_twin
