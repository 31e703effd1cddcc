// Time of each system in the steps of a live twin, and the one that caused a deadline miss.
#include "twin/step_times.h"

#include <gtest/gtest.h>

#include "../scene/scenes.h"
#include "twin/live_twin.h"

namespace whirl_twin {
namespace step_times_test {

constexpr std::int64_t kPeriod = 10'000;  // ns
constexpr std::size_t kLight = 0, kHeavy = 1, kControllers = 2;

/// A rotor, pendulums by the hundred, and a controller, every 10 us.
class Timed : public testing::Test {
 protected:
  Timed()
      : live_(sceneOf(R"(
step: 0.00001
systems:
  light: {model: jeffcott_rotor,
          parameters: {mass: 2, stiffness: 800, speed: 5}}
  heavy: {model: double_pendulum, integrator: runge_kutta_4, count: 2000,
          parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1},
          initial: {theta1: 0.1}, spread: {length1: {relative_half_width: 0.01}}}
controllers:
  hold: {type: pid, rate: 1000, measures: [light.x], acts_on: [light.force_x],
         parameters: {kp: 1, ki: 1, kd: 0}}
)"),
              10) {}

  LiveTwin live_;
};

TEST_F(Timed, TheOneThatTakesMostIsTold) {
  for (int i = 0; i < 100; ++i) {
    live_.cycle(monotonicNow());  // in time: what is late is late for the step
  }
  const StepTimes& times = live_.stepTimes();
  ASSERT_EQ(times.parts(), 3u);
  EXPECT_GE(static_cast<double>(times.of(kHeavy).longest), times.of(kHeavy).mean);
  EXPECT_GT(times.of(kControllers).mean, 0.0);
  EXPECT_GE(times.of(kHeavy).long_steps, 8u) << "one step of ten is timed";
  EXPECT_GT(times.of(kHeavy).long_steps,
            3 * (times.of(kLight).long_steps + times.of(kControllers).long_steps));
}

TEST_F(Timed, AWakeUpThatIsLateIsNobodysLongStep) {
  for (int i = 0; i < 100; ++i) {
    live_.cycle(monotonicNow() - 3'600'000'000'000);
  }
  for (std::size_t part = 0; part < live_.stepTimes().parts(); ++part) {
    EXPECT_EQ(live_.stepTimes().of(part).long_steps, 0u);
  }
}

TEST_F(Timed, AResetBeginsAnew) {
  live_.cycle(monotonicNow());
  live_.cycle(monotonicNow());
  ASSERT_GT(live_.stepTimes().of(kHeavy).longest, 0);
  live_.pause();
  live_.resetStepTimes();
  live_.cycle(monotonicNow());
  EXPECT_EQ(live_.stepTimes().of(kHeavy).longest, 0);
  EXPECT_EQ(live_.stepTimes().of(kHeavy).mean, 0.0);
}

TEST(StepTimes, LooksAtTheClockStaySmallBesideThePeriod) {
  const auto dueOf = [](std::size_t parts, std::int64_t period, bool several) {
    StepTimes times(parts, period);
    int due = 0;
    for (int i = 0; i < 1280; ++i) {
      due += times.isDue(several) ? 1 : 0;
    }
    return due;
  };
  EXPECT_EQ(dueOf(10, 1'000'000, false), 1280);
  EXPECT_EQ(dueOf(10, 1'000'000, true), 20);
  EXPECT_EQ(dueOf(3, kPeriod, false), 128);
}

}  // namespace step_times_test
}  // namespace whirl_twin
