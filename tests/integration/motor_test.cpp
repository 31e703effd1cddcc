// A rotor with free spin: Sommerfeld's effect against the reference runs, conserved quantities, and
// agreement with free_rotor in its rotating frame; and the same for a shaft of elements
// (mechanics/spinning_rotor.h), against independently derived equations with another method.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "analysis/sommerfeld_speeds.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "mechanics/spinning_rotor.h"
#include "running_system.h"

namespace whirl_twin {
namespace motor_test {

constexpr std::int64_t kMillisecond = 1000000;

// Reference case G01: m, k, c, e, Jp; no-load speed 400 rad/s.
constexpr double kMass = 5.0;
constexpr double kStiffness = 2.0e5;
constexpr double kDamping = 40.0;
constexpr double kEccentricity = 2.0e-4;
constexpr double kNoLoad = 400.0;

RunningSystem::Setup sommerfeld(double stall_torque, double speed = 0.0) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", kMass},
                  {"stiffness", kStiffness},
                  {"damping", kDamping},
                  {"eccentricity", kEccentricity},
                  {"polar_inertia", 0.02}};
  s.motor = Motor::falling(stall_torque, kNoLoad);
  s.v = {0.0, 0.0, speed};
  return s;
}

/// 1.5 ms: a seventh of a turn at the critical speed, where order 6 leaves 1e-7 a turn.
constexpr std::int64_t kStep = 3 * kMillisecond / 2;

TEST(Motor, TooWeakItIsCapturedBelowTheCriticalSpeed) {
  RunningSystem rotor(sommerfeld(0.3), "gauss_legendre_6", kStep);
  ASSERT_EQ(rotor.run(26667), StepStatus::kOk);  // 40 s
  EXPECT_NEAR(rotor.v(2), 197.90070944526, 1e-4 * 197.9);
  EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)), 4.375819053e-3, 1e-3 * 4.376e-3);
}

TEST(Motor, HasItsUpperSteadySpeedTooWhereItStartsBeyondTheResonance) {
  RunningSystem rotor(sommerfeld(0.3, 390.0), "gauss_legendre_6", kMillisecond);
  // It approaches as exp(-t T0 / (w0 J)), J/26 s: 400 s leave 3e-7 of 8.5 rad/s.
  ASSERT_EQ(rotor.run(400000), StepStatus::kOk);
  EXPECT_NEAR(rotor.v(2), 398.4820931548651, 1e-5);
}

TEST(Motor, EscapesFromTheTorqueThatTheReferenceRunsBracket) {
  RunningSystem captured(sommerfeld(0.40078125 * 0.998), "gauss_legendre_6", kStep);
  RunningSystem passing(sommerfeld(0.40195312499999997 * 1.002), "gauss_legendre_6", kStep);
  ASSERT_EQ(captured.run(26667), StepStatus::kOk);
  ASSERT_EQ(passing.run(26667), StepStatus::kOk);
  EXPECT_LT(captured.v(2), 200.0);
  EXPECT_GT(passing.v(2), 210.0);
}

TEST(Motor, WithoutTorqueAndDampingAngularMomentumIsConserved) {
  RunningSystem::Setup s = sommerfeld(0.0, 180.0);
  s.parameters["damping"] = 0.0;
  s.parameters["internal_damping"] = 30.0;  // acts between disc and shaft: inside
  s.motor = Motor::constant(0.0);
  s.q = {2.0e-3, -1.0e-3, 0.3};
  RunningSystem rotor(s, "gauss_legendre_6", kMillisecond / 2);
  const auto momentum = [&] {
    const double c = kEccentricity * std::cos(rotor.q(2));
    const double d = kEccentricity * std::sin(rotor.q(2));
    const double gx = rotor.q(0) + c;
    const double gy = rotor.q(1) + d;
    const double vx = rotor.v(0) - rotor.v(2) * d;
    const double vy = rotor.v(1) + rotor.v(2) * c;
    return kMass * (gx * vy - gy * vx) + 0.02 * rotor.v(2);
  };
  const double before = momentum();
  const double energy = rotor.energies().jacobi;
  ASSERT_EQ(rotor.run(20000), StepStatus::kOk);
  EXPECT_NEAR(momentum(), before, 1e-9 * before);
  EXPECT_LT(rotor.energies().jacobi, 0.999 * energy) << "rotating damping takes energy";
}

