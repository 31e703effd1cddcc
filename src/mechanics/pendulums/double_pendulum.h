// Double pendulum: two arms in a vertical plane, each angle measured from the vertical (absolute
// angles), exact (lecture notes, "double pendulum"; errata E11 and note i). By default two point
// masses on massless rods; with centres of mass and inertias given, two rigid bodies.
//
//   T = m1 |v1|^2 / 2 + I1 theta1'^2 / 2 + m2 |v2|^2 / 2 + I2 theta2'^2 / 2
//   V = m1 g h1 + m2 g h2
//   D = c1 theta1'^2 / 2 + c2 w^2 / 2 + Mc1 s(theta1') + Mc2 s(w),   w = theta2' - theta1'
//
// v are the velocities of the mass centres, h their heights above where they hang at rest.
//
// The kinetic energy is written out in the angles, |v1|^2 = (lc1 theta1')^2 and |v2|^2 =
// (l1 theta1')^2 + (lc2 theta2')^2 + 2 l1 lc2 theta1' theta2' cos(theta1 - theta2), the last cosine
// from the sines and cosines that the weights need anyway.
//
// Coulomb friction in the joints can make them stick, s(w) = |w| (dry_friction.h). With a
// `coulomb_rate` w0 > 0 it is regularized: s(w) = sqrt(w^2 + w0^2) makes of the jump at w = 0 a
// moment Mc w / sqrt(w^2 + w0^2), short of Mc by the share (w0 / w)^2 / 2. A joint that would stick
// then creeps, at w0 M / sqrt(Mc^2 - M^2) under a moment M < Mc, so in the long run a stuck arm
// sinks to where it hangs. Near standstill the joint is a damper Mc / w0: explicit methods need
// steps below about 2 I w0 / Mc, I the inertia that it moves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "mechanics/dry_friction.h"
#include "mechanics/elementary.h"
#include "mechanics/evaluation_point.h"
#include "mechanics/force_inline.h"
#include "mechanics/model_description.h"
#include "mechanics/reaction.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

