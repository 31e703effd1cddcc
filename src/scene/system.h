// A system that steps: a model, a method and a state, behind one virtual call a step.
#pragma once

#include <cstddef>

#include "integration/motion_state.h"

namespace whirl_twin {

class System {
 public:
  virtual ~System() = default;

  // Real-time safe.

  /// One step of the twin from simulated time `time` [s]. The drive stands at the start of the
  /// step. If the outcome is not kOk the state stays what it was.
  virtual StepStatus step(double time) noexcept = 0;
  virtual std::size_t dof() const noexcept = 0;
  /// Copies q (dof), v (dof) and the audited work [J] (1) to `out`.
  virtual void write(double* out) const noexcept = 0;
  /// Sets q and v and forgets the past.
  virtual void set(const double* q, const double* v) noexcept = 0;
};

}  // namespace whirl_twin