// free_rotor has the same rotor in xi, eta, turning with it.
TEST(Motor, MovesAsTheFreeRotorOfTheTurningFrame) {
  const ParameterValues disc{{"mass", 2.0},
                             {"stiffness", 200.0},
                             {"damping", 2.0},
                             {"eccentricity", 0.01},
                             {"polar_inertia", 0.02}};
  RunningSystem::Setup fixed;
  fixed.model = "jeffcott_rotor";
  fixed.parameters = disc;
  fixed.motor = Motor::constant(0.25, 1.0e-4);
  fixed.q = {0.02, -0.01, 0.0};
  fixed.v = {0.0, 0.1, 2.0};
  RunningSystem::Setup turning;
  turning.model = "free_rotor";
  turning.parameters = disc;
  turning.parameters["torque"] = 0.25;
  turning.parameters["drag"] = 1.0e-4;
  turning.q = {0.02, -0.01, 0.0};
  turning.v = {2.0 * -0.01, 0.1 - 2.0 * 0.02, 2.0};
  RunningSystem a(fixed, "gauss_legendre_6", kMillisecond);
  RunningSystem b(turning, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(5000), StepStatus::kOk);
  ASSERT_EQ(b.run(5000), StepStatus::kOk);
  const double c = std::cos(b.q(2));
  const double d = std::sin(b.q(2));
  EXPECT_NEAR(a.q(0), b.q(0) * c - b.q(1) * d, 1e-9 * 0.02);
  EXPECT_NEAR(a.q(1), b.q(0) * d + b.q(1) * c, 1e-9 * 0.02);
  EXPECT_NEAR(a.v(2), b.v(2), 1e-9 * b.v(2));
}

// The spin is stored as turns and a remainder: after 1e9 rad the whirl is that of the first turn.
TEST(Motor, LosesNoPhaseHoweverOftenItHasTurned) {
  RunningSystem::Setup near = sommerfeld(0.3, 150.0);
  RunningSystem::Setup far = near;
  const double turns = 159154943.0;
  near.q = {0.0, 0.0, 0.0};
  far.q = {0.0, 0.0, turns * 6.283185307179586};
  // What this product is, less whole turns: 2 pi as a double is 2.449e-16 short.
  near.q[2] = std::fma(turns, 6.283185307179586, -far.q[2]) * -1.0 - turns * 2.4492935982947064e-16;
  RunningSystem a(near, "gauss_legendre_6", kMillisecond);
  RunningSystem b(far, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(3000), StepStatus::kOk);
  ASSERT_EQ(b.run(3000), StepStatus::kOk);
  EXPECT_NEAR(b.q(0), a.q(0), 1e-12 * kEccentricity);
  EXPECT_NEAR(b.q(1), a.q(1), 1e-12 * kEccentricity);
}

// rigid_disc_rotor with uncoupled tilt and displacement is a Jeffcott rotor.
TEST(Motor, TurnsARigidDiscAsAJeffcottRotor) {
  RunningSystem::Setup jeffcott = sommerfeld(0.3);
  RunningSystem::Setup disc = jeffcott;
  disc.model = "rigid_disc_rotor";
  disc.parameters = {{"mass", kMass},
                     {"polar_inertia", 0.02},
                     {"transverse_inertia", 0.013},
                     {"stiffness_displacement", kStiffness},
                     {"stiffness_rotation", 3.0e3},
                     {"damping_displacement", kDamping},
                     {"eccentricity", kEccentricity}};
  disc.settings.choices = {{"frame", "fixed"}, {"gravity_on_shaft", "false"}};
  RunningSystem a(jeffcott, "gauss_legendre_6", kMillisecond);
  RunningSystem b(disc, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(10000), StepStatus::kOk);
  ASSERT_EQ(b.run(10000), StepStatus::kOk);
  EXPECT_NEAR(b.v(4), a.v(2), 1e-10 * a.v(2));
  EXPECT_NEAR(b.q(0), a.q(0), 1e-9 * 4.0e-3);
}

