#include "studies/variation_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "messages/units.h"
#include "models/model_registry.h"
#include "scene/parameter_limits.h"
#include "scene/parameter_paths.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxEntries = 100000;  // of a list

class VariationReader {
 public:
  VariationReader(const Scene& scene, const std::map<std::string, NamedNumber>& numbers,
                  Diagnostics& diagnostics)
      : scene_(scene), numbers_(numbers), diagnostics_(diagnostics) {}

  std::vector<Variation> read(const MapReader& map) {
    if (!map.has("vary")) {
      diagnostics_.add("vary", "missing; must name the varied parameters of the scene");
      return {};
    }
    const MapReader vary(map.at("vary"), "vary", {}, "", diagnostics_);
    if (vary.usable() && vary.names().empty()) {
      diagnostics_.add("vary", "must name a varied parameter of the scene");
    }
    std::vector<Variation> all;
    std::map<std::string, std::string> taken;
    for (const std::string& path : vary.names()) {
      const auto found = numbers_.find(path);
      if (found == numbers_.end()) {
        diagnostics_.add(vary.key(path), objectionToPath(path));
        continue;
      }
      Variation variation;
      variation.path = path;
      variation.places = found->second.places;
      variation.unit = found->second.unit;
      variation.nominal = found->second.value;
      unit_known_ = found->second.known;
      unit_ = unit_known_ || variation.unit != "-" ? variation.unit : "";
      variation.written_unit = unit_known_ ? "" : unit_;
      for (const SceneNumber& place : variation.places) {
        const auto [other, first] = taken.emplace(keyOf(place), path);
        if (!first) {
          diagnostics_.add(vary.key(path), fmt::format("duplicate: {} is already varied by {}",
                                                       keyOf(place), other->second));
        }
      }
      const bool read = readDistribution(vary.at(path), vary.key(path), variation);
      if (!unit_known_ && !unit_.empty()) {
        variation.unit = variation.written_unit = unit_;
      }
      if (read) {
        checkRange(vary.key(path), found->second, variation.distribution);
      }
      all.push_back(variation);
    }
    return all;
  }

 private:
  static std::string keyOf(const SceneNumber& place) {
    std::string key;
    for (const auto& part : place) {
      const auto* const name = std::get_if<std::string>(&part);
      key += name == nullptr ? fmt::format("[{}]", std::get<std::size_t>(part))
                             : (key.empty() ? "" : ".") + *name;
    }
    return key;
  }

  /// Message for an unknown path, with the nearest valid one.
  std::string objectionToPath(const std::string& path) const {
    // The list exists, but not this row.
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
      return "is not a single number: name one of its parts, such as " + firstBelow(path);
    }
    std::vector<std::string> names;
    for (const auto& [name, number] : numbers_) {
      names.push_back(name);
    }
    const std::string near = nearestName(path, names);
    return fmt::format("must be a number of the scene{}",
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

  /// The numbers of a list; adds a diagnostic for each invalid entry.
  std::vector<double> numbersIn(const YAML::Node& list, const std::string& key, std::size_t least,
                                std::size_t most, const std::string& what) {
    std::vector<double> numbers;
    if (!list.IsSequence() || list.size() < least || list.size() > most) {
      diagnostics_.add(key, fmt::format("must be {}, found {}", what,
                                        list.IsSequence() ? fmt::format("{} entries", list.size())
                                                          : shown(list)));
      return {};
    }
    bool good = true;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto number = quantity(list[i]);
      if (!number) {
        diagnostics_.add(
            fmt::format("{}[{}]", key, i),
            fmt::format("must be {}, found {}{}",
                        expected(Range::kAny, unit_.empty() ? "-" : unit_), shown(list[i]),
                        unitDiagnostic(list[i], unit_.empty() ? "-" : unit_)));
        good = false;
      }
      numbers.push_back(number.value_or(0.0));
    }
    return good ? numbers : std::vector<double>();
  }

  /// A number with or without a unit. The unit of a number that only its reader knows is that of
  /// the first value, or of the scene's file.
  std::optional<double> quantity(const YAML::Node& node) {
    const auto written = node.IsScalar() ? writtenQuantity(node.Scalar()) : std::nullopt;
    if (!written) {
      return std::nullopt;
    }
    if (!unit_known_ && unit_.empty() && isUnit(written->unit)) {
      unit_ = written->unit;
    }
    if (!unit_known_ && !unit_.empty() && written->unit.empty()) {
      return std::nullopt;  // perhaps of another unit
    }
    return parseQuantity(node.Scalar(), unit_.empty() ? "-" : unit_);
  }

