#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

#include "algebra/constants.h"
#include "messages/names.h"
#include "reports/csv_table.h"
#include "reports/report_values.h"
#include "requests/rotor_requests.h"
#include "requests/scene_argument.h"
#include "tools/arguments.h"
#include "tools/balancing_runs.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kBalanceDescription =
    "Balances a rotor in several planes: by influence coefficients, from measured trial runs; or, "
    "of\n"
    "a rotor with a model, from one log of the running machine.";

constexpr const char* kBalanceFooter =
    "FILE is YAML or JSON:\n"
    "  probes:  [left, right]                      what is measured, each at each speed\n"
    "  planes:  [disc_1, disc_2]                   where masses can be added\n"
    "  initial: [[12e-6, 40], [9e-6, 130]]         amplitude and phase lag (deg) of each; the\n"
    "                                              amplitudes without a unit, or with: 2.5 mil\n"
    "  trials:                                     runs with one trial mass each\n"
    "    - {plane: disc_1, mass_radius: 1e-4, angle: 0, readings: [[8e-6, 55], [7e-6, 120]]}\n"
    "    - {plane: disc_2, mass_radius: 100 g mm, angle: 90, readings: [[10e-6, 20], [5e-6, "
    "150]]}\n"
    "  weights: [1, 1]                             of the probes; optional\n"
    "  deviation: 0.2e-6                           standard deviation of either component of a\n"
    "                                              reading; default: estimated from the residual,\n"
    "                                              where there are more probes than planes\n"
    "mass_radius in kg m, or with a unit: 15 g mm, 5 oz in; angles in deg, from the shaft's phase\n"
    "mark in the direction of rotation.\n"
    "The correction masses are to be added after the trial masses are removed.\n"
    "\n"
    "With --measured, FILE is a scene, and LOG an LCM log, a rosbag or a table with the "
    "measurements of "
    "its\n"
    "`sensors`, as `twin simulate --measure` writes it: displacement probes and a keyphasor, over "
    "a\n"
    "run-up or at several steady speeds. All sources with probes at the rotor are used. The "
    "slow-roll\n"
    "run-out is estimated with the unbalance. Angles count from the shaft's phase mark.\n"
    "Unbalances that the log does not identify are reported, and null in the JSON.\n"
    "\n"
    "Example:\n"
    "  twin balance balancing --measured run.lcmlog --planes left_disc right_disc";

constexpr OptionQuantity kAnySpeed{"a shaft speed", "rad/s", 0.0};

struct BalanceRequest {
  SceneArgument scene;  // or the file of the trial runs
  std::optional<std::string> measured, csv;
  MeasuredBalanceRequest log;
  bool json = false;
};

double degrees(const std::complex<double>& z) {
  return std::arg(z) / kDegree + 0.0;
}

using Spread = std::optional<CorrectionSpread>;

/// [deg], standard deviation of the angle of a mass from that of its components.
double angleDeviation(const std::complex<double>& mass, double deviation) {
  return std::atan2(deviation, std::abs(mass)) / kDegree;
}

/// Half width of the 95 % interval of a value; null where it is unknown.
Json aside(double value, const Spread& spread, double deviation) {
  return spread ? Json{value - spread->within95 * deviation, value + spread->within95 * deviation}
                : Json();
}

Json balanceJson(const BalancingRuns& runs, const BalanceCorrection& c, const Spread& spread) {
  Json json;
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const std::complex<double> mass = c.mass_radius[k];
    const double size = spread ? spread->deviation[k] : 0.0;
    const double turn = angleDeviation(mass, size);
    json["correction"][runs.planes[i]] = {
        {"mass_radius", std::abs(mass)},
        {"angle", degrees(mass)},
        {"mass_radius_deviation", spread ? Json(size) : Json()},
        {"angle_deviation", spread ? Json(turn) : Json()},
        {"mass_radius_interval", aside(std::abs(mass), spread, size)},
        {"angle_interval", aside(degrees(mass), spread, turn)}};
  }
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto left = c.residual[static_cast<Eigen::Index>(i)];
    json["residual"][runs.probes[i]] = {{"amplitude", std::abs(left)},
                                        {"phase_lag", -degrees(left) + 0.0}};
  }
  json["residual_rms"] = c.rms;
  json["amplitude_unit"] = textOrNull(runs.unit);  // null: that of the readings
  json["condition"] = c.condition;
  return json;
}

