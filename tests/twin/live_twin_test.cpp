// The twin in the fixed-rate loop: records out of a cycle, commands into it.
#include "twin/live_twin.h"

#include <gtest/gtest.h>

#include <optional>

#include "../scene/scenes.h"
#include "realtime/monotonic_clock.h"

namespace whirl_twin {
namespace live_twin_test {

class Live : public testing::Test {
 protected:
  explicit Live(std::size_t capacity = 100)
      : live_(sceneOf("{step: 0.001, drives: {shaft: {speed: 10}}, systems: {rotor: {model: "
                      "jeffcott_rotor, drive: shaft, parameters: {mass: 2, stiffness: 800}}}}"),
              capacity),
        record_(live_.twin().layout().size) {}

  /// Runs so many cycles, and returns the steps of the records read.
  std::vector<std::int64_t> stepsAfter(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      live_.cycle(scheduled_ += 1000000);
    }
    std::vector<std::int64_t> steps;
    while (live_.pop(record_.data())) {
      steps.push_back(RecordLayout::step(record_.data()));
    }
    return steps;
  }
  void send(TwinCommand::Kind kind, std::uint64_t steps = 0) {
    TwinCommand command;
    command.kind = kind;
    command.steps = steps;
    ASSERT_TRUE(live_.send(command));
  }

