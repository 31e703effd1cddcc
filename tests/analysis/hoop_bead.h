// Bead on a hoop that a shaft rotates about a vertical axis beside its centre, written as in
// docs/own_systems.md: in a separate namespace, functions without std::.
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/model_description.h"

namespace hoop {

using namespace whirl_twin;

struct HoopBead {
  static constexpr const char* kName = "hoop_bead";
  static constexpr const char* kSummary = "bead on a turning hoop beside its axis";
  static constexpr std::size_t kDof = 1;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = true;
  static constexpr std::array<Coordinate, kDof> kCoordinates{{{"theta", "rad"}}};

  double mass = 0.0, radius = 0.0, offset = 0.0, damping = 0.0, gravity = 0.0;

  template <class S>
  S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
            const EvaluationPoint<S>& at) const {
    const S out = offset + radius * sin(q[0]);
    const S across = at.speed * out;
    const S along = radius * v[0];
    return (0.5 * mass) * (along * along + across * across);
  }
  template <class S>
  S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>&) const {
    return (-mass * gravity * radius) * cos(q[0]);
  }
  template <class S>
  S dissipation(const std::array<S, kDof>&, const std::array<S, kDof>& v,
                const EvaluationPoint<S>&) const {
    return (0.5 * damping) * (v[0] * v[0]);
  }
  template <class S>
  std::array<S, kDof> force(const std::array<S, kDof>&, const std::array<S, kDof>&,
                            const EvaluationPoint<S>&) const {
    return {};
  }
};

}  // namespace hoop
