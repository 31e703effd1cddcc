#include "integration/linear_rotor_stepper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "integration/linear_stepper.h"

namespace whirl_twin {

namespace {

/// Coordinates up to which steps of further lengths cost little to prepare.
constexpr int kMaxStarted = 8;
/// Of a step, its first part.
constexpr double kFirstPart = 1.0 / 32.0;

}  // namespace

LinearRotorStepper::LinearRotorStepper(std::shared_ptr<const Dynamics> dynamics,
                                       JacobiIntegral jacobi, const StepContext& excitation,
                                       double step, int substeps, std::vector<LocalForce> forces)
    : LinearRotorStepper(std::move(dynamics), std::move(jacobi), excitation, step, substeps,
                         excitation.drive.speedRange(), excitation.drive.constantSpeeds(),
                         std::move(forces)) {}

LinearRotorStepper::LinearRotorStepper(std::shared_ptr<const Dynamics> dynamics,
                                       JacobiIntegral jacobi, const StepContext& excitation,
                                       double step, int substeps,
                                       const std::pair<double, double>& speeds,
                                       std::vector<double> constant_speeds,
                                       std::vector<LocalForce> forces)
    : dynamics_(std::move(dynamics)),
      jacobi_(std::move(jacobi)),
      excitation_(excitation),
      step_(step),
      substeps_(substeps),
      constant_speeds_(std::move(constant_speeds)),
      audited_(dynamics_->linearRotor().matrices(speeds.first)),
      load_(dynamics_->linearRotor().load),
      forcing_{excitation.inputs, directionsOf(dynamics_->inputs(), dynamics_->dof()),
               std::move(forces)},
      method_(dynamics_->linearRotor(), step / substeps, speeds, constant_speeds_, forcing_),
      halves_(dynamics_->linearRotor(), 0.5 * step / substeps, speeds, constant_speeds_, forcing_),
      parts_(excitation.inputs,
             [&](double length) {
               return ForcedRotorStep(dynamics_->linearRotor(), length, speeds, constant_speeds_,
                                      forcing_);
             }),
      state_(dynamics_->dof()),
      next_(dynamics_->dof()),
      finer_(dynamics_->dof()) {
  for (double part = kFirstPart;
       !forcing_.forces.empty() && dynamics_->dof() <= kMaxStarted && part < 0.5; part *= 2.0) {
    starting_.emplace_back(dynamics_->linearRotor(), part * step / substeps, speeds,
                           constant_speeds_, forcing_);
  }
  for (const CoordinateInfo& c : dynamics_->coordinates()) {
    angular_.push_back(c.isAngle());
  }
}

/// The dynamics' Jacobi integral less T + V of the matrices.
double LinearRotorStepper::furtherEnergy() const noexcept {
  if (!jacobi_) {
    return 0.0;
  }
  const ShaftMotion shaft = excitation_.drive.at(0.0);
  double energy = jacobi_(state_.q().data(), state_.v().data(),
                          {0.0, shaft.angle, shaft.speed, shaft.acceleration});
  const auto q = state_.q();
  const auto v = state_.v();
  for (Eigen::Index i = 0; i < state_.dof(); ++i) {
    energy -= 0.5 * v[i] * audited_.mass.col(i).dot(v) +
              0.5 * q[i] * audited_.stiffness.col(i).dot(q) - load_[i] * q[i];
  }
  return energy;
}

std::int64_t LinearRotorStepper::nextCorner(std::int64_t offset) const noexcept {
  return excitation_.inputs == nullptr ? Inputs::kNever : excitation_.inputs->nextCorner(offset);
}

StepStatus LinearRotorStepper::step(double) noexcept {
  next_ = state_;
  bool corner = false;
  const std::int64_t next_corner = nextCorner(0);
  std::int64_t length = 0;
  if (next_corner != Inputs::kNever) {
    length = std::llround(step_ * 1e9);
    corner = next_corner < length;
  }
  if (!corner || !method_.advanceInParts(excitation_.drive, 0, length, next_)) {
    for (int i = 0; i < substeps_; ++i) {
      const double h = step_ / substeps_;
      const StepStatus status = i == 0 && at_start_ && !starting_.empty()
                                    ? startingStep()
                                    : method_.advance(excitation_.drive, i * h, next_);
      if (status != StepStatus::kOk) {
        return isFinite(state_) ? status : StepStatus::kNotFinite;
      }
    }
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  if (errors_.countStep()) {
    if (corner) {
      errors_.passOver();
    } else {
      estimateError();
    }
  }
  std::swap(state_, next_);
  at_start_ = false;
  return StepStatus::kOk;
}

/// A step in parts that double: a motion that begins anywhere comes to the slow one that stiff
/// forces leave it within the first of them, and a whole step would not see how.
StepStatus LinearRotorStepper::startingStep() noexcept {
  const Drive& drive = excitation_.drive;
  const double h = step_ / substeps_;
  starting_.front().restart();
  StepStatus status = starting_.front().advance(drive, 0.0, next_);
  double offset = kFirstPart * h;
  for (std::size_t i = 0; i < starting_.size() && status == StepStatus::kOk; ++i, offset *= 2.0) {
    starting_[i].restart();
    status = starting_[i].advance(drive, offset, next_);
  }
  halves_.restart();
  return status == StepStatus::kOk ? halves_.advance(drive, offset, next_) : status;
}

StepStatus LinearRotorStepper::stepPart(double, std::int64_t from, std::int64_t to) noexcept {
  next_ = state_;
  if (!(nextCorner(from) < to && method_.advanceInParts(excitation_.drive, from, to, next_))) {
    const StepStatus status =
        parts_.advance(from, to, [&](ForcedRotorStep& part, double offset, double) {
          part.restart();
          return part.advance(excitation_.drive, offset, next_);
        });
    if (status != StepStatus::kOk) {
      return isFinite(state_) ? status : StepStatus::kNotFinite;
    }
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  std::swap(state_, next_);
  at_start_ = false;
  return StepStatus::kOk;
}

/// Repeats the step from state_ to next_ as two half steps.
void LinearRotorStepper::estimateError() noexcept {
  finer_ = state_;
  halves_.restart();
  const double h = 0.5 * (step_ / substeps_);
  for (int i = 0; i < 2 * substeps_; ++i) {
    if (halves_.advance(excitation_.drive, i * h, finer_) != StepStatus::kOk) {
      errors_.passOver();
      return;
    }
  }
  // Of the coordinates: the error of the rates of stiff modes oscillates within a step.
  errors_.add(dof(), step_, state_.v().data(), next_.q().data(), next_.v().data(),
              finer_.q().data(), next_.v().data(), [&](std::size_t i) { return angular_[i] != 0; });
}

void LinearRotorStepper::motion(double* out) const noexcept {
  std::copy_n(state_.state.data(), state_.state.size(), out);
}

void LinearRotorStepper::write(double* out) const noexcept {
  whirl_twin::write(state_, out);
  out[2 * dof()] += furtherEnergy() - further_energy_;
}

void LinearRotorStepper::set(const double* q, const double* v) noexcept {
  state_.set(q, v);
  method_.restart();
  at_start_ = true;
  errors_.restart();
  further_energy_ = furtherEnergy();
}

std::unique_ptr<Stepper> LinearRotorStepper::readyFor(double lowest_speed,
                                                      double highest_speed) const {
  std::vector<double> constant_speeds = constant_speeds_;
  for (const double speed : {lowest_speed, highest_speed}) {
    if (std::find(constant_speeds.begin(), constant_speeds.end(), speed) == constant_speeds.end()) {
      constant_speeds.push_back(speed);
    }
  }
  const bool covered =
      method_.lowestSpeed() <= lowest_speed && method_.highestSpeed() >= highest_speed;
  if (covered && constant_speeds.size() == constant_speeds_.size()) {
    return nullptr;
  }
  const std::pair<double, double> speeds{std::min(lowest_speed, method_.lowestSpeed()),
                                         std::max(highest_speed, method_.highestSpeed())};
  return std::unique_ptr<Stepper>(
      new LinearRotorStepper(dynamics_, jacobi_, excitation_, step_, substeps_, speeds,
                             std::move(constant_speeds), forcing_.forces));
}

}  // namespace whirl_twin
