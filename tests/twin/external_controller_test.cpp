// A controller in another process: here the test acts as the other process, between two cycles of
// the loop.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "controllers/external.h"
#include "twin/live_twin.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace external_controller_test {

constexpr std::int64_t kStep = 1'000'000;  // ns

/// Two equal masses that a magnet pulls away, and an uncontrolled one. `own` is held by a built-in
/// controller, `other` by another process.
std::string sceneText(const std::string& external, const std::string& delay = "0.004") {
  const std::string mass =
      "{model: linear_system, integrator: exponential, parameters: {names: [x], mass: [[1.0]], "
      "stiffness: [[-1.0]]}, initial: {x: 1.0e-3, x_rate: 2.0e-4}}";
  return fmt::format(
      "{{step: 0.001, systems: {{a: {0}, b: {0}, c: {{model: pendulum, parameters: {{length: 1.0, "
      "mass: 1.0}}, initial: {{theta: 0.1}}}}}}, controllers: {{"
      "own: {{type: pid, rate: 300.0, measures: [a.x], acts_on: [a.force_x], delay: {2}, "
      "parameters: {{kp: 2.0, ki: 0.0, kd: 1.0}}}}, "
      "other: {{type: external, rate: 300.0, measures: [b.x], acts_on: [b.force_x], delay: {2}, "
      "{1}}}}}}}",
      mass, external, delay);
}

