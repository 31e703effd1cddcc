#include "integration/lateral_rotor_stepper.h"

#include <algorithm>
#include <cmath>

#include "integration/sliver.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

namespace {

/// One step in this number is repeated as two half steps.
constexpr int kEstimateEvery = 64;
/// [rad]: stiffer rotors use the table over speed.
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

/// Is energy of the unbalance and the bow another at another angle?
bool energyTurns(const LateralRotor& rotor) {
  constexpr double kRoundingOfForces = 1.0e-9;  // of forces known by their values at right angles
  const auto& e = rotor.eccentricity;
  return rotor.bow_force[0] != 0.0 || rotor.bow_force[1] != 0.0 ||
         std::abs(e[1] + LateralRotor::Complex(0.0, 1.0) * e[0]) >
             kRoundingOfForces * std::abs(e[0]);
}

}  // namespace

std::unique_ptr<Stepper> LateralRotorStepper::of(const LinearRotor& rotor, const Drive& drive,
                                                 double step, int substeps) {
  const std::optional<LateralRotor> lateral = lateralRotor(rotor);
  if (!lateral || !(lateral->fastest() * step < kLongest * substeps)) {
    return nullptr;
  }
#ifdef WHIRL_TWIN_FOUR_WIDE
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    return std::make_unique<ByFours>(*lateral, drive, step, substeps);
  }
#endif
  return std::make_unique<ByTwos>(*lateral, drive, step, substeps);
}

LateralRotorStepper::LateralRotorStepper(const LateralRotor& rotor, const Drive& drive, double step,
                                         int substeps)
    : drive_(drive),
      step_(step),
      exact_(rotor, step),
      run_up_(rotor, step / substeps),
      rotor_(rotor),
      energy_turns_(energyTurns(rotor)),
      substeps_(substeps) {}

/// Separate from the plain step, to keep that function small and fast.
StepStatus LateralRotorStepper::otherStep() noexcept {
  StepStatus status;
  if (steps_since_estimate_ + 1 < kEstimateEvery && run_up_.goesOn(drive_, motion_, status)) {
    ++steps_since_estimate_;
  } else if (drive_.constantFor(step_)) {
    status = exact_.advance(drive_, motion_);
  } else {
    status = changingStep();
  }
  return status == StepStatus::kOk ? status : stopped(status);
}

StepStatus LateralRotorStepper::stopped(StepStatus why) noexcept {
  last_energy_ = furtherEnergy();
  return why;
}

/// In sub-steps if the drive has a breakpoint inside.
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
    // Just after the breakpoint, where the jerk (or acceleration) that follows holds.
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

/// [rad/s], at the drive's begin(): without its angle, where that is not needed.
double LateralRotorStepper::shaftSpeed() const noexcept {
  std::optional<double> speed = exact_.speedAt(drive_);
  if (!speed) {
    speed = run_up_.speedAt(drive_);
  }
  return speed ? *speed : drive_.at(0.0).speed;
}

/// In T the motion of the unbalance, d/dt Re[E e^(i theta)], with the sign that it has in h; in V
/// the bow that is B / k.
double LateralRotorStepper::furtherEnergy() const noexcept {
  const double speed = shaftSpeed();
  if (!energy_turns_) {
    return -0.5 * rotor_.mass * speed * speed * std::norm(rotor_.eccentricity[0]);
  }
  const SineCosine turn = sineCosine(drive_.angle().remainder);
  double energy = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const LateralRotor::Complex e = rotor_.eccentricity[i];
    const LateralRotor::Complex b = rotor_.bow_force[i];
    const double rate = speed * (e.real() * turn.sine + e.imag() * turn.cosine);
    const double pull = b.real() * turn.cosine - b.imag() * turn.sine;
    energy += pull * (0.5 * pull / rotor_.stiffness[i] - motion_.y[i]) - 0.5 * rate * rate;
  }
  return rotor_.mass * energy;
}

void LateralRotorStepper::write(double* out) const noexcept {
  motion(out);
  const double further = last_energy_ ? *last_energy_ : furtherEnergy();
  out[4] = motion_.work.high + (further - further_energy_);
}

void LateralRotorStepper::set(const double* q, const double* v) noexcept {
  motion_ = {};
  motion_.y = {q[0], q[1], v[0], v[1]};
  exact_.restart();
  run_up_.restart();
  last_energy_.reset();
  further_energy_ = furtherEnergy();
  steps_since_estimate_ = 0;
  largest_place_ = largest_rate_ = error_sum_ = 0.0;
}

}  // namespace whirl_twin
