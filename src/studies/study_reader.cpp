#include "studies/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "control/speed_profile.h"
#include "messages/checksum.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "monitoring/alarm_settings_reader.h"
#include "scene/built_scene.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/scene_reader.h"
#include "scene/signal_names.h"
#include "scene/yaml_file.h"
#include "studies/design_reader.h"
#include "studies/measure_reader.h"
#include "studies/study.h"
#include "studies/variation_reader.h"

namespace whirl_twin {

namespace {

// Reads the optimization of a study.

constexpr int kMaxEvaluations = 10'000'000;
constexpr int kUsualEvaluations = 500;
constexpr double kUsualTolerance = 1.0e-4;  // of each range

const std::vector<std::string> kMethods{"bobyqa", "cobyla", "crs", "isres"};

bool knowsRequirements(const std::string& method) {
  return method == "cobyla" || method == "isres";
}

class OptimizationReader {
 public:
  OptimizationReader(const YAML::Node& node, Study& study, Diagnostics& diagnostics)
      : map_(node, "optimize",
             {"minimize", "maximize", "over", "method", "evaluations", "tolerance"},
             "key of optimize", diagnostics),
        study_(study),
        diagnostics_(diagnostics) {}

  void read() {
    if (!map_.usable()) {
      return;
    }
    readObjective();
    readNumbers();
    found_.method = map_.choice("method", kMethods, "method", usualMethod());
    if (!study_.requirements.empty() && !knowsRequirements(found_.method)) {
      diagnostics_.add("optimize.method",
                       fmt::format("{} has no requirements: use cobyla, or isres over the whole "
                                   "range",
                                   found_.method));
    }
    if (found_.over.size() == 1 && found_.method == "bobyqa") {
      diagnostics_.add("optimize.method",
                       "bobyqa needs at least two parameters; use cobyla for one");
    }
    found_.evaluations = static_cast<std::uint64_t>(
        map_.integer("evaluations", 1, kMaxEvaluations, kUsualEvaluations));
    found_.tolerance =
        map_.numberBetween("tolerance", 1.0e-12, 0.5, "of each range", kUsualTolerance);
    study_.optimization = found_;
  }

 private:
  void readObjective() {
    if (map_.has("minimize") == map_.has("maximize")) {
      diagnostics_.add("optimize", "must have one of minimize and maximize, with a measure");
      return;
    }
    found_.maximize = map_.has("maximize");
    std::vector<std::string> names;
    for (const Measure& measure : study_.measures) {
      names.push_back(measure.name);
    }
    if (names.empty()) {
      return;  // reported above
    }
    const std::string name =
        map_.choice(found_.maximize ? "maximize" : "minimize", names, "measure", names.front());
    found_.measure =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }

