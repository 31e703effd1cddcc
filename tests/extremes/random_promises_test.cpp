// Error bounds of `integrator: auto` for random systems, checked with an independent method
// (independent_motion.h): none is violated. Every model in each of its forms, at steps from a tenth
// of a millisecond to a second; and the hardest: narrow dry friction, chaotic pendulums, run-ups of
// linear rotors at coarse steps. The scenes come from one seed: the same on any machine.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../accuracy/independent_motion.h"
#include "accuracy/step_choice.h"
#include "dice.h"
#include "general_position.h"
#include "judged_promise.h"
#include "measured.h"
#include "models/model_registry.h"
#include "random_elements.h"
#include "scene/model_context.h"
#include "scene/system_setup.h"

namespace whirl_twin {
namespace random_promises_test {

constexpr std::uint64_t kSeed = 12;    // or WHIRL_TWIN_SEED of the environment: other scenes
constexpr double kRounding = 1.0e-12;  // below, errors are indistinguishable
constexpr double kSamples = 250.0;

void giveAProfile(Scene& one, Dice& dice) {
  DriveSpec& drive = one.drives.front();
  if (!drive.motor && dice.below(2) == 0) {
    drive.profile = {{dice.uniform(5.0, 60.0), dice.anySize(5.0, 500.0),
                      dice.below(2) == 0 ? 0.0 : dice.anySize(100.0, 1000.0),
                      dice.uniform(0.0, 1.0)}};
  }
}

Scene anyModel(Dice& dice) {
  static const std::vector<VariantUnderTest> variants = everyVariant();
  Scene one;
  one.name = "random";
  SystemSpec spec;
  while (true) {
    one.drives.clear();
    spec = inGeneralPosition({variants[dice.below(variants.size())], "auto"}, one);
    for (auto& [name, value] : spec.parameters) {
      if (value == 0.3) {
        value *= dice.anySize(0.3, 3.0);
      }
    }
    if (!one.drives.empty()) {
      giveAProfile(one, dice);
    }
    one.step = std::llround(dice.anySize(1.0e5, 1.0e8));
    spec.horizon = dice.anySize(0.3, 10.0);
    try {
      // The number of modes of a reduced-order rotor depends on its parameters.
      const auto dof =
          static_cast<std::size_t>(setupOf(spec, surroundingsOf(one, spec)).made.dynamics->dof());
      spec.q.resize(dof, 0.5);
      spec.v.resize(dof, 0.1);
    } catch (const std::exception&) {  // numbers that do not fit together
      continue;
    }
    for (std::size_t i = 0; i < spec.q.size(); ++i) {
      spec.q[i] *= dice.uniform(-2.0, 2.0);
      spec.v[i] *= dice.uniform(-5.0, 5.0);
    }
    one.systems = {spec};
    return one;
  }
}

Scene friction(Dice& dice) {
  Scene one;
  one.step = kMillisecond;
  SystemSpec spec;
  spec.model = "friction_oscillator";
  spec.parameters = {{"mass", 1.0},
                     {"friction_coefficient", dice.uniform(0.1, 0.5)},
                     {"half_spacing", 0.0762},
                     {"height", 0.0127},
                     {"roller_speed", 0.2},
                     {"regularization", dice.anySize(1.0e-8, 1.0e-3)}};
  spec.q = {dice.uniform(0.01, 0.06)};
  spec.v = {0.0};
  spec.horizon = dice.anySize(0.1, 3.0);
  one.systems = {spec};
  return one;
}

Scene tumbling(Dice& dice) {
  Scene one;
  one.step = dice.below(2) == 0 ? kMillisecond : std::llround(dice.anySize(1.0e6, 1.0e9));
  SystemSpec spec;
  spec.model = "double_pendulum";
  spec.parameters = {{"mass1", 1.0},
                     {"mass2", dice.anySize(0.3, 3.0)},
                     {"length1", 1.0},
                     {"length2", dice.anySize(0.3, 3.0)}};
  spec.q = {dice.uniform(-3.0, 3.0), dice.uniform(-3.0, 3.0)};
  spec.v = {0.0, 0.0};
  spec.horizon = dice.anySize(10.0, fullLength() ? 100.0 : 20.0);
  one.systems = {spec};
  return one;
}

Scene runUp(Dice& dice) {
  Scene one;
  one.step = std::llround(dice.anySize(1.0e6, 2.0e7));
  DriveSpec drive;
  drive.name = "shaft";
  drive.profile = {{dice.uniform(100.0, 300.0), dice.anySize(30.0, 1000.0), 0.0, 1.0}};
  one.drives = {drive};
  SystemSpec spec;
  spec.model = "jeffcott_rotor";
  spec.drive = drive.name;
  spec.parameters = {{"mass", 2.0},
                     {"stiffness", 2.0e4},
                     {"damping", dice.uniform(1.0, 30.0)},
                     {"eccentricity", 1.0e-4}};
  if (dice.below(2) == 0) {
    spec.parameters["internal_damping"] = 6.0;
    spec.parameters["stiffness_y"] = 2.2e4;
  }
  spec.q = {0.0, 0.0};
  spec.v = {0.0, 0.0};
  spec.horizon = dice.uniform(0.5, 3.0);
  one.systems = {spec};
  return one;
}

Scene withDefaults(Scene one, Dice& dice) {
  SystemSpec& spec = one.systems.front();
  for (const ParameterInfo& p : findModel(spec.model)->parameters) {
    if (spec.parameters.count(p.name) == 0) {
      spec.parameters[p.name] = p.fallback ? *p.fallback : spec.parameters.at(p.fallback_parameter);
    }
  }
  for (const SettingInfo& setting : findModel(spec.model)->settings) {
    if (!setting.choices.empty()) {
      spec.settings.choices.try_emplace(setting.name, setting.choices.front());
    }
  }
  spec.name = "one";
  spec.tolerance = std::pow(10.0, -std::floor(dice.uniform(3.0, 10.0)));
  return one;
}

Scene randomScene(std::uint64_t number) {
  Dice dice(seedOr(kSeed) + 1000003 * number);
  switch (number % 8) {
    case 0:
      return withDefaults(friction(dice), dice);
    case 1:
      return withDefaults(tumbling(dice), dice);
    case 2:
      return withDefaults(runUp(dice), dice);
    default:
      return withDefaults(anyModel(dice), dice);
  }
}

void judge(const Scene& one, EvaluatedBounds& judged) {
  const SystemSpec& spec = one.systems.front();
  const StepChoice choice = chooseStep(one);
  const Sampling sampling(one, kSamples);
  const IndependentMotion truth =
      independentMotion(one, sampling.interval, sampling.samples, fullLength() ? 2.0e6 : 2.0e5);
  const ErrorCurve error(motion(withSetting(one, {choice.integrator, one.step, choice.substeps}),
                                sampling.interval, sampling.samples),
                         truth.trajectory);
  judged.judge(spec, choice.promise, sampling, error, truth.own);
}

TEST(RandomPromises, AreKept) {
  const auto scenes = static_cast<std::uint64_t>(runOf(100, 2000));
  EvaluatedBounds judged(kRounding);
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Scene one = randomScene(i);
    SCOPED_TRACE(fmt::format("scene {}: {}, step {:g} s, tolerance {:g}, horizon {:g} s", i,
                             one.systems.front().model, one.stepSeconds(),
                             one.systems.front().tolerance, one.systems.front().horizon));
    judge(one, judged);
  }
  judged.expectMost();
}

// Of rotors with films, rubs and cubic springs at their nodes, and of such on motors.
TEST(RandomPromises, OfShaftsWithElementsAreKept) {
  const auto scenes = static_cast<std::uint64_t>(runOf(4, 200));
  EvaluatedBounds judged(kRounding);
  for (std::uint64_t i = 0; i < scenes; ++i) {
    Dice dice(seedOr(kSeed) + 2000003 * i);
    Scene one = shaftWithElements(dice);
    one.systems.front().tolerance = std::pow(10.0, -std::floor(dice.uniform(3.0, 8.0)));
    SCOPED_TRACE(fmt::format("scene {}: step {:g} s, tolerance {:g}, horizon {:g} s", i,
                             one.stepSeconds(), one.systems.front().tolerance,
                             one.systems.front().horizon));
    judge(one, judged);
  }
  judged.expectMost();
}

}  // namespace random_promises_test
}  // namespace whirl_twin
