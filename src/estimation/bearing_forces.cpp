#include "estimation/bearing_forces.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl_twin {

std::vector<BearingForce> bearingForces(const BuiltSystem& system) {
  std::vector<BearingForce> all;
  const auto& tables = system.spec.settings.tables;
  const auto bearings = tables.find("bearings");
  if (bearings == tables.end()) {
    return all;
  }
  const auto over_speed = tables.find("bearing_tables");
  const auto pedestals = tables.find("pedestals");
  const std::vector<Station> stations = system.dynamics->stations();
  const Eigen::Index n = system.dynamics->dof();
  for (std::size_t i = 0; i < bearings->second.size(); ++i) {
    const auto& number = bearings->second[i].numbers;
    const auto at_node =
        std::find_if(stations.begin(), stations.end(), [&](const Station& station) {
          return station.name == fmt::format("node_{}", static_cast<long>(number.at("node")));
        });
    const bool by_table =
        over_speed != tables.end() &&
        std::any_of(over_speed->second.begin(), over_speed->second.end(), [&](const auto& row) {
          return static_cast<std::size_t>(row.numbers.at("bearing")) == i;
        });
    const bool on_pedestal =
        pedestals != tables.end() &&
        std::any_of(pedestals->second.begin(), pedestals->second.end(),
                    [&](const auto& row) { return row.numbers.at("node") == number.at("node"); });
    const bool with_mass = number.at("mxx") != 0.0 || number.at("myy") != 0.0;
    const auto isTrue = [&](const char* word) {
      const auto given = bearings->second[i].words.find(word);
      return given != bearings->second[i].words.end() && given->second == "true";
    };
    const bool rigid = isTrue("pin") || isTrue("clamp");
    if (at_node == stations.end() || by_table || on_pedestal || with_mass || rigid) {
      continue;
    }
    BearingForce force{fmt::format("bearings[{}]", i), Eigen::VectorXd(2 * n),
                       Eigen::VectorXd(2 * n)};
    const auto rowOf = [&](const char* kx, const char* ky, const char* cx, const char* cy,
                           Eigen::VectorXd& row) {
      row.head(n) = -number.at(kx) * at_node->along_x - number.at(ky) * at_node->along_y;
      row.tail(n) = -number.at(cx) * at_node->along_x - number.at(cy) * at_node->along_y;
    };
    rowOf("kxx", "kxy", "cxx", "cxy", force.x);
    rowOf("kyx", "kyy", "cyx", "cyy", force.y);
    all.push_back(std::move(force));
  }
  return all;
}

}  // namespace whirl_twin
