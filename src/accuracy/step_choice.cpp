#include "accuracy/step_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "accuracy/reference_trajectory.h"
#include "integration/step_methods.h"
#include "models/model_registry.h"
#include "realtime/denormals.h"
#include "scene/drive_profile.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMostCalibrations = 32;
constexpr double kSafety = 4.0;  // the error aimed at is so much below the tolerance
constexpr int kMostSubsteps = 64;
constexpr double kHorizons = 3.0;  // looked ahead, without a profile
constexpr int kRounds = 2;
constexpr std::int64_t kLook = 64;
constexpr int kMostReferenceSubsteps = 8;
constexpr std::int64_t kSamples = 128;
/// Evaluations that a step of the twin takes in a calibration: the reference's two runs and a
/// method or two. A system that is not smooth takes a few times that.
constexpr double kEvaluationsPerStep = 60.0;
/// A method that is not symplectic has to be this much cheaper than gauss_legendre_6.
constexpr double kWorthwhile = 0.7;
const char* const kReference = "gauss_legendre_6";
const char* const kExact = "exponential";
/// What a run-up by the table over speed leaves out at steps that a scene may well have.
constexpr double kTableError = 1.0e-7;
/// From a calibration's end to the horizon's; far beyond what any method keeps, and no infinity: at
/// rest the error is 0 over any horizon.
constexpr double kMostGrowth = 1.0e100;
constexpr double kMostDoublings = 16.0;  // of the substeps at once

struct Calibration {
  const Scene& one;
  std::int64_t interval = 0;  // [ns]
  std::int64_t duration = 0;  // [ns]
  bool whole = true;          // to the horizon
  double growth = 1.0;        // of the error from the calibration's end to the horizon's
};

/// Accelerations cost as the square of the coordinates, two of them what the budget counts in.
double sizeOf(const SystemSpec& spec) {
  const double pairs = std::max(1.0, 0.5 * static_cast<double>(spec.q.size()));
  return pairs * pairs;
}

Calibration calibration(const Scene& one, double budget) {
  const double steps = one.systems.front().horizon / one.stepSeconds();
  const double affordable = budget / (kEvaluationsPerStep * sizeOf(one.systems.front()));
  Calibration c{one};
  c.whole = steps <= affordable;
  const auto whole =
      std::max<std::int64_t>(8, static_cast<std::int64_t>(std::min(steps, affordable)));
  c.interval = std::max<std::int64_t>(2, whole / kSamples / 2 * 2) * one.step;
  c.duration =
      std::max<std::int64_t>(1, (whole * one.step + c.interval - 1) / c.interval) * c.interval;
  // The phase of a motion whose energy drifts goes with the square of the time.
  const double covered = static_cast<double>(c.duration) / static_cast<double>(one.step);
  c.growth = std::clamp(std::pow(steps / covered, 2), 1.0, kMostGrowth);
  return c;
}

/// What settings are judged by.
struct Judge {
  const Calibration& c;
  ReferenceTrajectory reference;
  std::size_t samples = 0;  // compared
  double allowed = 0.0;     // error at the horizon

  double errorOf(const Trajectory& t) const {
    return c.growth * trajectoryError(t, reference.trajectory, samples).position;
  }
  double errorOf(const StepSetting& setting) const {
    return errorOf(trajectory(withSetting(c.one, setting), c.duration, c.interval));
  }
};

/// A motion that magnifies rounding is judged as far as it can be; where no step resolves it, any
/// method is good that does as well as the reference.
Judge judge(const Calibration& c, const std::string& integrator, double wanted) {
  const int substeps = c.one.systems.front().substeps;
  Judge j{c, referenceTrajectory(c.one, integrator, c.duration, c.interval, 0.1 * wanted / c.growth,
                                 kMostReferenceSubsteps * substeps)};
  const std::size_t all = j.reference.trajectory.samples();
  j.samples = j.reference.samplesWithin(0.5 * wanted / c.growth);
  j.allowed = wanted;
  if (j.samples < all / 4) {
    j.samples = all;
    j.allowed = std::max(wanted, 2.0 * c.growth * j.reference.error);
  }
  return j;
}

