#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "messages/names.h"
#include "reports/fit_report.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kLongestRemark = 200;

/// The node at `bearings[0].kxx` below a map; made where there is none.
YAML::Node nodeAt(YAML::Node node, const std::string& path) {
  std::size_t from = 0;
  while (from < path.size()) {
    if (path[from] == '[') {
      const std::size_t end = path.find(']', from);
      node.reset(node[std::stoul(path.substr(from + 1, end - from - 1))]);
      from = end + 1;
    } else {
      from += path[from] == '.' ? 1 : 0;
      const std::size_t end = std::min(path.find_first_of(".[", from), path.size());
      node.reset(node[path.substr(from, end - from)]);
      from = end;
    }
  }
  return node;
}

void moveTables(const YAML::Node& scene, const std::filesystem::path& from,
                const std::filesystem::path& to) {
  for (const auto& system : scene["systems"]) {
    const YAML::Node inputs = system.second["inputs"];
    if (!inputs || !inputs.IsMap()) {
      continue;
    }
    for (const auto& input : inputs) {
      if (!input.second.IsMap() || !input.second["table"]) {
        continue;
      }
      const std::filesystem::path table = input.second["table"].as<std::string>();
      if (table.is_relative()) {
        YAML::Node place = input.second["table"];
        place = std::filesystem::absolute(from / table)
                    .lexically_normal()
                    .lexically_relative(std::filesystem::absolute(to).lexically_normal())
                    .string();
      }
    }
  }
}

/// Of one parameter with those before it, which have a spread if the runs tell of them.
void addCorrelations(const ShootingFit& fit, std::size_t i, YAML::Node spread) {
  for (std::size_t j = 0; j < i; ++j) {
    const Unknown& other = fit.unknowns[j];
    const double r =
        fit.information.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    if (other.kind == Unknown::Kind::kParameter && spread[other.subject] && std::isfinite(r)) {
      YAML::Node pair(YAML::NodeType::Sequence);
      pair.SetStyle(YAML::EmitterStyle::Flow);
      pair.push_back(other.subject);
      pair.push_back(fit.unknowns[i].subject);
      pair.push_back(fmt::format("{:.12g}", std::clamp(r, -1.0, 1.0)));
      spread["correlations"].push_back(pair);
    }
  }
}

}  // namespace

std::string fittedScene(const FitStudy& study, const ShootingFit& fit, const std::string& folder) {
  YAML::Node scene = YAML::LoadFile(study.scene_path);
  YAML::Node system = scene["systems"][study.system];
  YAML::Node parameters = system["parameters"];
  if (system["spread"]) {
    system["spread"].remove("correlations");  // the runs tell others now
  }
  std::string head =
      fmt::format("# {} of this scene was fitted to measured runs by `twin fit {}`.\n",
                  study.system, printable(std::filesystem::path(study.source).filename().string()));
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const Unknown& u = fit.unknowns[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (u.kind == Unknown::Kind::kParameter) {
      YAML::Node place = nodeAt(parameters, u.subject);
      place = fmt::format("{:.12g}", fit.theta[k]);
    }
    const double deviation = fit.information.deviation[k];
    if (u.kind == Unknown::Kind::kParameter && deviation > 0.0 && std::isfinite(deviation)) {
      YAML::Node spread(YAML::NodeType::Map);  // the monitor judges the system within it
      spread["standard_deviation"] = fmt::format("{:.3g}", deviation);
      system["spread"][u.subject] = spread;
      addCorrelations(fit, i, system["spread"]);
    }
    head += fmt::format("#   {:<24} {:>16.9g}  {}\n", u.name, fit.theta[k],
                        std::isfinite(deviation)
                            ? fmt::format("standard deviation {:.3g} {}", deviation, u.unit)
                            : std::string("not identifiable from the runs: unchanged"));
  }
  for (const UntoldDirection& direction : fit.information.untold) {
    head +=
        "# Not identifiable: " + printable(directionText(fit, direction), kLongestRemark) + "\n";
  }
  moveTables(scene, std::filesystem::path(study.scene_path).parent_path(), folder);
  YAML::Emitter out;
  out << scene;
  return head + out.c_str() + "\n";
}

}  // namespace whirl_twin
