#include "requests/balancing_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "requests/balancing_values.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxNames = 200;
constexpr std::size_t kMaxPlaces = 1000;
constexpr double kShares = 1.0e-6;  // of the sum of the planes' shares

class JobReader {
 public:
  explicit JobReader(const std::string& path) : diagnostics_(path), values_(job_, diagnostics_) {}

  BalancingJob read(const YAML::Node& tree) {
    const MapReader map(tree, "",
                        {"probes", "planes", "phase", "angles", "initial", "trials", "influence",
                         "symmetric", "weights", "deviation", "limits", "places", "tolerance"},
                        "key of a balancing job", diagnostics_);
    if (map.usable()) {
      readAll(map);
    }
    values_.requireUnitsOfAll();
    if (!diagnostics_.all().empty()) {
      throw InputError(errorList(diagnostics_.all(), "\ntwin: "));
    }
    return job_;
  }

 private:
  void readAll(const MapReader& map) {
    job_.probes = names(map, "probes");
    job_.planes = names(map, "planes");
    job_.lead = map.choice("phase", {"lag", "lead"}, "lag or lead", "lag") == "lead";
    job_.against =
        map.choice("angles", {"with_rotation", "against_rotation"},
                   "with_rotation or against_rotation", "with_rotation") == "against_rotation";
    const auto planes = static_cast<Eigen::Index>(job_.planes.size());
    job_.left_in = Eigen::VectorXcd::Zero(planes);
    job_.limits = Eigen::VectorXd::Constant(planes, std::numeric_limits<double>::infinity());
    job_.places.resize(job_.planes.size());
    job_.initial = readings(map, "initial", "");
    readWeights(map);
    readReflection(map);
    if (map.has("influence") == map.has("trials")) {
      diagnostics_.add(map.has("trials") ? map.key("influence") : map.key("trials"),
                       map.has("trials")
                           ? "must not be given beside trials"
                           : "missing; must be a list of trial runs, or influence the "
                             "coefficients of an earlier job");
    } else if (map.has("influence")) {
      readInfluence(map);
    } else {
      readTrials(map);
    }
    if (map.has("deviation")) {
      job_.deviation = values_.deviation(map.at("deviation"), map.key("deviation"));
    }
    eachPlane(map, "limits", [&](const YAML::Node& node, const std::string& key, Eigen::Index k) {
      job_.limits[k] = values_.mass(node, key, BalancingValues::kMinMass);
    });
    eachPlane(map, "places", [&](const YAML::Node& node, const std::string& key, Eigen::Index k) {
      job_.places[static_cast<std::size_t>(k)] = placesOf(node, key);
    });
    readTolerance(map);
  }