/// Rates enter the forces (the matrices at the start; a motion far from there may differ, and is
/// what the calibration is for).
bool hasRateForces(const ModelSetup& setup, const SystemSpec& spec) {
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  const Moment<double> at{0.0, 0.0, spec.speed.value_or(1.0), 0.0};
  const Eigen::VectorXd q = vector(spec.q);
  const Eigen::VectorXd v = vector(spec.v);
  const Linearization l =
      setup.dynamics->linearization(q, v, setup.dynamics->acceleration(q, v, at), at);
  return (l.damping.array() != 0.0).any() || (l.gyroscopic.array() != 0.0).any();
}

/// An explicit method near its limit of stability is no choice: it must be sound at twice the step.
bool soundAtTwiceTheStep(const Judge& judge, const StepSetting& setting, const StepMethod& method,
                         double error) {
  StepSetting twice = setting;
  twice.step *= 2;
  return judge.errorOf(twice) <= std::pow(2.0, method.order + 3) * error + 1.0e-12;
}

/// How often the substeps have to be doubled for an error so many times the one allowed, believed
/// up to `most`: beyond it, or where it is no number, it only says that the motion was lost.
int doublings(double times, double most, int order) {
  const double missing = std::ceil(std::log2(times < most ? times : most) / order);
  return static_cast<int>(std::clamp(missing, 1.0, kMostDoublings));
}

double cost(const StepChoice& choice) {
  return choice.substeps * stepMethod(choice.integrator).evaluations;
}

std::string reasonFor(const StepChoice& choice, const SystemSpec& spec, const Calibration& c) {
  const std::string where =
      c.whole ? ""
              : fmt::format(", from its first {:.3g} s", 1.0e-9 * static_cast<double>(c.duration));
  if (choice.until < spec.horizon) {
    return fmt::format("the best here: keeps {:g} until t = {:.3g} s{}; beyond, no step does",
                       spec.tolerance, choice.until, where);
  }
  if (!std::isfinite(choice.error)) {
    return fmt::format("the best here: no step resolves its motion over {:g} s{}", spec.horizon,
                       where);
  }
  if (!(choice.error <= spec.tolerance)) {
    return fmt::format("the best here: error {:.1g} over {:g} s{}, above the tolerance {:g}",
                       choice.error, spec.horizon, where, spec.tolerance);
  }
  return fmt::format("error {:.1g} over {:g} s where {:g} is allowed{}{}", choice.error,
                     spec.horizon, spec.tolerance, where,
                     choice.raised ? "; its later motion needs shorter steps" : "");
}

/// The coarsest step of the reference's own method that is good enough, or its finest.
StepChoice ofReference(const Judge& j) {
  const ReferenceTrajectory& reference = j.reference;
  StepChoice best;
  best.integrator = reference.setting.integrator;
  best.substeps = reference.setting.substeps;
  best.error = j.c.growth * reference.error;
  for (auto coarser = reference.coarser.rbegin(); coarser != reference.coarser.rend(); ++coarser) {
    const double error = j.errorOf(coarser->second);
    if (error > j.allowed) {
      break;
    }
    best.substeps = coarser->first;
    best.error = error + j.c.growth * reference.error;
  }
  best.until = best.calibrated = j.c.one.systems.front().horizon;
  if (!j.c.whole) {
    best.calibrated = 1.0e-9 * static_cast<double>(j.c.duration);
  }
  if (j.samples < reference.trajectory.samples()) {
    best.until = reference.trajectory.interval * static_cast<double>(j.samples - 1);
  }
  return best;
}

/// Largest error over a horizon that the twin would see in itself (observer.h) in so many steps.
double largestEstimate(const Scene& one, const StepChoice& choice, std::int64_t steps) {
  const DenormalsToZero denormals_to_zero;
  Twin twin(withSetting(one, {choice.integrator, one.step, choice.substeps}));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  double largest = 0.0;
  for (std::int64_t i = 1; i <= steps; ++i) {
    twin.step();
    if (i % kLook == 0 || i == steps) {
      twin.write(record.data());
      observer.observe(record.data());
      largest = std::max(largest, observer.errorEstimate(0));
    }
  }
  return twin.status(0) == StepStatus::kOk ? largest : std::numeric_limits<double>::infinity();
}