/// A flexible_rotor from its scene parameters.
RunningSystem::Setup flexible(const std::string& parameters, const Motor& motor,
                              double speed = 0.0) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {r: {model: flexible_rotor, parameters: "
      "{speed: 0, " +
      parameters + "}}}}");
  RunningSystem::Setup s;
  s.model = "flexible_rotor";
  s.parameters = scene.systems[0].parameters;
  s.settings = scene.systems[0].settings;
  s.motor = motor;
  s.speed = speed;
  s.q.resize(scene.systems[0].q.size() + 1);
  s.v.resize(s.q.size());
  s.v.back() = speed;
  return s;
}

/// 4 and 1 kg on 20 mm of steel in two bearings, with all that acts on a spin.
std::string laboratory(const std::string& further) {
  return "youngs_modulus: 2.1e+11, shear_modulus: 8.0e+10, density: 7800, internal_damping: "
         "1.0e-5, gravity_on_shaft: true, elements: [{length: 0.15, outer_diameter: 0.02, count: "
         "4}], discs: [{node: 2, mass: 4.0, polar_inertia: 0.02, transverse_inertia: 0.011}, "
         "{node: 3, mass: 1.0, polar_inertia: 0.004, transverse_inertia: 0.0022, skew: 0.002}], "
         "bearings: [{node: 0, kxx: 1.0e+7, kyy: 6.0e+6, cxx: 200}, {node: 4, kxx: 1.0e+7, kyy: "
         "6.0e+6, cxx: 200}, {node: 2, cxx: 15}], unbalances: [{node: 2, magnitude: 6.0e-4}, "
         "{node: 3, magnitude: 1.0e-4, angle: 2.0}], " +
         further;
}

// A Jeffcott rotor's J is about the mass centre, a disc's about the shaft.
TEST(Motor, OfAShaftOfElementsWithoutMassIsThatOfAJeffcottRotor) {
  const double bending = kStiffness * 0.6 * 0.6 * 0.6 / 48.0;  // E I
  const double diameter = std::pow(64.0 * bending / (3.14159265358979 * 2.1e11), 0.25);
  const std::string shaft = fmt::format(
      "youngs_modulus: 2.1e+11, density: 1.0e-4, shear_deformation: false, elements: [{{length: "
      "0.3, outer_diameter: {}, count: 2}}], discs: [{{node: 1, mass: {}, polar_inertia: {}, "
      "transverse_inertia: 0.013}}], bearings: [{{node: 0, kxx: 1.0e+13}}, {{node: 2, kxx: "
      "1.0e+13}}, {{node: 1, cxx: {}}}], unbalances: [{{node: 1, magnitude: {}}}], modes: 4, "
      "highest_speed: 400",
      diameter, kMass, 0.02 + kMass * kEccentricity * kEccentricity, kDamping,
      kMass * kEccentricity);
  RunningSystem jeffcott(sommerfeld(0.3), "gauss_legendre_6", kMillisecond / 2);
  RunningSystem rotor(flexible(shaft, Motor::falling(0.3, kNoLoad)), "exponential", kMillisecond);
  ASSERT_EQ(jeffcott.run(40000), StepStatus::kOk);
  ASSERT_EQ(rotor.run(20000), StepStatus::kOk);
  const auto spin = static_cast<std::size_t>(rotor.dynamics().dof()) - 1;
  EXPECT_NEAR(rotor.v(spin), jeffcott.v(2), 1e-7 * jeffcott.v(2));
  EXPECT_NEAR(rotor.q(spin), jeffcott.q(2), 1e-5);
  const Station disc = rotor.dynamics().stations().front();
  const std::vector<double> state = rotor.state();
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), rotor.dynamics().dof());
  EXPECT_NEAR(disc.along_x.dot(q), jeffcott.q(0), 1e-5 * 4.4e-3);
  EXPECT_NEAR(disc.along_y.dot(q), jeffcott.q(1), 1e-5 * 4.4e-3);
}