  std::vector<std::string> names(const MapReader& map, const std::string& name) {
    std::vector<std::string> all;
    const auto nodes =
        values_.list(map.at(name), map.key(name), fmt::format("a list of 1 to {} names", kMaxNames),
                     1, kMaxNames);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::string one = nodes[i].IsScalar() ? nodes[i].Scalar() : "";
      const std::string key = fmt::format("{}[{}]", map.key(name), i);
      if (one.empty()) {
        diagnostics_.add(key, fmt::format("must be a name, found {}", shown(nodes[i])));
      } else if (std::find(all.begin(), all.end(), one) != all.end()) {
        diagnostics_.add(key, fmt::format("must be unique, found {} twice", inQuotes(one)));
      }
      all.push_back(one);
    }
    return all;
  }

  Eigen::VectorXcd readings(const MapReader& map, const std::string& name, const std::string& per) {
    return values_.phasors(map.at(name), map.key(name), job_.probes.size(), "probe", per);
  }

  void readInfluence(const MapReader& map) {
    const std::size_t probes = job_.probes.size(), planes = job_.planes.size();
    job_.known = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(probes),
                                        static_cast<Eigen::Index>(planes));
    if (probes == 0 || planes == 0) {
      return;
    }
    const auto rows =
        values_.list(map.at("influence"), map.key("influence"),
                     fmt::format("a list of {}, one per probe", probes), probes, probes);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      job_.known.row(static_cast<Eigen::Index>(i)) =
          values_
              .phasors(rows[i], fmt::format("{}[{}]", map.key("influence"), i), planes, "plane",
                       "/(kg m)")
              .transpose();
    }
  }

  void readWeights(const MapReader& map) {
    const std::size_t probes = job_.probes.size();
    job_.weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(probes));
    if (!map.has("weights") || probes == 0) {
      return;
    }
    const std::size_t before = diagnostics_.all().size();
    const auto nodes =
        values_.list(map.at("weights"), map.key("weights"),
                     fmt::format("a list of {}, one per probe", probes), probes, probes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      job_.weights[static_cast<Eigen::Index>(i)] =
          values_.number(nodes[i], fmt::format("{}[{}]", map.key("weights"), i), 0.0,
                         BalancingValues::kLargest, "a weight", "-");
    }
    if (diagnostics_.all().size() == before && job_.weights.isZero(0.0)) {
      diagnostics_.add(map.key("weights"), "must have one > 0");
    }
  }

  /// Pairs of names that take each other's place; a name in no pair keeps its own.
  std::vector<Eigen::Index> pairs(const MapReader& map, const std::string& name,
                                  const std::vector<std::string>& all) {
    std::vector<Eigen::Index> other(all.size());
    std::iota(other.begin(), other.end(), 0);
    std::vector<bool> used(all.size(), false);
    const auto nodes =
        values_.list(map.at(name), map.key(name), "a list of pairs of names", 1, kMaxNames);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::string key = fmt::format("{}[{}]", map.key(name), i);
      std::vector<std::size_t> two;
      for (std::size_t k = 0; nodes[i].IsSequence() && nodes[i].size() == 2 && k < 2; ++k) {
        const auto place =
            std::find(all.begin(), all.end(), nodes[i][k].IsScalar() ? nodes[i][k].Scalar() : "");
        if (place != all.end() && !used[static_cast<std::size_t>(place - all.begin())]) {
          two.push_back(static_cast<std::size_t>(place - all.begin()));
          used[two.back()] = true;
        }
      }
      if (two.size() != 2) {
        diagnostics_.add(key, fmt::format("must be two of {}, each in one pair, found {}", name,
                                          YAML::Dump(nodes[i])));
        continue;
      }
      other[two[0]] = static_cast<Eigen::Index>(two[1]);
      other[two[1]] = static_cast<Eigen::Index>(two[0]);
    }
    return other;
  }

  void readReflection(const MapReader& map) {
    if (!map.has("symmetric")) {
      return;
    }
    const MapReader pairs_of(map.at("symmetric"), map.key("symmetric"), {"probes", "planes"},
                             "key of symmetric", diagnostics_);
    if (pairs_of.usable()) {
      job_.reflection = Reflection{pairs(pairs_of, "probes", job_.probes),
                                   pairs(pairs_of, "planes", job_.planes)};
    }
  }

  void readTrials(const MapReader& map) {
    constexpr std::size_t kMaxTrials = 10000;
    const std::size_t before = diagnostics_.all().size();
    const auto nodes =
        values_.list(map.at("trials"), map.key("trials"),
                     fmt::format("a list of 1 to {} runs", kMaxTrials), 1, kMaxTrials);
    std::vector<bool> tried(job_.planes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const MapReader run(nodes[i], fmt::format("{}[{}]", map.key("trials"), i),
                          {"plane", "mass_radius", "angle", "left_in", "readings"},
                          "key of a trial run", diagnostics_);
      if (run.usable() && !job_.planes.empty()) {
        readTrial(run, tried);
      }
    }
    const bool sound = diagnostics_.all().size() == before;
    for (std::size_t plane = 0; sound && plane < tried.size(); ++plane) {
      const bool opposite =
          job_.reflection && tried[static_cast<std::size_t>(job_.reflection->planes[plane])];
      if (!tried[plane] && !opposite) {
        diagnostics_.add(map.key("trials"),
                         fmt::format("must have a run with a mass in every plane, found none in {}",
                                     inQuotes(job_.planes[plane])));
      }
    }
  }

  void readTrial(const MapReader& run, std::vector<bool>& tried) {
    const std::vector<std::string>& planes = job_.planes;
    if (!run.has("plane")) {
      diagnostics_.add(run.key("plane"), "missing; must be the name of a plane");
    }
    const auto place = std::find(planes.begin(), planes.end(),
                                 run.choice("plane", planes, "the name of a plane", ""));
    const std::size_t before = diagnostics_.all().size();
    const double size =
        values_.mass(run.at("mass_radius"), run.key("mass_radius"), -BalancingValues::kLargest);
    const double at = values_.angle(run.at("angle"), run.key("angle"));
    const bool left_in =
        run.choice("left_in", {"true", "false"}, "true or false", "false") == "true";
    TrialRun trial{job_.left_in, readings(run, "readings", "")};
    if (place == planes.end()) {
      return;
    }
    const Eigen::Index plane = place - planes.begin();
    trial.masses[plane] += size * std::polar(1.0, at);
    if (left_in) {
      job_.left_in = trial.masses;
    }
    tried[static_cast<std::size_t>(plane)] = true;
    const bool read = diagnostics_.all().size() == before;
    if (read && std::fabs(size) < BalancingValues::kMinMass && run.has("mass_radius")) {
      diagnostics_.add(
          run.key("mass_radius"),
          fmt::format("must be {:g} kg m at least, found {} in plane {}", BalancingValues::kMinMass,
                      shown(run.at("mass_radius")), inQuotes(*place)));
    }
    job_.trials.push_back(trial);
  }

  /// Values under the names of planes.
  template <typename Read>
  void eachPlane(const MapReader& map, const std::string& name, const Read& read) {
    if (!map.has(name) || job_.planes.empty()) {
      return;
    }
    const MapReader of(map.at(name), map.key(name), job_.planes, "plane", diagnostics_);
    for (std::size_t k = 0; of.usable() && k < job_.planes.size(); ++k) {
      if (of.has(job_.planes[k])) {
        read(of.at(job_.planes[k]), of.key(job_.planes[k]), static_cast<Eigen::Index>(k));
      }
    }
  }

  /// A list of angles, or {count: N, first: ANGLE} of places around the plane.
  std::vector<double> placesOf(const YAML::Node& node, const std::string& key) {
    std::vector<double> places;
    if (node.IsMap()) {
      const MapReader evenly(node, key, {"count", "first"}, "key of places", diagnostics_);
      const int count =
          evenly.usable() ? evenly.integer("count", 3, static_cast<int>(kMaxPlaces), 0) : 0;
      const double first = evenly.usable() && evenly.has("first")
                               ? values_.angle(evenly.at("first"), evenly.key("first"))
                               : 0;
      for (int i = 0; i < count; ++i) {
        places.push_back(first + kTwoPi * i / count);
      }
      return places;
    }
    const auto nodes = values_.list(
        node, key,
        fmt::format("{{count: N, first: ANGLE}} or a list of 3 to {} angles in deg", kMaxPlaces), 3,
        kMaxPlaces);
    const std::size_t before = diagnostics_.all().size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      places.push_back(values_.angle(nodes[i], fmt::format("{}[{}]", key, i)));
    }
    try {
      if (!places.empty() && diagnostics_.all().size() == before) {
        static_cast<void>(partsAtPlaces(1.0, places));
      }
    } catch (const InputError& error) {
      diagnostics_.add(key, error.what());
    }
    return places;
  }

  void readTolerance(const MapReader& map) {
    if (!map.has("tolerance")) {
      return;
    }
    const MapReader of(map.at("tolerance"), map.key("tolerance"),
                       {"grade", "mass", "speed", "shares"}, "key of a tolerance", diagnostics_);
    if (!of.usable() || job_.planes.empty()) {
      return;
    }
    constexpr double kLeast = 1.0e-6;
    BalanceTolerance tolerance;
    tolerance.grade = of.numberBetween("grade", kLeast, 1.0e6, "mm/s", std::nullopt);
    tolerance.mass = of.numberBetween("mass", kLeast, 1.0e9, "kg", std::nullopt);
    tolerance.speed = of.numberBetween("speed", kLeast, 1.0e6, "rad/s", std::nullopt);
    const auto planes = static_cast<Eigen::Index>(job_.planes.size());
    tolerance.shares = Eigen::VectorXd::Constant(planes, 1.0 / static_cast<double>(planes));
    if (of.has("shares")) {
      tolerance.shares.setZero();
      const std::size_t before = diagnostics_.all().size();
      eachPlane(of, "shares", [&](const YAML::Node& node, const std::string& key, Eigen::Index k) {
        tolerance.shares[k] = values_.number(node, key, 0.0, 1.0, "a share", "-");
      });
      if (diagnostics_.all().size() == before &&
          std::fabs(tolerance.shares.sum() - 1.0) > kShares) {
        diagnostics_.add(of.key("shares"),
                         fmt::format("must be 1 together, found {:g}", tolerance.shares.sum()));
      }
    }
    job_.tolerance = tolerance;
  }

  Diagnostics diagnostics_;
  BalancingJob job_;
  BalancingValues values_;
};

}  // namespace

BalancingJob readBalancingJob(const YAML::Node& tree, const std::string& source) {
  return JobReader(source).read(tree);
}

BalancingJob readBalancingJob(const std::string& path) {
  return readBalancingJob(
      readYamlFile(path, "a balancing job", "probes, planes, initial and trials"), path);
}

}  // namespace whirl_twin
