// Run-ups by the exact step of a linear rotor (rotor_step.h): peaks and states of the reference
// rotors, far finer steps of another method, breakpoints of the profile inside a step, the audit,
// and no allocation.
#include "integration/rotor_step.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "allocation_guard.h"
#include "integration/linear_rotor_stepper.h"
#include "integration/packed_matrix.h"
#include "messages/input_error.h"
#include "models/linear_rotor_setup.h"
#include "running_system.h"

namespace whirl_twin {
namespace rotor_step_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Json = nlohmann::json;

Json reference(const std::string& id) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  for (const Json& entry : Json::parse(file)) {
    if (entry["id"] == id) {
      return entry;
    }
  }
  throw InputError("no reference rotor " + id);
}

Json expected(const Json& entry, const std::string& name) {
  for (const Json& value : entry["expected"]) {
    if (value["name"] == name) {
      return value["value"];
    }
  }
  throw std::logic_error("nothing expected of " + name);
}

/// A rotor whose matrices are given, stepped alone.
struct Stepped {
  LinearRotor rotor;
  Drive drive;
  double h;
  RotorStep step;
  LinearMotion motion;
  std::int64_t steps = 0;

  Stepped(LinearRotor given, const Drive& turned, double step_size)
      : rotor(std::move(given)),
        drive(turned),
        h(step_size),
        step(rotor, h, drive.speedRange(), drive.constantSpeeds()),
        motion(rotor.dof()) {}

  StepStatus advance() {
    drive.begin(std::llround(static_cast<double>(steps) * h * 1.0e9));
    ++steps;
    return step.advance(drive, 0.0, motion);
  }
  /// h = T + V gained beyond the work done.
  double residual() const {
    const Linearization l = rotor.matrices(0.0);
    return 0.5 * motion.v().dot(l.mass * motion.v()) +
           0.5 * motion.q().dot(l.stiffness * motion.q()) - rotor.load.dot(motion.q()) -
           motion.work.high;
  }
};

MatrixXd matrix(const Json& rows) {
  MatrixXd m(rows.size(), rows[0].size());
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return m;
}

/// C06: the overhung gyroscopic disc; its unbalance in x, y and its slopes.
LinearRotor overhungDisc() {
  const Json p = reference("C06_gyro_speed_ramp")["parameters"];
  const Json base = reference("C01_stodola_green_overhung")["parameters"];
  const MatrixXd none = MatrixXd::Zero(4, 4);
  const Linearization l{matrix(p["M"]), matrix(p["C"]), matrix(p["G_times_Om"]), matrix(p["K"]),
                        none};
  LinearRotor rotor;
  rotor.matrices = [l](double speed) {
    return Linearization{l.mass, l.damping, speed * l.gyroscopic, l.stiffness, l.circulatory};
  };
  rotor.speed_dependent = true;
  rotor.load = VectorXd::Zero(4);
  const double unbalance = p["unbalance_kgm"];
  const double skew =
      (base["Id"].get<double>() - base["Ip"].get<double>()) * p["disc_skew_rad"].get<double>();
  Eigen::VectorXcd amplitude(4);
  const std::complex<double> i(0.0, 1.0);
  amplitude << unbalance, -i * unbalance, skew, -i * skew;
  rotor.forces = {{amplitude, 1, true}};
  return rotor;
}

TEST(RotorStep, TakesTheGyroscopicDiscThroughItsCriticalSpeed) {
  const Json c06 = reference("C06_gyro_speed_ramp");
  const double acceleration = c06["parameters"]["alpha"];
  Stepped run(overhungDisc(), Drive(20.0, 0.0, {{400.0, acceleration, 0.0, 0.0}}), 1.0e-3);
  const Json times = expected(c06, "t");
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (static_cast<double>(run.steps) * run.h < times[k].get<double>() - 1.0e-9) {
      ASSERT_EQ(run.advance(), StepStatus::kOk);
    }
    for (const auto& [name, state] :
         {std::pair{"q", VectorXd(run.motion.q())}, std::pair{"qdot", VectorXd(run.motion.v())}}) {
      const Json row = expected(c06, name)[k];
      VectorXd truth(4);
      truth << row[0], row[1], row[2], row[3];
      // Slopes and positions are of a size here. The rates keep (w h)^2 a h^2 / 720 of the second
      // mode, whose w h is near one.
      const double bound = name == std::string("q") ? 2.0e-8 : 3.0e-7;
      EXPECT_LT((state - truth).norm(), bound * truth.norm()) << name << " at " << times[k];
    }
  }
}

