// Systems that precompute data for shaft speeds: prepared before a drive goes beyond their range,
// and deleted only by the thread that sends commands.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "../scene/scenes.h"
#include "models/model_registry.h"
#include "twin/live_parameters.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace prepared_system_test {

int made_ready = 0;
int deleted = 0;
double ready_from = 0.0;  // rad/s
double ready_to = 0.0;

/// A jeffcott_rotor that must be prepared for its speeds.
class PreparedRotor final : public Stepper {
 public:
  PreparedRotor(std::function<std::unique_ptr<Stepper>()> rotor, double lowest, double highest)
      : rotor_(std::move(rotor)), system_(rotor_()), lowest_(lowest), highest_(highest) {}
  ~PreparedRotor() override { ++deleted; }
  std::unique_ptr<Stepper> readyFor(double lowest, double highest) const override {
    if (lowest >= lowest_ && highest <= highest_) {
      return nullptr;
    }
    ++made_ready;
    ready_from = lowest;
    ready_to = highest;
    return std::make_unique<PreparedRotor>(rotor_, lowest, highest);
  }
  StepStatus step(double time) noexcept override { return system_->step(time); }
  std::size_t dof() const noexcept override { return system_->dof(); }
  StepStatus stepPart(double time, std::int64_t from, std::int64_t to) noexcept override {
    return system_->stepPart(time, from, to);
  }
  void motion(double* out) const noexcept override { system_->motion(out); }
  void write(double* out) const noexcept override { system_->write(out); }
  void set(const double* q, const double* v) noexcept override { system_->set(q, v); }
  void exchange(StateImage& image) noexcept override { system_->exchange(image); }

 private:
  std::function<std::unique_ptr<Stepper>()> rotor_;
  std::unique_ptr<Stepper> system_;
  double lowest_;   // rad/s
  double highest_;  // rad/s
};

ModelInfo preparedModel() {
  ModelInfo info = *findModel("jeffcott_rotor");
  info.name = "prepared_rotor";
  info.setUp = [plain = info.setUp](const ParameterValues& values, const Settings& settings,
                                    const ModelContext& around) {
    ModelSetup setup = plain(values, settings, around);
    setup.system = [make = setup.system](const std::string& integrator,
                                         const StepContext& excitation, double step,
                                         int substeps) -> std::unique_ptr<Stepper> {
      return std::make_unique<PreparedRotor>(
          [=] { return make(integrator, excitation, step, substeps); }, 0.0, 10.0);
    };
    return setup;
  };
  return info;
}

class Prepared : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setModelSource([] { return std::vector<ModelInfo>{preparedModel()}; },
                   [](const std::string& text) { FAIL() << text; });
  }
  Prepared()
      : live_(sceneOf("{step: 0.001, drives: {shaft: {speed: 10}}, systems: {rotor: {model: "
                      "prepared_rotor, drive: shaft, integrator: runge_kutta_4, parameters: "
                      "{mass: 2, stiffness: 800, eccentricity: 1.0e-3}}}}"),
              10000),
        parameters_(live_, [this] { return carriedOut(); }) {
    made_ready = 0;
  }
  bool carriedOut() {
    while (live_.carriedOut() < live_.sent()) {
      cycle(1);
    }
    return true;
  }
  void cycle(int times) {
    const int before = deleted;
    for (int i = 0; i < times; ++i) {
      live_.cycle(0);
    }
    EXPECT_EQ(deleted, before) << "the loop deletes nothing";
  }
  bool sendTo(double speed, double max_acceleration, double max_jerk) {
    TwinCommand command;
    command.kind = TwinCommand::Kind::kSetSpeed;
    command.speed = speed;
    command.max_acceleration = max_acceleration;
    command.max_jerk = max_jerk;
    return parameters_.prepareFor(0, {speed, max_acceleration, max_jerk, 0.0}) &&
           live_.send(command) && carriedOut() && live_.answer().done;
  }

  LiveTwin live_;
  LiveParameters parameters_;
};

TEST_F(Prepared, ASystemIsMadeReadyBeforeItsDriveGoesBeyondWhatItKnows) {
  cycle(10);
  ASSERT_TRUE(sendTo(5.0, 1.0, 0.0));
  EXPECT_EQ(made_ready, 1) << "it knows 0 to 10 rad/s, and is to know a little more";
  EXPECT_LE(ready_from, 5.0);
  EXPECT_GE(ready_to, 10.0);
  ASSERT_TRUE(sendTo(7.0, 1.0, 0.0));
  EXPECT_EQ(made_ready, 1) << "ready already";
  ASSERT_TRUE(sendTo(40.0, 100.0, 0.0));
  EXPECT_EQ(made_ready, 2);
  EXPECT_LE(ready_from, 5.0);
  EXPECT_GE(ready_to, 40.0);
  EXPECT_LE(ready_to, 50.0) << "and for little more";
}

TEST_F(Prepared, ForASpeedThatRunsOnWhileTheAccelerationIsBroughtDown) {
  cycle(10);
  ASSERT_TRUE(sendTo(1000.0, 100.0, 0.0));
  cycle(100);  // at 100 rad/s^2, 20 rad/s
  ASSERT_TRUE(sendTo(20.0, 100.0, 50.0));
  EXPECT_EQ(made_ready, 1) << "it has been made ready for 1000 rad/s";
  TwinCommand reset;
  reset.kind = TwinCommand::Kind::kReset;
  ASSERT_TRUE(live_.send(reset));
  cycle(1);
  parameters_.restored();
  ASSERT_TRUE(sendTo(15.0, 100.0, 0.0));
  cycle(40);  // near 14 rad/s
  made_ready = 0;
  ASSERT_TRUE(sendTo(12.0, 100.0, 50.0));
  EXPECT_EQ(made_ready, 1);
  EXPECT_GE(ready_to, 14.0 + 100.0 * 100.0 / (2.0 * 50.0)) << "v + a^2 / 2 j";
}

TEST_F(Prepared, AChangedSystemIsReadyForTheSpeedsOfItsDriveAndGoesOnAtTheSameState) {
  cycle(10);
  ASSERT_TRUE(sendTo(40.0, 1000.0, 0.0));
  cycle(100);
  std::vector<double> before(live_.twin().layout().size);
  std::vector<double> after(live_.twin().layout().size);
  live_.twin().write(before.data());
  made_ready = 0;
  live_.pause();
  ASSERT_TRUE(parameters_.set({"rotor", {"damping"}, {3.0}, 0.0}).done);
  EXPECT_EQ(made_ready, 1);
  EXPECT_GE(ready_to, 40.0);
  live_.twin().write(after.data());
  const SystemPlace was = live_.twin().layout().system(before.data(), 0);
  const SystemPlace is = live_.twin().layout().system(after.data(), 0);
  EXPECT_EQ(is.status(), was.status());
  EXPECT_TRUE(std::equal(was.q(), was.q() + 4, is.q())) << "x, y and their rates";
}

}  // namespace prepared_system_test
}  // namespace whirl_twin