struct DoublePendulum {
  static constexpr const char* kName = "double_pendulum";
  static constexpr const char* kSummary = "two arms in a vertical plane, of point masses or bodies";
  static constexpr std::size_t kDof = 2;
  static constexpr bool kLinear = false;
  static constexpr bool kHasShaft = false;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"theta1", "rad", "of the upper arm, from hanging, its end to the right"},
       {"theta2", "rad", "of the lower arm, from the vertical, its end to the right"}}};

  double mass1 = 0.0;         ///< [kg]
  double mass2 = 0.0;         ///< [kg]
  double length1 = 0.0;       ///< [m], joint to joint
  double length2 = 0.0;       ///< [m]
  double center1 = 0.0;       ///< [m], upper joint to the upper mass centre
  double center2 = 0.0;       ///< [m], lower joint to the lower mass centre
  double inertia1 = 0.0;      ///< [kg m^2], about the mass centre
  double inertia2 = 0.0;      ///< [kg m^2], about the mass centre
  double damping1 = 0.0;      ///< [N m s/rad], at the upper joint
  double damping2 = 0.0;      ///< [N m s/rad], at the lower joint
  double coulomb1 = 0.0;      ///< [N m], at the upper joint
  double coulomb2 = 0.0;      ///< [N m], at the lower joint
  double coulomb_rate = 0.0;  ///< [rad/s], w0: within it Coulomb friction is rounded off
  // Motors at the joints, a separate form (double_pendulum_forms.h).
  double motor_inertia1 = 0.0;  ///< [kg m^2], J1, of the rotor at the upper joint
  double motor_inertia2 = 0.0;  ///< [kg m^2], J2
  double gear_ratio1 = 0.0;     ///< [-], G1
  double gear_ratio2 = 0.0;     ///< [-], G2
  // Air drag, a separate form (double_pendulum_forms.h).
  double drag1 = 0.0;        ///< [kg/m], drag of the upper arm per square of its speed
  double drag2 = 0.0;        ///< [kg/m], of the lower arm
  double drag_reach1 = 0.0;  ///< [m], upper joint to the point of the air drag on the upper arm
  double drag_reach2 = 0.0;  ///< [m], lower joint to where it acts on the lower arm
  double gravity = 0.0;      ///< [m/s^2], of the scene

  static constexpr std::array<Parameter<DoublePendulum>, 21> parameters() {
    return {{{"mass1", "kg", Range::kPositive, &DoublePendulum::mass1, "of the upper bob"},
             {"mass2", "kg", Range::kPositive, &DoublePendulum::mass2, "of the lower bob"},
             {"length1", "m", Range::kPositive, &DoublePendulum::length1, "of the upper rod"},
             {"length2", "m", Range::kPositive, &DoublePendulum::length2, "of the lower rod"},
             {"center1", "m", Range::kNotNegative, &DoublePendulum::center1,
              "upper joint to the upper mass centre", kGiven, "length1"},
             {"center2", "m", Range::kNotNegative, &DoublePendulum::center2,
              "lower joint to the lower mass centre", kGiven, "length2"},
             {"inertia1", "kg m^2", Range::kNotNegative, &DoublePendulum::inertia1,
              "of the upper arm about its mass centre", 0.0},
             {"inertia2", "kg m^2", Range::kNotNegative, &DoublePendulum::inertia2,
              "of the lower arm about its mass centre", 0.0},
             {"damping1", "N m s/rad", Range::kNotNegative, &DoublePendulum::damping1,
              "viscous, at the upper joint", 0.0},
             {"damping2", "N m s/rad", Range::kNotNegative, &DoublePendulum::damping2,
              "viscous, at the lower joint", 0.0},
             {"coulomb1", "N m", Range::kNotNegative, &DoublePendulum::coulomb1,
              "Coulomb friction at the upper joint", 0.0},
             {"coulomb2", "N m", Range::kNotNegative, &DoublePendulum::coulomb2,
              "Coulomb friction at the lower joint", 0.0},
             {"coulomb_rate", "rad/s", Range::kNotNegative, &DoublePendulum::coulomb_rate,
              "rate of regularization of the Coulomb friction; 0: exact, with sticking", 0.0},
             {"motor_inertia1", "kg m^2", Range::kNotNegative, &DoublePendulum::motor_inertia1,
              "of the rotor of a motor at the upper joint", 0.0},
             {"motor_inertia2", "kg m^2", Range::kNotNegative, &DoublePendulum::motor_inertia2,
              "of the rotor of a motor at the lower joint, carried by the upper arm", 0.0},
             {"gear_ratio1", "-", Range::kAny, &DoublePendulum::gear_ratio1,
              "gear ratio: turns of that rotor per turn of the upper joint", 1.0},
             {"gear_ratio2", "-", Range::kAny, &DoublePendulum::gear_ratio2,
              "gear ratio: turns of that rotor per turn of the lower joint, < 0 if reversed", 1.0},
             {"drag1", "kg/m", Range::kNotNegative, &DoublePendulum::drag1,
              "air drag on the upper arm, force per speed squared", 0.0},
             {"drag2", "kg/m", Range::kNotNegative, &DoublePendulum::drag2,
              "air drag on the lower arm, force per speed squared", 0.0},
             {"drag_reach1", "m", Range::kPositive, &DoublePendulum::drag_reach1,
              "upper joint to the point of the air drag on the upper arm", kGiven, "length1"},
             {"drag_reach2", "m", Range::kPositive, &DoublePendulum::drag_reach2,
              "lower joint to the point of the air drag on the lower arm", kGiven, "length2"}}};
  }

  std::string singularMass() const {
    if (center2 == 0.0 && inertia2 == 0.0 && motor_inertia2 * gear_ratio2 == 0.0) {
      return "the lower arm has no inertia about its joint";
    }
    if (center1 == 0.0 && inertia1 == 0.0 && inertia2 == 0.0 && motor_inertia1 == 0.0 &&
        motor_inertia2 == 0.0) {
      return "with its mass at the pivot the upper arm has no inertia: with both arms in line it "
             "can rotate without moving the lower mass";
    }
    return "";
  }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"torque1", "N m", {1.0, 0.0}, "at the upper joint, on the upper arm"},
             {"torque2",
              "N m",
              {-1.0, 1.0},
              "at the lower joint, on the lower arm and back on the upper"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, 2>& q, const std::array<S, 2>& v,
                              const EvaluationPoint<S>&) const {
    return (0.5 * (mass1 * center1 * center1 + inertia1 + mass2 * length1 * length1)) *
               (v[0] * v[0]) +
           (0.5 * (inertia2 + mass2 * center2 * center2)) * (v[1] * v[1]) +
           (mass2 * length1 * center2) * (cosOfDifference(q[0], q[1]) * (v[0] * v[1]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, 2>& q, const EvaluationPoint<S>&) const {
    return ((mass1 * center1 + mass2 * length1) * gravity) * (1.0 - cos(q[0])) +
           (mass2 * gravity * center2) * (1.0 - cos(q[1]));
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, 2>&, const std::array<S, 2>& v,
                                  const EvaluationPoint<S>&) const {
    return jointDissipation(v[0], v[1] - v[0]);
  }
  DryContacts<kDof> dryContacts() const { return jointContacts({-1.0, 1.0}); }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, 2> force(const std::array<S, 2>&, const std::array<S, 2>&,
                                           const EvaluationPoint<S>&) const {
    return {};
  }

  /// Forces of the joints on the arms that hang from them, by Newton's law: along the rod, positive
  /// where it is pulled, and their size.
  std::vector<Reaction> reactions(const std::array<double, 2>& q, const std::array<double, 2>& v,
                                  const std::array<double, 2>& a,
                                  const EvaluationPoint<double>&) const {
    std::array<Eigen::Vector2d, 2> to_joint;  // along +x and up, from the arm towards its joint
    std::array<Eigen::Vector2d, 2> unit_acceleration;  // per length
    for (std::size_t i = 0; i < 2; ++i) {
      to_joint[i] = {-std::sin(q[i]), std::cos(q[i])};
      const Eigen::Vector2d across(std::cos(q[i]), std::sin(q[i]));
      unit_acceleration[i] = a[i] * across + v[i] * v[i] * to_joint[i];
    }
    const Eigen::Vector2d weightless(0.0, gravity);
    const Eigen::Vector2d upper = center1 * unit_acceleration[0] + weightless;
    const Eigen::Vector2d lower =
        length1 * unit_acceleration[0] + center2 * unit_acceleration[1] + weightless;
    const Eigen::Vector2d joint2 = mass2 * lower;
    const Eigen::Vector2d joint1 = mass1 * upper + joint2;
    return {{"rod_tension_1", "N", joint1.dot(to_joint[0])},
            {"rod_tension_2", "N", joint2.dot(to_joint[1])},
            {"joint_force_1", "N", joint1.norm()},
            {"joint_force_2", "N", joint2.norm()}};
  }

  Sketch sketch(const std::array<double, 2>& q, const EvaluationPoint<double>&) const {
    const double reach = length1 + length2;
    const SketchPoint joint = hangingPoint({}, length1, q[0]);
    const SketchPoint end = hangingPoint(joint, length2, q[1]);
    const double bob = 0.08 * reach / std::cbrt(mass1 + mass2);
    Sketch s;
    s.size = 2.3 * reach;
    s.rods = {{{}, joint, 0.016 * reach, SketchRole::kBody},
              {joint, end, 0.016 * reach, SketchRole::kBody}};
    addPin(s, {});
    s.balls = {{hangingPoint({}, center1, q[0]), bob * std::cbrt(mass1), SketchRole::kMass},
               {hangingPoint(joint, center2, q[1]), bob * std::cbrt(mass2), SketchRole::kMass}};
    s.tracer = end;
    s.has_tracer = true;
    return s;
  }

 protected:
  /// At these rates of the joints.
  template <class S>
  WHIRL_TWIN_INLINE S jointDissipation(const S& upper, const S& lower) const {
    S d = (0.5 * damping1) * (upper * upper) + (0.5 * damping2) * (lower * lower);
    if (coulomb1 != 0.0) {
      d = d + dryDissipation(coulomb1, coulomb_rate, upper);
    }
    if (coulomb2 != 0.0) {
      d = d + dryDissipation(coulomb2, coulomb_rate, lower);
    }
    return d;
  }
  /// The rate of the lower joint is `lower` times the coordinates' rates.
  DryContacts<kDof> jointContacts(const std::array<double, kDof>& lower) const {
    DryContacts<kDof> contacts;
    contacts.add({"at the upper joint", "N m", {1.0, 0.0}, coulomb1}, coulomb_rate);
    contacts.add({"at the lower joint", "N m", lower, coulomb2}, coulomb_rate);
    return contacts;
  }

 private:
  static constexpr double kGiven = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace whirl_twin
