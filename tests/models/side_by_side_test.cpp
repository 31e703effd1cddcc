// Batched samples of an ensemble: each equals its system stepped alone, at any position in the
// batch and whatever the state of its neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "../extremes/general_position.h"
#include "allocation_guard.h"
#include "integration/batch_runge_kutta.h"
#include "models/batched_models.h"

namespace whirl_twin {
namespace side_by_side_test {

constexpr std::int64_t kStep = 1000000;  // ns
constexpr double kStepSeconds = 1.0e-3;
constexpr std::size_t kMembers = 40;  // a full block and part of another

/// Samples of one model: setups, and their equations if they are batched.
struct Members {
  std::vector<ModelSetup> setups;
  std::unique_ptr<BatchEquations> equations;

  explicit Members(std::vector<ModelSetup> all) : setups(std::move(all)) {
    std::vector<const Dynamics*> dynamics;
    for (const ModelSetup& setup : setups) {
      dynamics.push_back(setup.dynamics.get());
    }
    equations = batchEquations(dynamics);
  }
};

Drive runUp() {
  return Drive(5.0, 0.3, {{9.0, 20.0, 700.0, 0.05}, {4.0, 50.0, 0.0, 0.0}});
}

TEST(BatchedMembers, AreWhatTheirSystemsAreByThemselves) {
  std::set<std::string> together;
  for (const MovingVariant& moving : everyMovingVariant()) {
    const RungeKuttaTable* const method = rungeKuttaTable(moving.integrator);
    if (method == nullptr) {
      continue;
    }
    Scene scene;
    const SystemSpec spec = inGeneralPosition(moving, scene);
    const ModelInfo& model = *findModel(spec.model);
    std::vector<ModelSetup> setups;
    for (std::size_t i = 0; i < kMembers; ++i) {
      ParameterValues values = spec.parameters;
      for (const ParameterInfo& p : model.parameters) {
        if (p.range != Range::kCount) {
          values[p.name] *= 1.0 + 1e-3 * static_cast<double>(i);
        }
      }
      setups.push_back(model.setUp(values, spec.settings, moving.variant.around(scene.gravity)));
    }
    Members members(std::move(setups));
    if (!members.equations) {
      continue;
    }
    together.insert(testName(moving.variant));
    BatchRungeKutta steps(std::move(members.equations), *method, kStepSeconds, 2);
    Drive drive = runUp();
    std::vector<std::unique_ptr<Stepper>> alone;
    for (std::size_t i = 0; i < kMembers; ++i) {
      steps.set(i, spec.q.data(), spec.v.data());
      alone.push_back(members.setups[i].system(moving.integrator, {drive}, kStepSeconds, 2));
      alone.back()->set(spec.q.data(), spec.v.data());
    }
    for (std::int64_t k = 0; k < 400; ++k) {
      drive.begin(k * kStep);
      const double time = static_cast<double>(k) * kStepSeconds;
      steps.step(drive, time);
      for (const auto& system : alone) {
        ASSERT_EQ(system->step(time), StepStatus::kOk);
      }
    }
    const std::size_t n = steps.dof();
    std::vector<double> state(2 * n + 1);
    for (std::size_t i = 0; i < kMembers; ++i) {
      alone[i]->write(state.data());
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_NEAR(steps.q(i, k), state[k], 2e-13 * std::fmax(1.0, std::fabs(state[k])))
            << testName(moving) << " member " << i;
        EXPECT_NEAR(steps.v(i, k), state[n + k], 2e-12 * std::fmax(1.0, std::fabs(state[n + k])))
            << testName(moving) << " member " << i;
      }
    }
  }
  std::set<std::string> models;
  for (const std::string& name : together) {
    models.insert(name.substr(0, name.find("__")));
  }
  EXPECT_GE(together.size(), 10u) << "many models go side by side";
}

/// Double pendulums: those with even index identical, those with odd index all different, with the
/// given start.
struct Pendulums {
  explicit Pendulums(double odd_rate, double friction = 0.0)
      : members(setups(friction)), steps(std::move(members.equations), *method(), kStepSeconds, 1) {
    for (std::size_t i = 0; i < steps.count(); ++i) {
      const std::vector<double> q{1.0, i % 2 == 0 ? 0.5 : 0.01 * static_cast<double>(i)};
      const std::vector<double> v{0.0, i % 2 == 0 ? 0.2 : odd_rate};
      steps.set(i, q.data(), v.data());
    }
  }
  void run(int count) {
    for (int k = 0; k < count; ++k) {
      steps.step(drive, k * kStepSeconds);
    }
  }
  static const RungeKuttaTable* method() { return rungeKuttaTable("dormand_prince_8"); }
  static std::vector<ModelSetup> setups(double friction) {
    const ModelInfo& model = *findModel("double_pendulum");
    std::vector<ModelSetup> all;
    for (std::size_t i = 0; i < kMembers; ++i) {
      const double mass = i % 2 == 0 ? 1.0 : 1.0 + 0.01 * static_cast<double>(i);
      all.push_back(model.setUp({{"mass1", mass},
                                 {"mass2", 2.0},
                                 {"length1", 1.0},
                                 {"length2", 0.5},
                                 {"center1", 1.0},
                                 {"center2", 0.5},
                                 {"inertia1", 0.0},
                                 {"inertia2", 0.0},
                                 {"damping1", 0.01},
                                 {"damping2", 0.0},
                                 {"coulomb1", i == kMembers - 1 ? friction : 0.0},
                                 {"coulomb2", 0.0},
                                 {"coulomb_rate", 0.01},
                                 {"motor_inertia1", 0.0},
                                 {"motor_inertia2", 0.0},
                                 {"gear_ratio1", 1.0},
                                 {"gear_ratio2", 1.0},
                                 {"drag1", 0.0},
                                 {"drag2", 0.0},
                                 {"drag_reach1", 1.0},
                                 {"drag_reach2", 0.5}},
                                {}, ModelContext(9.81)));
    }
    return all;
  }

