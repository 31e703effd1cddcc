#include "accuracy/step_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "accuracy/step_search.h"
#include "algebra/constants.h"
#include "integration/step_methods.h"
#include "models/model_registry.h"
#include "realtime/denormals.h"
#include "scene/built_scene.h"
#include "scene/control_parts.h"
#include "scene/drive_reader.h"
#include "scene/scene_error.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxCalibrations = 32;
constexpr double kHorizons = 3.0;      // evaluated ahead, without a profile
constexpr double kMaxHorizons = 16.0;  // and on as long as the estimate grows
constexpr double kStillGrows = 1.2;    // from one horizon to the next
constexpr double kLookBudget = 4.0e6;  // evaluations, for that
constexpr int kRounds = 4;
constexpr int kMaxRaised = 16;  // times the substeps, where nothing is promised
constexpr std::int64_t kLook = 64;
constexpr double kFastRate = 1.0e3;  // [m/s] or [rad/s]
constexpr double kLengthsOfParts = 36.0;
/// Coordinates of a rotor whose steps are tables over speed, and of one at a constant speed, that
/// is still calibrated.
constexpr Eigen::Index kMaxInTables = 64;
constexpr Eigen::Index kMaxAtOneSpeed = 200;

/// Rates enter the forces: in the matrices at the start, or in what friction does at rates large
/// and small. (A motion far from there may differ, and is what the calibration is for.)
bool hasRateForces(const ModelSetup& setup, const SystemSpec& spec) {
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  const Dynamics& dynamics = *setup.dynamics;
  const EvaluationPoint<double> at{0.0, 0.0, spec.speed.value_or(1.0), 0.0};
  const Eigen::VectorXd q = vector(spec.q);
  const Eigen::VectorXd v = vector(spec.v);
  const Linearization l = dynamics.linearization(q, v, dynamics.acceleration(q, v, at), at);
  const Eigen::VectorXd rates = Eigen::VectorXd::Constant(v.size(), kFastRate);
  return (l.damping.array() != 0.0).any() || (l.gyroscopic.array() != 0.0).any() ||
         dynamics.appliedForce(q, rates, at) != dynamics.appliedForce(q, -rates, at);
}

/// Whether its steps, with speed-dependent matrices, are too expensive to prepare for a dozen
/// settings. The cost grows with the cube of the number of coordinates and with the number of
/// distinct sub-step lengths: at the steps of a reference those never recur.
bool dearToPrepare(const Scene& one, const ModelSetup& setup) {
  const bool over_speed =
      !one.drives.empty() && (!one.drives.front().profile.empty() || one.drives.front().motor);
  const double lengths = one.controllers.empty() ? 1.0 : kLengthsOfParts;
  return setup.integrators.size() == 1 && setup.dynamics->isRotor() &&
         std::cbrt(lengths) * setup.dynamics->dof() > (over_speed ? kMaxInTables : kMaxAtOneSpeed);
}

/// What a converter rounds comes out another step of it where the motion differs by rounding only:
/// two trajectories of a loop with such a converter part, whatever the method.
bool roundsInItsLoop(const Scene& one) {
  return std::any_of(one.controllers.begin(), one.controllers.end(), [](const ControllerSpec& c) {
    return c.sensor.resolution > 0.0 || c.actuator.resolution > 0.0;
  });
}

std::string reasonFor(const StepChoice& choice, const SystemSpec& spec) {
  const ErrorBound& p = choice.promise;
  if (p.kept) {
    return fmt::format("error {:.1g}, uncertainty {:.1g}, over {:g} s, tolerance {:g}{}", p.error,
                       p.reference_error, spec.horizon, spec.tolerance,
                       choice.raised ? "; the later motion needs shorter steps" : "");
  }
  const bool known = p.known_until >= spec.horizon;
  std::string said = p.kept_until > 0.0 ? fmt::format("within {:g} until t = {:.3g} s",
                                                      spec.tolerance, p.kept_until)
                                        : fmt::format("tolerance {:g} not reached", spec.tolerance);
  if (p.known_until > p.kept_until) {
    said += std::isfinite(p.error)
                ? fmt::format(", error {:.1g} over {:.3g} s", p.error, p.known_until)
                : fmt::format(", not resolved by any step over {:.3g} s", p.known_until);
  }
  return "best choice: " + said +
         (known ? "" : fmt::format("; unknown after {:.3g} s", p.known_until)) +
         (choice.raised ? "; the later motion needs shorter steps" : "");
}