/// Peak of |z| through a run-up of a Jeffcott rotor and the speed there, between the steps too.
std::pair<double, double> peakOfRunUp(RunningSystem& run, double last_speed) {
  struct Square {
    double value, slope, bend;
  };
  const auto now = [&run] {
    const ShaftMotion shaft = run.drive().at(0.0);
    const Eigen::Vector2d q(run.q(0), run.q(1));
    const Eigen::Vector2d v(run.v(0), run.v(1));
    const Eigen::Vector2d a = run.dynamics().acceleration(
        q, v, {run.time(), shaft.angle, shaft.speed, shaft.acceleration});
    return Square{q.dot(q), 2.0 * q.dot(v), 2.0 * (v.dot(v) + q.dot(a))};
  };
  std::pair<double, double> peak{0.0, 0.0};
  Square before = now();
  double time = run.time();
  while (run.drive().at(0.0).speed < last_speed) {
    EXPECT_EQ(run.run(1), StepStatus::kOk);
    const Square after = now();
    const double h = run.time() - time;
    if (before.slope > 0.0 && after.slope <= 0.0) {
      // The quintic through both ends, maximised by the zero of its slope.
      const double d0 = after.value - before.value - h * before.slope - 0.5 * h * h * before.bend;
      const double d1 = h * (after.slope - before.slope) - h * h * before.bend;
      const double d2 = h * h * (after.bend - before.bend);
      const double c3 = 10.0 * d0 - 4.0 * d1 + 0.5 * d2;
      const double c4 = -15.0 * d0 + 7.0 * d1 - d2;
      const double c5 = 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
      const auto slope = [&](double x) {
        return h * before.slope +
               x * (h * h * before.bend + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)));
      };
      double low = 0.0;
      double high = 1.0;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(middle) > 0.0 ? low : high) = middle;
      }
      const double value =
          before.value + low * (h * before.slope + low * (0.5 * h * h * before.bend +
                                                          low * (c3 + low * (c4 + low * c5))));
      const double acceleration = run.drive().at(0.0).acceleration;
      peak = std::max(peak, {std::sqrt(value), acceleration * (time + low * h)});
    }
    before = after;
    time = run.time();
  }
  return peak;
}

class RunUpPeak : public testing::TestWithParam<const char*> {};

TEST_P(RunUpPeak, IsThatOfTheReferenceAtMillisecondSteps) {
  const Json entry = reference(GetParam());
  const Json p = entry["parameters"];
  for (const Json& row : expected(entry, "table")) {
    RunningSystem::Setup setup;
    setup.model = "jeffcott_rotor";
    const double mass = p["m"];
    const double frequency = p["wn"];
    const double eccentricity = p["e"];
    setup.parameters = {{"mass", mass},
                        {"stiffness", p["k"]},
                        {"damping", 2.0 * p["zeta"].get<double>() * mass * frequency},
                        {"eccentricity", eccentricity}};
    const double acceleration = row["alpha_over_wn2"].get<double>() * frequency * frequency;
    setup.profile = {{2.0 * frequency, acceleration, 0.0, 0.0}};
    RunningSystem run(setup, "exponential", 1'000'000);
    const double ratio = row["speed_ratio_at_peak"];
    const auto [radius, speed] = peakOfRunUp(run, (ratio + 0.05) * frequency);
    EXPECT_NEAR(radius / eccentricity / row["peak_amp_over_e"].get<double>(), 1.0, 1.0e-7)
        << "alpha / wn^2 = " << row["alpha_over_wn2"];
    // At a maximum the place is known to half the digits of the value.
    EXPECT_NEAR(speed / frequency, ratio, 1.0e-5) << "alpha / wn^2 = " << row["alpha_over_wn2"];
  }
}

INSTANTIATE_TEST_SUITE_P(ReferenceRotors, RunUpPeak,
                         testing::Values("F01_runup_zeta0.0", "F02_runup_zeta0.02"));

TEST(RunUpPeak, FeelsTheTangentialForceOfTheUnbalance) {
  const Json f05 = reference("F05_runup_no_tangential");
  RunningSystem::Setup setup;
  setup.model = "jeffcott_rotor";
  setup.parameters = {
      {"mass", 1.0}, {"stiffness", 9.0e4}, {"damping", 12.0}, {"eccentricity", 1.0}};
  setup.profile = {{600.0, 0.05 * 9.0e4, 0.0, 0.0}};
  RunningSystem run(setup, "exponential", 1'000'000);
  const auto [radius, speed] = peakOfRunUp(run, 550.0);
  EXPECT_NEAR(radius, expected(f05, "peak_with_term").get<double>(), 1.0e-5);
  EXPECT_GT(std::fabs(radius - expected(f05, "peak_amp_over_e").get<double>()), 4.0e-3);
  EXPECT_GT(speed, 0.0);
}

