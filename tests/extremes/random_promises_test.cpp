// What `integrator: auto` promises of random systems, judged by a method of another kind
// (independent_motion.h): none is promised falsely. Every model in each of its forms, at steps from
// a tenth of a millisecond to a second; and the hardest: narrow dry friction, chaotic pendulums,
// run-ups of linear rotors at coarse steps. The scenes come from one seed: the same on any machine.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../accuracy/independent_motion.h"
#include "accuracy/step_choice.h"
#include "dice.h"
#include "general_position.h"
#include "measured.h"
#include "models/model_registry.h"
#include "scene/surroundings.h"
#include "scene/system_setup.h"

namespace whirl_twin {
namespace {

constexpr std::uint64_t kSeed = 12;    // or WHIRL_TWIN_SEED of the environment: other scenes
constexpr double kRounding = 1.0e-12;  // below, errors are not told apart
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
      // How many coordinates a rotor is reduced to depends on its numbers.
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

/// How many promises could be judged, and over what part of the time.
struct Judged {
  int scenes = 0;
  int kept = 0;
  int whole = 0;
};

void judge(const Scene& one, Judged& judged) {
  const SystemSpec& spec = one.systems.front();
  const StepChoice choice = chooseStep(one);
  const Promise& p = choice.promise;
  const auto steps =
      std::max<std::int64_t>(1, std::llround(std::ceil(spec.horizon / one.stepSeconds() - 1e-6)));
  const auto stride =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<double>(steps) / kSamples));
  const auto samples = static_cast<std::size_t>(steps / stride) + 1;
  const IndependentMotion truth =
      independentMotion(one, stride * one.step, samples, fullLength() ? 2.0e6 : 2.0e5);
  const ErrorCurve error(motion(withSetting(one, {choice.integrator, one.step, choice.substeps}),
                                stride * one.step, samples),
                         truth.trajectory);
  const auto sampleAt = [&](double time) {
    return static_cast<std::size_t>(std::floor(time / truth.trajectory.interval + 1.0e-9));
  };
  // As far as the judge itself is good: there, not at some later time when all have parted.
  const auto isKnown = [&](std::size_t sample) {
    return truth.own.position(sample) <= 0.1 * std::max(spec.tolerance, error.position(sample));
  };
  const auto lastKnown = [&](double time) {
    std::size_t last = std::min(truth.own.samples() - 1, sampleAt(time));
    while (last > 0 && !isKnown(last)) {
      --last;
    }
    return last;
  };
  ++judged.scenes;
  judged.kept += p.kept ? 1 : 0;
  judged.whole += isKnown(samples - 1) ? 1 : 0;
  const std::size_t kept = lastKnown(p.kept_until);
  EXPECT_LE(error.position(kept), 2.0 * spec.tolerance + kRounding)
      << "not kept until " << p.kept_until << " s";
  const std::size_t known = lastKnown(p.known_until);
  EXPECT_GE(5.0 * p.error + 2.0 * truth.own.position(known) + kRounding, error.position(known))
      << "its error is larger, until " << p.known_until << " s";
}

TEST(RandomPromises, AreKept) {
  const auto scenes = static_cast<std::uint64_t>(runOf(100, 2000));
  Judged judged;
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Scene one = randomScene(i);
    SCOPED_TRACE(fmt::format("scene {}: {}, step {:g} s, tolerance {:g}, horizon {:g} s", i,
                             one.systems.front().model, one.stepSeconds(),
                             one.systems.front().tolerance, one.systems.front().horizon));
    judge(one, judged);
  }
  fmt::print("[ MEASURED ] of {} scenes {} are promised, {} could be judged to the end\n",
             judged.scenes, judged.kept, judged.whole);
  EXPECT_GT(judged.kept, judged.scenes / 2);
  EXPECT_GT(judged.whole, judged.scenes / 2);
}

}  // namespace
}  // namespace whirl_twin
