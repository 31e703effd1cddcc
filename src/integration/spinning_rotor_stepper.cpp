#include "integration/spinning_rotor_stepper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "integration/linear_stepper.h"

namespace whirl_twin {

namespace {

constexpr double kMaxStart = 0x1p53 * ShaftAngle::kTurn;  // beyond it no angle has a phase

RotorForcing forcingOf(const SpinningRotor& dynamics, const Inputs* inputs) {
  RotorForcing forcing;
  const Eigen::Index n = dynamics.held().dof();
  forcing.inputs = inputs;
  forcing.directions = directionsOf(dynamics.inputs(), n + 1).topRows(n);
  forcing.forces = dynamics.forces();
  forcing.spin = &dynamics.coupling();
  forcing.torque = static_cast<std::size_t>(forcing.directions.cols()) - 1;
  return forcing;
}

bool finite(const LinearMotion& motion, const SpinMotion& spin) noexcept {
  return isFinite(motion) && std::isfinite(spin.speed.high) && std::isfinite(spin.angle.high);
}

}  // namespace

SpinningRotorStepper::SpinningRotorStepper(std::shared_ptr<const SpinningRotor> dynamics,
                                           const StepContext& excitation, double step, int substeps,
                                           const std::pair<double, double>& speeds)
    : dynamics_(std::move(dynamics)),
      step_(step),
      substeps_(substeps),
      forcing_(forcingOf(*dynamics_, excitation.inputs)),
      method_(dynamics_->held().linearRotor(), step / substeps, speeds, {}, forcing_),
      halves_(dynamics_->held().linearRotor(), 0.5 * step / substeps, speeds, {}, forcing_),
      parts_(excitation.inputs,
             [&](double length) {
               return ForcedRotorStep(dynamics_->held().linearRotor(), length, speeds, {},
                                      forcing_);
             }),
      free_(dynamics_->held().linearRotor(), dynamics_->coupling(), step),
      state_(dynamics_->held().dof()),
      next_(state_.dof()),
      finer_(state_.dof()),
      start_rates_(dof()),
      taken_(2 * dof()),
      in_halves_(2 * dof()) {
  for (const CoordinateInfo& c : dynamics_->coordinates()) {
    angular_.push_back(c.isAngle());
  }
}

StepStatus SpinningRotorStepper::step(double) noexcept {
  next_ = state_;
  next_spin_ = spin_;
  if (!finite(state_, spin_)) {
    return StepStatus::kNotFinite;
  }
  if (std::fabs(spin_.angle.high) > 2.0 * ShaftAngle::kTurn) {
    return StepStatus::kOutOfRange;
  }
  const double h = step_ / substeps_;
  for (int i = 0; i < substeps_; ++i) {
    const StepStatus status = method_.advance(i * h, next_spin_, next_);
    if (status != StepStatus::kOk) {
      return finite(state_, spin_) ? status : StepStatus::kNotFinite;
    }
  }
  if (!finite(next_, next_spin_)) {
    return StepStatus::kNotFinite;
  }
  if (errors_.countStep()) {
    estimateError();
  }
  std::swap(state_, next_);
  spin_ = next_spin_;
  return StepStatus::kOk;
}

StepStatus SpinningRotorStepper::stepPart(double, std::int64_t from, std::int64_t to) noexcept {
  next_ = state_;
  next_spin_ = spin_;
  const StepStatus status =
      parts_.advance(from, to, [&](ForcedRotorStep& part, double offset, double) {
        part.restart();
        return part.advance(offset, next_spin_, next_);
      });
  if (status != StepStatus::kOk) {
    return status;
  }
  if (!finite(next_, next_spin_)) {
    return StepStatus::kNotFinite;
  }
  std::swap(state_, next_);
  spin_ = next_spin_;
  return StepStatus::kOk;
}

/// Repeats the step from state_ to next_ as two half steps.
void SpinningRotorStepper::estimateError() noexcept {
  finer_ = state_;
  finer_spin_ = spin_;
  halves_.restart();
  const double h = 0.5 * (step_ / substeps_);
  for (int i = 0; i < 2 * substeps_; ++i) {
    if (halves_.advance(i * h, finer_spin_, finer_) != StepStatus::kOk) {
      errors_.passOver();
      return;
    }
  }
  // Of the coordinates and of the spin: the error of the rates of stiff modes oscillates within a
  // step. Angles are compared by their remainders, as turns are whole numbers.
  const std::size_t n = dof();
  const auto put = [&](const LinearMotion& motion, double angle, double speed, double* out) {
    std::copy_n(motion.q().data(), n - 1, out);
    std::copy_n(next_.v().data(), n - 1, out + n);
    out[n - 1] = angle;
    out[2 * n - 1] = speed;
  };
  const auto turns = static_cast<double>(finer_spin_.turns - next_spin_.turns);
  put(next_, next_spin_.angle.high, next_spin_.speed.high, taken_.data());
  put(finer_, finer_spin_.angle.high + ShaftAngle::kTurn * turns, finer_spin_.speed.high,
      in_halves_.data());
  std::copy_n(state_.v().data(), n - 1, start_rates_.data());
  start_rates_[n - 1] = spin_.speed.high;
  errors_.add(n, step_, start_rates_.data(), taken_.data(), taken_.data() + n, in_halves_.data(),
              in_halves_.data() + n, [&](std::size_t i) { return angular_[i] != 0; });
}

void SpinningRotorStepper::motion(double* out) const noexcept {
  const std::size_t n = dof();
  std::copy_n(state_.q().data(), n - 1, out);
  std::copy_n(state_.v().data(), n - 1, out + n);
  out[n - 1] = spin_.shaftAngle().total();
  out[2 * n - 1] = spin_.speed.high;
}

void SpinningRotorStepper::write(double* out) const noexcept {
  motion(out);
  out[2 * dof()] = state_.work.high;
}

void SpinningRotorStepper::set(const double* q, const double* v) noexcept {
  const std::size_t n = dof();
  state_.set(q, v);
  const double angle = q[n - 1];
  const bool has_phase = std::isfinite(angle) && std::fabs(angle) < kMaxStart;
  spin_.set(has_phase ? angle : 0.0, v[n - 1], free_.freeAcceleration(v[n - 1]));
  if (!has_phase) {
    spin_.angle.high = angle;  // no step continues from there
  }
  method_.restart();
  errors_.restart();
}

}  // namespace whirl_twin
