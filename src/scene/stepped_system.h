// Model x method, composed at compile time. Compiled only in the translation units of models/, with
// the flags that let the compiler delete a dual's dead terms; the finiteness check reads bits.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "control/drive.h"
#include "control/shaft_angle.h"
#include "mechanics/dynamics.h"
#include "mechanics/lagrangian.h"
#include "scene/finite.h"
#include "scene/system.h"

namespace whirl_twin {

/// q'' = a(q, v, t) of a model on its drive during one step; offset [s] counts from its start.
template <class Model>
struct DrivenEquation {
  static constexpr std::size_t n = Model::kDof;
  using Array = std::array<double, n>;
  struct Jacobian {
    Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)> by_q, by_v;
  };

  const Model& model;
  const Drive& drive;
  double time;  ///< [s], simulated, at the start of the step

  WHIRL_TWIN_INLINE Moment<double> moment(double offset) const {
    if constexpr (Model::kHasShaft) {
      const ShaftMotion shaft = drive.at(offset);
      return {time + offset, shaft.angle, shaft.speed, shaft.acceleration};
    } else {
      return {time + offset, 0.0, 0.0, 0.0};
    }
  }
  WHIRL_TWIN_INLINE Derivative<n> evaluate(const Array& q, const Array& v,
                                           const Moment<double>& at) const {
    return derivative(model, q, v, at);
  }
  WHIRL_TWIN_INLINE Derivative<n> operator()(const Array& q, const Array& v, double offset) const {
    return evaluate(q, v, moment(offset));
  }
  /// da/dq and da/dv.
  Jacobian jacobian(const Array& q, const Array& v, double offset) const {
    const Moment<double> at = moment(offset);
    const auto l = linearization(model, q, v, derivative(model, q, v, at).acceleration, at);
    // Not mass.inverse(): Eigen's of size four needs signed zeros, which steps are compiled
    // without.
    const auto mass = l.mass.partialPivLu();
    return {-mass.solve(l.stiffness + l.circulatory), -mass.solve(l.damping + l.gyroscopic)};
  }
  /// Is the forcing that of a shaft at one speed? Loads that alternate by themselves are not.
  bool constantSpeed([[maybe_unused]] double duration) const {
    if constexpr (HasAlternatingLoads<Model>::value) {
      return false;
    } else {
      return !Model::kHasShaft || drive.constantFor(duration);
    }
  }
};

/// A shaft whose angle is the coordinate kSpin.
template <class Model, class = void>
struct HasSpin : std::false_type {};
template <class Model>
struct HasSpin<Model, std::void_t<decltype(Model::kSpin)>> : std::true_type {};

template <class Model, class Method>
class SteppedSystem final : public System {
 public:
  static constexpr std::size_t n = Model::kDof;

  /// step [s] of the twin, made of `substeps` steps of the method. The drive outlives the system.
  SteppedSystem(const Model& model, const Drive& drive, double step, int substeps)
      : model_(model), drive_(drive), substep_(step / substeps), substeps_(substeps) {}

  StepStatus step(double time) noexcept override {
    const DrivenEquation<Model> equation{model_, drive_, time};
    MotionState<n> next = state_;
    for (int i = 0; i < substeps_; ++i) {
      const StepStatus status = advance(equation, i * substep_, next);
      if (status != StepStatus::kOk) {
        return status;
      }
    }
    bool finite = isFinite(next.work.high);
    for (std::size_t i = 0; i < n; ++i) {
      finite = finite && isFinite(next.q[i]) && isFinite(next.v[i]);
    }
    if (!finite) {
      return StepStatus::kNotFinite;
    }
    state_ = next;
    wholeTurns();
    return StepStatus::kOk;
  }
  std::size_t dof() const noexcept override { return n; }
  void write(double* out) const noexcept override {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = state_.q[i];
      out[n + i] = state_.v[i];
    }
    out[2 * n] = state_.work.high;
    if constexpr (HasSpin<Model>::value) {
      out[Model::kSpin] = spin().total();
    }
  }
  bool shaft([[maybe_unused]] ShaftState& out) const noexcept override {
    if constexpr (HasSpin<Model>::value) {
      // No load on a rotor depends on the time by itself.
      const auto now = derivative(model_, state_.q, state_.v, Moment<double>{});
      out = {spin(), state_.v[Model::kSpin], now.acceleration[Model::kSpin]};
    }
    return HasSpin<Model>::value;
  }
  void set(const double* q, const double* v) noexcept override {
    state_ = MotionState<n>{};
    for (std::size_t i = 0; i < n; ++i) {
      state_.q[i] = q[i];
      state_.v[i] = v[i];
    }
    if constexpr (HasSpin<Model>::value) {
      const ShaftAngle angle = shaftAngle(q[Model::kSpin]);
      turns_ = angle.turns;
      state_.q[Model::kSpin] = angle.remainder;
    }
    method_.restart();
  }

 private:
  /// The spin is stepped as whole turns and a remainder, so that its phase is as exact after a
  /// month as after a second; 2 pi is taken off with 106 bits.
  WHIRL_TWIN_INLINE void wholeTurns() noexcept {
    if constexpr (HasSpin<Model>::value) {
      double& angle = state_.q[Model::kSpin];
      if (angle >= 0.0 && angle < kTwoPi) {
        return;
      }
      const double turns = std::floor(angle / kTwoPi);
      const double whole = turns * kTwoPi;
      const double error = std::fma(turns, kTwoPi, -whole) + turns * kTwoPiLow;
      CompensatedSum rest{angle - whole, state_.q_low[Model::kSpin]};
      rest.add(-error);
      angle = rest.high;
      state_.q_low[Model::kSpin] = rest.low;
      turns_ += static_cast<std::int64_t>(turns);
    }
  }
  ShaftAngle spin() const noexcept {
    const double angle = state_.q[n - 1];        // the spin is the last
    return {turns_, angle < 0.0 ? 0.0 : angle};  // below 0 only by rounding
  }

  /// One substep, in parts where the drive has a corner inside it: across a corner a method would
  /// lose its order.
  WHIRL_TWIN_INLINE StepStatus advance(const DrivenEquation<Model>& equation, double offset,
                                       MotionState<n>& state) noexcept {
    if constexpr (Model::kHasShaft) {
      const double end = offset + substep_;
      if (drive_.nextCorner(offset) < end - kSliver * substep_) {
        return advanceInParts(equation, offset, end, state);
      }
    }
    return method_.step(equation, offset, substep_, state);
  }
  StepStatus advanceInParts(const DrivenEquation<Model>& equation, double offset, double end,
                            MotionState<n>& state) noexcept {
    const double sliver = kSliver * substep_;
    StepStatus status = StepStatus::kOk;
    while (status == StepStatus::kOk && end - offset > sliver) {
      double corner = drive_.nextCorner(offset);
      corner = corner < end - sliver ? corner : end;
      if (corner - offset > sliver) {
        method_.restart();
        status = method_.step(equation, offset, corner - offset, state);
      }
      // Just behind the corner, where the jerk (or acceleration) that follows holds.
      offset = std::nextafter(corner, 2.0 * end);
    }
    method_.restart();
    return status;
  }

  /// Parts shorter than this share of a substep are not worth a step: they are rounding.
  static constexpr double kSliver = 1.0e-12;
  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kTwoPiLow = 2.4492935982947064e-16;

  Model model_;
  const Drive& drive_;
  double substep_;  ///< [s]
  int substeps_;
  Method method_{};
  MotionState<n> state_{};
  std::int64_t turns_ = 0;  ///< of a spin, beyond its coordinate
};

}  // namespace whirl_twin
