#include "studies/optimization_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace whirl_twin {

namespace {

constexpr int kMostEvaluations = 10'000'000;
constexpr int kUsualEvaluations = 500;
constexpr double kUsualTolerance = 1.0e-4;  // of each range

const std::vector<std::string> kMethods{"bobyqa", "cobyla", "crs", "isres"};

bool knowsRequirements(const std::string& method) {
  return method == "cobyla" || method == "isres";
}

class OptimizationReader {
 public:
  OptimizationReader(const YAML::Node& node, Study& study, Complaints& complaints)
      : map_(node, "optimize",
             {"minimize", "maximize", "over", "method", "evaluations", "tolerance"},
             "key of optimize", complaints),
        study_(study),
        complaints_(complaints) {}

  void read() {
    if (!map_.usable()) {
      return;
    }
    readObjective();
    readNumbers();
    found_.method = map_.choice("method", kMethods, "method", usualMethod());
    if (!study_.requirements.empty() && !knowsRequirements(found_.method)) {
      complaints_.add("optimize.method",
                      fmt::format("{} has no requirements: use cobyla, or isres over the whole "
                                  "range",
                                  found_.method));
    }
    if (found_.over.size() == 1 && found_.method == "bobyqa") {
      complaints_.add("optimize.method",
                      "bobyqa needs at least two parameters; use cobyla for one");
    }
    found_.evaluations = static_cast<std::uint64_t>(
        map_.integer("evaluations", 1, kMostEvaluations, kUsualEvaluations));
    found_.tolerance =
        map_.numberBetween("tolerance", 1.0e-12, 0.5, "of each range", kUsualTolerance);
    study_.optimization = found_;
  }

 private:
  void readObjective() {
    if (map_.has("minimize") == map_.has("maximize")) {
      complaints_.add("optimize", "must have one of minimize and maximize, with a measure");
      return;
    }
    found_.maximize = map_.has("maximize");
    std::vector<std::string> names;
    for (const Measure& measure : study_.measures) {
      names.push_back(measure.name);
    }
    if (names.empty()) {
      return;  // which has been complained of
    }
    const std::string name =
        map_.choice(found_.maximize ? "maximize" : "minimize", names, "measure", names.front());
    found_.measure =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }

  /// All that varies, unless some are named; the others stay as the scene has them.
  void readNumbers() {
    std::vector<std::string> paths;
    for (const Variation& variation : study_.vary) {
      paths.push_back(variation.path);
    }
    const YAML::Node list = map_.has("over") ? map_.at("over") : YAML::Node(paths);
    if (!list.IsSequence() || (list.size() == 0 && map_.has("over"))) {
      complaints_.add("optimize.over",
                      fmt::format("must be a list of varied parameters, found {}", shown(list)));
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string path = list[i].IsScalar() ? list[i].Scalar() : "";
      const auto place = std::find(paths.begin(), paths.end(), path);
      const auto number = static_cast<std::size_t>(place - paths.begin());
      if (place == paths.end()) {
        complaints_.add(fmt::format("optimize.over[{}]", i),
                        fmt::format("must be a varied parameter, found {}{}", shown(list[i]),
                                    hint(path, paths)));
      } else if (std::find(found_.over.begin(), found_.over.end(), number) != found_.over.end()) {
        complaints_.add(fmt::format("optimize.over[{}]", i), fmt::format("duplicate: {}", path));
      } else {
        found_.over.push_back(number);
      }
    }
    for (std::size_t j = 0; j < study_.vary.size(); ++j) {
      const Variation& v = study_.vary[j];
      const bool sought = std::find(found_.over.begin(), found_.over.end(), j) != found_.over.end();
      const double low = v.distribution.smallest();
      const double high = v.distribution.largest();
      if (sought && !(std::isfinite(low) && std::isfinite(high) && low < high)) {
        complaints_.add("vary." + v.path,
                        "must have bounds: uniform, log_uniform, relative_half_width or a list");
      } else if (!sought && std::isnan(v.nominal)) {
        complaints_.add(
            "vary." + v.path,
            "differs from move to move: name one move of the drive, or list it under optimize");
      }
    }
  }

  std::string usualMethod() const {
    return study_.requirements.empty() && found_.over.size() > 1 ? "bobyqa" : "cobyla";
  }

  MapReader map_;
  Study& study_;
  Complaints& complaints_;
  Optimization found_;
};

}  // namespace

void readOptimization(const MapReader& map, Study& study, Complaints& complaints) {
  if (map.has("design")) {
    complaints.add("optimize", "must not be given with a design: a study has one of the two");
  }
  OptimizationReader(map.at("optimize"), study, complaints).read();
}

}  // namespace whirl_twin
