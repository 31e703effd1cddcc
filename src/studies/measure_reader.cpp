#include "studies/measure_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/written_quantity.h"
#include "studies/alarm_watch.h"
#include "studies/analysed_numbers.h"
#include "studies/published_quantities.h"

namespace whirl_twin {

namespace {

bool isTimed(const Study& study) {
  return std::any_of(study.measures.begin(), study.measures.end(), [](const Measure& measure) {
    const auto& leaves = measure.expression.leaves();
    return std::any_of(leaves.begin(), leaves.end(), [](const ExpressionLeaf& leaf) {
      return !leaf.reduction.empty() || countedAlarm(leaf.path);
    });
  });
}

class MeasureReader {
 public:
  MeasureReader(const BuiltScene& scene, Study& study, Diagnostics& diagnostics)
      : scene_(scene), study_(study), diagnostics_(diagnostics) {}

  void readMeasures(const MapReader& map) {
    if (!map.has("measure")) {
      diagnostics_.add("measure",
                       "missing; must name the measures: {peak: "
                       "max(SYSTEM.whirl.radius)}");
      return;
    }
    const MapReader measures(map.at("measure"), "measure", {}, "", diagnostics_);
    if (measures.usable() && measures.names().empty()) {
      diagnostics_.add("measure", "must name a measure");
    }
    for (const std::string& name : measures.names()) {
      if (!isLegalName(name)) {
        diagnostics_.add(
            measures.key(name),
            fmt::format("the name must have at most {} letters, digits and _, a letter first",
                        kMaxNameLength));
      }
      const std::string text = measures.text(name, "");
      if (text.empty()) {
        continue;
      }
      try {
        Measure measure{name, text, Expression(text)};
        checkLeaves(measures.key(name), measure.expression);
        measure.unit = unitOf(measure);
        study_.measures.push_back(measure);
      } catch (const InputError& error) {
        diagnostics_.add(measures.key(name), error.what());
      }
    }
    if (!study_.duration && isTimed(study_) && map.has("run")) {
      diagnostics_.add("run.duration", "missing; needed in s for measures of a run");
    }
  }

  void readRequirements(const MapReader& map) {
    if (!map.has("require")) {
      return;
    }
    std::vector<std::string> names;
    for (const Measure& measure : study_.measures) {
      names.push_back(measure.name);
    }
    const MapReader require(map.at("require"), "require", names, "measure", diagnostics_);
    for (const std::string& name : require.names()) {
      const auto place = std::find(names.begin(), names.end(), name);
      if (place == names.end()) {
        continue;  // its measure has an error
      }
      const YAML::Node node = require.at(name);
      const bool several = node.IsSequence() && node.size() > 0;
      for (std::size_t i = 0; i < (several ? node.size() : 1); ++i) {
        readRequirement(several ? node[i] : node, require.key(name),
                        static_cast<std::size_t>(place - names.begin()));
      }
    }
  }

 private:
  void checkLeaves(const std::string& key, const Expression& expression) {
    const std::map<std::string, PublishedQuantity> published = publishedQuantities(scene_);
    std::vector<std::string> names;
    for (const auto& [name, quantity] : published) {
      names.push_back(name);
    }
    for (const ExpressionLeaf& leaf : expression.leaves()) {
      if (!leaf.reduction.empty()) {
        if (published.count(leaf.path) == 0) {
          diagnostics_.add(key, fmt::format("must be published by a run, found {}{}",
                                            inQuotes(leaf.path), nearIn(leaf.path, names)));
        }
        continue;
      }
      const bool varied = std::any_of(study_.vary.begin(), study_.vary.end(),
                                      [&](const Variation& v) { return v.path == leaf.path; });
      if (varied || analysedNumber(leaf.path, scene_) || countedAlarm(leaf.path)) {
        continue;
      }
      if (published.count(leaf.path) > 0) {
        diagnostics_.add(
            key, fmt::format("{} changes during a run: reduce it to one number, such as max({})",
                             leaf.path, leaf.path));
        continue;
      }
      std::vector<std::string> known = analysedNames(scene_);
      for (const std::string& path : alarmPaths()) {
        known.push_back(path);
      }
      for (const Variation& v : study_.vary) {
        known.push_back(v.path);
      }
      diagnostics_.add(
          key, fmt::format("unknown quantity {}{}", inQuotes(leaf.path), nearIn(leaf.path, known)));
    }
  }

  /// Unit of a measure that is a single operand.
  std::string unitOf(const Measure& measure) const {
    const std::vector<ExpressionLeaf>& leaves = measure.expression.leaves();
    if (leaves.size() != 1 || !measure.expression.isLeaf()) {
      return "-";
    }
    const ExpressionLeaf& leaf = leaves.front();
    if (leaf.reduction == "time_of_max" || leaf.reduction == "settling") {
      return "s";
    }
    if (!leaf.reduction.empty()) {
      const std::map<std::string, PublishedQuantity> published = publishedQuantities(scene_);
      const auto found = published.find(leaf.path);
      return found != published.end() ? found->second.unit : "-";
    }
    const auto varied = std::find_if(study_.vary.begin(), study_.vary.end(),
                                     [&](const Variation& v) { return v.path == leaf.path; });
    if (varied != study_.vary.end()) {
      return varied->unit;
    }
    const auto analysed = analysedNumber(leaf.path, scene_);
    return analysed ? whirl_twin::unitOf(*analysed) : "-";
  }

  static std::string nearIn(const std::string& name, const std::vector<std::string>& known) {
    const std::string near = nearestName(name, known);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
  }

  void readRequirement(const YAML::Node& node, const std::string& key, std::size_t measure) {
    static const std::array<std::pair<const char*, Requirement::Is>, 4> kSigns{
        {{"<=", Requirement::Is::kAtMost},
         {">=", Requirement::Is::kAtLeast},
         {"<", Requirement::Is::kBelow},
         {">", Requirement::Is::kAbove}}};
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    std::string why;
    for (const auto& [sign, is] : kSigns) {
      const std::string begin = sign;
      if (text.compare(0, begin.size(), begin) != 0) {
        continue;
      }
      const std::size_t at = text.find_first_not_of(' ', begin.size());
      const std::string written = at == std::string::npos ? "" : text.substr(at);
      const std::string& unit = study_.measures[measure].unit;
      if (const auto limit = parseQuantity(written, unit)) {
        study_.requirements.push_back({measure, is, *limit});
        return;
      }
      why = unitDiagnostic(written, unit);
      break;
    }
    diagnostics_.add(key, fmt::format("must be \"< LIMIT\", \"<= LIMIT\", \"> LIMIT\" or \">= "
                                      "LIMIT\", found {}{}",
                                      shown(node), why));
  }

  const BuiltScene& scene_;
  Study& study_;
  Diagnostics& diagnostics_;
};

}  // namespace

void readMeasures(const MapReader& map, const BuiltScene& scene, Study& study,
                  Diagnostics& diagnostics) {
  MeasureReader reader(scene, study, diagnostics);
  reader.readMeasures(map);
  reader.readRequirements(map);
}

}  // namespace whirl_twin