// The same rotor by energies and dual numbers (FreeSpin), and by its matrices.
TEST(SpinningRotor, HasTheEquationsThatTheEnergiesGive) {
  constexpr double kInternal = 2.0e-4;
  const ModelInfo& model = *findModel("rigid_disc_rotor");
  const ParameterValues disc = completed(model, {{"mass", 3.0},
                                                 {"polar_inertia", 0.05},
                                                 {"transverse_inertia", 0.03},
                                                 {"stiffness_displacement", 2.0e5},
                                                 {"stiffness_coupling", -1.0e4},
                                                 {"stiffness_rotation", 2.0e3},
                                                 {"damping_displacement", 20.0},
                                                 {"damping_rotation", 0.1},
                                                 {"internal_damping", kInternal},
                                                 {"eccentricity", 2.0e-3},
                                                 {"eccentricity_angle", 0.4},
                                                 {"skew", 0.01},
                                                 {"skew_angle", 1.9}});
  Settings settings;
  settings.choices = {{"frame", "fixed"}, {"gravity_on_shaft", "true"}};
  ModelContext around(9.81);
  const auto held = model.setUp(disc, settings, around).dynamics;
  SpinCoupling coupling;
  coupling.polar_inertia = 0.05 + 3.0 * 2.0e-3 * 2.0e-3;
  coupling.motor = Motor::falling(0.9, 400.0, 1.0e-3);
  coupling.circulatory = held->linearRotor().matrices(1.0).circulatory;
  coupling.resistance = kInternal * held->linearRotor().matrices(0.0).stiffness;
  around.motor = coupling.motor;
  const auto of_energies = model.setUp(disc, settings, around).dynamics;
  const Dynamics& by_energies = *of_energies;
  RotorDescription description;
  description.model = "rigid_disc_rotor";
  description.coordinates = held->coordinates();
  description.stations = held->stations();
  const SpinningRotor by_matrices(
      std::make_shared<LinearRotorDynamics>(description, held->linearRotor()), {}, coupling);

  std::mt19937 dice(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd q(5);
    Eigen::VectorXd v(5);
    for (Eigen::Index i = 0; i < 5; ++i) {
      q[i] = i < 4 ? 1.0e-2 * any(dice) : 3.0 * any(dice);
      v[i] = i < 4 ? any(dice) : 300.0 * any(dice);
    }
    const Eigen::VectorXd a = by_energies.acceleration(q, v, {});
    const Eigen::VectorXd b = by_matrices.acceleration(q, v, {});
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-9 * a.cwiseAbs().maxCoeff());
    const Energies ea = by_energies.energies(q, v, {});
    const Energies eb = by_matrices.energies(q, v, {});
    EXPECT_NEAR(eb.jacobi, ea.jacobi, 1e-12 * (ea.kinetic + std::fabs(ea.potential)));
    EXPECT_NEAR(eb.dissipated_power, ea.dissipated_power, 1e-10 * ea.dissipated_power);
    EXPECT_NEAR(eb.input_power - eb.dissipated_power, ea.input_power - ea.dissipated_power,
                1e-9 * (std::fabs(ea.input_power) + ea.dissipated_power));
    EXPECT_LT((by_energies.momenta(q, v, {}) - by_matrices.momenta(q, v, {})).tail(1).norm(),
              1e-12 * by_energies.momenta(q, v, {}).norm());
    const Linearization la = by_energies.linearization(q, v, a, {});
    const Linearization lb = by_matrices.linearization(q, v, b, {});
    const auto near = [](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
      EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-7 * (1.0 + y.cwiseAbs().maxCoeff()));
    };
    near(lb.mass, la.mass);
    near(lb.damping + lb.gyroscopic, la.damping + la.gyroscopic);
    near(lb.stiffness + lb.circulatory, la.stiffness + la.circulatory);
  }
}

/// Classical Runge-Kutta of a rotor's full equations.
std::vector<double> byRungeKutta(const Dynamics& dynamics, double speed, double duration,
                                 double h) {
  const Eigen::Index n = dynamics.dof();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd v = q;
  v[n - 1] = speed;
  const auto f = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& r) {
    return dynamics.acceleration(x, r, {});
  };
  for (long i = std::lround(duration / h); i > 0; --i) {
    const Eigen::VectorXd k1 = f(q, v);
    const Eigen::VectorXd k2 = f(q + 0.5 * h * v, v + 0.5 * h * k1);
    const Eigen::VectorXd k3 = f(q + 0.5 * h * v + 0.25 * h * h * k1, v + 0.5 * h * k2);
    const Eigen::VectorXd k4 = f(q + h * v + 0.5 * h * h * k2, v + h * k3);
    q += h * v + h * h / 6.0 * (k1 + k2 + k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  std::vector<double> state(q.data(), q.data() + n);
  state.insert(state.end(), v.data(), v.data() + n);
  return state;
}

double farthest(const RunningSystem& rotor, const std::vector<double>& from, std::size_t n) {
  double most = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    most = std::max(most, std::fabs(rotor.q(i) - from[i]));
  }
  return most;
}

