#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "messages/names.h"
#include "reports/output.h"
#include "tools/balancing_runs.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Balances a rotor in several planes by influence coefficients, from measured trial runs.";

constexpr const char* kFooter =
    "FILE is YAML or JSON:\n"
    "  probes:  [left, right]                      what is read, each at each speed\n"
    "  planes:  [disc_1, disc_2]                   where masses can be set\n"
    "  initial: [[12e-6, 40], [9e-6, 130]]         amplitude (any unit) and phase lag (deg) of "
    "each\n"
    "  trials:                                     runs with one trial mass each\n"
    "    - {plane: disc_1, mass_radius: 1e-4, angle: 0, readings: [[8e-6, 55], [7e-6, 120]]}\n"
    "    - {plane: disc_2, mass_radius: 1e-4, angle: 90, readings: [[10e-6, 20], [5e-6, 150]]}\n"
    "  weights: [1, 1]                             of the probes; may be left out\n"
    "mass_radius in kg m; angles in degrees from the shaft's mark in the direction of rotation.\n"
    "The correction is to be added, with the trial masses taken out.";

constexpr double kRadian = 3.14159265358979323846 / 180.0;

struct Request {
  std::string file;
  bool json = false;
};

double degrees(const std::complex<double>& z) {
  return std::arg(z) / kRadian + 0.0;
}

Json json(const BalancingRuns& runs, const BalanceCorrection& c) {
  Json json;
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto mass = c.mass_radius[static_cast<Eigen::Index>(i)];
    json["correction"][runs.planes[i]] = {{"mass_radius", std::abs(mass)},
                                          {"angle", degrees(mass)}};
  }
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto left = c.residual[static_cast<Eigen::Index>(i)];
    json["residual"][runs.probes[i]] = {{"amplitude", std::abs(left)},
                                        {"phase_lag", -degrees(left) + 0.0}};
  }
  json["residual_rms"] = c.rms;
  json["condition"] = c.condition;
  return json;
}

std::string text(const BalancingRuns& runs, const BalanceCorrection& c) {
  std::string out = "add                mass x radius, kg m   angle, deg\n";
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto mass = c.mass_radius[static_cast<Eigen::Index>(i)];
    out += fmt::format("  {:<18} {:>18.6g} {:>12.4f}\n", printable(runs.planes[i]), std::abs(mass),
                       degrees(mass));
  }
  out += "vibration                      before        after\n";
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out += fmt::format("  {:<18} {:>16.6g} {:>12.6g}\n", printable(runs.probes[i]),
                       std::abs(runs.initial[k]), std::abs(c.residual[k]));
  }
  return out + (std::isfinite(c.condition)
                    ? fmt::format("planes: condition number {:.4g}\n", c.condition)
                    : "planes: some do the same, or nothing: the least masses that do it\n");
}

int balanceRuns(const Request& request) {
  const BalancingRuns runs = readBalancingRuns(request.file);
  const BalanceCorrection correction = balance(
      influenceOfPlanes(runs.initial, runs.trials, static_cast<Eigen::Index>(runs.planes.size())),
      runs.initial, runs.weights);
  if (request.json) {
    printJson(json(runs, correction));
  } else {
    printText(text(runs, correction));
  }
  return kDone;
}

}  // namespace

void addBalanceCommand(CLI::App& twin, int& status) {
  CLI::App* command = twin.add_subcommand("balance", kDescription);
  const auto request = std::make_shared<Request>();
  command->add_option("FILE", request->file, "the runs")->required()->type_name("");
  command->add_flag("--json", request->json, "print one JSON object");
  command->footer(kFooter);
  command->callback([request, &status] { status = balanceRuns(*request); });
}

}  // namespace whirl_twin
