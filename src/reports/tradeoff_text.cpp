#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "integration/step_methods.h"
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

/// Rounding is drawn here where an error is zero.
constexpr double kErrorDrawnForZero = 1.0e-16;

/// Each method has one, whichever others there are: the twelfth is the first, dashed.
Pen methodPen(const std::string& integrator) {
  static constexpr std::array kInks{ink::kBlue,   ink::kVermilion, ink::kGreen, ink::kPurple,
                                    ink::kOrange, ink::kSkyBlue,   ink::kNavy,  ink::kGrey,
                                    ink::kOlive,  ink::kPink,      ink::kBlack};
  const auto& methods = stepMethods();
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const StepMethod& m) { return m.name == integrator; });
  const auto index = static_cast<std::size_t>(method - methods.begin());
  Pen pen{kInks[index % kInks.size()], 1.8};
  if (index >= kInks.size()) {
    pen.dash = {6.0, 4.0};
  }
  return pen;
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
  return {{"system", report.system},
          {"integrator", row.setting.integrator},
          {"step", 1.0e-9 * static_cast<double>(row.setting.step)},
          {"substeps", row.setting.substeps},
          {"error", row.error.position},
          {"below_reference", row.below},
          {"errors",
           {{"position", row.error.position},
            {"radius", row.error.radius},
            {"phase", row.error.phase},
            {"energy", row.error.energy}}},
          {"worst_error", row.worst},
          {"ns_per_step", row.step_cost},
          {"ns_per_step_spread", row.cost_spread},
          {"cpu_per_simulated_second", row.cpuPerSecond()},
          {"real_time_factor", 1.0 / row.cpuPerSecond()},
          {"energy_drift", row.energy_drift},
          {"momentum_drift", row.momentum_drift},
          {"stable", row.stable},
          {"pareto", row.pareto}};
}

Json summaryJson(const TradeoffReport& r) {
  Json stable = Json::object();
  for (const TradeoffRow& row : r.rows) {
    const std::string& name = row.setting.integrator;
    if (row.stable && !stable.contains(name)) {  // rows go from coarse to fine
      stable[name] = row.methodStep();
    } else if (!row.stable) {
      stable.erase(name);
    }
  }
  Json j{{"system", r.system},
         {"model", r.model},
         {"duration", r.duration},
         {"compared_until", r.compared},
         {"disturbance_growth", r.growth},
         {"tolerance", r.tolerance},
         {"reference",
          {{"integrator", r.reference.integrator},
           {"step", 1.0e-9 * static_cast<double>(r.reference.step)},
           {"substeps", r.reference.substeps},
           {"checked_by", r.checked_by.integrator},
           {"error", r.reference_error}}},
         {"largest_stable_step", stable},
         {"integrator", nullptr}};
  if (r.recommended) {
    const StepSetting& best = r.rows[*r.recommended].setting;
    j["integrator"] = best.integrator;
    j["step"] = 1.0e-9 * static_cast<double>(best.step);
    j["substeps"] = best.substeps;
    j["error"] = r.rows[*r.recommended].worst;
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

Figure figure(const TradeoffReport& report) {
  Chart work, order;
  work.title = "work-precision diagram";
  work.x = {"CPU time per simulated second (s)", true, false};
  work.y = {"largest relative position error", true, false};
  order.title = "error over the method's step";
  order.x = {"step of the method (s)", true, false};
  order.y = work.y;
  for (const TradeoffRow& row : report.rows) {
    if (work.series.empty() || work.series.back().name != row.setting.integrator) {
      for (Chart* chart : {&work, &order}) {
        Series series;
        series.name = chart == &work ? row.setting.integrator : "";  // of both, once
        series.pen = methodPen(row.setting.integrator);
        series.marks = Marks::kDots;
        chart->series.push_back(series);
      }
    }
    if (row.stable) {
      const double error = std::max(row.error.position, kErrorDrawnForZero);
      work.series.back().x.push_back(row.cpuPerSecond());
      work.series.back().y.push_back(error);
      order.series.back().x.push_back(row.methodStep());
      order.series.back().y.push_back(error);
    }
  }
  if (report.recommended) {
    const TradeoffRow& row = report.rows[*report.recommended];
    Series ring{
        "recommended", {row.cpuPerSecond()}, {std::max(row.error.position, kErrorDrawnForZero)}};
    ring.pen = Pen{ink::kBlack, 2.0};
    ring.line = false;
    ring.marks = Marks::kRings;
    work.series.push_back(ring);
  }
  for (Chart* chart : {&work, &order}) {
    chart->horizontal = {{report.tolerance, fmt::format("tolerance {:g}", report.tolerance)},
                         {report.reference_error, "reference"}};
  }
  Figure figure;
  figure.title = fmt::format("{}: {} ({}), {:g} s", report.scene, report.system, report.model,
                             report.compared);
  figure.charts = {work, order};
  figure.width = 940;
  figure.chart_height = 480;
  return figure;
}

}  // namespace whirl_twin
