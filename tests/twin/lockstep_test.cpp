// Lockstep: the twin advances only as far as all its receivers have acknowledged, and drops an
// overdue one only on request.
#include "twin/lockstep.h"

#include <gtest/gtest.h>

#include "../scene/scenes.h"
#include "twin/live_twin.h"

namespace whirl_twin {
namespace lockstep_test {

using Names = std::vector<std::string>;

/// A live twin in lockstep with two receivers, to which the test forwards its records.
class InLockstep : public testing::Test {
 protected:
  explicit InLockstep(std::int64_t ahead = 1, std::int64_t every = 1)
      : every_(every),
        live_(sceneOf("{step: 0.001, drives: {shaft: {speed: 10}}, systems: {rotor: {model: "
                      "jeffcott_rotor, drive: shaft, parameters: {mass: 2, stiffness: 800}}}}"),
              1000),
        lockstep_(live_.gate(), {{"/a", "/b"}, ahead, every, 5.0}, 0),
        record_(live_.twin().layout().size) {}

  /// Cycles so often, publishes, and returns the step reached.
  std::int64_t after(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      live_.cycle(scheduled_ += 1000000);
      while (live_.pop(record_.data())) {
        const std::int64_t step = RecordLayout::step(record_.data());
        if (step % every_ == 0) {
          lockstep_.published(step, step < newest_, now_);
        }
        newest_ = step;
      }
    }
    return newest_;
  }
  void bothAreThere() {
    lockstep_.see("/a", true, now_);
    lockstep_.see("/b", true, now_);
  }
  void bothAcknowledge(std::int64_t step) {
    EXPECT_TRUE(lockstep_.acknowledge("/a", step, now_));
    EXPECT_TRUE(lockstep_.acknowledge("/b", step, now_));
  }
  void send(TwinCommand::Kind kind, std::uint64_t steps = 0) {
    TwinCommand command;
    command.kind = kind;
    command.steps = steps;
    ASSERT_TRUE(live_.send(command));
  }