/// The correction masses; the residual vibration at the probes.
CsvTables balanceTables(const BalancingRuns& runs, const BalanceCorrection& c) {
  CsvTable planes{"", {"plane", "mass_radius", "angle"}};
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto mass = c.mass_radius[static_cast<Eigen::Index>(i)];
    planes.rows.push_back(
        {{"plane", runs.planes[i]}, {"mass_radius", std::abs(mass)}, {"angle", degrees(mass)}});
  }
  CsvTable probes{"vibration", {"probe", "before", "after"}};
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    probes.rows.push_back({{"probe", runs.probes[i]},
                           {"before", std::abs(runs.initial[k])},
                           {"after", std::abs(c.residual[k])}});
  }
  return {planes, probes};
}

std::string balanceText(const BalancingRuns& runs, const BalanceCorrection& c,
                        const Spread& spread) {
  std::string out = fmt::format("add                mass x radius, kg m   angle, deg{}\n",
                                spread ? "   (half-width of the 95 % interval: kg m, deg)" : "");
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const std::complex<double> mass = c.mass_radius[k];
    out += fmt::format("  {:<18} {:>18.6g} {:>12.4f}", printable(runs.planes[i]), std::abs(mass),
                       degrees(mass));
    out += spread ? fmt::format("   ({:.2g}, {:.2g})", spread->within95 * spread->deviation[k],
                                spread->within95 * angleDeviation(mass, spread->deviation[k]))
                  : "";
    out += "\n";
  }
  if (!spread) {
    out += "  no confidence intervals: give `deviation`, or more probes than planes\n";
  }
  const std::string vibration = runs.unit.empty() ? "vibration" : "vibration, " + runs.unit;
  out += fmt::format("{:<18} {:>18} {:>12}\n", vibration, "before", "after");
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out += fmt::format("  {:<18} {:>16.6g} {:>12.6g}\n", printable(runs.probes[i]),
                       std::abs(runs.initial[k]), std::abs(c.residual[k]));
  }
  return out +
         (std::isfinite(c.condition)
              ? fmt::format("planes: condition number {:.4g}\n", c.condition)
              : "planes: linearly dependent or without effect: the smallest masses are given\n");
}

int balanceRuns(const BalanceRequest& request) {
  const BalancingRuns runs = readBalancingRuns(request.scene.name);
  const Eigen::MatrixXcd influence =
      influenceOfPlanes(runs.initial, runs.trials, static_cast<Eigen::Index>(runs.planes.size()));
  const BalanceCorrection correction = balance(influence, runs.initial, runs.weights);
  const Spread spread =
      correctionSpread(influence, runs.trials, runs.weights, correction, runs.deviation);
  if (request.csv) {
    writeCsv(*request.csv, balanceTables(runs, correction));
  }
  return printReport(request.json, balanceJson(runs, correction, spread),
                     balanceText(runs, correction, spread));
}

int balanceMeasured(const BalanceRequest& request) {
  return printDocument(balanceDocument(sceneOf(request.scene), request.log), request.json,
                       request.csv);
}

}  // namespace

void addBalanceCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("balance", kBalanceDescription);
  const auto request = std::make_shared<BalanceRequest>();
  command.option("FILE", request->scene.name, "the trial runs; with --measured the scene")
      .required()
      .type("");
  const Option measured =
      command.option("--measured", request->measured, "log of the running machine").type("LOG");
  const auto with_log = [measured](const Option& option) { return option.needs(measured); };
  with_log(addSetOption(command, request->scene));
  with_log(command.option("--system", request->log.system, "this rotor").type("NAME"));
  with_log(
      command
          .option("--planes", request->log.unbalance.planes,
                  "stations where masses can be added; default: those of the scene's unbalances")
          .type("STATION"));
  with_log(command
               .quantity("--from", request->log.unbalance.from, kAnySpeed,
                         "slower intervals are left out: speed")
               .type("W"));
  with_log(command
               .quantity("--to", request->log.unbalance.to, kAnySpeed,
                         "faster intervals are left out: speed")
               .type("W"));
  with_log(command.flag("--known-run-out", request->log.unbalance.run_out_known,
                        "use the run-out of the scene's sensors, 0 where they have none"));
  with_log(command
               .option("--lcm-prefix", request->log.lcm_prefix,
                       "prefix of the log's channels; default: TWIN_")
               .type("PREFIX"));
  with_log(addImportOption(command, request->log.import));
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  command.footer(kBalanceFooter);
  command.callback([request, &status] {
    requireCsvName(request->csv);
    request->log.measured = request->measured.value_or("");
    status = request->measured ? balanceMeasured(*request) : balanceRuns(*request);
  });
}

}  // namespace whirl_twin