  using Kind = TwinCommand::Kind;
  using Steps = std::vector<std::int64_t>;
  LiveTwin live_;
  std::vector<double> record_;
  std::int64_t scheduled_ = 0;
};

TEST_F(Live, TheStartIsPublishedThenEveryStep) {
  EXPECT_EQ(stepsAfter(4), (Steps{0, 1, 2, 3}));
  EXPECT_EQ(RecordLayout::scheduled(record_.data()), 4000000);
}

TEST_F(Live, PausedItStandsStill) {
  stepsAfter(3);
  live_.pause();
  EXPECT_EQ(stepsAfter(5), Steps{});
  EXPECT_TRUE(live_.paused());
  send(Kind::kResume);
  EXPECT_EQ(stepsAfter(2), (Steps{3, 4}));
}

TEST_F(Live, StepsAreDoneOneACycleAndAnsweredWhenTheLastIsDone) {
  stepsAfter(3);
  live_.pause();
  send(Kind::kStep, 3);
  EXPECT_EQ(stepsAfter(2), (Steps{3, 4}));
  EXPECT_EQ(live_.carriedOut() + 1, live_.sent());
  EXPECT_EQ(stepsAfter(3), (Steps{5}));
  EXPECT_EQ(live_.carriedOut(), live_.sent());
  EXPECT_TRUE(live_.answer().done);
  EXPECT_EQ(live_.answer().step, 5);
}

TEST_F(Live, APauseEndsStepsThatAreUnderWay) {
  stepsAfter(1);
  live_.pause();
  send(Kind::kStep, 1000);
  send(Kind::kReset);
  EXPECT_EQ(stepsAfter(3), (Steps{1, 2, 3}));
  live_.pause();
  EXPECT_TRUE(live_.pausing());
  live_.cycle(scheduled_ += 1000000);
  EXPECT_FALSE(live_.pausing());
  EXPECT_EQ(live_.carriedOut(), live_.sent()) << "what waits behind the steps is carried out";
  EXPECT_EQ(stepsAfter(2), (Steps{0}));
  EXPECT_TRUE(live_.paused());
}

TEST_F(Live, NoStepsAreDoneAtOnce) {
  live_.pause();
  send(Kind::kStep, 0);
  stepsAfter(1);
  EXPECT_EQ(live_.carriedOut(), live_.sent());
  EXPECT_TRUE(live_.answer().done);
}

TEST_F(Live, SteppingWithoutAPauseIsNotDone) {
  send(Kind::kStep, 3);
  stepsAfter(1);
  EXPECT_EQ(live_.carriedOut(), live_.sent());
  EXPECT_FALSE(live_.answer().done);
}

TEST_F(Live, CommandsAreCarriedOutInOrderAndWaitForStepsUnderWay) {
  stepsAfter(10);
  live_.pause();
  send(Kind::kStep, 2);
  send(Kind::kReset);
  EXPECT_EQ(stepsAfter(4), (Steps{10, 11, 0}));
  EXPECT_EQ(live_.answer().step, 0);
}

TEST_F(Live, ASpeedIsSetWhilePausedAndTakesEffectWithTheNextStep) {
  stepsAfter(2);
  live_.pause();
  TwinCommand command;
  command.kind = Kind::kSetSpeed;
  command.speed = 20.0;
  command.max_acceleration = 1000.0;
  ASSERT_TRUE(live_.send(command));
  stepsAfter(1);
  EXPECT_TRUE(live_.answer().done);
  EXPECT_NEAR(live_.answer().duration, 0.01, 1e-12);
  send(Kind::kStep, 5);
  stepsAfter(5);
  EXPECT_NEAR(RecordLayout::shaft(record_.data(), 0).speed(), 15.0, 1e-9);
}

TEST_F(Live, ADriveThatIsNotThereIsRefused) {
  TwinCommand command;
  command.kind = Kind::kSetSpeed;
  command.drive = 7;
  command.max_acceleration = 1.0;
  ASSERT_TRUE(live_.send(command));
  stepsAfter(1);
  EXPECT_FALSE(live_.answer().done);
}

TEST_F(Live, TooManyCommandsAreRefusedAtTheDoor) {
  TwinCommand command;
  int accepted = 0;
  while (live_.send(command)) {
    ++accepted;
    ASSERT_LT(accepted, 1000);
  }
  EXPECT_GE(accepted, 60);
  stepsAfter(1);
  EXPECT_EQ(live_.carriedOut(), live_.sent());
}

TEST_F(Live, SlowerThanTheClockItStepsInSomeOfThePeriods) {
  stepsAfter(1);
  live_.setPace(0.25);
  EXPECT_EQ(stepsAfter(8), (Steps{1, 2}));
  live_.setPace(0.1);
  EXPECT_EQ(stepsAfter(500).size(), 50u);
  live_.setPace(1.0);
  EXPECT_EQ(stepsAfter(10).size(), 10u);
}

TEST_F(Live, FasterThanTheClockItTakesSeveralStepsStampedEvenlyInThePeriod) {
  stepsAfter(1);
  live_.setPace(2.5);
  EXPECT_EQ(stepsAfter(4).size(), 10u);
  live_.setPace(4.0);
  live_.cycle(scheduled_ += 1000000);
  for (std::int64_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(live_.pop(record_.data()));
    EXPECT_EQ(RecordLayout::scheduled(record_.data()), scheduled_ + i * 250000);
  }
  live_.pause();
  EXPECT_EQ(stepsAfter(3), Steps{});
}

TEST_F(Live, AsFastAsItGoesNothingIsLostHoweverSlowTheReader) {
  stepsAfter(1);
  live_.setPace(Pace::kAsFastAsItGoes);
  std::int64_t taken = 0;
  for (int i = 0; i < 200; ++i) {
    live_.cycle(monotonicNow() + 1000000);  // there is time
    if (i % 3 == 0 && live_.pop(record_.data())) {
      ++taken;
      EXPECT_EQ(RecordLayout::step(record_.data()), taken) << "every step, in order";
    }
  }
  EXPECT_EQ(live_.dropped(), 0u);
  EXPECT_GT(live_.stepCount(), taken);
  EXPECT_LT(live_.stepCount() - taken, 20) << "an eighth of the ring";
}

TEST_F(Live, StepsThatAreAskedForNeedNoRealTime) {
  stepsAfter(1);
  live_.pause();
  send(Kind::kStep, 10);
  live_.cycle(monotonicNow() + 3600 * std::int64_t{1000000000});  // all the time there is
  EXPECT_EQ(live_.stepCount(), 10);
  EXPECT_EQ(live_.carriedOut(), live_.sent());
  EXPECT_EQ(stepsAfter(3).size(), 10u) << "and then it stands still";
}

struct SmallRing : Live {
  SmallRing() : Live(3) {}
};

TEST_F(SmallRing, KeepsTheOldestRecordsAndCountsTheDropped) {
  EXPECT_EQ(stepsAfter(8), (Steps{0, 1, 2}));
  EXPECT_EQ(live_.dropped(), 5u);
  EXPECT_EQ(stepsAfter(1), (Steps{8}));
}

}  // namespace live_twin_test
}  // namespace whirl_twin
