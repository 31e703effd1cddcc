#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "analysis/balancing.h"
#include "messages/refusal.h"
#include "reports/output.h"
#include "scene/node_reader.h"
#include "tools/arguments.h"
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

struct Runs {
  std::vector<std::string> probes, planes;
  Eigen::VectorXcd initial;
  Eigen::VectorXd weights;
  std::vector<TrialRun> trials;
};

/// Values of a file, with the place in the message where they are not what was expected.
class RunsReader {
 public:
  explicit RunsReader(const std::string& file) : file_(file) {}

  Runs read() const {
    YAML::Node root;
    try {
      root = YAML::LoadFile(file_);
    } catch (const YAML::Exception& error) {
      throw Refusal(fmt::format("{}: cannot be read: {}", file_, error.what()));
    }
    if (!root.IsMap()) {
      refuse("the file", "a map with probes, planes, initial and trials", root);
    }
    Runs runs;
    runs.probes = names(root["probes"], "probes");
    runs.planes = names(root["planes"], "planes");
    runs.initial = readings(root["initial"], "initial", runs.probes.size());
    runs.weights = Eigen::VectorXd::Ones(runs.initial.size());
    if (const YAML::Node weights = root["weights"]) {
      requireList(weights, "weights", runs.probes.size());
      for (std::size_t i = 0; i < weights.size(); ++i) {
        runs.weights[static_cast<Eigen::Index>(i)] =
            number(weights[i], fmt::format("weights[{}]", i));
      }
    }
    const YAML::Node trials = root["trials"];
    if (!trials || !trials.IsSequence() || trials.size() == 0) {
      refuse("trials", "a list of runs", trials);
    }
    for (std::size_t i = 0; i < trials.size(); ++i) {
      runs.trials.push_back(trial(trials[i], fmt::format("trials[{}]", i), runs));
    }
    return runs;
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& expected,
                           const YAML::Node& found) const {
    throw Refusal(fmt::format("{}: {}: expected {}, found {}", file_, key, expected,
                              found ? shown(found) : "nothing"));
  }
  void requireList(const YAML::Node& node, const std::string& key, std::size_t size) const {
    if (!node || !node.IsSequence() || node.size() != size) {
      refuse(key, fmt::format("a list of {}", size), node);
    }
  }
  double number(const YAML::Node& node, const std::string& key) const {
    const auto value =
        node && node.IsScalar() ? parseNumber(node.Scalar()) : std::optional<double>();
    if (!value) {
      refuse(key, "a number", node);
    }
    return *value;
  }
  std::vector<std::string> names(const YAML::Node& node, const std::string& key) const {
    if (!node || !node.IsSequence() || node.size() == 0) {
      refuse(key, "a list of names", node);
    }
    std::vector<std::string> all;
    for (const YAML::Node& one : node) {
      if (!one.IsScalar()) {
        refuse(key, "a list of names", one);
      }
      all.push_back(one.Scalar());
    }
    return all;
  }
  Eigen::VectorXcd readings(const YAML::Node& node, const std::string& key,
                            std::size_t probes) const {
    requireList(node, key, probes);
    Eigen::VectorXcd all(static_cast<Eigen::Index>(probes));
    for (std::size_t i = 0; i < probes; ++i) {
      const std::string place = fmt::format("{}[{}]", key, i);
      if (!node[i].IsSequence() || node[i].size() != 2) {
        refuse(place, "[amplitude, phase lag in degrees]", node[i]);
      }
      all[static_cast<Eigen::Index>(i)] =
          std::polar(1.0, -kRadian * number(node[i][1], place)) * number(node[i][0], place);
    }
    return all;
  }
  TrialRun trial(const YAML::Node& node, const std::string& key, const Runs& runs) const {
    if (!node.IsMap()) {
      refuse(key, "a map with plane, mass_radius, angle and readings", node);
    }
    const YAML::Node plane = node["plane"];
    const auto place = std::find(runs.planes.begin(), runs.planes.end(),
                                 plane && plane.IsScalar() ? plane.Scalar() : std::string());
    if (place == runs.planes.end()) {
      refuse(key + ".plane", fmt::format("one of {}", fmt::join(runs.planes, ", ")), plane);
    }
    const double mass_radius = number(node["mass_radius"], key + ".mass_radius");
    const double angle = number(node["angle"], key + ".angle");
    return {place - runs.planes.begin(), mass_radius * std::polar(1.0, kRadian * angle),
            readings(node["readings"], key + ".readings", runs.probes.size())};
  }

  std::string file_;
};

double degrees(const std::complex<double>& z) {
  return std::arg(z) / kRadian + 0.0;
}

Json json(const Runs& runs, const BalanceCorrection& c) {
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

std::string text(const Runs& runs, const BalanceCorrection& c) {
  std::string out = "add                mass x radius, kg m   angle, deg\n";
  for (std::size_t i = 0; i < runs.planes.size(); ++i) {
    const auto mass = c.mass_radius[static_cast<Eigen::Index>(i)];
    out += fmt::format("  {:<18} {:>18.6g} {:>12.4f}\n", runs.planes[i], std::abs(mass),
                       degrees(mass));
  }
  out += "vibration                      before        after\n";
  for (std::size_t i = 0; i < runs.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out += fmt::format("  {:<18} {:>16.6g} {:>12.6g}\n", runs.probes[i], std::abs(runs.initial[k]),
                       std::abs(c.residual[k]));
  }
  return out + fmt::format("planes: condition number {:.4g}\n", c.condition);
}

int balanceRuns(const Request& request) {
  const Runs runs = RunsReader(request.file).read();
  BalanceCorrection correction;
  try {
    correction = balance(
        influenceOfPlanes(runs.initial, runs.trials, static_cast<Eigen::Index>(runs.planes.size())),
        runs.initial, runs.weights);
  } catch (const std::invalid_argument& error) {
    throw Refusal(fmt::format("{}: {}", request.file, error.what()));
  }
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