TEST(SpinningRotor, MovesAsItsEquationsDoByAnotherMethod) {
  const Motor motor = Motor::falling(0.9, 260.0, 1.0e-4);
  RunningSystem rotor(flexible(laboratory("modes: 6"), motor, 80.0), "exponential", kMillisecond);
  const std::vector<double> reference = byRungeKutta(rotor.dynamics(), 80.0, 0.3, 1.0e-5);
  ASSERT_EQ(rotor.run(300), StepStatus::kOk);
  EXPECT_NEAR(rotor.v(6), reference[13], 1e-9 * reference[13]);
  EXPECT_NEAR(rotor.q(6), reference[6], 1e-9);
  EXPECT_LT(farthest(rotor, reference, 6), 1e-11);
}

TEST(SpinningRotor, WithARubMovesAsItsEquationsDoByAnotherMethod) {
  // In contact all the time: no instant of touching reduces the order.
  const std::string rubbing =
      "modes: 6, rubs: [{node: 2, clearance: 1.0e-6, stiffness: 2.0e+4, damping: 20.0, friction: "
      "0.2, radius: 0.05}], cubic_springs: [{node: 3, stiffness: 1.0e+10}]";
  const Motor motor = Motor::falling(0.9, 260.0, 1.0e-4);
  RunningSystem::Setup setup = flexible(laboratory(rubbing), motor, 80.0);
  RunningSystem rotor(setup, "exponential", kMillisecond / 4);
  const std::vector<double> reference = byRungeKutta(rotor.dynamics(), 80.0, 0.05, 5.0e-6);
  ASSERT_EQ(rotor.run(200), StepStatus::kOk);
  EXPECT_NEAR(rotor.v(rotor.dynamics().dof() - 1), reference.back(), 1e-6 * reference.back());
  RunningSystem::Setup smooth = setup;
  smooth.settings.tables.at("rubs").front().numbers.at("friction") = 0.0;
  RunningSystem free(smooth, "exponential", kMillisecond / 4);
  ASSERT_EQ(free.run(200), StepStatus::kOk);
  EXPECT_GT(free.v(6), rotor.v(6) + 1.0e-3) << "friction brakes the spin";
}

TEST(SpinningRotor, ConvergesWithTheFifthPowerOfTheStep) {
  const Motor motor = Motor::falling(0.9, 260.0, 1.0e-4);
  // Of two modes, which these steps resolve: the lowest along x and along y.
  const auto speed = [&](std::int64_t step) {
    RunningSystem rotor(flexible(laboratory("modes: 2, highest_speed: 300"), motor, 80.0),
                        "exponential", step);
    EXPECT_EQ(rotor.run(640 * kMillisecond / step), StepStatus::kOk);
    return rotor.v(static_cast<std::size_t>(rotor.dynamics().dof()) - 1);
  };
  const double exact = speed(kMillisecond / 2);
  const double coarse = std::fabs(speed(4 * kMillisecond) - exact);
  const double fine = std::fabs(speed(2 * kMillisecond) - exact);
  EXPECT_GT(coarse, 16.0 * fine);
  EXPECT_LT(fine, 1e-8 * exact);
}

TEST(SpinningRotor, ClosesItsEnergyBalance) {
  RunningSystem rotor(flexible(laboratory("modes: auto, highest_speed: 300"),
                               Motor::falling(0.9, 260.0, 1.0e-4), 20.0),
                      "exponential", kMillisecond / 2);
  const double before = rotor.energies().jacobi;
  double most = 0.0;
  for (int part = 0; part < 40; ++part) {
    ASSERT_EQ(rotor.run(100), StepStatus::kOk);
    most = std::max(most, std::fabs(rotor.energies().jacobi - before - rotor.work()));
  }
  const double after = rotor.energies().jacobi;
  EXPECT_GT(after, before + 1.0) << "a run-up";
  EXPECT_LT(most, 1e-9 * after);
}

