// Speed against accuracy, measured: what every way of stepping a system costs on this machine, and
// what it gets wrong.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/trajectory_error.h"
#include "reports/figure.h"
#include "reports/output.h"

namespace whirl_twin {

struct TradeoffRow {
  StepSetting setting;
  TrajectoryError error;  ///< against the reference; of positions its own at least
  bool below = false;     ///< positions nearer to the reference than that is to the truth
  /// Largest position error of this and every finer step of the method: what it can be trusted for;
  /// the reference's own at least.
  double worst = 0.0;
  double energy_drift = 0.0;    ///< [-], largest energy residual over the whole duration
  double momentum_drift = 0.0;  ///< [-], of conserved momenta; NaN: there is none
  bool stable = false;          ///< ran to the end and stayed within ten times the motion's size
  bool pareto = false;          ///< nothing stable is both cheaper and more accurate
  double step_cost = 0.0;       ///< [ns], of a step of the twin: median of the rounds
  double cost_spread = 0.0;     ///< [ns], from the fastest round to the slowest

  /// [s]
  double methodStep() const {
    return 1.0e-9 * static_cast<double>(setting.step) / setting.substeps;
  }
  /// [s] of CPU for a second of the system.
  double cpuPerSecond() const { return step_cost / static_cast<double>(setting.step); }
};

struct TradeoffReport {
  std::string scene, system, model;
  double duration = 0.0;  ///< [s]
  double compared = 0.0;  ///< [s], from the start: beyond, no trajectory is reproducible
  double growth = 0.0;    ///< [-], of a small disturbance over the duration
  StepSetting reference;
  StepSetting checked_by;         ///< another method, with which the reference was compared
  double reference_error = 0.0;   ///< bound, of its positions up to `compared`
  double tolerance = 0.0;         ///< of the scene
  std::vector<TradeoffRow> rows;  ///< method by method, from the coarsest step to the finest
  std::optional<std::size_t> recommended;  ///< of `rows`
  std::string reason;
  std::string automatic;  ///< what `auto` takes: "gauss_legendre_6, 1 a step"
};

/// For a scene of one system. duration [ns]. progress gets the fraction done, 0 to 1.
TradeoffReport tradeoffReport(const Scene& one, std::int64_t duration,
                              const std::function<void(double)>& progress);

std::string text(const TradeoffReport& report);
Json rowJson(const TradeoffReport& report, const TradeoffRow& row);
/// What is not in the rows: reference, recommendation.
Json summaryJson(const TradeoffReport& report);
/// A header line, and one line for each row of all reports.
std::string csv(const std::vector<TradeoffReport>& reports);
Figure figure(const TradeoffReport& report);

}  // namespace whirl_twin