/// A rotor with every effect with speed-dependent matrices, on a drive with breakpoints everywhere.
RunningSystem::Setup everythingThatFollowsTheSpeed(double speed, std::vector<SpeedMove> profile) {
  RunningSystem::Setup setup;
  setup.model = "jeffcott_rotor";
  setup.parameters = {{"mass", 2.0},
                      {"stiffness", 8.0e4},
                      {"stiffness_y", 9.0e4},
                      {"damping", 30.0},
                      {"internal_damping", 6.0},
                      {"fluid_damping", 10.0},
                      {"fluid_ratio", 0.48},
                      {"cross_coupling", 200.0},
                      {"eccentricity", 1.0e-4},
                      {"eccentricity_angle", 0.4},
                      {"bow", 3.0e-5},
                      {"bow_angle", -1.0}};
  setup.settings.choices["gravity_on_shaft"] = "true";
  setup.speed = speed;
  setup.profile = std::move(profile);
  return setup;
}

double distance(const RunningSystem& a, const RunningSystem& b) {
  return std::hypot(a.q(0) - b.q(0), a.q(1) - b.q(1));
}

TEST(RotorStep, AgreesWithFarFinerGaussLegendreSteps) {
  // Accelerations that jump, limited jerk, a dwell: breakpoints inside steps everywhere.
  const auto setup = everythingThatFollowsTheSpeed(
      30.0, {{171.3, 83.0, 0.0, 0.0377}, {260.0, 60.0, 900.0, 0.1}, {200.0, 150.0, 0.0, 0.2}});
  RunningSystem exact(setup, "exponential", 1'000'000);
  RunningSystem fine(setup, "gauss_legendre_6", 50'000);
  double largest = 0.0;
  double error = 0.0;
  for (int i = 0; i < 450; ++i) {
    ASSERT_EQ(exact.run(10), StepStatus::kOk);
    ASSERT_EQ(fine.run(200), StepStatus::kOk);
    largest = std::max(largest, std::hypot(fine.q(0), fine.q(1)));
    error = std::max(error, distance(exact, fine));
  }
  EXPECT_LT(error, 1.0e-8 * largest);
}

TEST(RotorStep, AuditsItsWorkInARunUp) {
  const auto setup = everythingThatFollowsTheSpeed(
      30.0, {{171.3, 83.0, 0.0, 0.0377}, {260.0, 60.0, 900.0, 0.1}, {200.0, 150.0, 0.0, 0.2}});
  RunningSystem run(setup, "exponential", 1'000'000);
  const double start = run.energies().jacobi;
  double largest = 0.0;
  double residual = 0.0;
  for (int i = 0; i < 4500; ++i) {
    ASSERT_EQ(run.run(1), StepStatus::kOk);
    const Energies e = run.energies();
    largest = std::max(largest, e.kinetic + std::fabs(e.potential));
    residual = std::max(residual, std::fabs(e.jacobi - start - run.work()));
  }
  EXPECT_LT(residual, 1.0e-9 * largest);
}

TEST(RotorStep, IsTheExactStepAtConstantSpeed) {
  // Against the method made for two coordinates: no truncation error in either.
  const auto setup = everythingThatFollowsTheSpeed(140.0, {});
  const ModelInfo& model = *findModel(setup.model);
  const auto dynamics =
      model.setUp(completed(model, setup.parameters), setup.settings, setup.gravity).dynamics;
  const LinearRotor rotor = dynamics->linearRotor();
  Stepped long_steps(rotor, Drive(140.0, 0.0), 0.5);
  Stepped short_steps(rotor, Drive(140.0, 0.0), 1.0e-3);
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(long_steps.advance(), StepStatus::kOk);
  }
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(short_steps.advance(), StepStatus::kOk);
  }
  EXPECT_LT((long_steps.motion.q() - short_steps.motion.q()).norm(),
            1.0e-11 * short_steps.motion.q().norm());
  EXPECT_LT(std::fabs(short_steps.residual()), 1.0e-11 * std::fabs(short_steps.motion.work.high));
}

