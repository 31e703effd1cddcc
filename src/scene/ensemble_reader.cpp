#include "scene/ensemble_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "messages/names.h"
#include "scene/ensemble_draw.h"
#include "scene/parameter_paths.h"

namespace whirl_twin {

namespace {

constexpr int kMaxMembers = 100000;
constexpr int kMaxSeed = 1000000000;
const std::string kInitial = "initial.";
const std::string kCorrelations = "correlations";  // a key of spread, not a parameter

struct Width {
  const char* key;
  bool normal;
  bool relative;
};
constexpr std::array<Width, 4> kWidths{{{"standard_deviation", true, false},
                                        {"half_width", false, false},
                                        {"relative_standard_deviation", true, true},
                                        {"relative_half_width", false, true}}};

/// The unit of a parameter; "-" if the model does not have it.
std::string unitOf(const std::string& path, const ModelInfo& model,
                   const std::vector<CoordinateInfo>& coordinates, const Spread& spread) {
  if (spread.kind != Spread::Kind::kParameter) {
    const std::string& unit = coordinates[spread.coordinate].unit;
    return spread.kind == Spread::Kind::kRate ? unit + "/s" : unit;
  }
  for (const ParameterInfo& parameter : model.parameters) {
    if (parameter.name == path) {
      return parameter.unit;
    }
  }
  for (const SettingInfo& setting : model.settings) {
    if (setting.name != path.substr(0, path.find('['))) {
      continue;
    }
    for (const ColumnInfo& column : setting.columns) {
      if (column.name == path.substr(path.find('.') + 1)) {
        return column.unit;
      }
    }
    return setting.unit;
  }
  return "-";
}

/// The value in the scene of a number with a spread; sets its path and kind.
std::optional<double> centre(const std::string& path, const ModelInfo& model,
                             const std::vector<CoordinateInfo>& coordinates, const SystemSpec& spec,
                             Spread& spread, const std::string& key, Diagnostics& diagnostics) {
  spread.path = path;
  if (path.compare(0, kInitial.size(), kInitial) == 0) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      for (const bool rate : {false, true}) {
        known.push_back(kInitial + coordinates[i].name + (rate ? "_rate" : ""));
        if (path == known.back()) {
          spread.kind = rate ? Spread::Kind::kRate : Spread::Kind::kCoordinate;
          spread.coordinate = i;
          return rate ? spec.v[i] : spec.q[i];
        }
      }
    }
    const std::string near = nearestName(path, known);
    diagnostics.add(key,
                    fmt::format("unknown coordinate of {}{}", spec.model,
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }
  const state::ParameterChange all = parametersOf(model, spec);
  const auto found = std::find(all.names.begin(), all.names.end(), path);
  if (found == all.names.end()) {
    const std::string near = nearestName(path, all.names);
    diagnostics.add(key,
                    fmt::format("unknown parameter of {}{}", spec.model,
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }
  return all.values[static_cast<std::size_t>(found - all.names.begin())];
}

/// Reads the width; adds a diagnostic unless exactly one is given.
void readWidth(const MapReader& map, const std::string& key, double about, const std::string& unit,
               Spread& spread, Diagnostics& diagnostics) {
  int given = 0;
  for (const Width& width : kWidths) {
    if (!map.has(width.key)) {
      continue;
    }
    ++given;
    const double value =
        map.number(width.key, Range::kPositive, width.relative ? "-" : unit, std::nullopt);
    spread.normal = width.normal;
    spread.width = width.relative ? value * std::fabs(about) : value;
    if (!std::isfinite(spread.width)) {
      diagnostics.add(map.key(width.key), "exceeds the range of a double");
    }
    if (width.relative && about == 0.0) {
      diagnostics.add(map.key(width.key),
                      fmt::format("is relative, but the value is 0: give the width in {}", unit));
    }
  }
  if (given != 1) {
    diagnostics.add(key, fmt::format("must have one of standard_deviation, half_width, "
                                     "relative_standard_deviation, relative_half_width, found {}",
                                     given == 0 ? "none" : "several"));
  }
}

void readSpread(const MapReader& map, const ModelInfo& model,
                const std::vector<CoordinateInfo>& coordinates, SystemSpec& spec,
                Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const Width& width : kWidths) {
    known.emplace_back(width.key);
  }
  for (const std::string& path : map.names()) {
    if (path == kCorrelations) {
      continue;
    }
    const MapReader entry(map.at(path), map.key(path), known, "key of a spread", diagnostics);
    Spread spread;
    const auto about = centre(path, model, coordinates, spec, spread, map.key(path), diagnostics);
    if (entry.usable() && about) {
      readWidth(entry, map.key(path), *about, unitOf(path, model, coordinates, spread), spread,
                diagnostics);
      spec.ensemble.spread.push_back(spread);
    }
  }
}

}  // namespace

void readEnsemble(const MapReader& system, const ModelInfo& model,
                  const std::vector<CoordinateInfo>& coordinates, SystemSpec& spec,
                  Diagnostics& diagnostics) {
  if (!system.has("count") && !system.has("spread")) {
    if (system.has("seed")) {
      diagnostics.add(system.key("seed"), "needs a spread, from which the samples are drawn");
    }
    return;
  }
  const std::size_t before = diagnostics.all().size();
  if (system.has("count")) {
    spec.ensemble.count = static_cast<std::size_t>(system.integer("count", 1, kMaxMembers, 1));
  }
  spec.ensemble.seed = static_cast<std::uint32_t>(system.integer("seed", 0, kMaxSeed, 1));
  if (!system.has("spread")) {
    diagnostics.add(
        system.key("spread"),
        "missing; must name the parameters or initial values that differ between the samples");
    return;
  }
  const MapReader spread(system.at("spread"), system.key("spread"), {}, "", diagnostics);
  if (!spread.usable()) {
    return;
  }
  if (spread.names().size() == (spread.has(kCorrelations) ? 1 : 0)) {
    diagnostics.add(system.key("spread"), "must name a parameter or initial value, found none");
  }
  readSpread(spread, model, coordinates, spec, diagnostics);
  if (spread.has(kCorrelations) && diagnostics.all().size() == before) {
    readCorrelations(spread.at(kCorrelations), spread.key(kCorrelations), spec.ensemble,
                     diagnostics);
  }
  if (diagnostics.all().size() == before) {
    const std::string objection = toleranceDiagnostic(spec, model);
    if (!objection.empty()) {
      diagnostics.add(system.key("spread"), objection);
    }
  }
}

}  // namespace whirl_twin
