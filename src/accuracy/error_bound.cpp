#include "accuracy/error_bound.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "integration/step_methods.h"
#include "models/model_registry.h"

namespace whirl_twin {

namespace {

constexpr double kSafety = 4.0;           // the error aimed at is so much below the tolerance
constexpr double kReferenceMargin = 8.0;  // the reference's own is so much below
constexpr double kKnown = 2.0;            // minimum ratio to the tolerance or to the error that it
                                          // bounds
constexpr double kReferencePart = 0.6;    // of the budget
constexpr double kExactBudget = 2.0e6;    // evaluations: what their rounding does, it does soon
constexpr double kMaxSamples = 16384.0;
/// Of accelerations, that a step of the twin takes of a reference at its coarsest, and of one by
/// exact steps.
constexpr double kEvaluations = 100.0;
constexpr double kExactEvaluations = 5.0;

/// Whether it uses the exact step of its linear part.
bool byExactLinearPart(const Scene& one, const ModelSetup& setup) {
  return setup.integrators.size() == 1 ||
         (!setup.dynamics->linear() &&
          chooseIntegrator(setup, one.systems.front().drive.has_value()).integrator ==
              kExactMethod);
}

}  // namespace

bool stepsAreExact(const Scene& one, const ModelSetup& setup) {
  const bool on_drive = one.systems.front().drive.has_value();
  return setup.dynamics->linear() && chooseIntegrator(setup, on_drive).integrator == kExactMethod &&
         (one.drives.empty() || one.drives.front().profile.empty());
}

ReferenceTrajectory referenceOf(const Scene& one, const ModelSetup& setup, std::int64_t interval,
                                std::size_t samples, double wanted, EvaluationBudget& budget) {
  const bool on_drive = one.systems.front().drive.has_value();
  const std::string own = chooseIntegrator(setup, on_drive).integrator;
  std::vector<std::string> others;
  for (const char* name : {"dormand_prince_8", "gauss_legendre_6", "gauss_legendre_4"}) {
    if (!stepsAreExact(one, setup) && !byExactLinearPart(one, setup) &&
        canStepWith(setup, on_drive, name) && name != own && others.size() < 2) {
      others.push_back(name);
    }
  }
  if (others.empty()) {
    others = {own};
  }
  return referenceTrajectory(one, own, others, !setup.dynamics->linear(), interval, samples, wanted,
                             budget);
}

StepJudge::StepJudge(const Scene& one, const ModelSetup& setup, EvaluationBudget& budget)
    : one_(one), budget_(budget), exact_(stepsAreExact(one, setup)) {
  const SystemSpec& spec = one.systems.front();
  EvaluationBudget part = budget.upTo(exact_ ? kExactBudget : kReferencePart * budget.left());
  const double before = part.left();
  const double steps = std::max(1.0, std::ceil(spec.horizon / one.stepSeconds() - 1.0e-6));
  const bool by_itself = byExactLinearPart(one, setup);
  const double evaluations = exact_ || by_itself ? kExactEvaluations : kEvaluations;
  const double affordable =
      before / (evaluations * budget.cost({kExactMethod, one.step, ownSubsteps(one)}, one.step, 1));
  const double seen = std::min(steps, std::max(affordable, 8.0));
  std::int64_t stride = 1;
  while (seen / static_cast<double>(stride) > kMaxSamples) {
    stride *= 2;
  }
  interval_ = stride * one.step;
  samples_ = 1.0 + std::ceil(steps / static_cast<double>(stride));
  const double asked = std::min(samples_, 1.0 + std::ceil(seen / static_cast<double>(stride)));
  reference_ = referenceOf(one, setup, interval_, static_cast<std::size_t>(asked),
                           spec.tolerance / kReferenceMargin, part);
  budget.take(before - part.left());
  known_ = reference_.lastWithin(spec.tolerance / kReferenceMargin);
  followed_ = reference_.lastWithin(kDivergedDistance);
}

double StepJudge::seconds(std::size_t sample) const {
  return std::min(one_.systems.front().horizon,
                  1.0e-9 * static_cast<double>(interval_) * static_cast<double>(sample));
}

double StepJudge::excessOf(const StepSetting& setting, std::int64_t interval) {
  const auto ratio = static_cast<std::size_t>(interval / interval_);
  const std::size_t samples = followed_ / ratio + 1;
  if (!budget_.take(budget_.cost(setting, interval, samples))) {
    return kInfinity;
  }
  ErrorCurve curve;
  const Trajectory t =
      motion(withSetting(one_, setting), interval, samples, [&](const Trajectory& now) {
        return curve.take(now, reference_.trajectory) &&
               curve.position(curve.samples() - 1) < 10.0 * kDivergedDistance;
      });
  const double aim = one_.systems.front().tolerance / kSafety;
  const double error = curve.position(known_ / ratio) / aim;
  const double later =
      curve.position(followed_ / ratio) / std::max(aim, reference_.error(followed_));
  return std::max(error, later);
}

double StepJudge::excess(const StepSetting& setting) {
  return excessOf(setting, interval_);
}

double StepJudge::excessAtLongerSteps(const StepSetting& setting, int times) {
  StepSetting longer = setting;
  longer.step *= times;
  return excessOf(longer, std::max(interval_, longer.step));
}

double StepJudge::knownSteps(const StepSetting& setting) const {
  return static_cast<double>(known_) * static_cast<double>(interval_) /
         static_cast<double>(setting.step) *
         stepMethod(setting.integrator).stepsFor(setting.substeps);
}

ErrorBound StepJudge::promise(const StepSetting& setting) {
  const SystemSpec& spec = one_.systems.front();
  const std::size_t samples = reference_.trajectory.samples();
  const ErrorCurve curve(motion(withSetting(one_, setting), interval_, samples),
                         reference_.trajectory);
  const auto error = [&](std::size_t sample) {
    return curve.position(sample) + reference_.error(sample);
  };
  if (curve.samples() == 0) {
    return {};  // it cannot even start
  }
  std::size_t known = curve.samples() - 1;  // what stops is known no longer
  while (known > 0 && !(error(known) <= spec.tolerance) &&
         !(reference_.error(known) <= std::max(spec.tolerance, curve.position(known)) / kKnown)) {
    --known;
  }
  std::size_t kept = known;
  while (kept > 0 && !(error(kept) <= spec.tolerance)) {
    --kept;
  }
  ErrorBound p;
  p.error = error(known);
  p.reference_error = reference_.error(known);
  p.rate_error = curve.rate(known) + reference_.rateError(known);
  p.known_until = seconds(known);
  p.kept_until = seconds(kept);
  if (exact_ && known > 0 && static_cast<double>(known + 1) < samples_) {
    const double growth = (samples_ - 1.0) / static_cast<double>(known);
    p.error *= growth;
    p.rate_error *= growth;
    p.reference_error *= growth;
    p.known_until = spec.horizon;
    p.kept_until = p.error <= spec.tolerance ? spec.horizon : p.kept_until;
  }
  p.kept = p.known_until >= spec.horizon && p.error <= spec.tolerance;
  return p;
}

}  // namespace whirl_twin
