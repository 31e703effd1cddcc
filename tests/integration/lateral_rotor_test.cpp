// The exact steps of a rotor of two coordinates (lateral_rotor_stepper.h) against the general step
// by matrices and a table over speed (rotor_step.h): run-ups at any step, random rotors,
// breakpoints of the profile inside a step, the audit, constant speed, and no allocation.
#include "integration/lateral_rotor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "allocation_guard.h"
#include "integration/lateral_rotor_stepper.h"
#include "integration/lateral_run_up.h"
#include "integration/linear_rotor_stepper.h"
#include "integration/matrix_exponential.h"
#include "running_system.h"

namespace whirl_twin {
namespace lateral_rotor_test {

constexpr std::int64_t kMillisecond = 1'000'000;

/// A Jeffcott rotor by its matrices alone, stepped from rest.
class ByMatrices {
 public:
  ByMatrices(const RunningSystem& like, const Drive& drive, std::int64_t step)
      : dynamics_(std::shared_ptr<const Dynamics>(), &like.dynamics()),
        drive_(drive),
        step_(step),
        stepper_(dynamics_, {}, drive_, 1.0e-9 * static_cast<double>(step), 1) {
    drive_.reset();
    stepper_.set(std::vector<double>(2).data(), std::vector<double>(2).data());
  }

  void runTo(std::int64_t time) {
    while (time_ < time) {
      ASSERT_EQ(stepper_.step(0.0), StepStatus::kOk);
      time_ += step_;
      drive_.begin(time_);
    }
    stepper_.write(state_.data());
  }
  double q(std::size_t i) const { return state_[i]; }

