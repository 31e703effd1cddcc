#include "studies/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "control/speed_profile.h"
#include "messages/names.h"
#include "messages/refusal.h"
#include "models/model_registry.h"
#include "scene/built_scene.h"
#include "scene/node_reader.h"
#include "scene/parameter_paths.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"
#include "studies/analysed_numbers.h"
#include "studies/published_quantities.h"

namespace whirl_twin {

namespace {

constexpr double kMostPoints = 1.0e12;
constexpr int kMostInBlock = 1000000;
constexpr std::uint64_t kUsualBlock = 1000;
constexpr std::uint64_t kUsualBlocks = 64;  // that a small study is divided into
constexpr int kLargestSeed = 1000000000;
constexpr double kLongestDuration = 1.0e9;    // s
constexpr std::size_t kMostEntries = 100000;  // of a list
constexpr int kUsualMorrisLevels = 4;

std::string contentsOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// FNV-1a (Fowler, Noll & Vo): tells texts apart, and keeps no secret.
std::uint64_t hashOf(const std::string& text, std::uint64_t hash = 14695981039346656037U) {
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  }
  return hash;
}

bool isTimed(const Study& study) {
  return std::any_of(study.measures.begin(), study.measures.end(), [](const Measure& measure) {
    const auto& leaves = measure.expression.leaves();
    return std::any_of(leaves.begin(), leaves.end(),
                       [](const ExpressionLeaf& leaf) { return !leaf.reduction.empty(); });
  });
}

class StudyReader {
 public:
  explicit StudyReader(const std::string& path)
      : folder_(std::filesystem::path(path).parent_path()), complaints_(path) {
    study_.source = path;
  }

  Study read(const YAML::Node& tree) {
    const MapReader map(tree, "", {"study", "vary", "design", "run", "measure", "require"},
                        "key of a study", complaints_);
    if (map.usable()) {
      readScene(map);
      readRun(map);
      if (built_) {
        readVary(map);
        readMeasures(map);
      }
      readDesign(map);
      if (built_) {
        readRequirements(map);
      }
    }
    if (!complaints_.all().empty()) {
      throw Refusal(fmt::format("{}", fmt::join(complaints_.all(), "\ntwin: ")));
    }
    if (study_.block == 0) {
      study_.block = std::clamp(study_.points() / kUsualBlocks, std::uint64_t{1}, kUsualBlock);
    }
    study_.text = contentsOf(study_.source);
    study_.hash = hashOf(study_.scene_text, hashOf(study_.text));
    return study_;
  }

 private:
  void readScene(const MapReader& map) {
    if (!map.has("study")) {
      complaints_.add("study", "missing; must be a map with the scene: study: {scene: FILE.yaml}");
      return;
    }
    const MapReader study(map.at("study"), "study", {"scene", "seed", "block", "on_failure"},
                          "key of study", complaints_);
    if (!study.usable()) {
      return;
    }
    study_.seed = static_cast<std::uint32_t>(study.integer("seed", 0, kLargestSeed, 1));
    study_.block = study.has("block")
                       ? static_cast<std::uint64_t>(study.integer("block", 1, kMostInBlock, 1))
                       : 0;
    study_.stop_at_failure = study.choice("on_failure", {"record", "stop"},
                                          "what a failed point does", "record") == "stop";
    const std::string scene = study.text("scene", "");
    if (scene.empty()) {
      if (!study.has("scene")) {
        complaints_.add("study.scene", "missing; must be the file of a scene");
      }
      return;
    }
    study_.scene_path = (folder_ / scene).lexically_normal().string();
    try {
      const Scene read = readSceneFile(study_.scene_path);
      study_.scene_text = contentsOf(study_.scene_path);
      built_ = build(read);
      const YAML::Node tree =
          separated(readYamlText(study_.scene_text, study_.scene_path, "a scene", "a step"));
      numbers_ = numbersOf(tree, built_->scene);
    } catch (const Refusal& error) {  // each of its errors is a line, with its own place
      complaints_.add("study.scene", error.what());
    }
  }

