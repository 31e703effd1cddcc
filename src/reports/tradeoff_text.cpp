#include <fmt/format.h>

#include <cmath>

#include "reports/tradeoff_report.h"

namespace whirl_twin {

namespace {

std::string errorText(double x) {
  return std::isfinite(x) ? fmt::format("{:.1e}", x) : "-";
}

std::string tradeoffRowText(const TradeoffReport& report, std::size_t index) {
  const TradeoffRow& row = report.rows[index];
  const double real_time = 1.0 / row.cpuPerSecond();
  return fmt::format(
      "  {:<19} {:>10} {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>9} {:>8.0f} {:>6.0f} {:>9.3g}  {}{}\n",
      row.setting.integrator, fmt::format("{:g}", 1.0e-9 * static_cast<double>(row.setting.step)),
      row.setting.substeps,
      row.stable ? (row.below ? "<" : "") + errorText(row.error.position) : "unstable",
      row.stable ? errorText(row.error.radius) : "-", row.stable ? errorText(row.error.phase) : "-",
      row.stable ? errorText(row.error.energy) : "-",
      row.stable ? errorText(row.energy_drift) : "-", row.step_cost, row.cost_spread, real_time,
      row.pareto ? "*" : "", report.recommended == index ? " <- recommended" : "");
}

}  // namespace

std::string text(const TradeoffReport& r) {
  std::string out = fmt::format("{} ({}), {:g} s\n", r.system, r.model, r.duration);
  out += fmt::format(
      "  reference: {}, {} in {:g} s, and {}, {}: its error is below {:.1e}{}\n",
      r.reference.integrator, r.reference.substeps, 1.0e-9 * static_cast<double>(r.reference.step),
      r.checked_by.integrator, r.checked_by.substeps, r.reference_error,
      r.compared < r.duration
          ? fmt::format(
                "; compared up to {:.4g} s: after that, the chaotic motion amplifies every error",
                r.compared)
          : "");
  out += fmt::format("  a small perturbation of the start grows {:.3g}-fold\n\n", r.growth);
  out += fmt::format("  {:<19} {:>10} {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>9} {:>8} {:>6} {:>9}\n",
                     "integrator", "step (s)", "substeps", "position", "radius", "phase/rad",
                     "energy", "drift", "ns/step", "+-", "x real");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    if (i > 0 && r.rows[i].setting.integrator != r.rows[i - 1].setting.integrator) {
      out += "\n";
    }
    out += tradeoffRowText(r, i);
  }
  out += "\n  * no other is both cheaper and more accurate\n";
  if (r.recommended) {
    const StepSetting& best = r.rows[*r.recommended].setting;
    out += fmt::format("  recommended: {}, {} per step: {}\n", best.integrator, best.substeps,
                       r.reason);
  } else {
    out += "  " + r.reason + "\n";
  }
  return out + fmt::format("  auto selects: {}\n", r.automatic);
}

Json rowJson(const TradeoffReport& report, const TradeoffRow& row) {
  Json j;
  j["system"] = report.system;
  j["integrator"] = row.setting.integrator;
  j["step"] = 1.0e-9 * static_cast<double>(row.setting.step);
  j["substeps"] = row.setting.substeps;
  j["error"] = row.error.position;
  j["below_reference"] = row.below;
  j["errors"] = {{"position", row.error.position},
                 {"radius", row.error.radius},
                 {"phase", row.error.phase},
                 {"energy", row.error.energy}};
  j["worst_error"] = row.worst;
  j["ns_per_step"] = row.step_cost;
  j["ns_per_step_spread"] = row.cost_spread;
  j["cpu_per_simulated_second"] = row.cpuPerSecond();
  j["real_time_factor"] = 1.0 / row.cpuPerSecond();
  j["energy_drift"] = row.energy_drift;
  j["momentum_drift"] = row.momentum_drift;
  j["stable"] = row.stable;
  j["pareto"] = row.pareto;
  return j;
}

Json summaryJson(const TradeoffReport& r) {
  Json j;
  j["system"] = r.system;
  j["model"] = r.model;
  j["duration"] = r.duration;
  j["compared_until"] = r.compared;
  j["disturbance_growth"] = r.growth;
  j["tolerance"] = r.tolerance;
  j["reference"] = {{"integrator", r.reference.integrator},
                    {"step", 1.0e-9 * static_cast<double>(r.reference.step)},
                    {"substeps", r.reference.substeps},
                    {"checked_by", r.checked_by.integrator},
                    {"error", r.reference_error}};
  Json stable = Json::object();
  for (const TradeoffRow& row : r.rows) {
    const std::string& name = row.setting.integrator;
    if (row.stable && !stable.contains(name)) {  // rows go from coarse to fine
      stable[name] = row.methodStep();
    } else if (!row.stable) {
      stable.erase(name);
    }
  }
  j["largest_stable_step"] = stable;
  if (r.recommended) {
    const StepSetting& best = r.rows[*r.recommended].setting;
    j["integrator"] = best.integrator;
    j["step"] = 1.0e-9 * static_cast<double>(best.step);
    j["substeps"] = best.substeps;
    j["error"] = r.rows[*r.recommended].worst;
  } else {
    j["integrator"] = nullptr;
  }
  j["reason"] = r.reason;
  j["auto"] = r.automatic;
  return j;
}

std::string csv(const std::vector<TradeoffReport>& reports) {
  std::string out =
      "system,integrator,step,substeps,error,radius_error,phase_error,energy_error,worst_error,"
      "energy_drift,momentum_drift,stable,ns_per_step,ns_per_step_spread,cpu_per_simulated_second,"
      "real_time_factor,pareto\n";
  for (const TradeoffReport& report : reports) {
    for (const TradeoffRow& row : report.rows) {
      out += fmt::format(
          "{},{},{:.9g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g},"
          "{:.6g},{:.6g},{:.6g},{}\n",
          report.system, row.setting.integrator, 1.0e-9 * static_cast<double>(row.setting.step),
          row.setting.substeps, row.error.position, row.error.radius, row.error.phase,
          row.error.energy, row.worst, row.energy_drift, row.momentum_drift, row.stable ? 1 : 0,
          row.step_cost, row.cost_spread, row.cpuPerSecond(), 1.0 / row.cpuPerSecond(),
          row.pareto ? 1 : 0);
    }
  }
  return out;
}

}  // namespace whirl_twin