 private:
  std::shared_ptr<const Dynamics> dynamics_;
  Drive drive_;
  std::int64_t step_;
  std::int64_t time_ = 0;
  LinearRotorStepper stepper_;
  std::array<double, 5> state_{};
};

struct Found {
  double error = 0.0;     ///< of the position, relative to the largest radius
  double residual = 0.0;  ///< of the energy, relative to the largest
};

/// From rest, at a step [ns] against steps of `finer` [ns].
Found compared(const RunningSystem::Setup& setup, std::int64_t step, std::int64_t steps,
               std::int64_t finer) {
  RunningSystem run(setup, "exponential", step);
  Drive drive(setup.speed, 0.0, setup.profile);
  ByMatrices reference(run, drive, finer);
  const double start = run.energies().jacobi;
  double radius = 0.0;
  double energy = 0.0;
  Found found;
  for (std::int64_t i = 1; i <= steps; ++i) {
    EXPECT_EQ(run.run(1), StepStatus::kOk);
    reference.runTo(i * step);
    const Energies e = run.energies();
    radius = std::max(radius, std::hypot(reference.q(0), reference.q(1)));
    energy = std::max(energy, e.kinetic + std::fabs(e.potential));
    found.error =
        std::max(found.error, std::hypot(run.q(0) - reference.q(0), run.q(1) - reference.q(1)));
    found.residual = std::max(found.residual, std::fabs(e.jacobi - start - run.work()));
  }
  found.error /= radius;
  found.residual /= energy;
  return found;
}

RunningSystem::Setup jeffcott(ParameterValues parameters, std::vector<SpeedMove> profile) {
  RunningSystem::Setup setup;
  setup.model = "jeffcott_rotor";
  setup.parameters = std::move(parameters);
  setup.profile = std::move(profile);
  return setup;
}

class LongSteps : public testing::TestWithParam<std::int64_t> {};

TEST_P(LongSteps, FollowARunUpAsExactlyAsShortOnes) {
  const std::int64_t step = GetParam() * kMillisecond;
  const auto plain =
      jeffcott({{"mass", 2.0}, {"stiffness", 2.0e4}, {"damping", 10.0}, {"eccentricity", 2.0e-4}},
               {{250.0, 50.0, 0.0, 0.0}});
  const Found found = compared(plain, step, 6000 / GetParam(), kMillisecond / 10);
  EXPECT_LT(found.error, 1.0e-11);
  EXPECT_LT(found.residual, 1.0e-11);

  auto turning = plain;
  turning.parameters["internal_damping"] = 6.0;
  turning.parameters["stiffness_y"] = 2.2e4;
  const Found with_coupling = compared(turning, step, 6000 / GetParam(), kMillisecond / 10);
  EXPECT_LT(with_coupling.error, 1.0e-11);
  EXPECT_LT(with_coupling.residual, 1.0e-11);
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, LongSteps,
                         testing::Values(1, 3, 5, 8, 10, 12, 15, 20, 24, 30, 50, 100));

TEST(LateralRotor, FollowsRandomRotorsThroughRandomProfiles) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto sometimes = [&](double value) { return share(random) < 0.5 ? value : 0.0; };
  for (int i = 0; i < 40; ++i) {
    const double frequency = 30.0 + 200.0 * share(random);
    const double stiffness = 2.0 * frequency * frequency;
    const double damping = 4.0 * frequency * (i % 8 == 0 ? 1.5 : 0.1 * share(random));
    auto setup = jeffcott({{"mass", 2.0},
                           {"stiffness", stiffness},
                           {"stiffness_y", stiffness * (1.0 + sometimes(0.3))},
                           {"damping", damping},
                           {"damping_y", damping * (1.0 + sometimes(0.5))},
                           {"internal_damping", sometimes(4.0)},
                           {"fluid_damping", sometimes(5.0)},
                           {"fluid_ratio", 0.48},
                           {"cross_coupling", sometimes(0.02 * stiffness)},
                           {"eccentricity", 1.0e-4},
                           {"eccentricity_angle", 6.0 * share(random)},
                           {"bow", sometimes(5.0e-5)},
                           {"bow_angle", 6.0 * share(random)}},
                          {});
    setup.settings.choices["gravity_on_shaft"] = i % 2 == 0 ? "true" : "false";
    setup.speed = 400.0 * share(random) - 200.0;
    // Accelerations that jump, limited jerk, dwells: breakpoints inside steps everywhere.
    setup.profile = {{300.0 * share(random), 100.0 + 300.0 * share(random), sometimes(3.0e3),
                      0.3 * share(random)},
                     {-100.0 * share(random), 200.0, sometimes(1.0e4), 0.2}};
    const std::int64_t step = std::vector<std::int64_t>{1, 2, 5, 10, 20}[i % 5] * kMillisecond;
    const Found found = compared(setup, step, 3000 * kMillisecond / step, kMillisecond / 4);
    EXPECT_LT(found.error, 1.0e-9) << "rotor " << i;
    EXPECT_LT(found.residual, 1.0e-10) << "rotor " << i;
  }
}

TEST(LateralRotor, KeepsConstantSpeedsWithoutEnd) {
  // Whatever is on, and against the exact map of the matrices.
  for (const char* heavy : {"false", "true"}) {
    for (const double uneven : {1.0, 1.2}) {
      auto setup = jeffcott({{"mass", 2.0},
                             {"stiffness", 8.0e4},
                             {"stiffness_y", 8.0e4 * uneven},
                             {"damping", 30.0},
                             {"internal_damping", 6.0},
                             {"cross_coupling", 200.0},
                             {"eccentricity", 1.0e-4},
                             {"bow", 3.0e-5},
                             {"bow_angle", -1.0}},
                            {});
      setup.speed = 140.0;
      setup.settings.choices["gravity_on_shaft"] = heavy;
      const Found found = compared(setup, 7 * kMillisecond, 2000, 7 * kMillisecond);
      EXPECT_LT(found.error, 1.0e-13) << heavy << uneven;
      EXPECT_LT(found.residual, 1.0e-12) << heavy << uneven;
    }
  }
}

TEST(LateralRotor, FollowsANewSpeedWithoutBeingPreparedForIt) {
  const auto setup = jeffcott({{"mass", 2.0},
                               {"stiffness", 2.0e4},
                               {"damping", 10.0},
                               {"eccentricity", 2.0e-4},
                               {"internal_damping", 3.0}},
                              {});
  RunningSystem like(setup, "exponential", kMillisecond);
  Drive drive(0.0, 0.0);
  const auto stepper = LateralRotorStepper::of(like.dynamics().linearRotor(), drive, 1e-3, 1);
  ASSERT_NE(stepper, nullptr);
  EXPECT_EQ(stepper->readyFor(-1000.0, 1000.0), nullptr);
  const std::array<double, 2> rest{};
  stepper->set(rest.data(), rest.data());
  auto moves = setup;
  moves.profile = {{130.0, 200.0, 4000.0, 0.4}};
  RunningSystem planned(moves, "exponential", kMillisecond);
  ASSERT_TRUE(drive.setSpeed(130.0, 200.0, 4000.0));
  for (int i = 1; i <= 1000; ++i) {
    ASSERT_EQ(stepper->step(0.0), StepStatus::kOk);
    drive.begin(i * kMillisecond);
  }
  planned.run(1000);
  std::array<double, 5> state;
  stepper->write(state.data());
  EXPECT_NEAR(state[0], planned.q(0), 1e-16);
  EXPECT_NEAR(state[1], planned.q(1), 1e-16);
}

// A step that continues reuses the shaft's phase of the previous one. After a change of the shaft
// angle, or of the rotor's state, it must not.
TEST(LateralRotor, SeesWhenTheShaftIsElsewhere) {
  const auto setup = jeffcott(
      {{"mass", 2.0}, {"stiffness", 2.0e4}, {"damping", 10.0}, {"eccentricity", 2.0e-4}}, {});
  RunningSystem like(setup, "exponential", kMillisecond);
  const auto rotor = like.dynamics().linearRotor();
  const auto stateOf = [](const Stepper& stepper) {
    std::array<double, 5> state;
    stepper.write(state.data());
    return state;
  };
  Drive drive(90.0, 0.3);
  const auto stepper = LateralRotorStepper::of(rotor, drive, 1e-3, 1);
  stepper->set(std::array<double, 2>{}.data(), std::array<double, 2>{}.data());
  std::int64_t time = 0;
  for (int i = 0; i < 100; ++i) {
    drive.begin(time);
    if (i % 10 == 7) {
      time += 123 * kMillisecond;  // later
      drive.begin(time);
    } else if (i % 10 == 4) {
      time = 0;
      drive.reset();
    } else if (i % 10 == 2) {
      ASSERT_TRUE(drive.setSpeed(90.0, 1.0, 0.0));  // to the speed that it has
    } else if (i % 10 == 9) {
      ASSERT_TRUE(drive.setSpeed(i % 20 == 9 ? 95.0 : 90.0, 1e9, 0.0));  // in a step
    }
    const std::array<double, 5> before = stateOf(*stepper);
    const auto restarted = LateralRotorStepper::of(rotor, drive, 1e-3, 1);
    restarted->set(before.data(), before.data() + 2);
    ASSERT_EQ(stepper->step(0.0), StepStatus::kOk);
    ASSERT_EQ(restarted->step(0.0), StepStatus::kOk);
    const std::array<double, 5> after = stateOf(*stepper);
    const std::array<double, 5> expected = stateOf(*restarted);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(after[k], expected[k], k < 2 ? 1e-17 : 1e-15) << i;
    }
    time += kMillisecond;
  }
}