/// The error; "" if there is none.
std::string inputErrorOf(const std::string& text) {
  try {
    sceneOf(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

const char* const kLockstep = "mode: lockstep, timeout: 0.01";

/// The process: the same law.
class Process {
 public:
  /// Answers all pending samples; `late` of them wait for the next time.
  void answer(ExternalLink& link, std::size_t late = 0) {
    ExternalSample sample;
    while (link.take(sample)) {
      const double y = sample.values[0];
      if (sample.sample == 0) {
        last_ = y;
      }
      ExternalSample command = sample;
      command.values = {2.0 * (0.0 - y) - 1.0 * ((y - last_) * (1.0 / (1.0 / 300.0)))};
      last_ = y;
      answers_.push_back(command);
    }
    while (answers_.size() > late) {
      EXPECT_TRUE(link.answer(answers_.front()));
      answers_.erase(answers_.begin());
    }
  }

 private:
  double last_ = 0.0;
  std::vector<ExternalSample> answers_;
};

class Live {
 public:
  explicit Live(const std::string& text) : twin_(sceneOf(text), 4000) {}

  void cycle(int times = 1) {
    for (int i = 0; i < times; ++i) {
      twin_.cycle(now_ += kStep);
    }
  }
  std::int64_t step() const { return twin_.stepCount(); }
  ExternalController& external() const {
    return *twin_.twin().control().controllers()[1].external();
  }
  ExternalLink& link() const { return external().link(); }
  LiveTwin& twin() { return twin_; }
  /// x and its rate.
  std::vector<double> motion(std::size_t system) const {
    std::vector<double> motion(2);
    twin_.twin().running(system).motion(motion.data());
    return motion;
  }
  double acting() const { return twin_.twin().control().controllers()[1].acting(0); }
  void reset() {
    TwinCommand command;
    command.kind = TwinCommand::Kind::kReset;
    ASSERT_TRUE(twin_.send(command));
    cycle();
  }

 private:
  LiveTwin twin_;
  std::int64_t now_ = 0;
};

TEST(ExternalController, WithoutAProcessItGivesNothingAndTimeGoesOn) {
  Live live(sceneText(kLockstep));
  live.cycle(101);
  EXPECT_EQ(live.step(), 100);
  EXPECT_EQ(live.acting(), 0.0);
  EXPECT_FALSE(live.external().lost()) << "it was never there";
  EXPECT_EQ(live.external().age(), ExternalController::kNoAge);
}

TEST(ExternalController, InLockstepItIsTheBuiltInOneByteForByte) {
  Live live(sceneText(kLockstep));
  Process process;
  live.cycle(20);
  process.answer(live.link());
  live.cycle();
  live.reset();  // from its first sample on, every one is answered
  for (int i = 0; i < 4000; ++i) {
    live.cycle();
    if (i % 6 == 0) {  // time waits for it
      process.answer(live.link());
    }
    ASSERT_EQ(live.motion(1), live.motion(0)) << "step " << live.step();
  }
  EXPECT_GT(live.step(), 2000);
  EXPECT_LT(live.step(), 4000) << "it has waited";
  EXPECT_NE(live.acting(), 0.0);
}

TEST(ExternalController, InLockstepTimeWaitsAndNoLongerThanTheTimeout) {
  for (const bool zero : {false, true}) {
    Live live(sceneText(std::string(kLockstep) + (zero ? ", on_timeout: zero" : "")));
    Process process;
    live.cycle(200);
    process.answer(live.link());
    for (int i = 0; i < 100; ++i) {
      live.cycle();
      process.answer(live.link());
    }
    const double held = live.acting();
    ASSERT_NE(held, 0.0);
    // Killed. Steps under way continue; then time is stopped for 10 ms, and a period.
    std::int64_t stood = 0;
    std::int64_t before = live.step();
    while (!live.external().lost() && stood < 100) {
      live.cycle();
      stood += live.step() == before ? 1 : 0;
      before = live.step();
    }
    EXPECT_GE(stood, 10);
    EXPECT_LE(stood, 11);
    live.cycle(50);
    EXPECT_EQ(live.step(), before + 50) << "nothing else stops";
    EXPECT_EQ(live.acting() == 0.0, zero);
    // It is there again.
    process.answer(live.link());
    live.cycle();
    EXPECT_FALSE(live.external().lost());
  }
}

TEST(ExternalController, APauseIsNoWaiting) {
  Live live(sceneText(kLockstep));
  Process process;
  live.cycle(20);
  process.answer(live.link());
  live.cycle(8);  // it waits
  live.twin().pause();
  live.cycle(100);
  EXPECT_FALSE(live.external().lost());
  TwinCommand command;
  command.kind = TwinCommand::Kind::kStep;
  command.steps = 20;
  ASSERT_TRUE(live.twin().send(command));
  const std::int64_t start = live.step();
  for (int i = 0; i < 40 && live.twin().carriedOut() < live.twin().sent(); ++i) {
    process.answer(live.link());
    live.cycle();
  }
  EXPECT_EQ(live.step(), start + 20) << "steps wait for answers, too";
  EXPECT_FALSE(live.external().lost());
}

TEST(ExternalController, AnAnswerToASampleBeforeAResetIsDropped) {
  Live live(sceneText(kLockstep));
  Process process;
  live.cycle(20);
  process.answer(live.link());
  live.cycle(3);
  ExternalSample old;
  ASSERT_TRUE(live.link().take(old));
  live.reset();
  ExternalSample late = old;
  late.values = {1.0e6};
  for (const std::int64_t sample : {0, 1, 2, 7}) {
    late.sample = sample;
    ASSERT_TRUE(live.link().answer(late));
  }
  live.cycle(5);
  EXPECT_EQ(live.acting(), 0.0);
  EXPECT_EQ(live.external().age(), ExternalController::kNoAge);
}

TEST(ExternalController, FreeRunningTheNewestActsAndItsAgeIsKnown) {
  Live live(sceneText("mode: free_running, timeout: 0.05", "0.0"));
  Process process;
  for (int i = 0; i < 300; ++i) {
    live.cycle();
    process.answer(live.link(), 2);
  }
  EXPECT_EQ(live.step(), 299) << "it waits for nothing";
  EXPECT_GE(live.external().age(), 2);
  EXPECT_LE(live.external().age(), 3);
  const TimingHistogram ages = live.external().ages();
  EXPECT_GT(ages.count(), 80u);
  EXPECT_LE(ages.count(), 90u) << "one a sample";
  EXPECT_GE(ages.percentile(50.0), 2);
  EXPECT_LE(ages.percentile(50.0), 3);
  EXPECT_LE(ages.max(), 3);
  const double held = live.acting();
  ASSERT_NE(held, 0.0);
  // Killed: 0.05 s, and a sample.
  live.cycle(40);
  EXPECT_FALSE(live.external().lost());
  live.cycle(20);
  EXPECT_TRUE(live.external().lost());
  EXPECT_NE(live.acting(), 0.0) << "it holds";
  EXPECT_GE(live.external().ages().max(), 15) << "of the time that it was lost";
  const std::int64_t step = live.step();
  live.cycle(10);
  EXPECT_EQ(live.step(), step + 10);
  live.reset();
  EXPECT_EQ(live.external().ages().count(), 0u);
}

TEST(ExternalController, FreeRunningLostItMayGiveZero) {
  Live live(sceneText("mode: free_running, timeout: 0.05, on_timeout: zero"));
  Process process;
  for (int i = 0; i < 100; ++i) {
    live.cycle();
    process.answer(live.link());
  }
  ASSERT_NE(live.acting(), 0.0);
  live.cycle(60);
  EXPECT_TRUE(live.external().lost());
  EXPECT_EQ(live.acting(), 0.0);
}

// The system that it controls stops; those with a built-in controller, or with none, continue.
TEST(ExternalController, LostItMayStopWhatItActsOnAndNothingElse) {
  for (const char* const mode : {"lockstep", "free_running"}) {
    Live live(sceneText(fmt::format("mode: {}, timeout: 0.05, on_timeout: stop", mode)));
    Observer observer(live.twin().twin(), live.twin().generations());
    Process process;
    live.cycle(20);
    for (int i = 0; i < 200; ++i) {
      process.answer(live.link());
      live.cycle();
    }
    EXPECT_EQ(live.twin().twin().status(1), StepStatus::kOk) << mode;
    live.cycle(70);  // the time-out, a sample and what lockstep waits for
    ASSERT_EQ(live.twin().twin().status(1), StepStatus::kControllerLost) << mode;
    const std::vector<double> stopped = live.motion(1);
    const std::int64_t step = live.step();
    process.answer(live.link());
    live.cycle();
    std::vector<double> record(live.twin().twin().layout().size);
    while (live.twin().pop(record.data())) {
      observer.observe(record.data());
    }
    const std::string& why = observer.stopReason(1);
    EXPECT_EQ(why.find("b: stopped in step "), 0u) << why;
    EXPECT_NE(why.find("controller other has not answered for 0.05 s of "), std::string::npos)
        << why;
    const std::vector<double> own = live.motion(0);
    live.cycle(30);
    EXPECT_GT(live.step(), step) << mode;
    EXPECT_EQ(live.motion(1), stopped) << "until a reset, though it answers again";
    EXPECT_NE(live.motion(0), own);
    EXPECT_EQ(live.twin().twin().status(0), StepStatus::kOk);
    EXPECT_EQ(live.twin().twin().status(2), StepStatus::kOk);
    live.reset();
    EXPECT_EQ(live.twin().twin().status(1), StepStatus::kOk);
  }
}

TEST(ExternalController, AllocatesNothingInTheLoop) {
  for (const char* const mode : {"lockstep", "free_running"}) {
    Live live(sceneText(fmt::format("mode: {}, timeout: 0.01", mode)));
    Process process;
    live.cycle(20);
    process.answer(live.link());
    const AllocationGuard guard;
    live.cycle(100);
    EXPECT_EQ(guard.allocations(), 0u) << mode;
  }
}

TEST(ExternalController, InLockstepADelayBelowAStepIsRefused) {
  EXPECT_NE(inputErrorOf(sceneText(kLockstep, "0.0005"))
                .find("controllers.other.delay: must be at "
                      "least a step"),
            std::string::npos);
  EXPECT_NE(inputErrorOf(sceneText("mode: lockstep")).find("controllers.other.timeout"),
            std::string::npos);
}

}  // namespace external_controller_test
}  // namespace whirl_twin
