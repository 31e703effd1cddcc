#include "reports/tradeoff_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "accuracy/reference_trajectory.h"
#include "accuracy/step_choice.h"
#include "algebra/constants.h"
#include "integration/step_methods.h"
#include "models/model_registry.h"
#include "reports/step_cost.h"
#include "scene/model_context.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kCoarsest = 32;  // steps of the scene in the coarsest step tried
constexpr int kMaxSubsteps = 64;
constexpr std::int64_t kSamples = 256;
constexpr double kWanted = 1.0e-12;  // of the reference
constexpr double kGoodThroughout = 1.0e-5;
constexpr double kReferenceBudget = 4.0e8;  // evaluations
/// A perturbation of the start, relative to the motion.
constexpr double kDisturbance = 1.0e-8;
constexpr double kMaxStepsOfRun = 4.0e6;  // of a method in one run
constexpr double kPatience = 1.5;         // s, for one run

/// The methods that suit the system, from the lowest order to the exact one.
std::vector<StepMethod> methodsOf(const Scene& one) {
  SystemSpec spec = one.systems.front();
  const ModelSetup& setup = setupOf(spec, surroundingsOf(one, spec)).made;
  std::vector<StepMethod> suited;
  for (const StepMethod& method : stepMethods()) {
    // Steps ahead of the twin's are those of another method, read off.
    if (!method.ahead && canStepWith(setup, spec.drive.has_value(), method.name)) {
      suited.push_back(method);
    }
  }
  return suited;
}

/// The steps tried with one method, coarse to fine: multiples of the scene's step, then parts.
std::vector<StepSetting> ladder(const Scene& one, const std::string& integrator, double steps) {
  std::vector<StepSetting> settings;
  for (std::int64_t multiple = kCoarsest; multiple > 1; multiple /= 2) {
    if (multiple * one.step <= 10'000'000'000) {
      settings.push_back({integrator, multiple * one.step, 1});
    }
  }
  for (int substeps = 1; substeps <= kMaxSubsteps && substeps * steps <= kMaxStepsOfRun;
       substeps *= 2) {
    settings.push_back({integrator, one.step, substeps});
  }
  return settings;
}

/// What settings are compared with, and the number of samples where that is accurate.
struct ReferenceRun {
  StepSetting setting, other;
  Trajectory trajectory;
  std::size_t samples = 0;
  double error = 0.0;  // bound, of the reference's positions in these samples
  double growth = 0.0;
};

/// Of a small disturbance of the start.
double growth(const Scene& one, const ReferenceRun& reference, std::int64_t duration,
              std::int64_t interval) {
  std::vector<double> largest(reference.trajectory.dof);
  for (std::size_t i = 0; i < reference.trajectory.coordinates.size(); ++i) {
    double& own = largest[i % largest.size()];
    own = std::max(own, std::fabs(reference.trajectory.coordinates[i]));
  }
  for (std::size_t i = 0; i < largest.size(); ++i) {
    largest[i] =
        kDisturbance * (reference.trajectory.angular[i] ? std::min(largest[i], 1.0) : largest[i]);
  }
  const Trajectory disturbed =
      trajectory(withSetting(one, reference.setting), duration, interval, largest);
  return trajectoryError(disturbed, reference.trajectory, reference.trajectory.samples()).position /
         kDisturbance;
}

/// All samples where the reference is good; of a motion that magnifies rounding those up to where
/// it is good yet, at the best level that half of them keep.
ReferenceRun referenceRun(const Scene& one, std::int64_t duration, std::int64_t interval) {
  SystemSpec spec = one.systems.front();
  const ModelSetup& setup = setupOf(spec, surroundingsOf(one, spec)).made;
  const auto all = static_cast<std::size_t>(duration / interval) + 1;
  EvaluationBudget budget(kReferenceBudget, one, setup);
  const ReferenceTrajectory reference = referenceOf(one, setup, interval, all, kWanted, budget);
  ReferenceRun run{reference.setting, reference.other,
                   trajectory(withSetting(one, reference.setting), duration, interval)};
  run.samples = all;
  run.error = reference.error(all - 1);
  if (!(run.error <= kGoodThroughout)) {
    for (const double level : {1.0e-10, 1.0e-8, 1.0e-6, 1.0e-4}) {
      run.samples = reference.lastWithin(level) + 1;
      run.error = level;
      if (2 * run.samples >= all) {
        break;
      }
    }
  }
  run.growth = growth(one, run, duration, interval);
  return run;
}

