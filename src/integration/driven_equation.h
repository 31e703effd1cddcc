// The equation that a step integrates: a model, the motion of its shaft, and its inputs.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cstddef>

#include "control/drive.h"
#include "integration/input_force.h"
#include "mechanics/dynamics.h"
#include "mechanics/lagrangian.h"

namespace whirl_twin {

/// q'' = a(q, v, t) of a model on its drive and with its inputs during one step; offset [s] counts
/// from its start.
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
  /// What the inputs do, in the piece that it stands at; nullptr: there are none.
  const InputForce* inputs = nullptr;

  WHIRL_TWIN_INLINE Moment<double> moment(double offset) const {
    if constexpr (Model::kHasShaft) {
      const ShaftMotion shaft = drive.at(offset);
      return {time + offset, shaft.angle, shaft.speed, shaft.acceleration};
    } else {
      return {time + offset, 0.0, 0.0, 0.0};
    }
  }
  /// Without the inputs.
  WHIRL_TWIN_INLINE Derivative<n> evaluate(const Array& q, const Array& v,
                                           const Moment<double>& at) const {
    return derivative(model, q, v, at);
  }
  /// The power is without that of held inputs, whose work is Q . dq.
  WHIRL_TWIN_INLINE Derivative<n> operator()(const Array& q, const Array& v, double offset) const {
    EquationsOfMotion<double, n> eom = equationsOfMotion(model, q, v, moment(offset));
    if (__builtin_expect(inputs != nullptr, 0)) {
      // In arrays of their own, so that what is computed above may stay in registers.
      Array all;
      Array varying;
      inputs->at(offset, all.data(), varying.data());
      for (std::size_t j = 0; j < n; ++j) {
        eom.force[j] += all[j];
        eom.power += v[j] * varying[j];
      }
    }
    return {solveMass<double, n>(eom.mass, eom.force), eom.power};
  }
  /// da/dq and da/dv.
  Jacobian jacobian(const Array& q, const Array& v, double offset) const {
    const Moment<double> at = moment(offset);
    const auto l = linearization(model, q, v, (*this)(q, v, offset).acceleration, at);
    // Not mass.inverse(): Eigen's of size four needs signed zeros, which steps are compiled
    // without.
    const auto mass = l.mass.partialPivLu();
    return {-mass.solve(l.stiffness + l.circulatory), -mass.solve(l.damping + l.gyroscopic)};
  }
  bool hasInputs() const { return inputs != nullptr; }
  /// Is the forcing that of a shaft at one speed? Inputs and loads that alternate by themselves are
  /// not.
  bool constantSpeed([[maybe_unused]] double duration) const {
    if (hasInputs()) {
      return false;
    }
    if constexpr (HasAlternatingLoads<Model>::value) {
      return false;
    } else {
      return !Model::kHasShaft || drive.constantFor(duration);
    }
  }
};

}  // namespace whirl_twin