/// The largest error over a horizon that the twin would estimate of itself (observer.h), or the
/// largest residual of its energy in two records running, if that is larger: few of the sampled
/// steps meet a contact, which the residual shows. Over `steps`, and on up to `most` as long as the
/// estimate grows from one horizon to the next.
double largestEstimate(const Scene& one, const StepChoice& choice, std::int64_t steps,
                       std::int64_t most) {
  const DenormalsToZero denormals_to_zero;
  Twin twin(withSetting(one, settingOf(one, choice)));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  const auto horizon =
      static_cast<std::int64_t>(std::ceil(one.systems.front().horizon / one.stepSeconds()));
  double largest = 0.0;
  double horizon_ago = 0.0;
  double residual_before = 0.0;
  for (std::int64_t i = 1; i <= steps; ++i) {
    twin.step();
    if (i % kLook == 0 || i == steps) {
      twin.write(record.data());
      observer.observe(record.data());
      const double residual = std::fabs(observer.energyResidual(0));
      largest = std::max({largest, observer.errorEstimate(0), std::min(residual, residual_before)});
      residual_before = residual;
    }
    if (i == steps && steps < most && observer.errorEstimate(0) > kStillGrows * horizon_ago) {
      steps = std::min(most, steps + horizon);
    }
    if (i % horizon == 0) {
      horizon_ago = observer.errorEstimate(0);
    }
  }
  return twin.status(0) == StepStatus::kOk ? largest : kInfinity;
}

/// With as many substeps as the motion after the horizon needs: through the drive's profile, or a
/// few horizons, as far as the budget goes. Where nothing is promised, only if that many keep the
/// estimate within the tolerance.
StepChoice lasting(const Scene& one, const ModelSetup& setup, const StepChoice& given) {
  StepChoice choice = given;
  bool keeps = false;
  const SystemSpec& spec = one.systems.front();
  const double later = one.drives.empty() ? 0.0 : profileDuration(one.drives.front());
  const double horizons = spec.horizon / one.stepSeconds();
  const double steps = std::max(later / one.stepSeconds(), kHorizons * horizons);
  const StepMethod& method = stepMethod(choice.integrator);
  for (int round = 0; round < kRounds; ++round) {
    EvaluationBudget budget(kLookBudget, one, setup);
    const double affordable = kLookBudget / budget.cost(settingOf(one, choice), one.step, 1);
    const auto within = [&](double count) {
      return static_cast<std::int64_t>(std::max(1.0, std::min(count, affordable)));
    };
    const double estimate = largestEstimate(one, choice, within(steps),
                                            within(std::max(steps, kMaxHorizons * horizons)));
    keeps = !(estimate > spec.tolerance);
    if (keeps) {
      break;
    }
    if (method.ahead) {
      choice.raised = true;  // the caller then excludes multistep methods
      break;
    }
    const int more = doublings(std::min(estimate / spec.tolerance, 1.0e6), method.order);
    if (choice.substeps > mostSubsteps(one) >> more) {
      break;
    }
    choice.substeps <<= more;
    choice.raised = true;
  }
  const bool promised = given.promise.kept;
  return promised || (keeps && choice.substeps <= kMaxRaised * given.substeps) ? choice : given;
}

struct Searched {
  StepChoice best;
  StepChoice without_past;  ///< the best of the methods whose steps rest on nothing but the state
};

Searched searched(const Scene& one, const ModelSetup& setup, StepJudge& judge) {
  const SystemSpec& spec = one.systems.front();
  const bool on_drive = spec.drive.has_value();
  const IntegratorChoice structural = chooseIntegrator(setup, on_drive);
  StepSearch search(one, setup, judge);
  if (structural.integrator == kExactMethod || setup.integrators.size() == 1) {
    search.tryMethod(stepMethod(structural.integrator));
    return {search.best(), search.best()};
  }
  const bool rate_forces = hasRateForces(setup, spec);
  search.tryMethod(stepMethod(kReferenceMethod));
  if (search.found() && !judge.knowsMuch()) {
    return {search.best(), search.best()};  // the robust choice, as the future input is unknown
  }
  const auto tryThose = [&](bool with_past) {
    for (const StepMethod& method : stepMethods()) {
      if ((method.past > 0) == with_past && method.order != 0 && method.name != kReferenceMethod &&
          !(method.predicts_rates && rate_forces) && !method.ahead && !method.by_name &&
          canStepWith(setup, on_drive, method.name)) {
        search.tryMethod(method);
      }
    }
  };
  tryThose(false);
  const StepChoice without_past = search.best();
  tryThose(true);
  if (one.controllers.empty()) {
    for (const StepMethod& method : stepMethods()) {
      if (method.ahead && canStepWith(setup, on_drive, method.name)) {
        search.tryAhead(method);
      }
    }
  }
  return {search.best(), without_past};
}

}  // namespace