// The torque of the steady whirl at the resonance bounds what captures (sommerfeld_speeds.h).
TEST(SpinningRotor, IsCapturedBelowTheTorqueThatItsWhirlTakesAndPassesAbove) {
  const std::string shaft = laboratory("modes: 6, highest_speed: 300");
  const RunningSystem::Setup weak = flexible(shaft, Motor::falling(0.4, 400.0));
  ModelContext around(9.81);
  const auto held =
      findModel("flexible_rotor")
          ->setUp(completed(*findModel("flexible_rotor"), weak.parameters), weak.settings, around)
          .dynamics;
  const LinearRotor whirling = held->linearRotor();
  const std::vector<SteadySpeed> steady =
      sommerfeldSpeeds(whirling, Motor::falling(0.4, 400.0), 400.0);
  ASSERT_GE(steady.size(), 3u);
  RunningSystem captured(weak, "exponential", 2 * kMillisecond);
  ASSERT_EQ(captured.run(15000), StepStatus::kOk);
  EXPECT_NEAR(captured.v(6), steady.front().speed, 0.005 * steady.front().speed);

  double most = 0.0;
  for (double speed = 60.0; speed < 400.0; speed += 0.05) {
    most = std::max(most, whirlTorque(whirling, speed));
  }
  RunningSystem passing(flexible(shaft, Motor::falling(3.0 * most, 800.0)), "exponential",
                        kMillisecond);
  ASSERT_EQ(passing.run(12000), StepStatus::kOk);
  EXPECT_GT(passing.v(6), 1.5 * steady.front().speed) << most << " N m";
}

// Dropped into films while its speed changes: stiff transients, that a quadrature of the work
// misses.
TEST(SpinningRotor, InFilmsClosesItsEnergyBalanceWhileItSettles) {
  const std::string film = "length: 0.02, diameter: 0.05, clearance: 1.0e-4, viscosity: 0.03}";
  const std::string shaft =
      "youngs_modulus: 2.1e+11, density: 7800, gravity_on_shaft: true, elements: [{length: 0.1, "
      "outer_diameter: 0.03, count: 6}], discs: [{node: 3, mass: 5.0, polar_inertia: 0.02, "
      "transverse_inertia: 0.012}], unbalances: [{node: 3, magnitude: 1.0e-4}], modes: 12, "
      "journal_bearings: [{node: 0, " +
      film + ", {node: 6, " + film + "]";
  for (const bool on_motor : {false, true}) {
    RunningSystem::Setup setup = flexible(shaft, Motor::falling(2.0, 400.0), 100.0);
    if (!on_motor) {
      setup.motor.reset();
      setup.q.pop_back();
      setup.v.pop_back();
      setup.profile = {{300.0, 100.0, 0.0, 0.0}};
    }
    RunningSystem rotor(setup, "exponential", kMillisecond / 2);
    const double start = rotor.energies().jacobi;
    double most = 0.0;
    double largest = 0.0;
    for (int i = 0; i < 800; ++i) {
      ASSERT_EQ(rotor.run(1), StepStatus::kOk);
      const double energy = rotor.energies().jacobi;
      most = std::max(most, std::fabs(energy - start - rotor.work()));
      largest = std::max(largest, std::fabs(energy));
    }
    EXPECT_LT(most, 1e-11 * largest) << (on_motor ? "on a motor" : "on a drive");
  }
}

TEST(SpinningRotor, StepsWithoutAllocation) {
  RunningSystem rotor(
      flexible(laboratory("modes: 6, rubs: [{node: 2, clearance: 1.0e-4, stiffness: 1.0e+6, "
                          "friction: 0.1, radius: 0.02}]"),
               Motor::falling(0.9, 260.0), 50.0),
      "exponential", kMillisecond);
  ASSERT_EQ(rotor.run(10), StepStatus::kOk);
  const AllocationGuard guard;
  ASSERT_EQ(rotor.run(300), StepStatus::kOk);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(SpinningRotor, StopsBeyondTheSpeedsItWasPreparedFor) {
  RunningSystem::Setup driven =
      flexible(laboratory("modes: 6, highest_speed: 60"), Motor::constant(0.9));
  RunningSystem rotor(driven, "exponential", kMillisecond);
  EXPECT_EQ(rotor.run(20000), StepStatus::kOutOfRange);
}

}  // namespace motor_test
}  // namespace whirl_twin
