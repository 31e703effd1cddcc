#include "scene/linear_stepped_system.h"

#include <algorithm>
#include <utility>

#include "integration/linear_methods.h"
#include "scene/finite.h"

namespace whirl_twin {

LinearSteppedSystem::LinearSteppedSystem(const LinearModel& model, const std::string& method,
                                         double step, int substeps)
    : method_(model, method, step / substeps),
      substep_(step / substeps),
      substeps_(substeps),
      state_(model.mass.rows()),
      next_(model.mass.rows()) {}

StepStatus LinearSteppedSystem::step(double time) noexcept {
  next_ = state_;
  for (int i = 0; i < substeps_; ++i) {
    method_.advance(time + i * substep_, next_);
  }
  bool finite = isFinite(next_.work.high);
  for (Eigen::Index i = 0; i < next_.q.size(); ++i) {
    finite = finite && isFinite(next_.q[i]) && isFinite(next_.v[i]);
  }
  if (!finite) {
    return StepStatus::kNotFinite;
  }
  state_ = next_;
  return StepStatus::kOk;
}

void LinearSteppedSystem::write(double* out) const noexcept {
  out = std::copy_n(state_.q.data(), state_.q.size(), out);
  out = std::copy_n(state_.v.data(), state_.v.size(), out);
  *out = state_.work.high;
}

void LinearSteppedSystem::set(const double* q, const double* v) noexcept {
  std::copy_n(q, state_.q.size(), state_.q.data());
  std::copy_n(v, state_.v.size(), state_.v.data());
  state_.q_low.setZero();
  state_.v_low.setZero();
  state_.work = CompensatedSum{};
}

ModelSetup linearSetup(LinearModel model) {
  const auto dynamics = std::make_shared<const LinearDynamics>(std::move(model));
  return {dynamics, linearMethodNames(),
          [dynamics](const std::string& integrator, const Drive&, double step, int substeps) {
            return std::make_unique<LinearSteppedSystem>(dynamics->linearModel(), integrator, step,
                                                         substeps);
          }};
}

}  // namespace whirl_twin