// While the speed changes a step that continues rotates the phasors of the previous one. It must
// equal the step of a newly initialized rotor: for any number of nodes, and after a change of the
// shaft's angle, its acceleration or the rotor's state.
TEST(LateralRotor, GoesOnInARunUpAsOneThatBeginsAnew) {
  const auto setup = jeffcott({{"mass", 2.0},
                               {"stiffness", 2.0e4},
                               {"damping", 10.0},
                               {"internal_damping", 1.0},
                               {"eccentricity", 2.0e-4}},
                              {});
  RunningSystem like(setup, "exponential", kMillisecond);
  const auto rotor = like.dynamics().linearRotor();
  for (const std::int64_t step : {kMillisecond, 24 * kMillisecond}) {
    const double h = 1e-9 * static_cast<double>(step);
    Drive drive(0.0, 0.3, {{280.0, 12.0, 0.0, 0.0}});
    const auto stepper = LateralRotorStepper::of(rotor, drive, h, 1);
    stepper->set(std::array<double, 2>{}.data(), std::array<double, 2>{}.data());
    std::int64_t time = 0;
    for (int i = 0; i < 900; ++i) {
      drive.begin(time);
      if (i % 100 == 37) {
        time += step;  // by a step
        drive.begin(time);
      } else if (i % 100 == 63) {
        ASSERT_TRUE(drive.setSpeed(280.0, i < 500 ? 9.0 : 7.0, 0.0));
      } else if (i % 100 == 81) {
        ASSERT_TRUE(drive.setSpeed(280.0, 11.0, 20.0));  // with a jerk at first
      } else if (i == 590) {
        drive.reset();
        time = 0;
      }
      std::array<double, 5> before;
      stepper->write(before.data());
      const auto restarted = LateralRotorStepper::of(rotor, drive, h, 1);
      restarted->set(before.data(), before.data() + 2);
      ASSERT_EQ(stepper->step(0.0), StepStatus::kOk);
      ASSERT_EQ(restarted->step(0.0), StepStatus::kOk);
      time += step;
      drive.begin(time);
      std::array<double, 5> after;
      std::array<double, 5> expected;
      stepper->write(after.data());
      restarted->write(expected.data());
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(after[k], expected[k], k < 2 ? 1e-16 : 1e-14) << i << " of " << step;
      }
    }
  }
}