/// The rows of one method: from coarse to fine until its error is that of the reference.
void measureErrors(const Scene& one, const StepMethod& method, const ReferenceRun& reference,
                   std::int64_t duration, std::int64_t interval, TradeoffReport& report,
                   const std::function<void()>& stepDone) {
  const double steps = static_cast<double>(duration) / static_cast<double>(one.step);
  const std::size_t first = report.rows.size();
  bool finest = false;
  for (const StepSetting& setting : ladder(one, method.name, steps)) {
    if (!finest) {
      const auto start = std::chrono::steady_clock::now();
      const Trajectory t = trajectory(withSetting(one, setting), duration, interval);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      TradeoffRow row;
      row.setting = setting;
      row.error = trajectoryError(t, reference.trajectory, reference.samples);
      row.below = row.error.position < reference.error;
      row.energy_drift = t.status == StepStatus::kOk ? t.energy_drift : kInfinity;
      row.momentum_drift = t.momentum_drift;
      row.stable = t.status == StepStatus::kOk && row.error.position < 10.0;
      const bool good = row.error.position <= 4.0 * reference.error;
      row.error.position = std::max(row.error.position, reference.error);
      report.rows.push_back(row);
      // Finer ones would show the reference's error, or rounding; or take too long.
      finest = setting.step == one.step && (good || taken.count() > kPatience);
    }
    stepDone();
  }
  double worst = 0.0;
  for (std::size_t i = report.rows.size(); i-- > first;) {
    worst = std::max(worst, report.rows[i].error.position);
    report.rows[i].worst = worst;
  }
}

void markPareto(std::vector<TradeoffRow>& rows) {
  for (TradeoffRow& row : rows) {
    row.pareto =
        row.stable && std::none_of(rows.begin(), rows.end(), [&](const TradeoffRow& other) {
          return other.stable && other.worst <= row.worst &&
                 other.cpuPerSecond() <= row.cpuPerSecond() &&
                 (other.worst < row.worst || other.cpuPerSecond() < row.cpuPerSecond());
        });
  }
}

/// The cheapest at the scene's own step that keeps its tolerance; else the most accurate.
void recommend(const Scene& one, TradeoffReport& report) {
  const auto better = [&](const TradeoffRow& a, const TradeoffRow& b) {
    const bool a_keeps = a.worst <= report.tolerance;
    const bool b_keeps = b.worst <= report.tolerance;
    if (a_keeps != b_keeps) {
      return a_keeps;
    }
    return a_keeps ? a.step_cost < b.step_cost : a.worst < b.worst;
  };
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const TradeoffRow& row = report.rows[i];
    if (row.stable && row.setting.step == one.step &&
        (!report.recommended || better(row, report.rows[*report.recommended]))) {
      report.recommended = i;
    }
  }
  if (!report.recommended) {
    report.reason = "no method is stable at the scene's step";
    return;
  }
  const TradeoffRow& row = report.rows[*report.recommended];
  report.reason =
      row.worst <= report.tolerance
          ? fmt::format("the cheapest at the scene's step whose error, {:.1e}, is within {:g}",
                        row.worst, report.tolerance)
          : fmt::format("none at the scene's step is within {:g}: the most accurate, {:.1e}",
                        report.tolerance, row.worst);
}

}  // namespace

TradeoffReport tradeoffReport(const Scene& one, std::int64_t duration,
                              const std::function<void(double)>& progress) {
  const SystemSpec& spec = one.systems.front();
  const std::vector<StepMethod> methods = methodsOf(one);
  // A whole number of the coarsest steps between samples.
  const std::int64_t coarsest = kCoarsest * one.step;
  const std::int64_t interval =
      std::max<std::int64_t>(1, duration / kSamples / coarsest) * coarsest;
  duration = std::max<std::int64_t>(1, (duration + interval - 1) / interval) * interval;

  const ReferenceRun reference = referenceRun(one, duration, interval);

  TradeoffReport report;
  report.scene = one.name;
  report.system = spec.name;
  report.model = spec.model;
  report.tolerance = spec.tolerance;
  report.duration = 1.0e-9 * static_cast<double>(duration);
  report.reference = reference.setting;
  report.checked_by = reference.other;
  report.reference_error = reference.error;
  report.compared = reference.trajectory.interval * static_cast<double>(reference.samples - 1);
  report.growth = reference.growth;
  const StepChoice automatic = chooseStep(one);
  report.automatic = fmt::format("{}, {}", automatic.integrator,
                                 stepsText(automatic.integrator, automatic.substeps));

  double done = 0.0;
  double all = 0.0;
  const double steps = static_cast<double>(duration) / static_cast<double>(one.step);
  for (const StepMethod& method : methods) {
    all += static_cast<double>(ladder(one, method.name, steps).size());
  }
  for (const StepMethod& method : methods) {
    measureErrors(one, method, reference, duration, interval, report,
                  [&] { progress(0.8 * ++done / all); });
  }
  std::vector<Scene> settings;
  for (const TradeoffRow& row : report.rows) {
    settings.push_back(withSetting(one, row.setting));
  }
  const std::vector<StepTiming> timings =
      interleavedTimings(settings, duration, [&](double share) { progress(0.8 + 0.2 * share); });
  for (std::size_t i = 0; i < timings.size(); ++i) {
    report.rows[i].step_cost = timings[i].median;
    report.rows[i].cost_spread = timings[i].spread;
  }
  markPareto(report.rows);
  recommend(one, report);
  return report;
}

}  // namespace whirl_twin
