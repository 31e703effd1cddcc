// Properties of every controller: it lists what a scene needs to specify, its linearization matches
// its response to small changes, a reset clears its state, transfer to another one is bumpless, and
// a sample allocates nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "../realtime/allocation_guard.h"
#include "example_controllers.h"

namespace whirl_twin {
namespace every_controller_test {

constexpr double kSpeed = 40.0;  // [rad/s], of the shaft

class EveryController : public testing::TestWithParam<std::string> {
 protected:
  static const std::vector<ExampleController>& examples() {
    return exampleControllers().at(GetParam());
  }
  static std::unique_ptr<Controller> build(const ExampleController& example) {
    return made(GetParam(), example.values, example.settings, example.plan);
  }
};

/// Samples that a controller of so many is shown, on a shaft at kSpeed.
class RandomSamples {
 public:
  explicit RandomSamples(const ControllerPlan& plan)
      : values_(plan.measured, 0.0), rate_(plan.rate) {}

  /// The first is 0: the input before it is assumed constant.
  ControlSample next() {
    if (index_ > 0) {
      for (double& value : values_) {
        value = distribution_(random_);
      }
    }
    const double time = static_cast<double>(index_) / rate_;
    const ControlSample sample{values_.data(), index_, std::llround(1e9 * time),
                               shaftAngle(kSpeed * time + 1.0), kSpeed};
    ++index_;
    return sample;
  }
  Eigen::VectorXd values() const {
    return Eigen::Map<const Eigen::VectorXd>(values_.data(),
                                             static_cast<Eigen::Index>(values_.size()));
  }

 private:
  std::vector<double> values_;
  double rate_;
  std::int64_t index_ = 0;
  std::mt19937_64 random_{7};
  std::normal_distribution<double> distribution_;
};

TEST_P(EveryController, SaysWhatASceneNeeds) {
  const ControllerInfo& info = *findController(GetParam());
  EXPECT_FALSE(info.summary.empty());
  std::set<std::string> names;
  for (const ParameterInfo& parameter : info.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.unit.empty()) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
  }
  for (const SettingInfo& setting : info.settings) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_FALSE(setting.meaning.empty()) << setting.name;
    EXPECT_EQ(setting.choices.empty(), setting.kind != SettingKind::kChoice) << setting.name;
  }
}

TEST_P(EveryController, ActsOnSmallChangesAsItsLinearLawSays) {
  for (const ExampleController& example : examples()) {
    const auto controller = build(example);
    const auto law = controller->linear(kSpeed);
    if (!law) {
      continue;
    }
    const auto outputs = static_cast<Eigen::Index>(example.plan.outputs);
    RandomSamples samples(example.plan);
    // Relative to the output for 0: a set-point is not small.
    const auto resting = build(example);
    RandomSamples nothing(example.plan);
    const std::vector<double> zero(example.plan.measured, 0.0);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(law->states());
    Eigen::VectorXd u(outputs);
    Eigen::VectorXd at_rest(outputs);
    for (int k = 0; k < 300; ++k) {
      const ControlSample sample = samples.next();
      ControlSample still = sample;
      still.values = zero.data();
      controller->update(sample, u.data());
      resting->update(still, at_rest.data());
      const Eigen::VectorXd expected = law->c * state + law->d * samples.values();
      state = (law->a * state + law->b * samples.values()).eval();
      ASSERT_LE((u - at_rest - expected).cwiseAbs().maxCoeff(),
                1e-10 * (1.0 + expected.cwiseAbs().maxCoeff()))
          << "sample " << k;
    }
  }
}

TEST_P(EveryController, ForgetsByAReset) {
  for (const ExampleController& example : examples()) {
    const auto controller = build(example);
    std::vector<std::vector<double>> first;
    for (int run = 0; run < 2; ++run) {
      RandomSamples samples(example.plan);
      std::vector<double> u(example.plan.outputs);
      for (std::size_t k = 0; k < 50; ++k) {
        controller->update(samples.next(), u.data());
        if (run == 0) {
          first.push_back(u);
        }
        ASSERT_EQ(u, first[k]) << "sample " << k;
      }
      controller->reset();
    }
  }
}

TEST_P(EveryController, OneThatTakesOverGoesOnAsItWould) {
  for (const ExampleController& example : examples()) {
    const auto controller = build(example);
    const auto next = build(example);
    RandomSamples samples(example.plan);
    std::vector<double> u(example.plan.outputs);
    std::vector<double> taken_over(example.plan.outputs);
    for (int k = 0; k < 60; ++k) {
      const ControlSample sample = samples.next();
      if (k == 30) {
        const AllocationGuard guard;
        next->takeOver(*controller);
        EXPECT_EQ(guard.allocations(), 0u);
      }
      controller->update(sample, u.data());
      if (k >= 30) {
        next->update(sample, taken_over.data());
        for (std::size_t i = 0; i < u.size(); ++i) {
          ASSERT_NEAR(taken_over[i], u[i], 1e-10 * (1.0 + std::abs(u[i]))) << "sample " << k;
        }
      }
    }
  }
}

TEST_P(EveryController, AllocatesNothing) {
  for (const ExampleController& example : examples()) {
    const auto controller = build(example);
    RandomSamples samples(example.plan);
    std::vector<double> u(example.plan.outputs);
    const AllocationGuard guard;
    for (int k = 0; k < 50; ++k) {
      controller->update(samples.next(), u.data());
    }
    controller->reset();
    EXPECT_EQ(guard.allocations(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Controllers, EveryController, testing::ValuesIn(controllerNames()),
                         [](const auto& test) { return test.param; });

}  // namespace every_controller_test
}  // namespace whirl_twin
