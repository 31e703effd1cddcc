// A non-finite state - an infinity or a NaN, from a start or in the middle of a run, in any
// coordinate or rate, of any model and method - stops its system with an error; the other systems
// continue bit-identically, as without it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "../scene/scenes.h"
#include "general_position.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace broken_states_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> record(const Twin& twin) {
  std::vector<double> r(twin.layout().size);
  twin.write(r.data());
  return r;
}

/// Bit-identity of the first three systems, which are independent of the fourth.
bool sameNeighbours(const Twin& a, const Twin& b) {
  const std::vector<double> x = record(a);
  const std::vector<double> y = record(b);
  bool same = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const SystemView one = a.layout().system(x.data(), i);
    const SystemView other = b.layout().system(y.data(), i);
    same = same && one.status() == other.status() &&
           std::memcmp(one.motion(), other.motion(),
                       SystemView::motionSize(one.dof()) * sizeof(double)) == 0;
  }
  return same;
}

class BrokenState : public testing::TestWithParam<MovingVariant> {};

TEST_P(BrokenState, StopsItsSystemAndNoOther) {
  Scene scene = sceneOf(kThreeSystems);
  Twin without(scene);
  scene.systems.push_back(inGeneralPosition(GetParam(), scene));
  const std::size_t n = scene.systems[3].q.size();
  for (int i = 0; i < 20; ++i) {
    without.step();
  }
  for (const double value : {kNaN, -kNaN, kInfinity, -kInfinity}) {
    for (std::size_t place = 0; place < 2 * n; ++place) {
      Scene broken = scene;
      (place < n ? broken.systems[3].q[place] : broken.systems[3].v[place - n]) = value;
      Twin twin(broken);
      twin.step();
      EXPECT_EQ(twin.status(3), StepStatus::kNotFinite) << value << " at " << place;
      for (int i = 1; i < 20; ++i) {
        twin.step();
      }
      EXPECT_EQ(twin.status(3), StepStatus::kNotFinite)
          << "it stays stopped, " << value << " at " << place;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(twin.status(i), StepStatus::kOk);
      }
      EXPECT_TRUE(sameNeighbours(twin, without)) << value << " at " << place;
    }
  }
}

TEST_P(BrokenState, DoesNotComeOfTheSameStartWithNumbers) {
  Scene scene = sceneOf(kThreeSystems);
  scene.systems.push_back(inGeneralPosition(GetParam(), scene));
  Twin twin(scene);
  for (int i = 0; i < 20; ++i) {
    twin.step();
  }
  EXPECT_EQ(twin.status(3), StepStatus::kOk);
}

INSTANTIATE_TEST_SUITE_P(Models, BrokenState, testing::ValuesIn(everyMovingVariant()),
                         [](const auto& test) {
                           return testName(test.param.variant) + "_" + test.param.integrator;
                         });

/// A system that is struck by a value after some steps.
class Struck final : public Stepper {
 public:
  Struck(std::unique_ptr<Stepper> inner, int steps, double value)
      : inner_(std::move(inner)), left_(steps), value_(value) {}
  StepStatus step(double time) noexcept override {
    if (left_-- == 0) {
      const double q[2] = {1e-3, value_};
      const double v[2] = {0.0, 0.0};
      inner_->set(q, v);
    }
    return inner_->step(time);
  }
  std::size_t dof() const noexcept override { return inner_->dof(); }
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override {
    return inner_->stepPart(time, from, to);
  }
  void motion(double* out) const noexcept override { inner_->motion(out); }
  void write(double* out) const noexcept override { inner_->write(out); }
  void set(const double* q, const double* v) noexcept override { inner_->set(q, v); }
  void exchange(StateImage& image) noexcept override { inner_->exchange(image); }

 private:
  std::unique_ptr<Stepper> inner_;
  int left_;
  double value_;
};

TEST(StateBrokenInTheMiddleOfARun, StopsItsSystemAtThatStepAndTheObserverSaysSo) {
  for (const double value : {kNaN, kInfinity}) {
    Scene scene = sceneOf(kThreeSystems);
    SystemSpec spec = scene.systems[0];
    spec.name = "struck";
    spec.parameters["bow"] = 1e-5;
    scene.systems.push_back(spec);
    Twin twin(scene);
    Twin without(sceneOf(kThreeSystems));
    Observer observer(twin);
    // The generation is the scene's own: the parameters are.
    twin.replace(3, std::make_unique<Struck>(twin.stepperOf(*twin.systems()[3]), 100, value), 0);
    for (int i = 0; i < 1000; ++i) {
      twin.step();
      without.step();
      ASSERT_EQ(twin.status(3), i < 100 ? StepStatus::kOk : StepStatus::kNotFinite) << i;
      observer.observe(record(twin).data());
    }
    EXPECT_TRUE(sameNeighbours(twin, without));
    EXPECT_NE(observer.stopReason(3).find("state not finite"), std::string::npos)
        << observer.stopReason(3);
    EXPECT_EQ(observer.stopReason(0), "");
  }
}

}  // namespace broken_states_test
}  // namespace whirl_twin
