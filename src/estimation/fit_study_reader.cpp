#include "estimation/fit_study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "estimation/run_units.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "models/model_registry.h"
#include "scene/built_scene.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/parameter_paths.h"
#include "scene/part_of_scene.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxRuns = 1000;
constexpr double kMinWindow = 0.01;   // s
constexpr double kMaxWindow = 1.0e5;  // s

class StudyReader {
 public:
  StudyReader(const std::string& path, bool validate_only, const RunReader& read)
      : folder_(std::filesystem::path(path).parent_path()), diagnostics_(path), read_(read) {
    study_.source = path;
    study_.validate_only = validate_only;
  }

  FitStudy read(const YAML::Node& tree) {
    const MapReader map(tree, "", {"scene", "system", "runs", "windows", "fit", "huber"},
                        "key of a study", diagnostics_);
    if (map.usable()) {
      readSystem(map);
      readWindows(map);
      if (built_) {
        readRuns(map);
        readFit(map);
      }
      if (map.has("huber")) {
        study_.huber = map.number("huber", Range::kPositive, "deviations", 1.0);
      }
    }
    if (!diagnostics_.all().empty()) {
      throw InputError(errorList(diagnostics_.all(), "\ntwin: "));
    }
    return study_;
  }

 private:
  void readSystem(const MapReader& map) {
    for (const char* key : {"scene", "system"}) {
      if (!map.has(key)) {
        diagnostics_.add(map.key(key), fmt::format("missing; must be {}",
                                                   std::string(key) == "scene"
                                                       ? "the file of a scene"
                                                       : "the name of one of its systems"));
      }
    }
    const std::string scene = map.text("scene", "");
    study_.system = map.text("system", "");
    if (scene.empty()) {
      return;
    }
    study_.scene_path = (folder_ / scene).string();
    Scene all = readSceneFile(study_.scene_path);  // reports all its errors
    std::vector<std::string> names;
    for (const SystemSpec& system : all.systems) {
      names.push_back(system.name);
    }
    const auto place = std::find(names.begin(), names.end(), study_.system);
    if (place == names.end()) {
      if (!study_.system.empty()) {
        diagnostics_.add(map.key("system"),
                         fmt::format("the scene has no {}{}", whirl_twin::inQuotes(study_.system),
                                     hint(study_.system, names)));
      }
      return;
    }
    SystemSpec system = all.systems[static_cast<std::size_t>(place - names.begin())];
    const std::size_t drive = all.driveOf(system);
    if (system.ensemble.count > 0) {
      diagnostics_.add(map.key("system"),
                       "must not be an ensemble: remove count to fit the nominal system");
      return;
    }
    if (drive < all.drives.size() && all.drives[drive].motor) {
      diagnostics_.add(map.key("system"),
                       "must not be driven by a motor: use a drive or a constant speed");
      return;
    }
    // The outputs of its controllers are measured inputs, or there were none.
    all = partOf(all, {static_cast<std::size_t>(place - names.begin())});
    all.controllers.clear();
    all.systems = {std::move(system)};
    study_.scene = std::move(all);
    built_ = build(study_.scene).systems.front();
  }

  void readWindows(const MapReader& map) {
    if (!map.has("windows")) {
      return;
    }
    const MapReader windows(map.at("windows"), map.key("windows"), {"length", "start"},
                            "key of windows", diagnostics_);
    if (!windows.usable()) {
      return;
    }
    study_.start_estimated =
        windows.choice("start", {"estimated", "measured"}, "the source of a window's initial state",
                       "estimated") == "estimated";
    if (windows.has("length") && windows.text("length", "") == "all") {
      study_.window = std::numeric_limits<double>::infinity();
    } else if (windows.has("length")) {
      const auto number = parseQuantity(windows.text("length", ""), "s");
      if (!number || *number < kMinWindow || *number > kMaxWindow) {
        diagnostics_.add(
            windows.key("length"),
            fmt::format("must be from {:g} to {:g} s, or `all`, found {}{}", kMinWindow, kMaxWindow,
                        shown(windows.at("length")), unitDiagnostic(windows.at("length"), "s")));
      } else {
        study_.window = *number;
      }
    }
  }

