#include "studies/design_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace whirl_twin {

namespace {

constexpr double kMaxPoints = 1.0e9;
constexpr int kUsualMorrisLevels = 4;

class DesignReader {
 public:
  DesignReader(const std::vector<Variation>& vary, Diagnostics& diagnostics)
      : vary_(vary), diagnostics_(diagnostics) {}

  Design read(const MapReader& map) {
    if (!map.has("design")) {
      diagnostics_.add("design",
                       fmt::format("missing; must be one of {}", fmt::join(designNames(), ", ")));
      return design_;
    }
    const YAML::Node node = map.at("design");
    design_.dimensions = vary_.size();
    std::string kind;
    YAML::Node size(YAML::NodeType::Undefined);
    if (node.IsScalar()) {
      kind = node.Scalar();
      if (std::find(designNames().begin(), designNames().end(), kind) == designNames().end()) {
        diagnostics_.add(
            "design", fmt::format("unknown design {}{}", shown(node), hint(kind, designNames())));
        return design_;
      }
    } else {
      const MapReader chosen(node, "design", designNames(), "design", diagnostics_);
      if (!chosen.usable()) {
        return design_;
      }
      if (chosen.names().size() != 1) {
        if (node.size() != 1) {
          diagnostics_.add("design", "must have exactly one design");
        }
        return design_;
      }
      kind = chosen.names().front();
      size = chosen.at(kind);
    }
    design_.kind = static_cast<Design::Kind>(
        std::find(designNames().begin(), designNames().end(), kind) - designNames().begin());
    if (vary_.empty()) {
      return design_;
    }
    switch (design_.kind) {
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
    return design_;
  }

 private:
  /// An integer number of points, runs or levels; empty, with a diagnostic, if invalid.
  std::optional<std::uint64_t> whole(const std::string& key, const YAML::Node& node,
                                     const std::string& what, double least, double most) {
    const auto number =
        node.IsDefined() && node.IsScalar() ? parseNumber(node.Scalar()) : std::nullopt;
    if (!number || !(*number >= least) || !(*number <= most) || *number != std::floor(*number)) {
      diagnostics_.add(key, fmt::format("must be {}, a whole number from {:g} to {:g}, found {}",
                                        what, least, most, shown(node)));
      return std::nullopt;
    }
    return static_cast<std::uint64_t>(*number);
  }

  void readCount(const std::string& kind, const YAML::Node& size) {
    const bool indices = design_.kind == Design::Kind::kSobolIndices;
    const auto each = static_cast<double>(indices ? design_.dimensions + 2 : 1);
    if (const auto count =
            whole("design." + kind, size, indices ? "how many base points" : "how many points", 1.0,
                  std::floor(kMaxPoints / each))) {
      design_.base = *count;
      design_.points = *count * static_cast<std::uint64_t>(each);
    }
    const std::size_t dimensions = (indices ? 2 : 1) * design_.dimensions;
    if ((indices || design_.kind == Design::Kind::kSobol) && dimensions > kMaxSobolDimensions) {
      diagnostics_.add("design." + kind, fmt::format("has up to {} dimensions, found {}",
                                                     kMaxSobolDimensions, dimensions));
    }
  }

  void readListDesign(const YAML::Node& size) {
    if (size.IsDefined() && !size.IsNull()) {
      diagnostics_.add("design.list", "must have no number: each varied parameter has its list");
    }
    const std::size_t first = vary_.front().distribution.list.size();
    for (const Variation& v : vary_) {
      if (v.distribution.kind != Distribution::Kind::kList) {
        diagnostics_.add("vary." + v.path, "must be a list with the design list");
      } else if (v.distribution.list.size() != first && !v.distribution.list.empty()) {
        diagnostics_.add("vary." + v.path,
                         fmt::format("must have {} entries, as {} has, found {}", first,
                                     vary_.front().path, v.distribution.list.size()));
      }
    }
    design_.points = first;
  }

  void readLevels(const std::string& kind, const YAML::Node& size) {
    const bool grid = design_.kind == Design::Kind::kGrid;
    const bool lists = std::all_of(vary_.begin(), vary_.end(), [](const Variation& v) {
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
      diagnostics_.add(
          "design",
          fmt::format("must be {{{}: LEVELS}}, because a varied parameter has no list of values",
                      kind));
      return;
    }
    double points = 1.0;  // one_at_a_time: the nominal scene
    for (const Variation& v : vary_) {
      if (!grid && std::isnan(v.nominal)) {
        diagnostics_.add(
            "vary." + v.path,
            "differs from move to move: with one_at_a_time, name one move of the drive");
      }
      design_.levels.push_back(v.distribution.levels(static_cast<std::size_t>(asked)));
      const auto count = static_cast<double>(design_.levels.back());
      points = grid ? points * count : points + count;
    }
    if (!(points <= kMaxPoints)) {
      diagnostics_.add(
          "design", fmt::format("must have at most {1:g} points, found {0:g}", points, kMaxPoints));
      return;
    }
    design_.points = static_cast<std::uint64_t>(points);
  }

  void readMorris(const YAML::Node& size) {
    std::optional<std::uint64_t> count;
    std::uint64_t levels = kUsualMorrisLevels;
    const double most = std::floor(kMaxPoints / static_cast<double>(design_.dimensions + 1));
    if (size.IsDefined() && size.IsMap()) {
      const MapReader map(size, "design.morris", {"trajectories", "levels"}, "key of morris",
                          diagnostics_);
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
      diagnostics_.add("design.morris.levels",
                       fmt::format("must be even (a step is half of them), found {}", levels));
    }
    design_.levels.assign(1, static_cast<std::size_t>(levels));
    if (count) {
      design_.base = *count;
      design_.points = *count * (design_.dimensions + 1);
    }
    for (const Variation& v : vary_) {
      if (v.distribution.kind == Distribution::Kind::kList) {
        diagnostics_.add(
            "vary." + v.path,
            "must be a range such as uniform (a Morris step is half of it), found a list");
      }
    }
  }

  const std::vector<Variation>& vary_;
  Diagnostics& diagnostics_;
  Design design_;
};

}  // namespace

Design readDesign(const MapReader& study, const std::vector<Variation>& vary,
                  Diagnostics& diagnostics) {
  return DesignReader(vary, diagnostics).read(study);
}

}  // namespace whirl_twin
