// Horizontal flywheel with two masses that slide on its spokes against springs from the hub;
// nothing holds its speed (lecture notes, "flywheel with sliding masses"; errata E42-E46).
//
//   T = J phi'^2 / 2 + m (rho1'^2 + rho2'^2) / 2 + m (rho1^2 + rho2^2) phi'^2 / 2
//   V = k (rho1 - a)^2 / 2 + k (rho2 - a)^2 / 2
//
// phi is cyclic: (J + m (rho1^2 + rho2^2)) phi' is conserved. Steady rotation at w has
// rho = k a / (k - m w^2): with a > 0 for w^2 < k/m and always stable, with pretensioned springs
// (a < 0) only for w^2 > k/m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct SlidingMassFlywheel {
  static constexpr const char* kName = "sliding_mass_flywheel";
  static constexpr const char* kSummary = "flywheel with two masses sliding on sprung spokes";
  static constexpr std::size_t kDof = 3;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"rho1", "m", "from the axis to the first mass, outwards"},
       {"rho2", "m", "from the axis to the second mass, outwards"},
       {"phi", "rad", "of the wheel, counterclockwise"}}};

  double inertia = 0.0;      ///< [kg m^2], of the wheel about its axis
  double slider_mass = 0.0;  ///< [kg], of each slider
  double stiffness = 0.0;    ///< [N/m], of each spring
  double free_length = 0.0;  ///< [m], of each spring, from the axis; < 0: pretensioned

  static constexpr std::array<Parameter<SlidingMassFlywheel>, 4> parameters() {
    return {
        {{"inertia", "kg m^2", Range::kNotNegative, &SlidingMassFlywheel::inertia,
          "of the wheel about its axis"},
         {"slider_mass", "kg", Range::kPositive, &SlidingMassFlywheel::slider_mass,
          "of each slider"},
         {"stiffness", "N/m", Range::kPositive, &SlidingMassFlywheel::stiffness, "of each spring"},
         {"free_length", "m", Range::kAny, &SlidingMassFlywheel::free_length,
          "of each spring, from the axis; < 0: pretensioned"}}};
  }

  /// The springs', or the radius at which the sliders have the inertia of the wheel.
  double naturalLength() const {
    const double longest = std::max(std::abs(free_length), std::sqrt(0.5 * inertia / slider_mass));
    return longest > 0.0 ? longest : 1.0;
  }
  std::string singularMass() const {
    return inertia == 0.0 ? "without an inertia of the wheel there is no inertia about the axis "
                            "while both masses are at the centre"
                          : "";
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {0.0, 0.0, 1.0}, "on the wheel's shaft"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 3>& q, const std::array<S, 3>& v,
                              const EvaluationPoint<S>&) const {
    const S around1 = q[0] * v[2];
    const S around2 = q[1] * v[2];
    return (0.5 * inertia) * (v[2] * v[2]) +
           (0.5 * slider_mass) *
               (v[0] * v[0] + v[1] * v[1] + around1 * around1 + around2 * around2);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 3>& q, const EvaluationPoint<S>&) const {
    const S stretch1 = q[0] - free_length;
    const S stretch2 = q[1] - free_length;
    return (0.5 * stiffness) * (stretch1 * stretch1 + stretch2 * stretch2);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 3>&, const std::array<S, 3>&,
                                  const EvaluationPoint<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 3> force(const std::array<S, 3>&, const std::array<S, 3>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  std::vector<Condition> conditions(const std::array<double, 3>& q, const std::array<double, 3>&,
                                    const std::array<double, 3>&,
                                    const EvaluationPoint<double>&) const {
    return {{"slider_past_centre", "m", std::min(q[0], q[1]),
             "a mass has passed the centre of the wheel"}};
  }

  /// View along the axis; phi from the vertical, counter-clockwise.
  Sketch sketch(const std::array<double, 3>& q, const EvaluationPoint<double>&) const {
    const double unit = naturalLength();
    const double rim = 2.0 * unit;
    const auto onSpoke = [&](double radius) {
      return SketchPoint{-radius * std::sin(q[2]), 0.0, radius * std::cos(q[2])};
    };
    Sketch s;
    s.size = 2.2 * rim;
    s.discs.push_back(
        {{0.0, 0.1 * unit, 0.0}, {0.0, -1.0, 0.0}, rim, 0.05 * unit, q[2], SketchRole::kBody});
    s.rods.push_back({onSpoke(-rim), onSpoke(rim), 0.03 * unit, SketchRole::kBody});
    s.balls.push_back({{}, 0.1 * unit, SketchRole::kSupport});
    for (const double place : {q[0], -q[1]}) {
      s.springs.push_back({{}, onSpoke(place), 0.08 * unit});
      s.balls.push_back({onSpoke(place), 0.15 * unit, SketchRole::kMass});
    }
    s.tracer = onSpoke(q[0]);
    s.has_tracer = true;
    return s;
  }
};

// The flywheel with two sliding masses kept at equal radii: rho1 = rho2 = rho.
//
//   T = J phi'^2 / 2 + m (rho'^2 + rho^2 phi'^2),   V = k (rho - a)^2

struct SymmetricSlidingMassFlywheel : SlidingMassFlywheel {
  static constexpr std::size_t kDof = 2;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"rho", "m", "from the axis to each mass, outwards"},
       {"phi", "rad", "of the wheel, counterclockwise"}}};

  static constexpr std::array<Parameter<SymmetricSlidingMassFlywheel>, 4> parameters() {
    return inherited<SymmetricSlidingMassFlywheel>(SlidingMassFlywheel::parameters());
  }

  std::array<Input<kDof>, 1> inputs() const {
    return {{{"torque", "N m", {0.0, 1.0}, "on the wheel's shaft"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const EvaluationPoint<S>& at) const {
    return SlidingMassFlywheel::kinetic(both(q), both(v), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const EvaluationPoint<S>& at) const {
    return SlidingMassFlywheel::potential(both(q), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>&,
                                  const EvaluationPoint<S>&) const {
    return {};
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>&, const std::array<S, 2>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  std::vector<Condition> conditions(const std::array<double, 2>& q, const std::array<double, 2>& v,
                                    const std::array<double, 2>& a,
                                    const EvaluationPoint<double>& at) const {
    return SlidingMassFlywheel::conditions(both(q), both(v), both(a), at);
  }
  Sketch sketch(const std::array<double, 2>& q, const EvaluationPoint<double>& at) const {
    return SlidingMassFlywheel::sketch(both(q), at);
  }

 private:
  template <class S>
  WHIRL_TWIN_INLINE static std::array<S, 3> both(const std::array<S, 2>& x) {
    return {x[0], x[0], x[1]};
  }
};

}  // namespace whirl_twin