// The phase is that of the shaft at any speed, however large the fraction of a turn in a step:
// forces of e w^2 nearly cancel at the almost stationary mass centre, so that every digit of the
// phase matters.
TEST(LateralRotor, TurnsAboutItsMassCentreAtAnySpeedFarAboveTheCriticalOne) {
  double largest = 0.0;
  for (double speed = 5.0e4; speed < 2.0e5; speed *= 1.0123) {
    RunningSystem::Setup setup = jeffcott(
        {{"mass", 1.0}, {"stiffness", 100.0}, {"damping", 10.0}, {"eccentricity", 1.0e-3}}, {});
    setup.speed = speed;
    RunningSystem rotor(setup, "exponential", kMillisecond);
    ASSERT_EQ(rotor.run(10000), StepStatus::kOk);  // 50 times its decay
    const double angle = rotor.drive().at(0.0).angle;
    const double x = rotor.q(0) + 1.0e-3 * std::cos(angle);
    const double y = rotor.q(1) + 1.0e-3 * std::sin(angle);
    largest =
        std::fmax(largest, std::fabs(std::hypot(x, y) / 1.0e-3 - 10.0 / speed) * 10.0 / speed);
  }
  EXPECT_LT(largest, 3.0e-14);
}

TEST(LateralRotor, EstimatesItsErrorInARunUp) {
  const auto setup =
      jeffcott({{"mass", 2.0}, {"stiffness", 2.0e4}, {"damping", 10.0}, {"eccentricity", 2.0e-4}},
               {{250.0, 50.0, 0.0, 0.0}});
  RunningSystem like(setup, "exponential", kMillisecond);
  Drive drive(0.0, 0.0, setup.profile);
  const auto stepper = LateralRotorStepper::of(like.dynamics().linearRotor(), drive, 0.012, 1);
  const std::array<double, 2> rest{};
  stepper->set(rest.data(), rest.data());
  for (int i = 1; i <= 400; ++i) {
    ASSERT_EQ(stepper->step(0.0), StepStatus::kOk);
    drive.begin(12 * i * kMillisecond);
  }
  EXPECT_GT(stepper->errorSum(), 0.0);
  EXPECT_LT(stepper->errorSum(), 1.0e-10);
}