  void readRun(const MapReader& map) {
    if (!map.has("run")) {
      complaints_.add("run", "missing; must be {duration: S} or analyze, or have both");
      return;
    }
    if (map.at("run").IsScalar() && map.at("run").Scalar() == "analyze") {
      return;
    }
    const MapReader run(map.at("run"), "run", {"duration", "analyze", "speed"}, "key of run",
                        complaints_);
    if (!run.usable()) {
      return;
    }
    if (run.has("duration")) {
      study_.duration = run.numberBetween("duration", 0.0, kLongestDuration, "s", std::nullopt);
    } else if (!run.has("analyze")) {
      complaints_.add("run", "must be {duration: S} or analyze, or have both");
    }
    if (run.has("analyze")) {
      readAnalyses(run.at("analyze"));
    }
    if (run.has("speed")) {
      study_.speed =
          run.numberBetween("speed", -kLargestSpeed, kLargestSpeed, "rad/s", std::nullopt);
    }
  }

  /// For the reader: what is measured tells what is analysed.
  void readAnalyses(const YAML::Node& list) {
    static const std::vector<std::string> known{"critical_speeds", "margins",
                                                "stability",       "natural_frequencies",
                                                "damping_ratios",  "separation"};
    if (list.IsScalar() && list.Scalar() == "true") {
      return;
    }
    if (!list.IsSequence() || list.size() == 0) {
      complaints_.add("run.analyze",
                      fmt::format("must be true or a list of analyses, found {}", shown(list)));
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string name = list[i].IsScalar() ? list[i].Scalar() : "";
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        complaints_.add(fmt::format("run.analyze[{}]", i),
                        fmt::format("unknown analysis {}{}", shown(list[i]), hint(name, known)));
      }
    }
  }

  void readVary(const MapReader& map) {
    if (!map.has("vary")) {
      complaints_.add("vary", "missing; must name the numbers of the scene that vary");
      return;
    }
    const MapReader vary(map.at("vary"), "vary", {}, "", complaints_);
    if (vary.usable() && vary.names().empty()) {
      complaints_.add("vary", "must name a number of the scene that varies");
    }
    std::map<std::string, std::string> taken;
    for (const std::string& path : vary.names()) {
      const auto found = numbers_.find(path);
      if (found == numbers_.end()) {
        complaints_.add(vary.key(path), objectionToPath(path));
        continue;
      }
      Variation variation;
      variation.path = path;
      variation.places = found->second.places;
      variation.unit = found->second.unit;
      variation.nominal = found->second.value;
      for (const SceneNumber& place : variation.places) {
        const auto [other, first] = taken.emplace(keyOf(place), path);
        if (!first) {
          complaints_.add(vary.key(path), fmt::format("varies {}, which {} does already",
                                                      keyOf(place), other->second));
        }
      }
      if (readDistribution(vary.at(path), vary.key(path), variation)) {
        checkRange(vary.key(path), found->second, variation.distribution);
      }
      study_.vary.push_back(variation);
    }
  }

  static std::string keyOf(const SceneNumber& place) {
    std::string key;
    for (const auto& part : place) {
      const auto* const name = std::get_if<std::string>(&part);
      key += name == nullptr ? fmt::format("[{}]", std::get<std::size_t>(part))
                             : (key.empty() ? "" : ".") + *name;
    }
    return key;
  }

  /// Why there is no such number; the nearest that there is.
  std::string objectionToPath(const std::string& path) const {
    // Another row of a list that is there: said as what it is.
    const std::size_t open = path.find('[');
    const std::size_t close = path.find(']');
    if (open != std::string::npos && close != std::string::npos && open < close) {
      std::size_t rows = 0;
      while (hasBelow(fmt::format("{}[{}]", path.substr(0, open), rows))) {
        ++rows;
      }
      if (rows > 0 && !hasBelow(path.substr(0, close + 1))) {
        return fmt::format("there are {} rows, counted from 0", rows);
      }
    }
    if (hasBelow(path)) {
      return "is not one number: name one below it, such as " + firstBelow(path);
    }
    std::vector<std::string> names;
    for (const auto& [name, number] : numbers_) {
      names.push_back(name);
    }
    const std::string near = nearestName(path, names);
    return fmt::format("is no number of the scene{}",
                       near.empty() ? "; a path is SYSTEM.PARAMETER, SYSTEM.initial.COORDINATE, "
                                      "DRIVE.speed or a full key of the scene's file"
                                    : fmt::format("; did you mean '{}'?", near));
  }
  std::string firstBelow(const std::string& path) const {
    const auto found = numbers_.lower_bound(path);
    for (auto it = found; it != numbers_.end() && it->first.compare(0, path.size(), path) == 0;
         ++it) {
      const char next = it->first.size() > path.size() ? it->first[path.size()] : '\0';
      if (next == '.' || next == '[') {
        return it->first;
      }
    }
    return "";
  }
  bool hasBelow(const std::string& path) const { return !firstBelow(path).empty(); }