TEST(RotorStep, KeepsTheEnergyOfAnUndampedGyroscopicRotor) {
  LinearRotor rotor = overhungDisc();
  rotor.forces.clear();
  rotor.matrices = [m = rotor.matrices](double speed) {
    Linearization l = m(speed);
    l.damping.setZero();
    return l;
  };
  Stepped run(rotor, Drive(20.0, 0.0, {{260.0, 60.0, 0.0, 0.0}}), 1.0e-3);
  run.motion.q() << 1.0e-4, 0.0, 0.0, 1.0e-4;
  const double start = run.residual();
  for (int i = 0; i < 4000; ++i) {
    ASSERT_EQ(run.advance(), StepStatus::kOk);
  }
  EXPECT_NEAR(run.residual() / start, 1.0, 1.0e-9);
}

TEST(RotorStep, RefusesASpeedItWasNotPreparedFor) {
  Stepped run(overhungDisc(), Drive(20.0, 0.0, {{60.0, 60.0, 0.0, 0.0}}), 1.0e-3);
  ASSERT_EQ(run.advance(), StepStatus::kOk);
  const VectorXd before = run.motion.q();
  Drive faster(100.0, 0.0);
  faster.begin(0);
  EXPECT_EQ(run.step.advance(faster, 0.0, run.motion), StepStatus::kOutOfRange);
  EXPECT_EQ(run.motion.q(), before);
}

TEST(LinearRotorStepper, IsMadeReadyForFurtherSpeeds) {
  const auto setup = everythingThatFollowsTheSpeed(30.0, {});
  const ModelInfo& model = *findModel(setup.model);
  const auto dynamics =
      model.setUp(completed(model, setup.parameters), setup.settings, setup.gravity).dynamics;
  Drive drive(30.0, 0.0);
  const LinearRotorStepper system(dynamics, {}, drive, 1.0e-3, 1);
  EXPECT_EQ(system.readyFor(30.0, 30.0), nullptr);
  const auto further = system.readyFor(30.0, 90.0);
  ASSERT_NE(further, nullptr);
  EXPECT_EQ(further->readyFor(30.0, 90.0), nullptr);
  const std::array<double, 2> rest{0.0, 0.0};
  further->set(rest.data(), rest.data());
  ASSERT_TRUE(drive.setSpeed(90.0, 100.0, 0.0));
  for (int i = 0; i < 1000; ++i) {
    drive.begin(i * 1'000'000);
    ASSERT_EQ(further->step(0.0), StepStatus::kOk);
  }
}

TEST(RotorStep, DoesNotAllocate) {
  Stepped run(overhungDisc(), Drive(20.0, 0.0, {{60.0, 60.0, 0.0, 0.3}, {90.0, 60.0, 500.0, 0.0}}),
              1.0e-3);
  AllocationGuard guard;
  for (int i = 0; i < 3000; ++i) {
    run.advance();
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(PackedMatrix, ProductsAreThoseOfTheWholeMatrixWhateverItLeavesOut) {
  MatrixXd matrix = MatrixXd::Zero(37, 50);
  // A full block, a triangle, single columns, and rows of nothing.
  for (Eigen::Index i = 0; i < 37; ++i) {
    for (Eigen::Index j = 0; j < 50; ++j) {
      const bool is_there = (i < 12 && j > 20 && j < 33) || (i > 20 && j < i - 20) || j == 41;
      matrix(i, j) = is_there && i != 36 ? std::sin(1.0 + 3.0 * i + 7.0 * j) : 0.0;
    }
  }
  PackedMatrix packed(matrix);
  constexpr Eigen::Index kTogether = PackedMatrix::kTogether;
  MatrixXd vectors(kTogether, 50);
  MatrixXd products(kTogether, packed.rows());
  for (Eigen::Index k = 0; k < vectors.size(); ++k) {
    vectors.data()[k] = std::cos(0.3 * k);
  }
  for (int again = 0; again < 2; ++again) {
    packed.multiplyTogether(vectors.data(), products.data());
    for (Eigen::Index k = 0; k < kTogether; ++k) {
      const VectorXd one = vectors.row(k);
      VectorXd product(packed.rows());
      packed.multiply(one.data(), product.data());
      const VectorXd whole = matrix * one;
      EXPECT_LT((product.head(37) - whole).norm(), 1e-14 * whole.norm());
      EXPECT_LT((products.row(k).head(37).transpose() - whole).norm(), 1e-14 * whole.norm());
      EXPECT_EQ(product.tail(packed.rows() - 37).norm(), 0.0);
    }
  }
}

}  // namespace rotor_step_test
}  // namespace whirl_twin
