#include "integration/linear_stepper.h"

#include <algorithm>
#include <utility>

#include "integration/finite.h"

namespace whirl_twin {

bool isFinite(const LinearMotion& motion) noexcept {
  // What is not finite makes its sum so.
  return isFinite(motion.work.high + motion.q.sum() + motion.v.sum());
}

void write(const LinearMotion& motion, double* out) noexcept {
  out = std::copy_n(motion.q.data(), motion.q.size(), out);
  out = std::copy_n(motion.v.data(), motion.v.size(), out);
  *out = motion.work.high;
}

LinearStepper::LinearStepper(const LinearModel& model, const std::string& method, double step,
                             int substeps)
    : method_(model, method, step / substeps),
      substep_(step / substeps),
      substeps_(substeps),
      state_(model.mass.rows()),
      next_(model.mass.rows()) {}

StepStatus LinearStepper::step(double time) noexcept {
  next_ = state_;
  for (int i = 0; i < substeps_; ++i) {
    method_.advance(time + i * substep_, next_);
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  std::swap(state_, next_);
  return StepStatus::kOk;
}

void LinearStepper::write(double* out) const noexcept {
  whirl_twin::write(state_, out);
}

void LinearStepper::set(const double* q, const double* v) noexcept {
  state_.set(q, v);
}

}  // namespace whirl_twin
