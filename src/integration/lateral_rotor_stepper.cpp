#include "integration/lateral_rotor_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {

namespace {

/// Parts shorter than this share of a step are rounding.
constexpr double kSliver = 1.0e-12;
/// One step in so many is taken twice, the second time in halves.
constexpr int kEstimateEvery = 64;
/// [rad]: stiffer rotors go by the table over speed.
constexpr double kLongest = 640.0;

class ByTwos final : public LateralRotorStepper {
 public:
  using LateralRotorStepper::LateralRotorStepper;
  StepStatus step(double) noexcept override { return take<2>(); }
};

#if defined(__x86_64__) && !defined(__clang__)
#define WHIRL_TWIN_FOUR_WIDE
class ByFours final : public LateralRotorStepper {
 public:
  using LateralRotorStepper::LateralRotorStepper;
  [[gnu::target("avx2,fma")]] StepStatus step(double) noexcept override { return take<4>(); }
};
#endif

}  // namespace

std::unique_ptr<Stepper> LateralRotorStepper::of(const LinearRotor& rotor, JacobiIntegral jacobi,
                                                 const Drive& drive, double step, int substeps) {
  const std::optional<LateralRotor> lateral = lateralRotor(rotor);
  if (!lateral || !(lateral->fastest() * step < kLongest * substeps)) {
    return nullptr;
  }
#ifdef WHIRL_TWIN_FOUR_WIDE
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    return std::make_unique<ByFours>(*lateral, std::move(jacobi), drive, step, substeps);
  }
#endif
  return std::make_unique<ByTwos>(*lateral, std::move(jacobi), drive, step, substeps);
}

LateralRotorStepper::LateralRotorStepper(const LateralRotor& rotor, JacobiIntegral jacobi,
                                         const Drive& drive, double step, int substeps)
    : drive_(drive),
      step_(step),
      exact_(rotor, step),
      run_up_(rotor, step / substeps),
      rotor_(rotor),
      jacobi_(std::move(jacobi)),
      substeps_(substeps) {}

StepStatus LateralRotorStepper::otherStep() noexcept {
  StepStatus status;
  if (drive_.constantFor(step_)) {
    const ShaftMotion shaft = drive_.at(0.0);
    status = exact_.advance(shaft.angle, shaft.speed, motion_);
  } else {
    status = changingStep();
  }
  return status == StepStatus::kOk ? status : stopped(status);
}

StepStatus LateralRotorStepper::stopped(StepStatus why) noexcept {
  last_energy_ = furtherEnergy();
  return why;
}

/// In parts where the drive has a corner inside.
StepStatus LateralRotorStepper::advance(double offset, double h, LateralMotion& motion) noexcept {
  const double sliver = kSliver * h;
  const double end = offset + h;
  if (drive_.nextCorner(offset) >= end - sliver) {
    return run_up_.advance(drive_, offset, h, motion);
  }
  StepStatus status = StepStatus::kOk;
  while (status == StepStatus::kOk && end - offset > sliver) {
    const double next = drive_.nextCorner(offset);
    const double corner = next < end - sliver ? next : end;
    if (corner - offset > sliver) {
      status = run_up_.advance(drive_, offset, corner - offset, motion);
    }
    // Just behind the corner, where the jerk (or acceleration) that follows holds.
    offset = std::nextafter(corner, 2.0 * end);
  }
  return status;
}

StepStatus LateralRotorStepper::changingStep() noexcept {
  exact_.restart();
  const double h = step_ / substeps_;
  LateralMotion next = motion_;
  for (int i = 0; i < substeps_; ++i) {
    const StepStatus status = advance(i * h, h, next);
    if (status != StepStatus::kOk) {
      return status;
    }
  }
  if (!isFinite(next)) {
    return StepStatus::kNotFinite;
  }
  if (++steps_since_estimate_ == kEstimateEvery) {
    steps_since_estimate_ = 0;
    estimateError(next);
  }
  motion_ = next;
  return StepStatus::kOk;
}

/// How far two steps of half the length come out from one.
void LateralRotorStepper::estimateError(const LateralMotion& end) noexcept {
  LateralMotion finer = motion_;
  const double h = 0.5 * step_ / substeps_;
  for (int i = 0; i < 2 * substeps_; ++i) {
    if (advance(i * h, h, finer) != StepStatus::kOk) {
      return;
    }
  }
  const auto off = [&](std::size_t first, double& largest) {
    double error = 0.0;
    for (std::size_t i = first; i < first + 2; ++i) {
      largest = std::fmax(largest, std::fabs(end.y[i]));
      error = std::fmax(error, std::fabs((end.y[i] - finer.y[i]) + (end.low[i] - finer.low[i])));
    }
    return error == 0.0 ? 0.0 : error / largest;
  };
  const double places = off(0, largest_place_);
  const double rates = off(2, largest_rate_);
  error_sum_ += kEstimateEvery * std::fmax(places, rates);
}

/// The Jacobi integral less T + V of the matrices. Both have the same in the rates: those are left
/// out, for they would only cancel.
double LateralRotorStepper::furtherEnergy() const noexcept {
  if (!jacobi_) {
    return 0.0;
  }
  constexpr std::array<double, 2> kAtRest{};
  const ShaftMotion shaft = drive_.at(0.0);
  const std::array<double, 4>& y = motion_.y;
  double energy =
      jacobi_(y.data(), kAtRest.data(), {0.0, shaft.angle, shaft.speed, shaft.acceleration});
  for (std::size_t i = 0; i < 2; ++i) {
    energy -= rotor_.mass * y[i] * (0.5 * rotor_.stiffness[i] * y[i] - rotor_.load[i]);
  }
  return isFinite(energy) ? energy : further_energy_;  // lost beside energies beyond all range
}

void LateralRotorStepper::write(double* out) const noexcept {
  std::copy(motion_.y.begin(), motion_.y.end(), out);
  const double further = last_energy_ ? *last_energy_ : furtherEnergy();
  out[4] = motion_.work.high + (further - further_energy_);
}

void LateralRotorStepper::set(const double* q, const double* v) noexcept {
  motion_ = {};
  motion_.y = {q[0], q[1], v[0], v[1]};
  exact_.restart();
  last_energy_.reset();
  further_energy_ = furtherEnergy();
  steps_since_estimate_ = 0;
  largest_place_ = largest_rate_ = error_sum_ = 0.0;
}

}  // namespace whirl_twin