  Members members;
  BatchRungeKutta steps;
  Drive drive{0.0, 0.0};
};

TEST(BatchedMembers, ThatAreAlikeKeepTheSameBitsWhereverTheyStand) {
  Pendulums pendulums(0.3);
  pendulums.run(2000);
  for (std::size_t i = 0; i < kMembers; i += 2) {
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(pendulums.steps.q(i, k), pendulums.steps.q(0, k)) << i;
      EXPECT_EQ(pendulums.steps.v(i, k), pendulums.steps.v(0, k)) << i;
      EXPECT_EQ(pendulums.steps.peak(i, k), pendulums.steps.peak(0, k)) << i;
    }
    EXPECT_NE(pendulums.steps.q(i + 1, 1), pendulums.steps.q(i, 1)) << "is another one";
  }
}

// The last one, whose values pad its block, is among those that diverge.
TEST(BatchedMembers, AreNotDisturbedByOnesThatRunAway) {
  Pendulums calm(0.3);
  Pendulums wild(1e200);
  calm.run(500);
  wild.run(500);
  for (std::size_t i = 0; i < kMembers; ++i) {
    EXPECT_EQ(wild.steps.stopped(i), i % 2 == 1) << i;
    EXPECT_FALSE(calm.steps.stopped(i)) << i;
    if (i % 2 == 0) {
      EXPECT_EQ(wild.steps.q(i, 0), calm.steps.q(i, 0)) << i;
      EXPECT_EQ(wild.steps.v(i, 1), calm.steps.v(i, 1)) << i;
    }
  }
  const std::vector<double> rest{0.0, 0.0};
  wild.steps.set(1, rest.data(), rest.data());
  EXPECT_FALSE(wild.steps.stopped(1)) << "started anew";
}

// Arms that have been rotating for minutes. A double resolves 1e5 rad to 1.5e-11 rad, and each
// stage of either rounds its angles to that: the difference is this, amplified by the motion.
TEST(BatchedMembers, KeepTheirDigitsAtLargeAngles) {
  for (const double turned : {1e3, -1e4, 1e5, 3e6}) {
    Pendulums together(0.3);
    std::vector<std::unique_ptr<Stepper>> alone;
    for (std::size_t i = 0; i < kMembers; ++i) {
      const std::vector<double> q{turned + 0.01 * static_cast<double>(i), 2.0 * turned};
      const std::vector<double> v{3.0, -5.0};
      together.steps.set(i, q.data(), v.data());
      alone.push_back(
          together.members.setups[i].system("dormand_prince_8", {together.drive}, kStepSeconds, 1));
      alone.back()->set(q.data(), v.data());
    }
    together.run(200);
    std::vector<double> state(5);
    for (std::size_t i = 0; i < kMembers; ++i) {
      for (int k = 0; k < 200; ++k) {
        ASSERT_EQ(alone[i]->step(k * kStepSeconds), StepStatus::kOk);
      }
      alone[i]->write(state.data());
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(together.steps.q(i, k), state[k], 1e-12 + 1e-14 * std::fabs(turned)) << turned;
        EXPECT_NEAR(together.steps.v(i, k), state[2 + k], 1e-11 + 1e-13 * std::fabs(turned))
            << turned;
      }
    }
  }
}

// Friction of one sample is a zero term in the equations of the others.
TEST(BatchedMembers, HaveTheFrictionOfTheirOwn) {
  Pendulums without(0.3);
  Pendulums with(0.3, 0.5);
  without.run(300);
  with.run(300);
  for (std::size_t i = 0; i + 1 < kMembers; ++i) {
    EXPECT_NEAR(with.steps.q(i, 0), without.steps.q(i, 0), 1e-13) << i;
  }
  EXPECT_GT(std::fabs(with.steps.q(kMembers - 1, 0) - without.steps.q(kMembers - 1, 0)), 1e-3);
}

TEST(BatchedMembers, StepWithoutAllocating) {
  Pendulums pendulums(1e200);
  const AllocationGuard guard;
  pendulums.run(100);
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace side_by_side_test
}  // namespace whirl_twin