  /// False if a diagnostic was added.
  bool readDistribution(const YAML::Node& node, const std::string& key, Variation& variation) {
    const std::size_t before = diagnostics_.all().size();
    static const std::vector<std::string> kinds{"uniform",
                                                "log_uniform",
                                                "normal",
                                                "grid",
                                                "list",
                                                "relative_half_width",
                                                "relative_standard_deviation"};
    const MapReader map(node, key, kinds, "distribution", diagnostics_);
    if (!map.usable()) {
      return false;
    }
    if (map.names().size() != 1) {
      if (diagnostics_.all().size() == before) {
        diagnostics_.add(key, fmt::format("must be one of {}", fmt::join(kinds, ", ")));
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
          diagnostics_.add(map.key(kind),
                           fmt::format("the standard deviation must be > 0, found {}", pair[1]));
        }
        checkWidth(map.key(kind), d.mean, d.deviation);
      }
    } else if (kind == "grid" || kind == "list") {
      d.kind = Distribution::Kind::kList;
      d.list = numbersIn(map.at(kind), map.key(kind), 1, kMaxEntries,
                         fmt::format("a list of 1 to {} numbers", kMaxEntries));
    } else {
      readRelative(map, kind, variation);
    }
    return diagnostics_.all().size() == before;
  }

  /// Range check: a normal distribution is limited to 8.3 standard deviations about its mean, an
  /// interval to one width.
  void checkWidth(const std::string& key, double middle, double width) {
    if (!std::isfinite(10.0 * width) || !std::isfinite(middle + 10.0 * width)) {
      diagnostics_.add(key,
                       fmt::format("exceeds the range of a double: {} about {}", width, middle));
    }
  }

  void readInterval(const YAML::Node& node, const std::string& key, Distribution& d) {
    const auto pair = numbersIn(node, key, 2, 2, "[lowest, highest]");
    if (pair.empty()) {
      return;
    }
    d.low = pair[0];
    d.high = pair[1];
    if (!(d.low < d.high) || !std::isfinite(d.high - d.low)) {
      diagnostics_.add(key,
                       fmt::format("must be [lowest, highest], found [{}, {}]", d.low, d.high));
    } else if (d.kind == Distribution::Kind::kLogUniform && !(d.low > 0.0)) {
      diagnostics_.add(key, fmt::format("must be > 0 with a logarithmic range, found {}", d.low));
    }
  }

  void readRelative(const MapReader& map, const std::string& kind, Variation& variation) {
    const double part = map.number(kind, Range::kPositive, "-", std::nullopt);
    const double width = part * std::fabs(variation.nominal);
    Distribution& d = variation.distribution;
    if (variation.nominal == 0.0) {
      diagnostics_.add(map.key(kind),
                       "must not be relative to 0, the value of the scene: give an absolute width");
    }
    if (variation.places.size() > 1) {
      diagnostics_.add(map.key(kind), "must be a list of values for all moves, or name one move");
    }
    if (std::isfinite(part) && !std::isnan(variation.nominal)) {
      checkWidth(map.key(kind), variation.nominal, width);
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

  /// Ends outside the valid range of the parameter are an error of the study, not of single points.
  void checkRange(const std::string& key, const NamedNumber& number,
                  const Distribution& distribution) {
    if (number.parameter.empty()) {
      return;
    }
    SystemSpec spec = scene_.systems[number.system];
    for (const double end : {distribution.smallest(), distribution.largest()}) {
      Diagnostics said("");
      if (std::isfinite(end) &&
          !setParameter(number.parameter, end, *findModel(spec.model), spec, said)) {
        const std::string& why = said.all().front();
        diagnostics_.add(key, why.substr(why.rfind(": ") + 2));
        return;
      }
    }
  }

  const Scene& scene_;
  const std::map<std::string, NamedNumber>& numbers_;
  Diagnostics& diagnostics_;
  std::string unit_;  // of the number that is read; "": none
  bool unit_known_ = true;
};

}  // namespace

std::vector<Variation> readVariations(const MapReader& study, const Scene& scene,
                                      const std::map<std::string, NamedNumber>& numbers,
                                      Diagnostics& diagnostics) {
  return VariationReader(scene, numbers, diagnostics).read(study);
}

}  // namespace whirl_twin
