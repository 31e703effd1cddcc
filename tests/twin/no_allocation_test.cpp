// Code of the real-time thread does not allocate: step, write, setSpeed and reset, for every model
// and every method, at constant and at changing speed; and saving and restoring the state.
#include <gtest/gtest.h>

#include <cstring>

#include "../models/every_variant.h"
#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "models/model_registry.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace no_allocation_test {

struct Pair {
  VariantUnderTest variant;
  std::string integrator;
};

void PrintTo(const Pair& p, std::ostream* out) {
  *out << testName(p.variant) << " by " << p.integrator;
}

std::vector<Pair> everyPair() {
  std::vector<Pair> pairs;
  for (const VariantUnderTest& variant : everyVariant()) {
    const ModelInfo& model = *findModel(variant.model);
    for (const ModelVariant& v : model.variants) {
      for (const std::string& integrator : integratorsOf(v)) {
        if (v.when == variant.when) {
          pairs.push_back({variant, integrator});
        }
      }
    }
  }
  return pairs;
}

class NoAllocation : public testing::TestWithParam<Pair> {
 protected:
  /// The system on a shaft that changes its speed, keeps it, and changes it again.
  Scene scene() const {
    Scene scene = sceneOf(kThreeSystems);
    const ModelInfo& model = *findModel(GetParam().variant.model);
    SystemSpec spec;
    spec.name = "one";
    spec.model = model.name;
    spec.integrator = GetParam().integrator;
    if (model.has_shaft) {
      spec.drive = "shaft";
    }
    if (GetParam().variant.motor) {
      scene.drives.front().motor = GetParam().variant.motor;
    }
    for (const ParameterInfo& p : model.parameters) {
      const bool matrices_change = (p.name == "internal_damping" || p.name == "fluid_ratio") &&
                                   spec.integrator == "exponential";
      spec.parameters[p.name] = matrices_change || choosesForm(p.name) ? 0.0
                                : p.range == Range::kCount             ? 3.0
                                : p.name == "stiffness_coupling"       ? 0.1
                                                                       : 0.3;
    }
    for (const auto& [name, value] : GetParam().variant.parameters) {
      spec.parameters[name] = value;
    }
    spec.settings = GetParam().variant.settings;
    const auto dynamics =
        model.setUp(spec.parameters, spec.settings, GetParam().variant.around(scene.gravity))
            .dynamics;
    spec.q.assign(static_cast<std::size_t>(dynamics->dof()), 0.5);
    spec.v.assign(static_cast<std::size_t>(dynamics->dof()), 0.1);
    scene.systems = {spec};
    return scene;
  }
};

TEST_P(NoAllocation, InTheRealTimeThread) {
  Twin twin(scene());
  std::vector<double> record(twin.layout().size);
  bool set = true;
  {
    const AllocationGuard guard;
    for (int run = 0; run < 2; ++run) {
      for (int i = 0; i < 3000; ++i) {
        twin.step();
        twin.write(record.data());
        if (i == 1500) {
          // A motor goes as fast as it can.
          set = set && twin.setSpeed(0, 20.0, 30.0, 100.0) != GetParam().variant.motor.has_value();
        }
      }
      twin.reset();
    }
    EXPECT_EQ(guard.allocations(), 0u);
  }
  EXPECT_TRUE(set);
  EXPECT_EQ(twin.status(0), StepStatus::kOk) << "what does not step does not allocate";
}

/// Every value of a step's history missing in the image changes the bits of the steps that follow.
TEST_P(NoAllocation, GoesOnFromItsImageToTheBit) {
  Twin twin(scene());
  Twin resumed(scene());
  const auto resume = [](Twin& one, int steps) {
    for (int i = 0; i < steps; ++i) {
      one.step();
    }
  };
  resume(resumed, 90);
  std::vector<char> room(1'000'000);
  for (const int before : {300, 500, 77}) {
    resume(twin, before);
    if (before == 500) {
      twin.setSpeed(0, 20.0, 30.0, 100.0);
      resume(twin, 3);
    }
    const AllocationGuard guard;
    StateImage taken = StateImage::taking(room.data(), room.size());
    twin.exchange(taken);
    ASSERT_TRUE(taken.sound());
    StateImage put = StateImage::putting(room.data(), taken.size());
    resumed.exchange(put);
    ASSERT_TRUE(put.sound());
    EXPECT_EQ(put.size(), taken.size());
    EXPECT_EQ(guard.allocations(), 0u);
    std::vector<double> expected(twin.layout().size);
    std::vector<double> found(expected.size());
    for (int i = 0; i < 700; ++i) {
      twin.step();
      resumed.step();
      twin.write(expected.data());
      resumed.write(found.data());
      ASSERT_EQ(std::memcmp(expected.data(), found.data(), expected.size() * sizeof(double)), 0)
          << "step " << twin.stepCount();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, NoAllocation, testing::ValuesIn(everyPair()),
                         [](const auto& test) {
                           return testName(test.param.variant) + "_" + test.param.integrator;
                         });

TEST(NoAllocationOf, AStiffImplicitStepOrOneThatFails) {
  // Newton's iteration, and its error for thousands of turns in one step.
  for (const char* rate : {"0", "3000"}) {
    Twin twin(
        sceneOf("{step: 0.05, systems: {a: {model: double_pendulum, integrator: "
                "gauss_legendre_6, parameters: {mass1: 1, mass2: 1e4, length1: 1, length2: "
                "1}, initial: {theta1: 0.2, theta1_rate: " +
                std::string(rate) + "}}}}"));
    const AllocationGuard guard;
    for (int i = 0; i < 50; ++i) {
      twin.step();
    }
    EXPECT_EQ(guard.allocations(), 0u) << rate;
  }
}

}  // namespace no_allocation_test
}  // namespace whirl_twin
