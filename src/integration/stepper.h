// A system that steps: a model, a method and a state, behind one virtual call a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "control/shaft_angle.h"
#include "integration/motion_state.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// A shaft whose motion is a system's own.
struct ShaftState {
  ShaftAngle angle;
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s^2]
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Of a system that must prepare for the speeds of its shaft [rad/s] and is not ready for all
  /// from lowest_speed to highest_speed: one that is, its state yet to be set. nullptr: it is
  /// ready. Not real-time safe: called by another thread while the system steps, it reads only what
  /// steps do not change, and not the drive.
  virtual std::unique_ptr<Stepper> readyFor(double /*lowest_speed*/,
                                            double /*highest_speed*/) const {
    return nullptr;
  }

  // Real-time safe.

  /// One step of the twin from simulated time `time` [s]. The drive is at the start of the step. If
  /// the result is not kOk the state is unchanged.
  virtual StepStatus step(double time) noexcept = 0;
  /// A part of that step, from one instant to another, both [ns] after its start: between two
  /// instants at which controllers act (Inputs::parts()). Parts come in order and make up the step.
  virtual StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept = 0;
  virtual std::size_t dof() const noexcept = 0;
  /// Copies q (dof) and v (dof) to `out`.
  virtual void motion(double* out) const noexcept = 0;
  /// Copies q (dof), v (dof) and the audited work [J] (1) to `out`.
  virtual void write(double* out) const noexcept = 0;
  /// The shaft that a motor turns, whose angle is a coordinate; false: there is none.
  virtual bool shaft(ShaftState& /*out*/) const noexcept { return false; }
  /// What the method has got wrong since the state was set: the sum of the errors of its steps, in
  /// parts of the largest coordinates and rates so far, from a sample of them. NaN: not estimated.
  virtual double errorSum() const noexcept { return std::numeric_limits<double>::quiet_NaN(); }
  /// Sets q and v and discards the history.
  virtual void set(const double* q, const double* v) noexcept = 0;
  /// Serializes all state that its next steps depend on, except construction arguments, drive and
  /// inputs.
  virtual void exchange(StateImage& image) noexcept = 0;
};

}  // namespace whirl_twin