StepChoice chooseStep(const Scene& given, double evaluations) {
  const BuiltScene built = build(given);
  const Scene& one = built.scene;  // with its setup, which the runs take from there
  const SystemSpec& spec = one.systems.front();
  const ModelSetup& setup = built.systems.front()->setup();
  const IntegratorChoice structural = chooseIntegrator(setup, spec.drive.has_value());
  EvaluationBudget budget(evaluations, one, setup);
  if (evaluations <= 0.0 || dearToPrepare(one, setup) || roundsInItsLoop(one)) {
    StepChoice plain;
    plain.integrator = structural.integrator;
    plain.substeps = spec.substeps;
    plain.reason = structural.reason + "; not calibrated: " +
                   (evaluations <= 0.0     ? "too many systems"
                    : roundsInItsLoop(one) ? "its controllers quantize"
                                           : "its steps take long to prepare");
    return plain;
  }
  StepJudge judge(one, setup, budget);
  const Searched found = searched(one, setup, judge);
  const auto withPromise = [&](StepChoice of) {
    of.promise = judge.promise(settingOf(one, of));
    const StepChoice longer = lasting(one, setup, of);
    if (longer.raised) {
      of = longer;
      of.promise = judge.promise(settingOf(one, of));
    }
    return of;
  };
  StepChoice choice = withPromise(found.best);
  if (stepMethod(choice.integrator).past > 0 && (choice.raised || !choice.promise.kept)) {
    choice = withPromise(found.without_past);  // the future motion differs from the calibrated one
  }
  choice.reason = reasonFor(choice, spec);
  if (choice.integrator == kExactMethod && stepsAreExact(one, setup)) {
    choice.reason = structural.reason + "; " + choice.reason;
  }
  return choice;
}

StepChoice judgeStep(const Scene& given, double evaluations) {
  const BuiltScene built = build(given);
  EvaluationBudget budget(evaluations, built.scene, built.systems.front()->setup());
  StepChoice named;
  named.integrator = built.systems.front()->integrator;
  named.substeps = built.scene.systems.front().substeps;
  if (evaluations > 0.0 && !roundsInItsLoop(built.scene) &&
      !dearToPrepare(built.scene, built.systems.front()->setup())) {
    StepJudge judge(built.scene, built.systems.front()->setup(), budget);
    named.promise = judge.promise(settingOf(built.scene, named));
  }
  return named;
}

std::vector<StepChoice> chooseSteps(const Scene& scene, bool judge_named) {
  const Scene whole = build(scene).scene;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (scene.systems[i].integrator == "auto" || judge_named) {
      open.push_back(i);
    }
  }
  const double budget =
      open.size() <= kMaxCalibrations ? kCalibrationBudget / static_cast<double>(open.size()) : 0.0;
  std::vector<StepChoice> choices(scene.systems.size());
  for (const std::size_t i : open) {
    const Scene one = sceneOfOne(whole, i);
    const double left = isTiedToOthers(whole, i) ? 0.0 : budget;  // alone it moves otherwise
    choices[i] =
        scene.systems[i].integrator == "auto" ? chooseStep(one, left) : judgeStep(one, left);
  }
  return choices;
}

Scene withSteps(const Scene& scene, const std::vector<StepChoice>& choices) {
  Scene chosen = build(scene).scene;
  for (std::size_t i = 0; i < chosen.systems.size(); ++i) {
    if (chosen.systems[i].integrator == "auto") {
      chosen.systems[i].chosen_integrator = choices[i].integrator;
      chosen.systems[i].substeps = choices[i].substeps;
      chosen.systems[i].choice_reason = choices[i].reason;
    }
  }
  return chosen;
}

Scene withStepsChosen(const Scene& scene) {
  return withSteps(scene, chooseSteps(scene));
}

}  // namespace whirl_twin
