// The derived equations of motion agree with hand-written ones.
#include <gtest/gtest.h>

#include <cmath>

#include "random_state.h"

namespace whirl_twin {
namespace hand_written_equations_test {

using Vector = Eigen::VectorXd;

constexpr int kStates = 1000;

// Bodies with centres of mass at c and inertias I about them; joint torques t1, t2, viscous and
// Coulomb:
// (m1 c1^2 + I1 + m2 l1^2) th1'' + m2 l1 c2 (cos D th2'' + sin D th2'^2)
//     + (m1 c1 + m2 l1) g sin th1 = t2 - t1
// (m2 c2^2 + I2) th2'' + m2 l1 c2 (cos D th1'' - sin D th1'^2) + m2 g c2 sin th2 = -t2,
// D = th1 - th2
TEST(HandWritten, DoublePendulum) {
  std::mt19937_64 random(1738);
  for (int i = 0; i < kStates; ++i) {
    const RandomState s = randomState("double_pendulum", random);
    const auto given = [&](const std::string& name) { return s.parameters.at(name); };
    const auto torque = [&](const std::string& joint, double rate) {
      return given("damping" + joint) * rate +
             given("coulomb" + joint) * rate / std::hypot(rate, given("coulomb_rate"));
    };
    const double m2 = given("mass2");
    const double l1 = given("length1");
    const double c2 = given("center2");
    const double first = given("mass1") * given("center1");  // moments of the upper mass
    const double second = first * given("center1") + given("inertia1");
    const double upper = torque("1", s.v[0]);
    const double lower = torque("2", s.v[1] - s.v[0]);
    const double d = std::sin(s.q[0] - s.q[1]);
    const double m11 = second + m2 * l1 * l1;
    const double m12 = m2 * l1 * c2 * std::cos(s.q[0] - s.q[1]);
    const double m22 = m2 * c2 * c2 + given("inertia2");
    const double f1 = -m2 * l1 * c2 * d * s.v[1] * s.v[1] -
                      (first + m2 * l1) * s.gravity * std::sin(s.q[0]) - upper + lower;
    const double f2 =
        m2 * l1 * c2 * d * s.v[0] * s.v[0] - m2 * s.gravity * c2 * std::sin(s.q[1]) - lower;
    // The determinant without the cancellation of m11 m22 - m12^2.
    const double determinant =
        second * m22 + m2 * l1 * l1 * given("inertia2") + m2 * l1 * l1 * m2 * c2 * c2 * d * d;
    const Eigen::Vector2d a((m22 * f1 - m12 * f2) / determinant,
                            (m11 * f2 - m12 * f1) / determinant);
    const Vector found = s.dynamics->acceleration(s.q, s.v, s.at);
    const double cancelled = m11 * m22 / determinant;  // in an elimination
    for (int k = 0; k < 2; ++k) {
      ASSERT_NEAR(found[k], a[k], 1e-12 * cancelled * std::abs(a[k]))
          << "state " << i << ", coordinate " << k;
    }
  }
}

// A motor on each joint with a gear of ratio G that reverses: (G^2 + 1) J in 11, -G J in 12, G^2 J
// in 22 of the mass matrix in relative coordinates.
TEST(HandWritten, MotorsOfADoublePendulum) {
  std::mt19937_64 random(1750);
  const double j = 0.02;
  const double g = 6.0;
  VariantUnderTest driven{"double_pendulum", "", {}, {}, {}};
  driven.settings.choices["coordinates"] = "relative";
  driven.parameters = {
      {"motor_inertia1", j}, {"motor_inertia2", j}, {"gear_ratio1", g}, {"gear_ratio2", -g}};
  for (int i = 0; i < kStates; ++i) {
    const RandomState with = randomState(driven, random);
    ParameterValues parameters = with.parameters;
    parameters["motor_inertia1"] = parameters["motor_inertia2"] = 0.0;
    const auto without = findModel("double_pendulum")
                             ->setUp(parameters, driven.settings, ModelContext(with.gravity))
                             .dynamics;
    const Eigen::MatrixXd added = with.dynamics->massMatrix(with.q, with.v, with.at) -
                                  without->massMatrix(with.q, with.v, with.at);
    const double rounding = 1e-14 * with.dynamics->massMatrix(with.q, with.v, with.at).norm();
    ASSERT_NEAR(added(0, 0), (g * g + 1.0) * j, rounding);
    ASSERT_NEAR(added(0, 1), -g * j, rounding);
    ASSERT_NEAR(added(1, 1), g * g * j, rounding);
  }
}

// Air drag at one point of each arm, with its velocity u: F = -k |u| u. Its contribution to M a is
// the sum of (du / dv_j) . F, in any coordinates.
TEST(HandWritten, AirOnADoublePendulum) {
  std::mt19937_64 random(1726);
  const ParameterValues air{
      {"drag1", 0.3}, {"drag2", 0.2}, {"drag_reach1", 0.4}, {"drag_reach2", 0.7}};
  for (const bool relative : {false, true}) {
    VariantUnderTest in_air{"double_pendulum", "", {}, air, {}};
    in_air.settings.choices["coordinates"] = relative ? "relative" : "absolute";
    for (int i = 0; i < kStates; ++i) {
      const RandomState with = randomState(in_air, random);
      ParameterValues parameters = with.parameters;
      parameters["drag1"] = parameters["drag2"] = 0.0;
      const auto without = findModel("double_pendulum")
                               ->setUp(parameters, in_air.settings, ModelContext(with.gravity))
                               .dynamics;
      const Eigen::MatrixXd mass = with.dynamics->massMatrix(with.q, with.v, with.at);
      const Vector added = mass * (with.dynamics->acceleration(with.q, with.v, with.at) -
                                   without->acceleration(with.q, with.v, with.at));
      const double theta2 = with.q[1] + (relative ? with.q[0] : 0.0);
      const Eigen::Vector2d across1(std::cos(with.q[0]), std::sin(with.q[0]));
      const Eigen::Vector2d across2(std::cos(theta2), std::sin(theta2));
      // Velocities of the two points by the coordinates' rates.
      Eigen::Matrix2d u1 = Eigen::Matrix2d::Zero(), u2;
      u1.col(0) = 0.4 * across1;
      u2.col(0) = parameters.at("length1") * across1;
      u2.col(1) = 0.7 * across2;
      if (relative) {
        u2.col(0) += u2.col(1);
      }
      const Eigen::Vector2d v1 = u1 * with.v, v2 = u2 * with.v;
      const Vector by_hand =
          -0.3 * v1.norm() * u1.transpose() * v1 - 0.2 * v2.norm() * u2.transpose() * v2;
      const double size = mass.norm() * with.dynamics->acceleration(with.q, with.v, with.at).norm();
      ASSERT_LE((added - by_hand).norm(), 1e-12 * (size + by_hand.norm())) << "state " << i;
    }
  }
}

// m l^2 th'' = m l^2 w^2 sin th cos th - m g l sin th - c th', whatever the shaft's acceleration.
TEST(HandWritten, SpinningPendulum) {
  std::mt19937_64 random(1788);
  for (int i = 0; i < kStates; ++i) {
    const RandomState s = randomState("spinning_pendulum", random);
    const double l = s.parameters.at("length");
    const double inertia = s.parameters.at("mass") * l * l;
    const double sine = std::sin(s.q[0]);
    const double spin = s.at.speed * s.at.speed * sine * std::cos(s.q[0]);
    const double weight = s.gravity / l * sine;
    const double damping = s.parameters.at("damping") / inertia * s.v[0];
    // Rounding of the largest term remains where the terms cancel.
    const double size = std::max({std::abs(spin), std::abs(weight), std::abs(damping)});
    ASSERT_NEAR(s.dynamics->acceleration(s.q, s.v, s.at)[0], spin - weight - damping, 1e-12 * size);
  }
}

// m x'' + (c + cf) x' + ci (x' + w y) + k (x - b cos psi) + (lambda cf w + q) y
//     = m e (w^2 cos phi + w' sin phi), and so for y, with psi the angle of the bow.
TEST(HandWritten, JeffcottRotorOnAnAcceleratingShaft) {
  std::mt19937_64 random(1919);
  for (int i = 0; i < kStates; ++i) {
    const RandomState s = randomState("jeffcott_rotor", random);
    const auto p = [&](const char* name) { return s.parameters.at(name); };
    const double w = s.at.speed;
    const double phi = s.at.angle + p("eccentricity_angle");
    const double ci = p("internal_damping");
    const double m = p("mass");
    const double cf = p("fluid_damping");
    const double cross = p("fluid_ratio") * cf * w + p("cross_coupling");
    const double psi = s.at.angle + p("bow_angle");
    const double terms[2][8] = {
        {p("stiffness") * p("bow") * std::cos(psi) / m, -p("stiffness") * s.q[0] / m,
         -p("damping") * s.v[0] / m, -ci * (s.v[0] + w * s.q[1]) / m,
         p("eccentricity") * w * w * std::cos(phi),
         p("eccentricity") * s.at.acceleration * std::sin(phi), -cf * s.v[0] / m,
         -cross * s.q[1] / m},
        {p("stiffness_y") * p("bow") * std::sin(psi) / m, -p("stiffness_y") * s.q[1] / m,
         -p("damping_y") * s.v[1] / m, -ci * (s.v[1] - w * s.q[0]) / m,
         p("eccentricity") * w * w * std::sin(phi),
         -p("eccentricity") * s.at.acceleration * std::cos(phi), -cf * s.v[1] / m,
         cross * s.q[0] / m}};
    const Vector found = s.dynamics->acceleration(s.q, s.v, s.at);
    for (int k = 0; k < 2; ++k) {
      double sum = 0.0;
      double size = 0.0;
      for (const double term : terms[k]) {
        sum += term;
        size = std::max(size, std::abs(term));
      }
      ASSERT_NEAR(found[k], sum, 1e-12 * size) << "state " << i << ", coordinate " << k;
    }
  }
}

}  // namespace hand_written_equations_test
}  // namespace whirl_twin
