#include "tools/balancing_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/written_quantity.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxNames = 200;
constexpr double kLargest = 1.0e12;    // amplitude, weight, mass times radius [kg m]
constexpr double kMinMass = 1.0e-12;   // kg m: a speck of dust at a centimetre
constexpr double kMaxAngle = 360.0e3;  // deg, either way

class RunsReader {
 public:
  explicit RunsReader(const std::string& path) : diagnostics_(path) {}

  BalancingRuns read(const YAML::Node& tree) {
    const MapReader map(tree, "", {"probes", "planes", "initial", "trials", "weights", "deviation"},
                        "key of balancing runs", diagnostics_);
    if (map.usable()) {
      runs_.probes = names(map, "probes");
      runs_.planes = names(map, "planes");
      runs_.initial = readings(map, "initial");
      readWeights(map);
      readTrials(map);
      if (map.has("deviation")) {
        noteUnit(map.at("deviation"), map.key("deviation"));
        runs_.deviation = number(map.at("deviation"), map.key("deviation"), kMinMass, kLargest,
                                 "a standard deviation", amplitudeUnit(map.at("deviation")));
      }
    }
    if (with_unit_ && without_unit_ && diagnostics_.all().empty()) {
      diagnostics_.add(*without_unit_, fmt::format("must have a unit, as {} has", *with_unit_));
    }
    if (!diagnostics_.all().empty()) {
      throw InputError(errorList(diagnostics_.all(), "\ntwin: "));
    }
    return runs_;
  }

 private:
  /// The list under a key; empty, with an error recorded, where there is none of this size.
  std::vector<YAML::Node> list(const MapReader& map, const std::string& name,
                               const std::string& expected, std::size_t least, std::size_t most) {
    const YAML::Node node = map.at(name);
    if (!node.IsDefined() || !node.IsSequence() || node.size() < least || node.size() > most) {
      const bool other_size = node.IsDefined() && node.IsSequence();
      diagnostics_.add(
          map.key(name),
          fmt::format("must be {}, found {}", expected,
                      other_size ? fmt::format("{} entries", node.size()) : shown(node)));
      return {};
    }
    return {node.begin(), node.end()};
  }

