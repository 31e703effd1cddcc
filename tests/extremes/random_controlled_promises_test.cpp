// Error bounds of `integrator: auto` for random systems with a controller and inputs, checked
// against the same controllers with another method at steps eight and sixteen times as short: none
// is violated. Every model that has inputs, in each of its forms; samples at any ratio to the step,
// delays, limits, slew, noise and anti-alias filters; PID laws of either sign, so that some loops
// are unstable. The scenes come from one seed: the same on any machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/step_choice.h"
#include "accuracy/trajectory.h"
#include "accuracy/trajectory_error.h"
#include "controllers/controller_registry.h"
#include "dice.h"
#include "general_position.h"
#include "judged_promise.h"
#include "measured.h"
#include "models/model_registry.h"
#include "scene/model_context.h"
#include "scene/system_setup.h"

namespace whirl_twin {
namespace random_controlled_promises_test {

constexpr std::uint64_t kSeed = 15;
constexpr double kRounding = 1.0e-11;  // below, errors are indistinguishable
constexpr double kSamples = 200.0;
constexpr int kFiner = 8;

InputSignal anySignal(Dice& dice) {
  switch (dice.below(3)) {
    case 0: {
      const double amplitude = dice.uniform(-0.5, 0.5);
      return InputSignal::harmonic(amplitude, dice.anySize(0.5, 30.0), 0.3);
    }
    case 1:
      return InputSignal::constant(dice.uniform(-0.3, 0.3));
    default: {
      const std::vector<double> values = {0.0, dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5),
                                          0.0};
      return InputSignal::table({0, 100'000'007, 200'000'000, 300'000'000}, values,
                                dice.below(2) == 0);
    }
  }
}

ControllerSpec anyPid(const Dynamics& dynamics, std::size_t input, Dice& dice) {
  const ControllerInfo& pid = *findController("pid");
  ControllerSpec spec;
  spec.name = "law";
  spec.type = pid.name;
  spec.rate =
      dice.below(2) == 0 ? std::floor(dice.anySize(20.0, 2000.0)) : dice.anySize(20.0, 500.0);
  spec.delay = dice.below(3) == 0
                   ? 0
                   : static_cast<std::int64_t>(dice.uniform(0.0, 3.0) * 1.0e9 / spec.rate);
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  SignalSpec signal;
  signal.coordinate = dice.below(coordinates.size());
  signal.kind = dice.below(4) == 0 ? SignalSpec::Kind::kRate : SignalSpec::Kind::kCoordinate;
  signal.unit = coordinates[signal.coordinate].unit;
  spec.measures = {signal};
  spec.measured = {"one." + coordinates[signal.coordinate].name};
  spec.acts_on = {{0, input}};
  spec.acted_on = {"one." + dynamics.inputs()[input].name};
  if (dice.below(3) == 0) {
    spec.sensor.bandwidth = dice.anySize(0.2, 3.0) * spec.rate;
  }
  if (dice.below(3) == 0) {
    spec.sensor.noise = dice.anySize(1.0e-6, 1.0e-2);
  }
  if (dice.below(3) == 0) {
    spec.actuator.limit = dice.anySize(0.03, 3.0);
  }
  if (dice.below(4) == 0) {
    spec.actuator.slew = dice.anySize(0.3, 30.0);
  }
  for (const ParameterInfo& p : pid.parameters) {
    spec.parameters[p.name] = p.fallback.value_or(0.0);
  }
  spec.parameters["kp"] = (dice.below(4) == 0 ? -1.0 : 1.0) * dice.anySize(0.03, 3.0);
  spec.parameters["kd"] = dice.below(2) == 0 ? 0.0 : dice.anySize(0.01, 0.3);
  spec.parameters["ki"] = dice.below(2) == 0 ? 0.0 : dice.anySize(0.01, 1.0);
  spec.parameters["setpoint"] = dice.uniform(-0.3, 0.3);
  spec.parameters["tracking_time"] = 1.0;
  for (const SettingInfo& setting : pid.settings) {
    if (!setting.choices.empty()) {
      spec.settings.choices[setting.name] = setting.choices.front();
    }
  }
  return spec;
}

/// A system with inputs, one of them given by a controller, some of the others by signals.
Scene randomScene(std::uint64_t number) {
  static const std::vector<VariantUnderTest> variants = everyVariant();
  Dice dice(seedOr(kSeed) + 1000003 * number);
  while (true) {
    Scene one;
    one.name = "random";
    SystemSpec spec = inGeneralPosition({variants[dice.below(variants.size())], "auto"}, one);
    spec.name = "one";
    one.step = std::llround(dice.anySize(1.0e5, 1.0e7)) / 16 * 16;
    spec.horizon = dice.anySize(0.3, 5.0);
    spec.tolerance = std::pow(10.0, -std::floor(dice.uniform(3.0, 10.0)));
    for (const ParameterInfo& p : findModel(spec.model)->parameters) {
      if (spec.parameters.count(p.name) == 0) {
        spec.parameters[p.name] =
            p.fallback ? *p.fallback : spec.parameters.at(p.fallback_parameter);
      }
    }
    try {
      const SystemSetup setup = setupOf(spec, surroundingsOf(one, spec));
      const Dynamics& dynamics = *setup.made.dynamics;
      const std::vector<InputInfo> inputs = dynamics.inputs();
      if (inputs.empty()) {
        continue;
      }
      spec.q.resize(static_cast<std::size_t>(dynamics.dof()), 0.5);
      spec.v.resize(static_cast<std::size_t>(dynamics.dof()), 0.1);
      const std::size_t acted = dice.below(inputs.size());
      spec.inputs[inputs[acted].name] = InputSignal::controlled();
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (i != acted && dice.below(2) == 0) {
          spec.inputs[inputs[i].name] = anySignal(dice);
        }
      }
      one.controllers = {anyPid(dynamics, acted, dice)};
    } catch (const std::exception&) {  // numbers that do not fit together
      continue;
    }
    one.systems = {spec};
    return one;
  }
}

