// Steady motions of systems with cyclic coordinates, against the notes' closed forms: cones of the
// rotating pendulum, the flywheel's radius, the governed speed, rigid-body modes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "analysis/equilibria.h"
#include "models_under_test.h"

namespace whirl_twin {
namespace steady_motion_test {

constexpr double kG = 9.81;
using Vector = Eigen::VectorXd;

Vector vector(std::initializer_list<double> x) {
  return Eigen::Map<const Vector>(x.begin(), static_cast<Eigen::Index>(x.size()));
}

class SteadyMotions : public testing::Test {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::mt19937 random_{20240711};
};

// cos(th0) = g / (l w^2);  p^2 = w^2 sin^2 [1 + 4 m l^2 cos^2 / (J + m l^2 sin^2)]: from
// w^2 (1 + 3 cos^2) without a hub to w^2 sin^2 on a shaft that holds the speed.
TEST_F(SteadyMotions, AFreePendulumCirclesOnItsConeAtTheMomentumOfItsState) {
  for (int draw = 0; draw < 200; ++draw) {
    const double m = between(0.2, 3.0);
    const double l = between(0.1, 2.0);
    const double w = std::sqrt(kG / l) * between(1.05, 4.0);
    const double inertia = m * l * l * std::pow(10.0, between(-3.0, 4.0));
    const auto pendulum =
        dynamicsOf("rotating_pendulum", {{"mass", m}, {"length", l}, {"hub_inertia", inertia}});
    const double cone = std::acos(kG / (l * w * w));
    const auto motion = operatingPoint(*pendulum, vector({cone, 2.5}), vector({0.0, w}), 0.0);
    ASSERT_TRUE(motion) << draw;
    EXPECT_NEAR(motion->q[0], cone, 1e-12);
    EXPECT_NEAR(motion->v[1], w, 1e-12 * w);
    EXPECT_EQ(motion->v[0], 0.0);
    EXPECT_EQ(motion->stability.routh.verdict, Verdict::kMarginal);
    const double s = std::sin(cone);
    const double c = std::cos(cone);
    const double p =
        w * s * std::sqrt(1.0 + 4.0 * m * l * l * c * c / (inertia + m * l * l * s * s));
    ASSERT_EQ(motion->stability.natural_frequencies.size(), 1u);
    EXPECT_NEAR(motion->stability.natural_frequencies[0], p, 1e-10 * p);
  }
}

TEST_F(SteadyMotions, EachIsClassifiedBelowAndAboveTheConesBirth) {
  const auto pendulum =
      dynamicsOf("rotating_pendulum", {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", 0.05}});
  const auto verdicts = [&](double w) {
    std::vector<std::pair<double, Verdict>> all;
    for (const Equilibrium& e : equilibria(*pendulum, 0.0, vector({0.0, 0.0}), vector({0.0, w}))) {
      all.emplace_back(e.q[0], e.stability.routh.verdict);
    }
    return all;
  };
  const double born = std::sqrt(kG / 0.5);
  const auto slow = verdicts(0.9 * born);
  ASSERT_EQ(slow.size(), 2u);
  EXPECT_EQ(slow[0], std::make_pair(0.0, Verdict::kMarginal));
  EXPECT_EQ(slow[1].second, Verdict::kUnstable) << "upside down";
  const auto fast = verdicts(2.0 * born);
  ASSERT_EQ(fast.size(), 4u);
  EXPECT_EQ(fast[0].second, Verdict::kMarginal);
  EXPECT_EQ(fast[1], std::make_pair(0.0, Verdict::kUnstable));
  EXPECT_EQ(fast[2].second, Verdict::kMarginal);
  EXPECT_NEAR(fast[2].first, -fast[0].first, 1e-12);
  EXPECT_EQ(fast[3].second, Verdict::kUnstable);
}

TEST_F(SteadyMotions, ADampedPendulumSettlesOnItsCone) {
  const auto pendulum =
      dynamicsOf("rotating_pendulum",
                 {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", 0.05}, {"damping", 0.05}});
  const auto motion = operatingPoint(*pendulum, vector({0.9, 0.0}), vector({0.0, 6.0}), 0.0);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->stability.routh.verdict, Verdict::kAsymptoticallyStable);
}

// rho = k a / (k - m w^2), p_s^2 = k/m - w^2 + 8 m rho^2 w^2 / (J + 2 m rho^2), p_a^2 = k/m - w^2.
TEST_F(SteadyMotions, AFlywheelsMassesStandAtOneRadiusAndSwingTwoWays) {
  for (int draw = 0; draw < 200; ++draw) {
    const double inertia = between(0.01, 1.0);
    const double m = between(0.05, 1.0);
    const double k = between(50.0, 500.0);
    const double a = between(0.05, 0.5);
    const double w = std::sqrt(k / m) * between(0.05, 0.95);
    const double radius = k * a / (k - m * w * w);
    const ParameterValues values{
        {"inertia", inertia}, {"slider_mass", m}, {"stiffness", k}, {"free_length", a}};
    const double anti = std::sqrt(k / m - w * w);
    const double together = std::sqrt(anti * anti + 8.0 * m * radius * radius * w * w /
                                                        (inertia + 2.0 * m * radius * radius));
    const auto wheel = dynamicsOf("sliding_mass_flywheel", values);
    const auto motion =
        operatingPoint(*wheel, vector({radius, radius, 0.0}), vector({0.0, 0.0, w}), 0.0);
    ASSERT_TRUE(motion) << draw;
    EXPECT_NEAR(motion->q[0], radius, 1e-10 * radius);
    EXPECT_NEAR(motion->q[1], radius, 1e-10 * radius);
    EXPECT_NEAR(motion->v[2], w, 1e-10 * w);
    EXPECT_TRUE(motion->stability.bounded()) << "a > 0: stable wherever it exists (E46)";
    ASSERT_EQ(motion->stability.natural_frequencies.size(), 2u);
    EXPECT_NEAR(motion->stability.natural_frequencies[0], anti, 1e-8 * anti);
    EXPECT_NEAR(motion->stability.natural_frequencies[1], together, 1e-8 * together);

    const auto pair =
        dynamicsOf("sliding_mass_flywheel", values, 0.0, {{{"symmetric", "true"}}, {}, {}, {}});
    const auto same = operatingPoint(*pair, vector({radius, 0.0}), vector({0.0, w}), 0.0);
    ASSERT_TRUE(same) << draw;
    EXPECT_NEAR(same->stability.natural_frequencies.at(0), together, 1e-8 * together);
  }
}

// The engine runs at cos(th0) = F / kappa, w0^2 = g / (l cos th0), and does not hunt while
// c J / (m l^2) > 2 F / w0: Routh's condition of a real cubic.
TEST_F(SteadyMotions, AGovernedEngineHuntsWithoutEnoughFriction) {
  for (int draw = 0; draw < 200; ++draw) {
    const double m = between(0.5, 2.0);
    const double l = between(0.1, 0.5);
    const double inertia = between(0.2, 5.0);
    const double kappa = between(10.0, 100.0);
    const double load = kappa * between(0.2, 0.9);
    const double w = std::sqrt(kG * kappa / (l * load));
    const double enough = 2.0 * load / w * m * l * l / inertia;
    const double share = between(0.2, 3.0);
    const auto engine = dynamicsOf("governor", {{"mass", m},
                                                {"length", l},
                                                {"inertia", inertia},
                                                {"damping", share * enough},
                                                {"torque", kappa},
                                                {"load", load}});
    const double arm = std::acos(load / kappa);
    const auto all = equilibria(*engine, 0.0, vector({arm, 0.0}), vector({0.0, 0.8 * w}));
    const auto up = std::find_if(all.begin(), all.end(), [&](const Equilibrium& e) {
      return std::fabs(e.q[0] - arm) < 1e-9 && e.v[1] > 0.0;
    });
    ASSERT_NE(up, all.end()) << draw;
    EXPECT_NEAR(up->v[1], w, 1e-9 * w);
    EXPECT_EQ(up->stability.eigenvalues.size(), 3u) << "one and a half degrees of freedom";
    EXPECT_EQ(up->stability.routh.verdict,
              share > 1.0 ? Verdict::kAsymptoticallyStable : Verdict::kUnstable)
        << share;
  }
}

// T_motor = c w r(w)^2 with r = e w^2 / |p^2 - w^2 + i c w / m|: three steady speeds of a weak
// motor, of which the middle one, where more speed requires less torque, is unstable (Sommerfeld).
TEST_F(SteadyMotions, AWeakMotorHasThreeSteadySpeedsAndStaysAtTheLowest) {
  for (int draw = 0; draw < 50; ++draw) {
    const double m = between(0.5, 5.0);
    const double p = between(5.0, 50.0);
    const double e = between(1e-3, 1e-2);
    const double c = 2.0 * m * p * between(0.01, 0.05);
    const auto torque = [&](double w) {
      const double r = e * w * w / std::abs(std::complex<double>(p * p - w * w, c * w / m));
      return c * w * r * r;
    };
    const double motor = torque(0.95 * p);
    const auto rotor = dynamicsOf("free_rotor", {{"mass", m},
                                                 {"stiffness", m * p * p},
                                                 {"damping", c},
                                                 {"eccentricity", e},
                                                 {"polar_inertia", 50.0 * m * e * e},
                                                 {"torque", motor}});
    int stable = 0;
    for (const Equilibrium& steady :
         equilibria(*rotor, 0.0, vector({0.0, 0.0, 0.0}), vector({0.0, 0.0, 0.8 * p}))) {
      const double w = steady.v[2];
      EXPECT_NEAR(torque(w), motor, 1e-9 * motor) << draw << ": " << w;
      const double slope = torque(1.0001 * w) - torque(0.9999 * w);
      EXPECT_EQ(steady.stability.bounded(), slope > 0.0) << draw << ": " << w;
      stable += slope > 0.0 ? 1 : 0;
    }
    EXPECT_GE(stable, 1) << draw;
    const auto captured =
        operatingPoint(*rotor, vector({0.0, 0.0, 0.0}), vector({0.0, 0.0, 0.8 * p}), 0.0);
    ASSERT_TRUE(captured) << draw;
    EXPECT_NEAR(captured->v[2], 0.95 * p, 1e-6 * p) << draw;
  }
}

TEST_F(SteadyMotions, AFreeCartDriftsWhileItsRodSwings) {
  const double m1 = 2.0, m2 = 1.0, l = 1.0;
  const auto cart =
      dynamicsOf("cart_pendulum",
                 {{"cart_mass", m1}, {"rod_mass", m2}, {"rod_length", l}, {"stiffness", 0.0}}, kG);
  const CyclicCoordinates cyclic = cyclicCoordinates(*cart, 0.0);
  EXPECT_EQ(cyclic.conserved, CyclicCoordinates::Places{0});
  EXPECT_EQ(cyclic.shape, CyclicCoordinates::Places{1});
  const auto motion = operatingPoint(*cart, vector({5.0, 0.1}), vector({0.7, 0.0}), 0.0);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->q[1], 0.0);
  const double determinant = m2 * l * l * (4.0 * m1 + m2) * m2 / 12.0;
  EXPECT_NEAR(motion->stability.natural_frequencies.at(0),
              std::sqrt(m2 * kG * l / 2.0 * (m1 + m2) / determinant), 1e-12);
}

Settings matrices(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                  const Eigen::MatrixXd& stiffness) {
  Settings settings;
  settings.matrices = {{"mass", mass}, {"damping", damping}, {"stiffness", stiffness}};
  return settings;
}

// p3^2 = kb (1/m1 + 4/m2 + 1/m3) beside two rigid-body modes, which do not affect stability.
TEST_F(SteadyMotions, AFreeBarBendsAboutItsRigidBodyModes) {
  const Eigen::Vector3d bend(1.0, -2.0, 1.0);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Vector3d m(between(0.1, 5.0), between(0.1, 5.0), between(0.1, 5.0));
    const double kb = between(1.0, 1000.0);
    for (const double loss : {0.0, 0.01}) {
      const auto bar = dynamicsOf("linear_system", {}, 0.0,
                                  matrices(m.asDiagonal(), loss * kb * bend * bend.transpose(),
                                           kb * bend * bend.transpose()));
      const auto rest = operatingPoint(*bar, vector({1.0, 2.0, 4.0}), vector({0.3, 0.1, 0.2}), 0.0);
      ASSERT_TRUE(rest) << draw;
      EXPECT_EQ(cyclicCoordinates(*bar, 0.0).conserved.size(), 2u);
      const double p = std::sqrt(kb * (1.0 / m[0] + 4.0 / m[1] + 1.0 / m[2]));
      EXPECT_NEAR(rest->stability.natural_frequencies.at(0), p, 1e-10 * p);
      EXPECT_EQ(rest->stability.routh.verdict,
                loss > 0.0 ? Verdict::kAsymptoticallyStable : Verdict::kMarginal);
    }
  }
}

// A soft or unstable mode beside a stiff one is a mode, not a rigid body.
TEST_F(SteadyMotions, ASoftSpringBesideAStiffOneIsNotTakenForNone) {
  for (const double soft : {-2.0, 2.0}) {
    const auto pair = dynamicsOf("linear_system", {}, 0.0,
                                 matrices(Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero(),
                                          Eigen::Vector2d(1.0e13, soft).asDiagonal()));
    EXPECT_FALSE(cyclicCoordinates(*pair, 0.0).any());
    const auto all = equilibria(*pair, 0.0);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].stability.routh.verdict, soft > 0.0 ? Verdict::kMarginal : Verdict::kUnstable);
  }
}

// Friction that has levelled off at high speed does not make the plank's place cyclic.
TEST_F(SteadyMotions, APlankThatSticksHasARestInTheMiddle) {
  const double mu = 0.3, a = 0.0762, h = 0.0127;
  const auto plank = dynamicsOf("friction_oscillator", {{"mass", 1.0},
                                                        {"friction_coefficient", mu},
                                                        {"half_spacing", a},
                                                        {"height", h},
                                                        {"roller_speed", 0.2},
                                                        {"regularization", 0.005}});
  EXPECT_FALSE(cyclicCoordinates(*plank, 0.0).any());
  const auto rest = operatingPoint(*plank, vector({0.05}), vector({0.0}), 0.0);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->q[0], 0.0);
  EXPECT_NEAR(rest->stability.natural_frequencies.at(0), std::sqrt(mu * kG / (a - mu * h)), 1e-9);
}

