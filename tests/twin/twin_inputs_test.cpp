// Inputs of a running twin: the setting of a scene acts from the start, a command from the next
// step until its time-out, and samples of an ensemble receive the same input as the system.
#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"
#include "twin/live_twin.h"

namespace whirl_twin {
namespace twin_inputs_test {

constexpr std::int64_t kMillisecond = 1000000;

Scene oneMass(const std::string& inputs, const std::string& further = "") {
  return sceneOf(
      "{step: 0.001, time: 2.0, gravity: 10, systems: {rotor: {model: jeffcott_rotor, inputs: {" +
      inputs + "}, parameters: {mass: 2, stiffness: 200, speed: 3}" + further + "}}}");
}

double xOf(const Twin& twin) {
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  return twin.layout().system(record.data(), 0).q()[0];
}

/// From rest, F (1 - cos p t) / k.
double pushed(double force, double time) {
  return force / 200.0 * (1.0 - std::cos(10.0 * time));
}

TEST(TwinInputs, OfTheSceneActFromItsStart) {
  Twin twin(oneMass("force_x: 4.3"));
  for (int i = 0; i < 200; ++i) {
    twin.step();
  }
  EXPECT_NEAR(xOf(twin), pushed(4.3, 0.2), 1e-15);
  // The phase counts from simulated time 0, the start at 2 s.
  Twin harmonic(oneMass("force_x: {amplitude: 1.0, frequency: 3.0, phase: 0.5}"));
  EXPECT_NEAR(harmonic.inputs(0).value(0, 0.0), std::cos(3.0 * 2.0 + 0.5), 1e-15);
}

TEST(TwinInputs, CommandActsFromTheNextStepUntilItsTimeOut) {
  Twin twin(oneMass("force_x: 0.0, force_y: {amplitude: 1.0, frequency: 3.0}"));
  for (int i = 0; i < 10; ++i) {
    twin.step();
  }
  EXPECT_EQ(xOf(twin), 0.0);
  EXPECT_TRUE(twin.setInput(0, 0, 4.3, 100 * kMillisecond));
  for (int i = 0; i < 100; ++i) {
    twin.step();
  }
  EXPECT_NEAR(xOf(twin), pushed(4.3, 0.1), 1e-15);
  for (int i = 0; i < 50; ++i) {
    twin.step();
  }
  // After a push of 0.1 s it swings freely.
  EXPECT_NEAR(xOf(twin), pushed(4.3, 0.15) - pushed(4.3, 0.05), 1e-15);
  EXPECT_FALSE(twin.setInput(0, 0, NAN, kMillisecond));
  EXPECT_FALSE(twin.setInput(0, 0, 1.0, 0));
  EXPECT_FALSE(twin.setInput(0, 1, 1.0, kMillisecond));
  EXPECT_FALSE(twin.setInput(0, 2, 1.0, kMillisecond));
  EXPECT_FALSE(twin.setInput(1, 0, 1.0, kMillisecond));
  EXPECT_TRUE(twin.setInput(0, 0, 1.0, kMillisecond));
  twin.reset();
  twin.step();
  EXPECT_EQ(xOf(twin), 0.0);
}

TEST(TwinInputs, LiveCommandIsCarriedOutBetweenSteps) {
  LiveTwin live(oneMass("force_x: 0.0"), 1000);
  TwinCommand command;
  command.kind = TwinCommand::Kind::kSetInput;
  command.value = 4.3;
  command.duration = 50 * kMillisecond;
  for (int i = 0; i < 101; ++i) {
    if (i == 1) {
      ASSERT_TRUE(live.send(command));
    }
    live.cycle(0);
  }
  EXPECT_TRUE(live.answer().done);
  EXPECT_EQ(live.answer().step, 0);
  EXPECT_NEAR(xOf(live.twin()), pushed(4.3, 0.1) - pushed(4.3, 0.05), 1e-15);
  command.input = 7;
  ASSERT_TRUE(live.send(command));
  live.cycle(0);
  EXPECT_FALSE(live.answer().done);
}

TEST(TwinInputs, ActOnAllMembersOfAnEnsemble) {
  Twin twin(oneMass("force_x: 4.3", ", count: 3, spread: {mass: {relative_half_width: 1.0e-12}}"));
  twin.buildEnsembles();
  for (int i = 0; i < 200; ++i) {
    twin.step();
  }
  const Ensemble& ensemble = *twin.ensemble(0);
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(200, record.data());
  for (std::size_t member = 0; member < 3; ++member) {
    EXPECT_NEAR(ensemble.values(record.data())[member], pushed(4.3, 0.2), 1e-12);
  }
}

}  // namespace twin_inputs_test
}  // namespace whirl_twin