/// The same by steps so many times as short, by a method of another kind.
Trajectory finer(const Scene& one, const StepChoice& choice, int times, std::int64_t interval,
                 std::size_t samples) {
  const bool implicit = choice.integrator != "gauss_legendre_6";
  return motion(withSetting(one, {implicit ? "gauss_legendre_6" : "dormand_prince_8",
                                  one.step / times, choice.substeps}),
                interval, samples);
}

void judge(const Scene& one, EvaluatedBounds& judged) {
  const SystemSpec& spec = one.systems.front();
  const StepChoice choice = chooseStep(one);
  const Sampling sampling(one, kSamples);
  const auto [interval, samples] = std::pair(sampling.interval, sampling.samples);
  const Trajectory truth = finer(one, choice, 2 * kFiner, interval, samples);
  const ErrorCurve own(finer(one, choice, kFiner, interval, samples), truth);
  const ErrorCurve error(
      motion(withSetting(one, {choice.integrator, one.step, choice.substeps}), interval, samples),
      truth);
  ASSERT_GT(own.samples(), 0u);
  judged.judge(spec, choice.promise, sampling, error, own);
}

TEST(RandomControlledPromises, AreKept) {
  const auto scenes = static_cast<std::uint64_t>(runOf(20, 200));
  EvaluatedBounds judged(kRounding);
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Scene one = randomScene(i);
    SCOPED_TRACE(
        fmt::format("scene {}: {}, step {:g} s, tolerance {:g}, horizon {:g} s, {:g} Hz, {} ns "
                    "late, {} on {}, pole {:g} Hz",
                    i, one.systems.front().model, one.stepSeconds(), one.systems.front().tolerance,
                    one.systems.front().horizon, one.controllers[0].rate, one.controllers[0].delay,
                    one.controllers[0].measured[0], one.controllers[0].acted_on[0],
                    one.controllers[0].sensor.bandwidth));
    judge(one, judged);
  }
  judged.expectMost();
}

}  // namespace random_controlled_promises_test
}  // namespace whirl_twin