  /// The numbers of a list. Complains of any that is none.
  std::vector<double> numbersIn(const YAML::Node& list, const std::string& key, std::size_t least,
                                std::size_t most, const std::string& what) {
    std::vector<double> numbers;
    if (!list.IsSequence() || list.size() < least || list.size() > most) {
      complaints_.add(key, fmt::format("must be {}, found {}", what,
                                       list.IsSequence() ? fmt::format("{} entries", list.size())
                                                         : shown(list)));
      return {};
    }
    bool good = true;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto number = list[i].IsScalar() ? parseNumber(list[i].Scalar()) : std::nullopt;
      if (!number) {
        complaints_.add(fmt::format("{}[{}]", key, i),
                        fmt::format("must be a finite number, found {}", shown(list[i])));
        good = false;
      }
      numbers.push_back(number.value_or(0.0));
    }
    return good ? numbers : std::vector<double>();
  }

  /// False where a complaint was added.
  bool readDistribution(const YAML::Node& node, const std::string& key, Variation& variation) {
    const std::size_t before = complaints_.all().size();
    static const std::vector<std::string> kinds{"uniform",
                                                "log_uniform",
                                                "normal",
                                                "grid",
                                                "list",
                                                "relative_half_width",
                                                "relative_standard_deviation"};
    const MapReader map(node, key, kinds, "distribution", complaints_);
    if (!map.usable()) {
      return false;
    }
    if (map.names().size() != 1) {
      if (complaints_.all().size() == before) {
        complaints_.add(key, fmt::format("must be one of {}", fmt::join(kinds, ", ")));
      }
      return false;
    }
    const std::string kind = map.names().front();
    Distribution& d = variation.distribution;
    if (kind == "uniform" || kind == "log_uniform") {
      d.kind = kind == "uniform" ? Distribution::Kind::kUniform : Distribution::Kind::kLogUniform;
      readInterval(map.at(kind), map.key(kind), d);
    } else if (kind == "normal") {
      d.kind = Distribution::Kind::kNormal;
      const auto pair = numbersIn(map.at(kind), map.key(kind), 2, 2, "[mean, standard deviation]");
      if (!pair.empty()) {
        d.mean = pair[0];
        d.deviation = pair[1];
        if (!(d.deviation > 0.0)) {
          complaints_.add(map.key(kind),
                          fmt::format("the standard deviation must be > 0, found {}", pair[1]));
        }
      }
    } else if (kind == "grid" || kind == "list") {
      d.kind = Distribution::Kind::kList;
      d.list = numbersIn(map.at(kind), map.key(kind), 1, kMostEntries,
                         fmt::format("a list of 1 to {} numbers", kMostEntries));
    } else {
      readRelative(map, kind, variation);
    }
    return complaints_.all().size() == before;
  }

  void readInterval(const YAML::Node& node, const std::string& key, Distribution& d) {
    const auto pair = numbersIn(node, key, 2, 2, "[lowest, highest]");
    if (pair.empty()) {
      return;
    }
    d.low = pair[0];
    d.high = pair[1];
    if (!(d.low < d.high) || !std::isfinite(d.high - d.low)) {
      complaints_.add(key, fmt::format("must be [lowest, highest], found [{}, {}]", d.low, d.high));
    } else if (d.kind == Distribution::Kind::kLogUniform && !(d.low > 0.0)) {
      complaints_.add(key, fmt::format("must be > 0 to vary by its logarithm, found {}", d.low));
    }
  }

  void readRelative(const MapReader& map, const std::string& kind, Variation& variation) {
    const double part = map.number(kind, Range::kPositive, "-", std::nullopt);
    const double width = part * std::fabs(variation.nominal);
    Distribution& d = variation.distribution;
    if (variation.nominal == 0.0) {
      complaints_.add(map.key(kind), "the scene gives 0, of which any part is 0: give the width");
    }
    if (variation.places.size() > 1) {
      complaints_.add(map.key(kind),
                      "is one number for all moves: give the values, or name one move");
    }
    if (kind == "relative_half_width") {
      d.kind = Distribution::Kind::kUniform;
      d.low = variation.nominal - width;
      d.high = variation.nominal + width;
    } else {
      d.kind = Distribution::Kind::kNormal;
      d.mean = variation.nominal;
      d.deviation = width;
    }
  }

  /// Ends that the parameter cannot have are no matter of chance.
  void checkRange(const std::string& key, const NamedNumber& number,
                  const Distribution& distribution) {
    if (number.parameter.empty()) {
      return;
    }
    SystemSpec spec = built_->scene.systems[number.system];
    for (const double end : {distribution.smallest(), distribution.largest()}) {
      Complaints said("");
      if (std::isfinite(end) &&
          !setParameter(number.parameter, end, *findModel(spec.model), spec, said)) {
        const std::string& why = said.all().front();
        complaints_.add(key, why.substr(why.rfind(": ") + 2));
        return;
      }
    }
  }

  void readDesign(const MapReader& map) {
    if (!map.has("design")) {
      complaints_.add("design",
                      fmt::format("missing; must be one of {}", fmt::join(designNames(), ", ")));
      return;
    }
    const YAML::Node node = map.at("design");
    Design& design = study_.design;
    design.dimensions = study_.vary.size();
    std::string kind;
    YAML::Node size(YAML::NodeType::Undefined);
    if (node.IsScalar()) {
      kind = node.Scalar();
      if (std::find(designNames().begin(), designNames().end(), kind) == designNames().end()) {
        complaints_.add("design",
                        fmt::format("unknown design {}{}", shown(node), hint(kind, designNames())));
        return;
      }
    } else {
      const MapReader chosen(node, "design", designNames(), "design", complaints_);
      if (!chosen.usable()) {
        return;
      }
      if (chosen.names().size() != 1) {
        if (node.size() != 1) {
          complaints_.add("design", "must be one design");
        }
        return;
      }
      kind = chosen.names().front();
      size = chosen.at(kind);
    }
    design.kind = static_cast<Design::Kind>(
        std::find(designNames().begin(), designNames().end(), kind) - designNames().begin());
    if (study_.vary.empty()) {
      return;
    }
    switch (design.kind) {
      case Design::Kind::kList:
        readListDesign(size);
        break;
      case Design::Kind::kGrid:
      case Design::Kind::kOneAtATime:
        readLevels(kind, size);
        break;
      case Design::Kind::kMorris:
        readMorris(size);
        break;
      default:
        readCount(kind, size);
    }
  }

  /// A whole number of points, runs or levels; nothing with a complaint.
  std::optional<std::uint64_t> whole(const std::string& key, const YAML::Node& node,
                                     const std::string& what, double least, double most) {
    const auto number =
        node.IsDefined() && node.IsScalar() ? parseNumber(node.Scalar()) : std::nullopt;
    if (!number || !(*number >= least) || !(*number <= most) || *number != std::floor(*number)) {
      complaints_.add(key, fmt::format("must be {}, a whole number from {:g} to {:g}, found {}",
                                       what, least, most, shown(node)));
      return std::nullopt;
    }
    return static_cast<std::uint64_t>(*number);
  }

  void readCount(const std::string& kind, const YAML::Node& size) {
    Design& design = study_.design;
    const bool indices = design.kind == Design::Kind::kSobolIndices;
    const auto each = static_cast<double>(indices ? design.dimensions + 2 : 1);
    if (const auto count =
            whole("design." + kind, size, indices ? "how many base points" : "how many points", 1.0,
                  std::floor(kMostPoints / each))) {
      design.base = *count;
      design.points = *count * static_cast<std::uint64_t>(each);
    }
    const std::size_t dimensions = (indices ? 2 : 1) * design.dimensions;
    if ((indices || design.kind == Design::Kind::kSobol) && dimensions > kMostSobolDimensions) {
      complaints_.add("design." + kind, fmt::format("has up to {} dimensions, found {}",
                                                    kMostSobolDimensions, dimensions));
    }
  }

  void readListDesign(const YAML::Node& size) {
    if (size.IsDefined() && !size.IsNull()) {
      complaints_.add("design.list", "takes no number: each number that varies has its list");
    }
    const std::size_t first = study_.vary.front().distribution.list.size();
    for (const Variation& v : study_.vary) {
      if (v.distribution.kind != Distribution::Kind::kList) {
        complaints_.add("vary." + v.path, "must be a list where the design is one");
      } else if (v.distribution.list.size() != first && !v.distribution.list.empty()) {
        complaints_.add("vary." + v.path,
                        fmt::format("must have {} entries, as {} has, found {}", first,
                                    study_.vary.front().path, v.distribution.list.size()));
      }
    }
    study_.design.points = first;
  }

  void readLevels(const std::string& kind, const YAML::Node& size) {
    Design& design = study_.design;
    const bool grid = design.kind == Design::Kind::kGrid;
    const bool lists = std::all_of(study_.vary.begin(), study_.vary.end(), [](const Variation& v) {
      return v.distribution.kind == Distribution::Kind::kList;
    });
    std::uint64_t asked = 1;
    if (size.IsDefined() && !size.IsNull()) {
      const auto number = whole("design." + kind, size, "how many levels", 1.0, 1.0e6);
      if (!number) {
        return;
      }
      asked = *number;
    } else if (!lists) {
      complaints_.add("design",
                      fmt::format("must be {{{}: LEVELS}}: there are numbers that have no "
                                  "list of values",
                                  kind));
      return;
    }
    double points = 1.0;  // one at a time: the scene as it is
    for (const Variation& v : study_.vary) {
      if (!grid && std::isnan(v.nominal)) {
        complaints_.add("vary." + v.path,
                        "differs from move to move: one at a time, name one move of the drive");
      }
      design.levels.push_back(v.distribution.levels(static_cast<std::size_t>(asked)));
      const auto count = static_cast<double>(design.levels.back());
      points = grid ? points * count : points + count;
    }
    if (!(points <= kMostPoints)) {
      complaints_.add("design",
                      fmt::format("has {:g} points, more than {:g}", points, kMostPoints));
      return;
    }
    design.points = static_cast<std::uint64_t>(points);
  }

  void readMorris(const YAML::Node& size) {
    Design& design = study_.design;
    std::optional<std::uint64_t> count;
    std::uint64_t levels = kUsualMorrisLevels;
    const double most = std::floor(kMostPoints / static_cast<double>(design.dimensions + 1));
    if (size.IsDefined() && size.IsMap()) {
      const MapReader map(size, "design.morris", {"trajectories", "levels"}, "key of morris",
                          complaints_);
      count = whole("design.morris.trajectories", map.at("trajectories"), "how many trajectories",
                    1.0, most);
      if (map.has("levels")) {
        levels = whole("design.morris.levels", map.at("levels"), "how many levels", 2.0, 1000.0)
                     .value_or(levels);
      }
    } else {
      count = whole("design.morris", size, "how many trajectories", 1.0, most);
    }
    if (levels % 2 != 0) {
      complaints_.add("design.morris.levels",
                      fmt::format("must be even: a step is half of them, found {}", levels));
    }
    design.levels.assign(1, static_cast<std::size_t>(levels));
    if (count) {
      design.base = *count;
      design.points = *count * (design.dimensions + 1);
    }
    for (const Variation& v : study_.vary) {
      if (v.distribution.kind == Distribution::Kind::kList) {
        complaints_.add("vary." + v.path,
                        "has a list: Morris's steps are half of a range, such as uniform");
      }
    }
  }

  void readMeasures(const MapReader& map) {
    if (!map.has("measure")) {
      complaints_.add("measure",
                      "missing; must name what is measured: {peak: "
                      "max(SYSTEM.whirl.radius)}");
      return;
    }
    const MapReader measures(map.at("measure"), "measure", {}, "", complaints_);
    if (measures.usable() && measures.names().empty()) {
      complaints_.add("measure", "must name something that is measured");
    }
    for (const std::string& name : measures.names()) {
      if (!isLegalName(name)) {
        complaints_.add(measures.key(name),
                        fmt::format("is named by up to {} letters, digits and _, a letter first",
                                    kMaxNameLength));
      }
      const std::string text = measures.text(name, "");
      if (text.empty()) {
        continue;
      }
      try {
        Measure measure{name, text, Expression(text)};
        checkLeaves(measures.key(name), measure.expression);
        study_.measures.push_back(measure);
      } catch (const Refusal& error) {
        complaints_.add(measures.key(name), error.what());
      }
    }
    if (!study_.duration && isTimed(study_) && map.has("run")) {
      complaints_.add("run.duration", "missing; must be there for what is measured of a run, in s");
    }
  }

  void checkLeaves(const std::string& key, const Expression& expression) {
    const std::map<std::string, PublishedQuantity> published = publishedQuantities(*built_);
    std::vector<std::string> names;
    for (const auto& [name, quantity] : published) {
      names.push_back(name);
    }
    for (const ExpressionLeaf& leaf : expression.leaves()) {
      if (!leaf.reduction.empty()) {
        if (published.count(leaf.path) == 0) {
          complaints_.add(key, fmt::format("a run publishes no {}{}", quoted(leaf.path),
                                           nearIn(leaf.path, names)));
        }
        continue;
      }
      const bool varied = std::any_of(study_.vary.begin(), study_.vary.end(),
                                      [&](const Variation& v) { return v.path == leaf.path; });
      if (varied || analysedNumber(leaf.path, *built_)) {
        continue;
      }
      if (published.count(leaf.path) > 0) {
        complaints_.add(key, fmt::format("{} changes in a run: say which number of it is meant, "
                                         "such as max({})",
                                         leaf.path, leaf.path));
        continue;
      }
      std::vector<std::string> known = analysedNames(*built_);
      for (const Variation& v : study_.vary) {
        known.push_back(v.path);
      }
      complaints_.add(
          key, fmt::format("unknown number {}{}", quoted(leaf.path), nearIn(leaf.path, known)));
    }
  }

  static std::string nearIn(const std::string& name, const std::vector<std::string>& known) {
    const std::string near = nearestName(name, known);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
  }

  void readRequirements(const MapReader& map) {
    if (!map.has("require")) {
      return;
    }
    std::vector<std::string> names;
    for (const Measure& measure : study_.measures) {
      names.push_back(measure.name);
    }
    const MapReader require(map.at("require"), "require", names, "measure", complaints_);
    for (const std::string& name : require.names()) {
      const auto place = std::find(names.begin(), names.end(), name);
      if (place == names.end()) {
        continue;  // its measure has been complained of
      }
      const YAML::Node node = require.at(name);
      const bool several = node.IsSequence() && node.size() > 0;
      for (std::size_t i = 0; i < (several ? node.size() : 1); ++i) {
        readRequirement(several ? node[i] : node, require.key(name),
                        static_cast<std::size_t>(place - names.begin()));
      }
    }
  }

  void readRequirement(const YAML::Node& node, const std::string& key, std::size_t measure) {
    static const std::array<std::pair<const char*, Requirement::Is>, 4> kSigns{
        {{"<=", Requirement::Is::kAtMost},
         {">=", Requirement::Is::kAtLeast},
         {"<", Requirement::Is::kBelow},
         {">", Requirement::Is::kAbove}}};
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    for (const auto& [sign, is] : kSigns) {
      const std::string begin = sign;
      if (text.compare(0, begin.size(), begin) != 0) {
        continue;
      }
      const std::size_t at = text.find_first_not_of(' ', begin.size());
      const auto limit = at == std::string::npos ? std::nullopt : parseNumber(text.substr(at));
      if (limit) {
        study_.requirements.push_back({measure, is, *limit});
        return;
      }
    }
    complaints_.add(key, fmt::format("must be \"< LIMIT\", \"<= LIMIT\", \"> LIMIT\" or \">= "
                                     "LIMIT\", found {}",
                                     shown(node)));
  }

  std::filesystem::path folder_;
  Complaints complaints_;
  Study study_;
  std::optional<BuiltScene> built_;
  std::map<std::string, NamedNumber> numbers_;
};

}  // namespace

Study readStudy(const std::string& path) {
  const YAML::Node tree = readYamlFile(path, "a study", "study, vary, design, run and measure");
  try {
    return StudyReader(path).read(tree);
  } catch (const YAML::Exception& error) {
    throw Refusal(fmt::format("{}: not a study: {}", path, printable(error.what())));
  }
}

}  // namespace whirl_twin