  /// All varied numbers, unless some are named; the others keep their nominal values.
  void readNumbers() {
    std::vector<std::string> paths;
    for (const Variation& variation : study_.vary) {
      paths.push_back(variation.path);
    }
    const YAML::Node list = map_.has("over") ? map_.at("over") : YAML::Node(paths);
    if (!list.IsSequence() || (list.size() == 0 && map_.has("over"))) {
      diagnostics_.add("optimize.over",
                       fmt::format("must be a list of varied parameters, found {}", shown(list)));
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string path = list[i].IsScalar() ? list[i].Scalar() : "";
      const auto place = std::find(paths.begin(), paths.end(), path);
      const auto number = static_cast<std::size_t>(place - paths.begin());
      if (place == paths.end()) {
        diagnostics_.add(fmt::format("optimize.over[{}]", i),
                         fmt::format("must be a varied parameter, found {}{}", shown(list[i]),
                                     hint(path, paths)));
      } else if (std::find(found_.over.begin(), found_.over.end(), number) != found_.over.end()) {
        diagnostics_.add(fmt::format("optimize.over[{}]", i), fmt::format("duplicate: {}", path));
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
        diagnostics_.add(
            "vary." + v.path,
            "must have two different bounds, because optimize varies it: uniform, log_uniform, "
            "relative_half_width or a list");
      } else if (!sought && std::isnan(v.nominal)) {
        diagnostics_.add(
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
  Diagnostics& diagnostics_;
  Optimization found_;
};

/// Reads `optimize` into a study whose variations, measures and requirements have been read; adds
/// errors to the diagnostics.
void readOptimization(const MapReader& map, Study& study, Diagnostics& diagnostics) {
  if (map.has("design")) {
    diagnostics.add("optimize", "must not be given with a design: a study has one of the two");
  }
  OptimizationReader(map.at("optimize"), study, diagnostics).read();
}

constexpr int kMaxInBlock = 1000000;
constexpr std::uint64_t kMaxBlocks = 1000000;  // files of one folder
constexpr std::uint64_t kUsualBlock = 1000;
constexpr std::uint64_t kUsualBlocks = 64;  // for a small study
constexpr int kMaxSeed = 1000000000;
constexpr double kMaxDuration = 1.0e9;  // s

std::string readText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class StudyReader {
 public:
  explicit StudyReader(const std::string& path)
      : folder_(std::filesystem::path(path).parent_path()), diagnostics_(path) {
    study_.source = path;
  }

  Study read(const YAML::Node& tree) {
    const MapReader map(tree, "",
                        {"study", "vary", "design", "run", "measure", "require", "optimize"},
                        "key of a study", diagnostics_);
    if (map.usable()) {
      readScene(map);
      readRun(map);
      const std::size_t before = diagnostics_.all().size();
      if (built_) {
        study_.vary = readVariations(map, built_->scene, numbers_, diagnostics_);
      }
      const bool varied = diagnostics_.all().size() == before;
      if (map.has("design") || !map.has("optimize")) {
        study_.design = readDesign(map, study_.vary, diagnostics_);
      }
      if (built_) {
        readMeasures(map, *built_, study_, diagnostics_);
      }
      // A distribution with an error has no ends.
      if (built_ && varied && map.has("optimize")) {
        readOptimization(map, study_, diagnostics_);
      }
    }
    if (study_.block > 0 && study_.blocks() > kMaxBlocks) {
      diagnostics_.add(
          "study.block",
          fmt::format("must be at least {} for {} points (at most {} blocks), found {}",
                      (study_.points() - 1) / kMaxBlocks + 1, study_.points(), kMaxBlocks,
                      study_.block));
    }
    if (!diagnostics_.all().empty()) {
      throw InputError(errorList(diagnostics_.all(), "\ntwin: "));
    }
    if (study_.block == 0) {
      study_.block = std::clamp(study_.points() / kUsualBlocks, std::uint64_t{1}, kUsualBlock);
    }
    study_.text = readText(study_.source);
    study_.hash = kNoFingerprint;
    for (const std::string& text : {study_.text, study_.scene_text, settings_text_}) {
      study_.hash = fingerprint(text.data(), text.size(), study_.hash);
    }
    return study_;
  }

 private:
  void readScene(const MapReader& map) {
    if (!map.has("study")) {
      diagnostics_.add("study", "missing; must be a map with the scene: study: {scene: FILE.yaml}");
      return;
    }
    const MapReader study(map.at("study"), "study", {"scene", "seed", "block", "on_failure"},
                          "key of study", diagnostics_);
    if (!study.usable()) {
      return;
    }
    study_.seed = static_cast<std::uint32_t>(study.integer("seed", 0, kMaxSeed, 1));
    study_.block = study.has("block")
                       ? static_cast<std::uint64_t>(study.integer("block", 1, kMaxInBlock, 1))
                       : 0;
    study_.stop_at_failure = study.choice("on_failure", {"record", "stop"},
                                          "the reaction to a failed point", "record") == "stop";
    const std::string scene = study.text("scene", "");
    if (scene.empty()) {
      if (!study.has("scene")) {
        diagnostics_.add("study.scene", "missing; must be the file of a scene");
      }
      return;
    }
    study_.scene_path = (folder_ / scene).lexically_normal().string();
    try {
      const Scene read = readSceneFile(study_.scene_path);
      study_.scene_text = readText(study_.scene_path);
      built_ = build(read);
      const YAML::Node tree =
          separated(readYamlText(study_.scene_text, study_.scene_path, "a scene", "a step"));
      numbers_ = numbersOf(tree, built_->scene);
    } catch (const InputError& error) {  // one line per error, with its place
      diagnostics_.add("study.scene", error.what());
    }
  }

  void readRun(const MapReader& map) {
    if (!map.has("run")) {
      diagnostics_.add("run", "missing; must be {duration: S}, analyze or both");
      return;
    }
    if (map.at("run").IsScalar() && map.at("run").Scalar() == "analyze") {
      return;
    }
    const MapReader run(map.at("run"), "run", {"duration", "analyze", "speed", "alarms"},
                        "key of run", diagnostics_);
    if (!run.usable()) {
      return;
    }
    if (run.has("duration")) {
      study_.duration = run.numberBetween("duration", 0.0, kMaxDuration, "s", std::nullopt);
    } else if (!run.has("analyze")) {
      diagnostics_.add("run", "must be {duration: S}, analyze or both");
    }
    if (run.has("analyze")) {
      readAnalyses(run.at("analyze"));
    }
    if (run.has("alarms")) {
      readAlarms(run.text("alarms", ""));
    }
    if (run.has("speed")) {
      study_.speed = run.numberBetween("speed", -kMaxSpeed, kMaxSpeed, "rad/s", std::nullopt);
    }
  }

  /// Reads the file of the monitor's settings.
  void readAlarms(const std::string& file) {
    if (!built_ || file.empty()) {
      return;
    }
    const std::string path = (folder_ / file).lexically_normal().string();
    std::vector<std::string> rotors;
    std::vector<std::string> stations;
    for (const SharedSystem& system : built_->systems) {
      if (system->dynamics->isRotor()) {
        rotors.push_back(system->spec.name);
        const auto published = publishedStations(system->spec.name, *system->dynamics);
        stations.insert(stations.end(), published.begin() + 1, published.end());
      }
    }
    try {
      study_.alarms = readAlarmSettings(readYamlFile(path, "settings of the monitor", "alarms"),
                                        path, rotors, {}, stations);
      settings_text_ = readText(path);
    } catch (const InputError& error) {
      diagnostics_.add("run.alarms", error.what());
    }
  }

  /// Checks only: the measures determine what is analysed.
  void readAnalyses(const YAML::Node& list) {
    static const std::vector<std::string> known{"critical_speeds", "margins",
                                                "stability",       "natural_frequencies",
                                                "damping_ratios",  "separation"};
    if (list.IsScalar() && list.Scalar() == "true") {
      return;
    }
    if (!list.IsSequence() || list.size() == 0) {
      diagnostics_.add("run.analyze",
                       fmt::format("must be true or a list of analyses, found {}", shown(list)));
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string name = list[i].IsScalar() ? list[i].Scalar() : "";
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        diagnostics_.add(fmt::format("run.analyze[{}]", i),
                         fmt::format("unknown analysis {}{}", shown(list[i]), hint(name, known)));
      }
    }
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
  Study study_;
  std::string settings_text_;  // of the monitor's file, if any
  std::optional<BuiltScene> built_;
  std::map<std::string, NamedNumber> numbers_;
};

}  // namespace

Study readStudy(const std::string& path) {
  const YAML::Node tree = readYamlFile(path, "a study", "study, vary, design, run and measure");
  try {
    return StudyReader(path).read(tree);
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}: not a study: {}", path, printable(error.what())));
  }
}

}  // namespace whirl_twin