// Two equal oscillators beside a sliding body with a damper: equal frequencies with independent
// eigenvectors do not grow.
TEST_F(SteadyMotions, EqualFrequenciesBesideADampedSlideAreNoResonance) {
  const Eigen::Vector3d k(1.0, 1.0, 0.0);
  const Eigen::Vector3d c(0.0, 0.0, 1.0);
  const auto three =
      dynamicsOf("linear_system", {}, 0.0,
                 matrices(Eigen::Matrix3d::Identity(), c.asDiagonal(), k.asDiagonal()));
  const auto all = equilibria(*three, 0.0);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].stability.routh.verdict, Verdict::kMarginal);
}

TEST_F(SteadyMotions, ABeamUnderASteadyLoadRestsAtItsStaticAngle) {
  const auto beam = dynamicsOf("hinged_beam",
                               {{"mass", 12.0},
                                {"length", 2.0},
                                {"stiffness", 4000.0},
                                {"damping", 6.0},
                                {"load_amplitude", 100.0},
                                {"load_frequency", 0.0}},
                               kG, {{{"geometry", "small"}}, {}, {}, {}});
  const auto rest = operatingPoint(*beam, vector({0.0}), vector({0.0}), 0.0);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->q[0], 2.0 * 100.0 / 4000.0, 1e-15) << "2 f / k";
}