/// With as many substeps as the motion after the horizon needs: through the drive's profile, or a
/// few horizons, as far as the budget goes.
StepChoice lasting(const Scene& one, StepChoice choice, double budget) {
  const SystemSpec& spec = one.systems.front();
  const double later = one.drives.empty() ? 0.0 : profileDuration(one.drives.front());
  const double steps = std::max(later, kHorizons * spec.horizon) / one.stepSeconds();
  const StepMethod& method = stepMethod(choice.integrator);
  for (int round = 0; round < kRounds; ++round) {
    const double affordable = budget / (cost(choice) * sizeOf(spec));
    const double estimate = largestEstimate(
        one, choice, static_cast<std::int64_t>(std::max(1.0, std::min(steps, affordable))));
    if (!(estimate > spec.tolerance)) {
      break;
    }
    const int more = doublings(estimate / spec.tolerance, 1.0e6, method.order);
    if (choice.substeps > kMostSubsteps >> more) {
      break;
    }
    choice.substeps <<= more;
    choice.raised = true;
  }
  return choice;
}

/// The cheapest of the methods that a nonlinear system has.
StepChoice calibrated(const Scene& one, const ModelSetup& setup, const Calibration& c,
                      double budget) {
  const SystemSpec& spec = one.systems.front();
  const Judge j = judge(c, kReference, spec.tolerance / kSafety);
  StepChoice best = ofReference(j);
  const StepChoice reference = best;
  const double implicit_cost = cost(best);
  const bool rate_forces = hasRateForces(setup, spec);
  for (const StepMethod& method : stepMethods()) {
    if (method.order == 0 || method.name == kReference || (method.predicts_rates && rate_forces) ||
        !canStepWith(setup, spec.drive.has_value(), method.name)) {
      continue;
    }
    StepChoice choice = best;
    choice.integrator = method.name;
    choice.substeps = spec.substeps;
    while (choice.substeps <= kMostSubsteps && cost(choice) < cost(best) &&
           (method.symplectic || cost(choice) < kWorthwhile * implicit_cost)) {
      const StepSetting setting{choice.integrator, one.step, choice.substeps};
      choice.error = j.errorOf(setting);
      if (choice.error <= j.allowed) {
        if (method.implicit || soundAtTwiceTheStep(j, setting, method, choice.error)) {
          best = choice;
          best.error += c.growth * j.reference.error;
        }
        break;
      }
      choice.substeps <<= doublings(choice.error / j.allowed, 1.0e12, method.order);
    }
  }
  best = lasting(one, best, 0.5 * budget);
  if (best.raised && best.integrator != kReference) {
    const StepChoice other = lasting(one, reference, 0.5 * budget);
    best = cost(other) < cost(best) ? other : best;
  }
  return best;
}

}  // namespace

StepChoice chooseStep(const Scene& given, double budget) {
  const BuiltScene built = build(given);
  const Scene& one = built.scene;  // with its setup, which the runs take from there
  const SystemSpec& spec = one.systems.front();
  const ModelSetup& setup = built.systems.front()->setup();
  const IntegratorChoice structural = chooseIntegrator(setup, spec.drive.has_value());
  const bool exponential = structural.integrator == kExact;
  const bool table = exponential && spec.drive && setup.dynamics->speedDependent();
  if (budget <= 0.0 || (exponential && !(table && spec.tolerance < kTableError)) ||
      (!exponential && setup.integrators.size() == 1)) {
    StepChoice plain;
    plain.integrator = structural.integrator;
    plain.substeps = spec.substeps;
    plain.until = plain.calibrated = spec.horizon;
    plain.reason = structural.reason;
    return plain;
  }
  const Calibration c = calibration(one, budget);
  StepChoice choice = exponential ? ofReference(judge(c, kExact, spec.tolerance / kSafety))
                                  : calibrated(one, setup, c, budget);
  choice.reason = reasonFor(choice, spec, c);
  return choice;
}

Scene withStepsChosen(const Scene& scene) {
  Scene chosen = build(scene).scene;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (scene.systems[i].integrator == "auto") {
      open.push_back(i);
    }
  }
  const double budget = open.size() <= kMostCalibrations
                            ? kCalibrationBudget / static_cast<double>(open.size())
                            : 0.0;
  for (const std::size_t i : open) {
    const StepChoice choice = chooseStep(sceneOfOne(chosen, i), budget);
    chosen.systems[i].chosen_integrator = choice.integrator;
    chosen.systems[i].substeps = choice.substeps;
    chosen.systems[i].choice_reason = choice.reason;
  }
  return chosen;
}

}  // namespace whirl_twin
