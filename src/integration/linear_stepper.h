// A linear system given by its matrices, stepped by any of the methods for such.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "integration/applied_inputs.h"
#include "integration/motion_state.h"
#include "integration/packed_matrix.h"
#include "integration/step_error_sum.h"
#include "integration/step_parts.h"
#include "integration/stepper.h"
#include "mechanics/force_inline.h"
#include "mechanics/linear_dynamics.h"
#include "realtime/state_image.h"

namespace whirl_twin {

// Steps of a linear system of any number of coordinates, M q'' + (C+G) q' + (K+N) q = f(t), at a
// constant step h.
//
// Every method here is itself linear: with y = (q, v, cos w_k t, sin w_k t) for every frequency w_k
// of the forces, a step is
//   (dq, dv) = B y,      work done by and lost from the system = y^T W y,
// and the methods differ only in B and W, computed once. The methods are those of
// semi_implicit_euler.h, velocity_verlet.h, runge_kutta_4.h, dormand_prince_8.h and
// gauss_legendre.h (implicit_midpoint, gauss_legendre_4 and gauss_legendre_6), equal to them up to
// rounding; the work is the method's quadrature of dh/dt, which for the last three is exactly the
// change of h = T + V. `exponential` has no truncation error: B = e^(A h) - I and W = integral of
// e^(A't) S e^(At), y' = A y, dh/dt = y^T S y; so it is exact for any step, at undamped resonance,
// with rigid-body modes and with unstable ones. The phasors are computed from the time at every
// step, so that no phase error accumulates.
//
// Inputs are columns, too (applied_inputs.h). A step with a breakpoint of an input inside is
// divided into sub-steps of 2^k nanoseconds with exact maps, for any method: any instant is a sum
// of such sub-steps. These maps are prepared for tables only.

/// The state of n coordinates, each number as a compensated sum (motion_state.h).
struct LinearMotion {
  explicit LinearMotion(Eigen::Index n);

  Eigen::Index dof() const { return state.size() / 2; }
  auto q() const { return state.head(dof()); }  ///< [rad] or [m]
  auto v() const { return state.tail(dof()); }  ///< their rates
  auto q() { return state.head(dof()); }
  auto v() { return state.tail(dof()); }

  // Real-time safe.
  void set(const double* position, const double* rate) noexcept;  ///< n numbers each
  void advance(const double* increment, double energy) noexcept;  ///< 2 n, those of q first
  void exchange(StateImage& image) noexcept { image(state, low, work); }

  Eigen::VectorXd state;  ///< q and below it v: one loop goes through both
  Eigen::VectorXd low;    ///< of it
  CompensatedSum work;    ///< [J], integral of dh/dt
};

class LinearStep {
 public:
  /// Prepares steps of h [s]; for n coordinates that takes a time of order n^3. Throws
  /// std::logic_error for a method that is not among linearMethodNames().
  LinearStep(const LinearModel& model, const std::string& method, double h,
             const AppliedInputs& inputs = {});

  /// Advances by h from time [s], with inputs whose begin() is `offset` [s] before it and that have
  /// no breakpoint in the step. Real-time safe. A state beyond the range of doubles becomes
  /// infinite or NaN.
  void advance(double time, LinearMotion& motion, double offset = 0.0) noexcept;
  /// Advances from one instant to another, both in [ns] after the begin() of the inputs at `time`
  /// [s], across any of their breakpoints. Real-time safe; they must be tables.
  void advanceInParts(double time, std::int64_t from, std::int64_t to,
                      LinearMotion& motion) noexcept;

 private:
  WHIRL_TWIN_INLINE void apply(PackedMatrix& map, double time, double offset, std::int64_t piece,
                               LinearMotion& motion) noexcept;

  Eigen::Index n_;
  AppliedInputs inputs_;
  std::vector<double> frequencies_;  ///< [rad/s], of the phasors
  PackedMatrix map_;                 ///< B and W
  std::vector<PackedMatrix> parts_;  ///< of 1, 2, 4 ... ns
  Eigen::VectorXd y_;                ///< q, v, the phasors and the inputs
  Eigen::VectorXd result_;           ///< map_ y
};

/// Is every number of a motion finite? Real-time safe.
bool isFinite(const LinearMotion& motion) noexcept;
/// q, v and the work, one after the other. Real-time safe.
void write(const LinearMotion& motion, double* out) noexcept;

/// The directions of the inputs as columns [n x m].
Eigen::MatrixXd directionsOf(const std::vector<InputInfo>& inputs, Eigen::Index n);

class LinearStepper final : public Stepper {
 public:
  /// step [s] of the twin, made of `substeps` steps of one of linearMethodNames(). `inputs`, those
  /// of the model, outlive it; nullptr: nothing acts.
  LinearStepper(const LinearModel& model, const std::string& method, double step, int substeps,
                const Inputs* inputs = nullptr);

  StepStatus step(double time) noexcept override;
  /// Exact for any method.
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override;
  std::size_t dof() const noexcept override { return static_cast<std::size_t>(state_.dof()); }
  void motion(double* out) const noexcept override;
  void write(double* out) const noexcept override;
  double errorSum() const noexcept override { return errors_.sum(); }
  void set(const double* q, const double* v) noexcept override;
  void exchange(StateImage& image) noexcept override { image(state_, errors_); }

 private:
  void estimateError(double time) noexcept;

  AppliedInputs inputs_;
  LinearStep method_;
  LinearStep halves_;  ///< of half the length
  StepParts<LinearStep> parts_;
  double substep_;  ///< [s]
  int substeps_;
  std::int64_t step_;  ///< [ns], of the twin
  LinearMotion state_;
  LinearMotion next_;
  LinearMotion finer_;         ///< next_, by halves
  std::vector<char> angular_;  ///< of each coordinate
  StepErrorSum errors_{kLinearErrorEvery};
};

}  // namespace whirl_twin