  void readRuns(const MapReader& map) {
    const YAML::Node runs = map.at("runs");
    if (!runs.IsDefined() || !runs.IsSequence() || runs.size() == 0 || runs.size() > kMaxRuns) {
      diagnostics_.add(
          map.key("runs"),
          fmt::format("must be a list of 1 to {} runs, found {}", kMaxRuns,
                      runs.IsDefined() && runs.IsSequence() ? fmt::format("{} entries", runs.size())
                                                            : shown(runs)));
      return;
    }
    std::set<std::string> files;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      std::vector<std::string> keys = {"file", "use", "measured", "inputs"};
      keys.insert(keys.end(), tableKeys().begin(), tableKeys().end());
      const MapReader run(runs[i], fmt::format("{}[{}]", map.key("runs"), i), keys, "key of a run",
                          diagnostics_);
      if (run.usable()) {
        readRun(run, files);
      }
    }
    const bool any = std::any_of(study_.runs.begin(), study_.runs.end(),
                                 [](const StudyRun& run) { return run.train; });
    if (!any && !study_.validate_only && study_.runs.size() == runs.size()) {
      diagnostics_.add(map.key("runs"),
                       "must have a run with `use: train`, or be called with --validate-only");
    }
  }

  void readRun(const MapReader& map, std::set<std::string>& files) {
    const std::size_t before = diagnostics_.all().size();
    StudyRun run;
    run.file = map.text("file", "");
    if (run.file.empty()) {
      diagnostics_.add(
          map.key("file"),
          "missing; must be a table of measurements, a UFF file, an LCM log or a rosbag");
    } else if (!files.insert(run.file).second) {
      diagnostics_.add(map.key("file"), fmt::format("duplicate: {} is already in the list",
                                                    whirl_twin::inQuotes(run.file)));
    }
    run.train = map.choice("use", {"train", "validate"}, "the use of a run", "train") == "train";
    std::vector<WantedColumn> columns;
    readMeasured(map, run, columns);
    readInputs(map, run, columns);
    const TableSettings table = readTableSettings(map, diagnostics_);
    if (diagnostics_.all().size() != before) {
      return;
    }
    try {
      run.data = read_((folder_ / run.file).string(), table, columns);
      settleUnits(run, built_->dynamics->inputs(), study_.scene.stepSeconds());
      if (!study_.validate_only) {
        requireUse(run, study_.window);
      }
      study_.runs.push_back(std::move(run));
    } catch (const InputError& error) {
      diagnostics_.add(map.key("file"), fmt::format("{}: {}", printable(run.file), error.what()));
    }
  }

  void readMeasured(const MapReader& map, StudyRun& run, std::vector<WantedColumn>& columns) {
    std::vector<std::string> known, units;
    for (const bool rate : {false, true}) {
      for (const CoordinateInfo& c : built_->dynamics->coordinates()) {
        known.push_back(rate ? c.name + "_rate" : c.name);
        units.push_back(rate ? c.unit + "/s" : c.unit);
      }
    }
    const MapReader measured(map.at("measured"), map.key("measured"), known,
                             "coordinate or rate of the system", diagnostics_);
    if (!measured.usable()) {
      return;
    }
    if (measured.names().empty()) {
      diagnostics_.add(map.key("measured"), "must name a coordinate and its column");
    }
    for (const std::string& name : measured.names()) {
      const auto place = std::find(known.begin(), known.end(), name);
      if (place == known.end()) {
        continue;  // reported above
      }
      MeasuredChannel channel;
      channel.name = name;
      channel.state = static_cast<std::size_t>(place - known.begin());
      channel.unit = units[channel.state];
      if (const auto entry = column(
              measured, name, {"column", "offset", "scale", "deviation", "wrap"}, channel.column)) {
        channel.offset = givenOrFitted(*entry, "offset", channel.unit, 0.0);
        channel.scale = givenOrFitted(*entry, "scale", "-", 1.0);
        requireScale(*entry, channel.scale);
        channel.deviation = entry->number("deviation", Range::kPositive, channel.unit, 1.0);
        if (entry->has("wrap")) {
          channel.wrap =
              entry->choice("wrap", {"true", "false"}, "true or false", "true") == "true";
          if (channel.unit != "rad") {
            diagnostics_.add(entry->key("wrap"), "needs an angle");
          }
        }
      }
      add(columns, {channel.column});
      run.measured.push_back(channel);
    }
  }

  void readInputs(const MapReader& map, StudyRun& run, std::vector<WantedColumn>& columns) {
    if (!map.has("inputs")) {
      return;
    }
    std::vector<std::string> known;
    for (const InputInfo& input : built_->dynamics->inputs()) {
      known.push_back(input.name);
    }
    const MapReader inputs(map.at("inputs"), map.key("inputs"), known, "input of the system",
                           diagnostics_);
    if (!inputs.usable()) {
      return;
    }
    for (const std::string& name : inputs.names()) {
      const auto place = std::find(known.begin(), known.end(), name);
      if (place == known.end()) {
        if (known.empty()) {
          diagnostics_.add(inputs.key(name), "the system has no inputs");
        }
        continue;
      }
      MeasuredInput input;
      input.name = name;
      input.place = static_cast<std::size_t>(place - known.begin());
      if (const auto entry =
              column(inputs, name, {"column", "offset", "scale", "delay", "hold"}, input.column)) {
        const std::string& unit = built_->dynamics->inputs()[input.place].unit;
        input.offset = givenOrFitted(*entry, "offset", unit, 0.0);
        input.scale = givenOrFitted(*entry, "scale", "-", 1.0);
        requireScale(*entry, input.scale);
        input.delay = givenOrFitted(*entry, "delay", "s", 0.0);
        if (std::fabs(input.delay.value) > kMaxInputDelay) {
          diagnostics_.add(entry->key("delay"),
                           fmt::format("must be within {:g} s", kMaxInputDelay));
        }
        input.hold = entry->choice("hold", {"true", "false"}, "true or false", "false") == "true";
      }
      add(columns,
          {input.column, input.hold ? WantedColumn::Gap::kHeld : WantedColumn::Gap::kInterpolated});
      run.inputs.push_back(input);
    }
  }

  /// A column given by its name, or by a map with more settings; returns the map, if any.
  std::optional<MapReader> column(const MapReader& map, const std::string& name,
                                  const std::vector<std::string>& known, std::string& column) {
    const YAML::Node node = map.at(name);
    if (node.IsScalar()) {
      column = node.Scalar();
    } else {
      const MapReader entry(node, map.key(name), known, "key of a column", diagnostics_);
      if (!entry.usable()) {
        return std::nullopt;
      }
      column = entry.text("column", "");
      if (column.empty()) {
        diagnostics_.add(entry.key("column"), "missing; must be the name of a column");
      }
      return entry;
    }
    if (column.empty()) {
      diagnostics_.add(map.key(name), "must be the name of a column");
    }
    return std::nullopt;
  }

  GivenOrFitted givenOrFitted(const MapReader& map, const std::string& name,
                              const std::string& unit, double fallback) {
    if (!map.has(name)) {
      return {fallback, false};
    }
    for (const char* word : {"fit", "each_run"}) {
      if (map.at(name).IsScalar() && map.at(name).Scalar() == word) {
        return {fallback, true, std::string(word) == "each_run"};
      }
    }
    const auto number =
        map.at(name).IsScalar() ? parseQuantity(map.at(name).Scalar(), unit) : std::nullopt;
    if (!number) {
      diagnostics_.add(map.key(name),
                       fmt::format("must be a finite number of {}, `fit` or `each_run`, found {}{}",
                                   unit, shown(map.at(name)), unitDiagnostic(map.at(name), unit)));
      return {fallback, false};
    }
    return {*number, false};
  }

  void requireScale(const MapReader& map, const GivenOrFitted& scale) {
    if (!(scale.value > 0.0)) {
      diagnostics_.add(map.key("scale"), "must be > 0");
    }
  }

  static void add(std::vector<WantedColumn>& columns, const WantedColumn& column) {
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const WantedColumn& other) { return other.name == column.name; })) {
      columns.push_back(column);
    }
  }

  void readFit(const MapReader& map) {
    const state::ParameterChange parameters = built_->parameters();
    if (!map.has("fit")) {
      if (!study_.validate_only) {
        diagnostics_.add(map.key("fit"), "missing; must name the parameters to fit");
      }
      return;
    }
    const MapReader fit(map.at("fit"), map.key("fit"), parameters.names, "parameter of the system",
                        diagnostics_);
    if (!fit.usable()) {
      return;
    }
    for (const std::string& path : fit.names()) {
      const std::optional<double> start = built_->parameter(path);
      if (!start) {
        continue;  // reported above
      }
      FittedParameter parameter;
      parameter.path = path;
      parameter.start = *start;
      const YAML::Node node = fit.at(path);
      if (!node.IsNull()) {
        const MapReader bounds(node, fit.key(path), {"min", "max", "start"},
                               "key of a parameter to fit", diagnostics_);
        if (!bounds.usable()) {
          continue;
        }
        const std::string unit = unitAt(path, *findModel(built_->spec.model), built_->spec);
        parameter.least = bounds.number("min", Range::kAny, unit, parameter.least);
        parameter.most = bounds.number("max", Range::kAny, unit, parameter.most);
        parameter.start = bounds.number("start", Range::kAny, unit, parameter.start);
        if (!(parameter.least < parameter.most)) {
          diagnostics_.add(fit.key(path), "min must be < max");
        } else if (parameter.start < parameter.least || parameter.start > parameter.most) {
          diagnostics_.add(fit.key(path),
                           fmt::format("must start within its bounds {1:g} to {2:g}, found {0:g}",
                                       parameter.start, parameter.least, parameter.most));
        }
      }
      study_.fit.push_back(parameter);
    }
    const bool sensors = std::any_of(study_.runs.begin(), study_.runs.end(), [](const auto& run) {
      return std::any_of(run.measured.begin(), run.measured.end(),
                         [](const auto& c) { return c.offset.fitted || c.scale.fitted; });
    });
    if (study_.fit.empty() && !sensors && !study_.validate_only && fit.names().empty()) {
      diagnostics_.add(map.key("fit"),
                       "must name a parameter to fit, or be called with --validate-only");
    }
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
  const RunReader& read_;
  FitStudy study_;
  SharedSystem built_;
};

}  // namespace

FitStudy readFitStudy(const std::string& path, bool validate_only, const RunReader& read) {
  const YAML::Node tree = readYamlFile(path, "a study", "scene, system, runs and fit");
  return StudyReader(path, validate_only, read).read(tree);
}

}  // namespace whirl_twin
