#include "models/local_element_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mechanics/local_elements.h"
#include "models/model_info.h"
#include "models/settings.h"

namespace whirl_twin {

namespace {

using Between = NodeElement::Between;

ShortJournalBearing filmOf(const TableRow& row) {
  const auto& n = row.numbers;
  return {n.at("length"), n.at("diameter"), n.at("clearance"), n.at("viscosity")};
}

Rub rubOf(const TableRow& row, const std::string& key) {
  const auto& n = row.numbers;
  const Rub rub{n.at("clearance"), n.at("stiffness"), n.at("damping"), n.at("friction"),
                n.at("radius")};
  if (rub.friction > 0.0 && !(rub.radius > 0.0)) {
    throw SetupError(key + ".radius", "must be > 0 m with friction");
  }
  return rub;
}

/// Of a kind, two at one node would have one name.
void add(NodeElement element, const std::string& key, std::vector<NodeElement>& all) {
  if (std::any_of(all.begin(), all.end(),
                  [&](const NodeElement& other) { return other.name == element.name; })) {
    throw SetupError(key + ".node",
                     fmt::format("duplicate: node {} already has one", element.node));
  }
  all.push_back(std::move(element));
}

}  // namespace

std::vector<SettingInfo> localElementSettings() {
  const auto rows = [](const char* name, const char* meaning, std::vector<ColumnInfo> columns) {
    SettingInfo info{name, SettingKind::kTable, "", meaning};
    info.columns = std::move(columns);
    return info;
  };
  const ColumnInfo node{"node", "-", Range::kNotNegative, kRequired};
  return {rows("rubs",
               "stators that the shaft contacts beyond a clearance; a gap is one without friction",
               {node,
                {"clearance", "m", Range::kNotNegative, kRequired},
                {"stiffness", "N/m", Range::kPositive, kRequired},
                {"damping", "N s/m", Range::kNotNegative, 0.0},
                {"friction", "-", Range::kNotNegative, 0.0},
                {"radius", "m", Range::kNotNegative, 0.0}}),
          rows("cubic_springs", "to the ground, a force stiffness r^3 towards the middle",
               {node, {"stiffness", "N/m^3", Range::kAny, kRequired}}),
          rows("squeeze_films",
               "squeeze-film dampers (short film), between ground and the last of the node's "
               "pedestals where it has any",
               {node,
                {"length", "m", Range::kPositive, kRequired},
                {"diameter", "m", Range::kPositive, kRequired},
                {"clearance", "m", Range::kPositive, kRequired},
                {"viscosity", "Pa s", Range::kPositive, kRequired}})};
}

std::vector<NodeElement> nodeElements(const Settings& settings, int nodes) {
  std::vector<NodeElement> all;
  const auto each = [&](const char* table, const char* name, Between between, const auto& law) {
    const std::vector<TableRow>& rows = rowsOf(settings, table);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string key = fmt::format("{}[{}]", table, i);
      const int node = indexIn(rows[i], key, "node", nodes - 1);
      if (std::shared_ptr<const NodalForceLaw> made = law(rows[i], key)) {
        add({fmt::format("{}_{}", name, node), node, between, std::move(made)}, key, all);
        if (between != Between::kShaftAndGround) {
          all.back().damping = OilFilm{filmOf(rows[i]), false}.linearDamping();
        }
        if (between == Between::kShaftAndPedestal) {
          all.back().journal = filmOf(rows[i]);
        }
      }
    }
  };
  each("journal_bearings", "journal", Between::kShaftAndPedestal,
       [](const TableRow& row, const std::string&) {
         return row.numbers.at("load") > 0.0 ? nullptr : localLaw(OilFilm{filmOf(row), true});
       });
  each("rubs", "rub", Between::kShaftAndGround,
       [](const TableRow& row, const std::string& key) { return localLaw(rubOf(row, key)); });
  each("cubic_springs", "cubic_spring", Between::kShaftAndGround,
       [](const TableRow& row, const std::string&) {
         return localLaw(CubicSpring{row.numbers.at("stiffness")});
       });
  each("squeeze_films", "squeeze_film", Between::kPedestalAndGround,
       [](const TableRow& row, const std::string&) {
         return localLaw(OilFilm{filmOf(row), false});
       });
  return all;
}

}  // namespace whirl_twin
