// Causes of whirl in time: a bow, gravity, hysteresis, rub, journal bearings.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "analysis/equilibria.h"
#include "analysis/stability.h"
#include "mechanics/rotors/short_journal_bearing.h"
#include "running_system.h"

namespace whirl_twin {
namespace rotor_causes_test {

constexpr std::int64_t kMillisecond = 1000000;
constexpr double kMass = 2.0;
constexpr double kStiffness = 20000.0;  // p = 100 rad/s

RunningSystem::Setup rotor(double speed, const ParameterValues& effects) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = effects;
  s.parameters["mass"] = kMass;
  s.parameters["stiffness"] = kStiffness;
  s.speed = speed;
  return s;
}

std::complex<double> position(const RunningSystem& system) {
  return {system.q(0), system.q(1)};
}

// z = [m e w^2 e^(i delta) + k b e^(i beta)] / (k - m w^2 + i c w) e^(i theta)
TEST(Bow, IsForcedByTheShaftsRestAndAddsToTheUnbalance) {
  const double c = 40.0, e = 1.0e-4, b = 3.0e-4;
  for (const double speed : {30.0, 100.0, 250.0}) {
    RunningSystem::Setup s = rotor(speed, {{"damping", c},
                                           {"eccentricity", e},
                                           {"eccentricity_angle", 0.7},
                                           {"bow", b},
                                           {"bow_angle", -2.0}});
    RunningSystem system(s, "exponential", kMillisecond);
    ASSERT_EQ(system.run(4000), StepStatus::kOk);  // c/2m = 10/s: free motion is e^-40
    const auto expected = (kMass * e * speed * speed * std::polar(1.0, 0.7) +
                           kStiffness * b * std::polar(1.0, -2.0)) /
                          std::complex<double>(kStiffness - kMass * speed * speed, c * speed) *
                          std::polar(1.0, speed * system.time());
    EXPECT_LT(std::abs(position(system) - expected), 1e-9 * std::abs(expected)) << speed;
  }
}

TEST(Bow, ClosesItsEnergyBetweenUnequalSpringsAtConstantAndChangingSpeed) {
  RunningSystem::Setup s =
      rotor(40.0, {{"damping", 5.0}, {"stiffness_y", 14000.0}, {"bow", 1.0e-3}});
  for (const bool changing : {false, true}) {
    if (changing) {
      s.profile = {{90.0, 50.0, 0.0, 1.0}};
    }
    RunningSystem system(s, "exponential", kMillisecond / 2);
    const double before = system.energies().jacobi;
    ASSERT_EQ(system.run(2000), StepStatus::kOk);
    const Energies e = system.energies();
    EXPECT_NEAR(e.jacobi - before, system.work(), 1e-9 * (e.kinetic + e.potential)) << changing;
  }
}

TEST(Gravity, SagsTheRotorAndLeavesItsWhirlAlone) {
  Settings settings;
  settings.choices["gravity_on_shaft"] = "true";
  RunningSystem::Setup s = rotor(60.0, {{"damping", 40.0}, {"eccentricity", 1.0e-4}});
  RunningSystem weightless(s, "exponential", kMillisecond);
  s.settings = settings;
  RunningSystem heavy(s, "exponential", kMillisecond);
  ASSERT_EQ(weightless.run(4000), StepStatus::kOk);
  ASSERT_EQ(heavy.run(4000), StepStatus::kOk);
  EXPECT_NEAR(heavy.q(0), weightless.q(0), 1e-15);
  EXPECT_NEAR(heavy.q(1), weightless.q(1) - kMass * 9.81 / kStiffness, 1e-15);
}

TEST(Hysteresis, SagsATurningShaftSidewaysByItsLossFactor) {
  Settings settings;
  settings.choices["gravity_on_shaft"] = "true";
  for (const double speed : {50.0, -50.0}) {
    RunningSystem::Setup s = rotor(speed, {{"damping", 60.0}, {"loss_factor", 0.05}});
    s.settings = settings;
    RunningSystem shaft(s, "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(shaft.run(3000), StepStatus::kOk);
    // Towards the side that the shaft's underside turns to. Rounding off |u| costs (1e-3 p/w)^2/2.
    EXPECT_NEAR(shaft.q(0) / -shaft.q(1), std::copysign(0.05, speed), 0.05 * 3e-6);
  }
}

TEST(Hysteresis, DoesNothingToASynchronousWhirl) {
  // Below p, where the orbit is stable anyway. The material damping is so strong that the shaft
  // creeps to the same orbit, as exp(-1.3 t).
  const ParameterValues plain{{"damping", 40.0}, {"eccentricity", 1.0e-4}};
  ParameterValues lossy = plain;
  lossy["loss_factor"] = 0.05;
  RunningSystem a(rotor(60.0, plain), "gauss_legendre_6", kMillisecond);
  RunningSystem b(rotor(60.0, lossy), "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(25000), StepStatus::kOk);
  ASSERT_EQ(b.run(25000), StepStatus::kOk);
  EXPECT_LT(std::abs(position(a) - position(b)), 1e-9 * std::abs(position(a)));
}

/// Growth rate [1/s] of a circular whirl at p.
double growth(double speed, const ParameterValues& effects, bool forward) {
  RunningSystem::Setup s = rotor(speed, effects);
  s.q = {1.0e-3, 0.0};
  s.v = {0.0, forward ? 0.1 : -0.1};
  RunningSystem system(s, "gauss_legendre_6", kMillisecond);
  EXPECT_EQ(system.run(500), StepStatus::kOk);
  return std::log(std::abs(position(system)) / 1.0e-3) / system.time();
}

TEST(Hysteresis, DrivesAForwardWhirlAboveTheCriticalSpeedAndDampsAllOthers) {
  // +-eta p / 2 of hysteresis, -c / 2m of damping. Its force turns a circle into a
  // spiral: eta of it.
  const ParameterValues effects{{"loss_factor", 0.02}, {"damping", 1.0}};
  EXPECT_NEAR(growth(150.0, effects, true), 1.0 - 0.25, 0.02);
  EXPECT_NEAR(growth(600.0, effects, true), 1.0 - 0.25, 0.02) << "at any speed alike";
  EXPECT_NEAR(growth(50.0, effects, true), -1.0 - 0.25, 0.02);
  EXPECT_NEAR(growth(150.0, effects, false), -1.0 - 0.25, 0.02);
  EXPECT_NEAR(growth(50.0, effects, false), -1.0 - 0.25, 0.02);
}

TEST(Hysteresis, AtRestHasTheVerdictOfItsWhirls) {
  const auto verdict = [](double speed, double damping) {
    ParameterValues values{
        {"mass", kMass}, {"stiffness", kStiffness}, {"damping", damping}, {"loss_factor", 0.02}};
    const ModelInfo& model = *findModel("jeffcott_rotor");
    const auto dynamics = model.setUp(completed(model, values), {}, 0.0).dynamics;
    return stability(linearizationAtRest(*dynamics, Eigen::VectorXd::Zero(2), speed)).routh.verdict;
  };
  // c p = eta k at c = 4 N s/m.
  EXPECT_EQ(verdict(150.0, 4.0 * 0.999), Verdict::kUnstable);
  EXPECT_EQ(verdict(150.0, 4.0 * 1.001), Verdict::kAsymptoticallyStable);
  EXPECT_EQ(verdict(-150.0, 4.0 * 0.999), Verdict::kUnstable);
  EXPECT_EQ(verdict(99.0, 0.0), Verdict::kAsymptoticallyStable) << "below p it only damps";
}

// A rotor thrown against its stator again and again: k_r = 10 k, p_r = 332 rad/s.
RunningSystem::Setup thrown() {
  RunningSystem::Setup s = rotor(0.0, {{"rub_stiffness", 2.0e5}, {"rub_clearance", 1.0e-3}});
  s.q = {5.0e-4, 2.0e-4};
  s.v = {0.15, -0.1};
  return s;
}

TEST(Rub, ConservesTheEnergyOfAnElasticStator) {
  // p_r h = 0.1, the step required in its header.
  RunningSystem system(thrown(), "gauss_legendre_6", 300000);
  const double energy = system.energies().jacobi;
  double farthest = 0.0;
  double worst = 0.0;
  for (int i = 0; i < 10000; ++i) {
    ASSERT_EQ(system.run(1), StepStatus::kOk);
    farthest = std::max(farthest, std::abs(position(system)));
    worst = std::max(worst, std::fabs(system.energies().jacobi / energy - 1.0));
  }
  EXPECT_GT(farthest, 1.05e-3) << "it touches";
  EXPECT_LT(worst, 1e-3);
}

TEST(Rub, ConvergesAsTheStepShrinks) {
  std::complex<double> end[3];
  const std::int64_t steps[] = {300000, 75000, 4000};
  for (int i = 0; i < 3; ++i) {
    RunningSystem system(thrown(), "gauss_legendre_6", steps[i]);
    ASSERT_EQ(system.run(60000000 / steps[i]), StepStatus::kOk);
    end[i] = position(system);
  }
  EXPECT_LT(std::abs(end[0] - end[2]), 2e-3 * 1.0e-3);
  EXPECT_LT(std::abs(end[1] - end[2]), 0.2 * std::abs(end[0] - end[2]));
}

TEST(Rub, FrictionDrivesAWhirlBackwards) {
  RunningSystem::Setup s = rotor(80.0, {{"damping", 4.0},
                                        {"rub_stiffness", 2.0e5},
                                        {"rub_clearance", 1.0e-3},
                                        {"rub_friction", 0.3},
                                        {"rub_damping", 100.0},
                                        {"rotor_radius", 0.05}});
  s.q = {1.2e-3, 0.0};
  s.v = {0.0, -0.2};  // along the wall
  RunningSystem system(s, "gauss_legendre_6", 100000);
  ASSERT_EQ(system.run(3000), StepStatus::kOk);
  const double angular = system.q(0) * system.v(1) - system.q(1) * system.v(0);
  const double radius = std::abs(position(system));
  EXPECT_GT(radius, 1.0e-3) << "it keeps in contact";
  EXPECT_LT(angular / (radius * radius), -100.0) << "faster than p, against the rotation";
}

// Two bearings carry the weight of disc and journals.
RunningSystem::Setup inBearings(double speed) {
  RunningSystem::Setup s = rotor(speed, {{"bearing_length", 0.01},
                                         {"bearing_diameter", 0.025},
                                         {"bearing_clearance", 1.0e-4},
                                         {"bearing_viscosity", 0.1},
                                         {"journal_mass", 0.2}});
  s.settings.choices["gravity_on_shaft"] = "true";
  s.q = {0.0, -1.0e-3, 0.0, -2.0e-5};
  return s;
}

TEST(JournalBearing, CarriesTheWeightAtItsStaticEccentricity) {
  const ShortJournalBearing bearing{0.01, 0.025, 1.0e-4, 0.1};
  const double speed = 60.0;
  RunningSystem system(inBearings(speed), "gauss_legendre_6", kMillisecond / 2);
  ASSERT_EQ(system.run(24000), StepStatus::kOk);  // 12 s: what swings yet is 1e-5 of the clearance
  const JournalPosition rest = bearing.staticPosition(0.5 * (kMass + 0.2) * 9.81, speed);
  EXPECT_NEAR(system.q(2), rest.x, 1e-3 * 1.0e-4);
  EXPECT_NEAR(system.q(3), rest.y, 1e-3 * 1.0e-4);
  EXPECT_NEAR(system.q(1), rest.y - kMass * 9.81 / kStiffness, 1e-6);
}

/// Mean rate [rad/s] of the disc's whirl about its mean over a second.
double whirlRate(RunningSystem& system, double sag) {
  double turned = 0.0;
  std::complex<double> before = position(system) + std::complex<double>(0.0, sag);
  for (int i = 0; i < 10000; ++i) {
    EXPECT_EQ(system.run(1), StepStatus::kOk);
    const std::complex<double> now = position(system) + std::complex<double>(0.0, sag);
    turned += std::arg(now / before);
    before = now;
  }
  return turned;
}

TEST(JournalBearing, WhipsAtTheCriticalSpeedFarAboveTwiceIt) {
  for (const double speed : {300.0, 400.0}) {
    RunningSystem system(inBearings(speed), "gauss_legendre_6", kMillisecond / 10);
    ASSERT_EQ(system.run(60000), StepStatus::kOk);  // 6 s: long since at its limit cycle
    const double rate = whirlRate(system, kMass * 9.81 / kStiffness);
    // The first critical speed on bearings is a little below p = 100 rad/s.
    EXPECT_GT(rate, 85.0) << speed;
    EXPECT_LT(rate, 102.0) << speed;
  }
}

}  // namespace rotor_causes_test
}  // namespace whirl_twin