TEST(LateralRotor, LeavesOtherRotorsToTheTable) {
  const auto is_lateral = [](const ParameterValues& parameters, double step) {
    RunningSystem like(jeffcott(parameters, {}), "exponential", kMillisecond);
    const Drive drive(0.0, 0.0);
    return LateralRotorStepper::of(like.dynamics().linearRotor(), drive, step, 1) != nullptr;
  };
  EXPECT_TRUE(is_lateral({{"mass", 2.0}, {"stiffness", 2.0e4}}, 1.0));
  EXPECT_FALSE(is_lateral({{"mass", 2.0}, {"stiffness", 2.0e12}}, 1.0)) << "100 000 turns a step";
  RunningSystem::Setup disc;
  disc.model = "rigid_disc_rotor";
  disc.parameters = {{"mass", 1.0},
                     {"stiffness_displacement", 1.0e4},
                     {"stiffness_rotation", 1.0e2},
                     {"polar_inertia", 0.02},
                     {"transverse_inertia", 0.01}};
  RunningSystem four(disc, "exponential", kMillisecond);
  EXPECT_FALSE(lateralRotor(four.dynamics().linearRotor()).has_value());
}

TEST(LateralRotor, RefusesAStepOfTooManyTurns) {
  const auto setup = jeffcott({{"mass", 2.0}, {"stiffness", 2.0e4}, {"eccentricity", 1.0e-4}},
                              {{1.0e6, 1.0e8, 0.0, 0.0}});
  RunningSystem run(setup, "exponential", 1000 * kMillisecond);
  EXPECT_EQ(run.run(1), StepStatus::kOutOfRange);
  EXPECT_EQ(run.q(0), 0.0);
}

TEST(LateralRotor, DoesNotAllocate) {
  auto setup = jeffcott({{"mass", 2.0},
                         {"stiffness", 8.0e4},
                         {"stiffness_y", 9.0e4},
                         {"damping", 30.0},
                         {"internal_damping", 6.0},
                         {"eccentricity", 1.0e-4}},
                        {{60.0, 60.0, 0.0, 0.3}, {290.0, 160.0, 500.0, 0.0}});
  RunningSystem run(setup, "exponential", 3 * kMillisecond);
  AllocationGuard guard;
  run.run(1500);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(FreeOscillation, IsTheMatrixExponential) {
  for (const double damping : {0.0, 1.0, 19.0, 20.0, 20.000001, 21.0, 4000.0}) {
    for (const double time : {1.0e-6, 0.01, 1.0}) {
      const double stiffness = 100.0;
      Eigen::Matrix2d a;
      a << 0.0, 10.0, -stiffness / 10.0, -damping;
      const Eigen::Matrix2d truth = exponentialLessIdentity<2>(Eigen::Matrix2d(time * a));
      const FreeOscillation found = freeOscillation(damping, stiffness, time);
      const double bound = 1.0e-13 * (1.0 + damping * time);
      EXPECT_NEAR(found.by_place, truth(0, 0), bound * truth.cwiseAbs().maxCoeff());
      EXPECT_NEAR(found.place_by_rate, truth(0, 1) / 10.0, bound * truth.cwiseAbs().maxCoeff());
      EXPECT_NEAR(found.rate_by_place, truth(1, 0) * 10.0,
                  10.0 * bound * truth.cwiseAbs().maxCoeff());
      EXPECT_NEAR(found.by_rate, truth(1, 1), bound * truth.cwiseAbs().maxCoeff());
    }
  }
}

}  // namespace lateral_rotor_test
}  // namespace whirl_twin