  std::int64_t every_;
  LiveTwin live_;
  Lockstep lockstep_;
  std::vector<double> record_;
  std::int64_t scheduled_ = 0;
  std::int64_t newest_ = -1;
  double now_ = 0.0;
};

TEST_F(InLockstep, NothingIsToldBeforeAllAreThere) {
  EXPECT_EQ(after(5), -1);
  EXPECT_EQ(lockstep_.missing(), (Names{"/a", "/b"}));
  lockstep_.see("/b", true, now_);
  EXPECT_EQ(after(5), -1);
  EXPECT_TRUE(lockstep_.gathers());
  lockstep_.see("/a", true, now_);
  EXPECT_FALSE(lockstep_.gathers());
  EXPECT_EQ(after(5), 0) << "the start, which both will hear";
}

TEST_F(InLockstep, EachStepWaitsForTheSlowest) {
  bothAreThere();
  after(3);
  for (std::int64_t step = 0; step < 20; ++step) {
    EXPECT_EQ(after(2), step);
    EXPECT_TRUE(lockstep_.acknowledge("/a", step, now_));
    EXPECT_EQ(after(2), step);
    EXPECT_TRUE(lockstep_.acknowledge("/b", step, now_));
  }
}

TEST_F(InLockstep, AStepYetToComeAndAStrangerOpenNothing) {
  bothAreThere();
  after(3);
  EXPECT_FALSE(lockstep_.acknowledge("/a", 7, now_));
  EXPECT_FALSE(lockstep_.acknowledge("/c", 0, now_));
  EXPECT_TRUE(lockstep_.acknowledge("/b", 0, now_));
  EXPECT_EQ(after(3), 0);
}

TEST_F(InLockstep, AsFastAsItGoesAndInStepsItWaitsToo) {
  bothAreThere();
  live_.setPace(Pace::kAsFastAsItGoes);
  EXPECT_EQ(after(3), 0);
  bothAcknowledge(0);
  EXPECT_EQ(after(5), 1);
  live_.pause();
  send(TwinCommand::Kind::kStep, 3);
  EXPECT_EQ(after(3), 1);
  for (const std::int64_t step : {1, 2, 3, 4}) {
    bothAcknowledge(step);
    EXPECT_EQ(after(3), std::min<std::int64_t>(step + 1, 4));
  }
  EXPECT_EQ(live_.carriedOut(), live_.sent());
}

TEST_F(InLockstep, AResetBeginsAnewWhateverWasAcknowledgedBefore) {
  bothAreThere();
  after(1);
  for (std::int64_t step = 0; step < 10; ++step) {
    bothAcknowledge(step);
    after(1);
  }
  send(TwinCommand::Kind::kReset);
  live_.cycle(scheduled_ += 1000000);
  EXPECT_TRUE(lockstep_.acknowledge("/a", 10, now_)) << "on its way before the reset was told";
  EXPECT_TRUE(lockstep_.acknowledge("/b", 10, now_));
  live_.cycle(scheduled_ += 1000000);
  EXPECT_EQ(live_.stepCount(), 0);
  EXPECT_EQ(after(3), 0);
  bothAcknowledge(0);
  EXPECT_EQ(after(3), 1);
}

TEST_F(InLockstep, WhoIsOverdueIsNamedAndWaitedForUntilLeftOut) {
  bothAreThere();
  after(1);
  bothAcknowledge(0);
  after(1);
  now_ = 4.0;
  EXPECT_TRUE(lockstep_.acknowledge("/b", 1, now_));
  EXPECT_EQ(lockstep_.waitsFor(4.0, 0.5), (Names{"/a"}));
  EXPECT_EQ(lockstep_.overdue(4.9), Names{});
  EXPECT_EQ(lockstep_.overdue(5.1), (Names{"/a"}));
  EXPECT_EQ(after(3), 1) << "still";
  lockstep_.leaveOut({"/a"});
  EXPECT_EQ(lockstep_.leftOut(), (Names{"/a"}));
  EXPECT_EQ(lockstep_.overdue(9.0), Names{});
  EXPECT_EQ(after(3), 2);
  EXPECT_TRUE(lockstep_.acknowledge("/b", 2, now_));
  EXPECT_EQ(after(3), 3);
  EXPECT_TRUE(lockstep_.acknowledge("/a", 2, now_)) << "it is back";
  EXPECT_TRUE(lockstep_.acknowledge("/b", 3, now_));
  EXPECT_EQ(after(3), 3);
  EXPECT_TRUE(lockstep_.acknowledge("/a", 3, now_));
  EXPECT_EQ(after(3), 4);
  lockstep_.leaveOut({"/a", "/b"});
  EXPECT_EQ(after(3), 7) << "with nobody";
}

TEST_F(InLockstep, WhoIsThereAnewOwesNothing) {
  bothAreThere();
  after(2);
  EXPECT_TRUE(lockstep_.acknowledge("/b", 0, now_));
  lockstep_.see("/a", false, now_);
  EXPECT_EQ(after(3), 0);
  lockstep_.see("/a", true, now_);
  EXPECT_EQ(after(3), 1) << "step 0 it will never hear";
  EXPECT_TRUE(lockstep_.acknowledge("/b", 1, now_));
  EXPECT_EQ(after(3), 1) << "this one it has heard";
  EXPECT_TRUE(lockstep_.acknowledge("/a", 1, now_));
  EXPECT_EQ(after(3), 2);
}

struct InLongerStrides : InLockstep {
  InLongerStrides() : InLockstep(2, 10) {}
};

TEST_F(InLongerStrides, ItGoesSoManyPublicationsAhead) {
  bothAreThere();
  EXPECT_EQ(after(50), 10);
  bothAcknowledge(0);
  EXPECT_EQ(after(50), 20);
  bothAcknowledge(20);
  EXPECT_EQ(after(50), 40);
}

}  // namespace lockstep_test
}  // namespace whirl_twin