  std::vector<std::string> names(const MapReader& map, const std::string& name) {
    std::vector<std::string> all;
    const auto nodes =
        list(map, name, fmt::format("a list of 1 to {} names", kMaxNames), 1, kMaxNames);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::string one = nodes[i].IsScalar() ? nodes[i].Scalar() : "";
      const std::string key = fmt::format("{}[{}]", map.key(name), i);
      if (one.empty()) {
        diagnostics_.add(key, fmt::format("must be a name, found {}", shown(nodes[i])));
      } else if (std::find(all.begin(), all.end(), one) != all.end()) {
        diagnostics_.add(key,
                         fmt::format("must be unique, found {} twice", whirl_twin::inQuotes(one)));
      }
      all.push_back(one);
    }
    return all;
  }

  /// `unit`: that of a number without one.
  double number(const YAML::Node& node, const std::string& key, double least, double largest,
                const std::string& what, const std::string& unit) {
    const auto value = node.IsDefined() && node.IsScalar() ? parseQuantity(node.Scalar(), unit)
                                                           : std::optional<double>();
    if (!value || !(*value >= least && *value <= largest)) {
      diagnostics_.add(
          key, fmt::format("must be {} from {:g} to {:g}, found {}{}", what, least, largest,
                           shown(node), node.IsDefined() ? unitDiagnostic(node, unit) : ""));
      return 0.0;
    }
    return *value;
  }

  /// Amplitudes have any unit, all the same, and then none; or a unit each.
  std::string amplitudeUnit(const YAML::Node& node) {
    const auto written =
        node.IsDefined() && node.IsScalar() ? writtenQuantity(node.Scalar()) : std::nullopt;
    if (runs_.unit.empty() && written && !written->unit.empty()) {
      runs_.unit = "m";
      for (const char* unit : {"m/s", "m/s^2"}) {
        runs_.unit = unitScale(written->unit, unit) != 0.0 ? unit : runs_.unit;
      }
    }
    return runs_.unit.empty() ? "m" : runs_.unit;
  }

  void noteUnit(const YAML::Node& node, const std::string& key) {
    const auto written = node.IsScalar() ? writtenQuantity(node.Scalar()) : std::nullopt;
    std::optional<std::string>& first =
        written && !written->unit.empty() ? with_unit_ : without_unit_;
    first = first.value_or(key);
  }

  Eigen::VectorXcd readings(const MapReader& map, const std::string& name) {
    const std::size_t probes = runs_.probes.size();
    Eigen::VectorXcd all = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(probes));
    if (probes == 0) {
      return all;  // already reported
    }
    const auto nodes =
        list(map, name, fmt::format("a list of {}, one per probe", probes), probes, probes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::string key = fmt::format("{}[{}]", map.key(name), i);
      if (!nodes[i].IsSequence() || nodes[i].size() != 2) {
        diagnostics_.add(
            key, fmt::format("must be [amplitude, phase lag in deg], found {}", shown(nodes[i])));
        continue;
      }
      const double amplitude = number(nodes[i][0], key + "[0]", -kLargest, kLargest, "an amplitude",
                                      amplitudeUnit(nodes[i][0]));
      noteUnit(nodes[i][0], key + "[0]");
      const double lag =
          number(nodes[i][1], key + "[1]", -kMaxAngle, kMaxAngle, "a phase lag in deg", "deg");
      all[static_cast<Eigen::Index>(i)] = amplitude * std::polar(1.0, -kDegree * lag);
    }
    return all;
  }

  void readWeights(const MapReader& map) {
    const std::size_t probes = runs_.probes.size();
    runs_.weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(probes));
    if (!map.has("weights") || probes == 0) {
      return;
    }
    const std::size_t before = diagnostics_.all().size();
    const auto nodes =
        list(map, "weights", fmt::format("a list of {}, one per probe", probes), probes, probes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      runs_.weights[static_cast<Eigen::Index>(i)] = number(
          nodes[i], fmt::format("{}[{}]", map.key("weights"), i), 0.0, kLargest, "a weight", "-");
    }
    if (diagnostics_.all().size() == before && runs_.weights.isZero(0.0)) {
      diagnostics_.add(map.key("weights"), "must have one > 0");
    }
  }

  void readTrials(const MapReader& map) {
    constexpr std::size_t kMaxTrials = 10000;
    const std::size_t before = diagnostics_.all().size();
    const auto nodes =
        list(map, "trials", fmt::format("a list of 1 to {} runs", kMaxTrials), 1, kMaxTrials);
    std::vector<bool> tried(runs_.planes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const MapReader run(nodes[i], fmt::format("{}[{}]", map.key("trials"), i),
                          {"plane", "mass_radius", "angle", "readings"}, "key of a trial run",
                          diagnostics_);
      if (run.usable() && !runs_.planes.empty()) {
        readTrial(run, tried);
      }
    }
    const bool sound = diagnostics_.all().size() == before;
    for (std::size_t plane = 0; sound && plane < tried.size(); ++plane) {
      if (!tried[plane]) {
        diagnostics_.add(map.key("trials"),
                         fmt::format("must have a run with a mass in every plane, found none in {}",
                                     whirl_twin::inQuotes(runs_.planes[plane])));
      }
    }
  }

  void readTrial(const MapReader& run, std::vector<bool>& tried) {
    const std::vector<std::string>& planes = runs_.planes;
    if (!run.has("plane")) {
      diagnostics_.add(run.key("plane"), "missing; must be the name of a plane");
    }
    const auto place = std::find(planes.begin(), planes.end(),
                                 run.choice("plane", planes, "the name of a plane", ""));
    TrialRun trial;
    const std::size_t before = diagnostics_.all().size();
    const double size = number(run.at("mass_radius"), run.key("mass_radius"), -kLargest, kLargest,
                               "mass times radius in kg m,", "kg m");
    const double angle =
        number(run.at("angle"), run.key("angle"), -kMaxAngle, kMaxAngle, "an angle in deg", "deg");
    trial.mass_radius = size * std::polar(1.0, kDegree * angle);
    trial.readings = readings(run, "readings");
    if (place == planes.end()) {
      return;
    }
    trial.plane = place - planes.begin();
    tried[static_cast<std::size_t>(trial.plane)] = true;
    const bool read = diagnostics_.all().size() == before;
    if (read && std::fabs(size) < kMinMass && run.has("mass_radius")) {
      diagnostics_.add(run.key("mass_radius"),
                       fmt::format("must be {:g} kg m at least, found {} in plane {}", kMinMass,
                                   shown(run.at("mass_radius")), whirl_twin::inQuotes(*place)));
    }
    runs_.trials.push_back(trial);
  }

  Diagnostics diagnostics_;
  BalancingRuns runs_;
  std::optional<std::string> with_unit_, without_unit_;  // keys of the first such amplitudes
};

}  // namespace

BalancingRuns readBalancingRuns(const std::string& path) {
  const YAML::Node tree =
      readYamlFile(path, "a record of balancing runs", "probes, planes, initial and trials");
  return RunsReader(path).read(tree);
}

}  // namespace whirl_twin