// Beyond kMaxExactCoordinates the definiteness of the matrices decides, as the exact test does up
// to there.
TEST_F(SteadyMotions, LargeSystemsAreJudgedByTheDefinitenessOfTheirMatrices) {
  const auto chain = [](Eigen::Index n, double loss, double twist) {
    Linearization l;
    l.mass = Eigen::MatrixXd::Identity(n, n);
    l.stiffness = 2.0 * Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 1; i < n; ++i) {
      l.stiffness(i, i - 1) = l.stiffness(i - 1, i) = -1.0;
    }
    l.damping = loss * l.stiffness;
    l.gyroscopic = l.circulatory = Eigen::MatrixXd::Zero(n, n);
    l.circulatory(0, 1) = twist;
    l.circulatory(1, 0) = -twist;
    return stability(l).routh;
  };
  for (const Eigen::Index n : {kMaxExactCoordinates, kMaxExactCoordinates + 4}) {
    EXPECT_EQ(chain(n, 0.0, 0.0).verdict, Verdict::kMarginal) << n;
    EXPECT_EQ(chain(n, 0.0, 0.0).imaginary, 2 * n);
    EXPECT_EQ(chain(n, 0.01, 0.0).verdict, Verdict::kAsymptoticallyStable) << n;
    EXPECT_EQ(chain(n, 0.01, 0.0).left, 2 * n);
    EXPECT_EQ(chain(n, 0.01, 5.0).verdict, Verdict::kUnstable) << n;
    EXPECT_GT(chain(n, 0.01, 5.0).right, 0) << n;
  }
}

}  // namespace steady_motion_test
}  // namespace whirl_twin
