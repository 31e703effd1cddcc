#include "models/flexible_shaft_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/rotors/bearing_laws.h"

namespace whirl_twin {

namespace {

constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostElements = 100;
constexpr double kUsualPoissonsRatio = 0.3;

const std::vector<TableRow>& table(const Settings& settings, const std::string& name) {
  static const std::vector<TableRow> none;
  const auto found = settings.tables.find(name);
  return found == settings.tables.end() ? none : found->second;
}

/// A whole number from 0 to `last` in a column of a row.
int indexIn(const TableRow& row, const std::string& key, const char* column, int last) {
  const double number = row.numbers.at(column);
  if (!(number >= 0.0 && number <= last && number == std::floor(number))) {
    throw SetupError(fmt::format("{}.{}", key, column),
                     fmt::format("must be a whole number from 0 to {}, found {}", last, number));
  }
  return static_cast<int>(number);
}

std::vector<ShaftSection> elementsOf(const Settings& settings) {
  std::vector<ShaftSection> elements;
  const std::vector<TableRow>& rows = table(settings, "elements");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i].numbers;
    const ShaftSection section{row.at("length"), row.at("outer_diameter"),
                               row.at("inner_diameter")};
    if (!(section.inner_diameter < section.outer_diameter)) {
      throw SetupError(fmt::format("elements[{}].inner_diameter", i),
                       fmt::format("must be < outer_diameter = {} m, found {}",
                                   section.outer_diameter, section.inner_diameter));
    }
    const double all = static_cast<double>(elements.size()) + row.at("count");
    if (all > kMostElements) {
      throw SetupError(
          fmt::format("elements[{}].count", i),
          fmt::format("must leave up to {} elements in all, found {}", kMostElements, all));
    }
    elements.insert(elements.end(), static_cast<std::size_t>(row.at("count")), section);
  }
  if (elements.empty()) {
    throw SetupError("elements", "missing; the shaft's elements, from node 0 on");
  }
  return elements;
}

BearingCoefficients coefficientsOf(const TableRow& row) {
  const auto& n = row.numbers;
  return {n.at("kxx"), n.at("kxy"), n.at("kyx"), n.at("kyy"),
          n.at("cxx"), n.at("cxy"), n.at("cyx"), n.at("cyy")};
}

bool isGiven(const BearingCoefficients& b) {
  return b.kxx != 0.0 || b.kxy != 0.0 || b.kyx != 0.0 || b.kyy != 0.0 || b.cxx != 0.0 ||
         b.cxy != 0.0 || b.cyx != 0.0 || b.cyy != 0.0;
}

/// The rows of bearing_tables, by the bearing they are of.
std::vector<std::vector<BearingRow>> bearingTables(const Settings& settings, std::size_t bearings) {
  std::vector<std::vector<BearingRow>> tables(bearings);
  const std::vector<TableRow>& rows = table(settings, "bearing_tables");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("bearing_tables[{}]", i);
    if (bearings == 0) {
      throw SetupError(key + ".bearing", "there is no row in bearings that it could be of");
    }
    const auto of =
        static_cast<std::size_t>(indexIn(rows[i], key, "bearing", static_cast<int>(bearings) - 1));
    const double speed = rows[i].numbers.at("speed");
    if (!tables[of].empty() && !(speed > tables[of].back().speed)) {
      throw SetupError(key + ".speed",
                       fmt::format("must be > {} rad/s, the row before of this bearing, found {}",
                                   tables[of].back().speed, speed));
    }
    tables[of].push_back({speed, coefficientsOf(rows[i])});
  }
  return tables;
}

void addBearings(const Settings& settings, FlexibleShaft& shaft) {
  const int last = shaft.nodes() - 1;
  const std::vector<TableRow>& rows = table(settings, "bearings");
  const auto tables = bearingTables(settings, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("bearings[{}]", i);
    const RotorBearing bearing{indexIn(rows[i], key, "node", last), coefficientsOf(rows[i])};
    if (tables[i].empty()) {
      shaft.bearings.push_back(bearing);
    } else if (isGiven(bearing.coefficients)) {
      throw SetupError(key, "must give its node only: bearing_tables gives its coefficients");
    } else {
      shaft.speed_bearings.push_back(tabulatedBearing(bearing.node, tables[i]));
    }
  }
  for (const NodeMagnet& at : nodeMagnets(settings, shaft.nodes())) {
    BearingCoefficients coefficients;
    coefficients.kxx = coefficients.kyy = -at.magnet.ks;
    shaft.bearings.push_back({at.node, coefficients});
  }
  const std::vector<TableRow>& journals = table(settings, "journal_bearings");
  for (std::size_t i = 0; i < journals.size(); ++i) {
    const auto& n = journals[i].numbers;
    const ShortJournalBearing journal{n.at("length"), n.at("diameter"), n.at("clearance"),
                                      n.at("viscosity")};
    const int node = indexIn(journals[i], fmt::format("journal_bearings[{}]", i), "node", last);
    shaft.speed_bearings.push_back(journalBearing(node, journal, n.at("load")));
  }
}

std::vector<ColumnInfo> coefficientColumns(std::vector<ColumnInfo> columns) {
  for (const char* name : {"kxx", "kyy", "kxy", "kyx"}) {
    columns.push_back({name, "N/m", Range::kAny, 0.0});
  }
  for (const char* name : {"cxx", "cyy", "cxy", "cyx"}) {
    columns.push_back({name, "N s/m", Range::kAny, 0.0});
  }
  return columns;
}

}  // namespace

std::vector<SettingInfo> flexibleShaftSettings() {
  const auto rows = [](const char* name, const char* meaning, std::vector<ColumnInfo> columns) {
    SettingInfo info{name, SettingKind::kTable, "", meaning};
    info.columns = std::move(columns);
    return info;
  };
  const ColumnInfo node{"node", "-", Range::kNotNegative, kRequired};
  std::vector<SettingInfo> all{
      rows("elements", "of the shaft; element i joins node i and node i + 1",
           {{"length", "m", Range::kPositive, kRequired},
            {"outer_diameter", "m", Range::kPositive, kRequired},
            {"inner_diameter", "m", Range::kNotNegative, 0.0},
            {"count", "-", Range::kCount, 1.0}}),
      rows("discs", "rigid, at nodes",
           {node,
            {"mass", "kg", Range::kNotNegative, kRequired},
            {"polar_inertia", "kg m^2", Range::kNotNegative, 0.0},
            {"transverse_inertia", "kg m^2", Range::kNotNegative, 0.0}}),
      rows("bearings", "by eight coefficients; none at all: the rotor floats",
           coefficientColumns({node})),
      rows("bearing_tables", "coefficients of bearings[bearing] over the shaft's speed",
           coefficientColumns({{"bearing", "-", Range::kNotNegative, kRequired},
                               {"speed", "rad/s", Range::kAny, kRequired}})),
      rows("journal_bearings", "short plain bearings under a load along -y",
           {node,
            {"length", "m", Range::kPositive, kRequired},
            {"diameter", "m", Range::kPositive, kRequired},
            {"clearance", "m", Range::kPositive, kRequired},
            {"viscosity", "Pa s", Range::kPositive, kRequired},
            {"load", "N", Range::kPositive, kRequired}}),
      magnetsSetting({node}, "current_x_NODE, current_y_NODE"),
      rows("unbalances", "at nodes",
           {node,
            {"magnitude", "kg m", Range::kNotNegative, kRequired},
            {"angle", "rad", Range::kAny, 0.0}}),
      rows("stations", "nodes whose whirl is published as SYSTEM_node_N, beside that of probe_node",
           {node}),
      {"shear_deformation",
       SettingKind::kChoice,
       "",
       "Timoshenko's beam, or Rayleigh's without",
       {"true", "false"}},
      {"gravity_on_shaft",
       SettingKind::kChoice,
       "",
       "the rotor's weight, along -y",
       {"false", "true"}}};
  all.front().required = true;
  return all;
}

FlexibleShaft flexibleShaft(const ParameterValues& values, const Settings& settings,
                            double gravity) {
  const auto chosen = [&](const char* name) { return settings.choices.at(name) == "true"; };
  FlexibleShaft shaft;
  const double youngs_modulus = values.at("youngs_modulus");
  const double shear_modulus = values.at("shear_modulus");
  shaft.material = {
      youngs_modulus,
      shear_modulus > 0.0 ? shear_modulus : youngs_modulus / (2.0 * (1.0 + kUsualPoissonsRatio)),
      values.at("density"), chosen("shear_deformation")};
  shaft.internal_damping = values.at("internal_damping");
  shaft.elements = elementsOf(settings);
  shaft.gravity = chosen("gravity_on_shaft") ? gravity : 0.0;
  const int last = shaft.nodes() - 1;
  const std::vector<TableRow>& discs = table(settings, "discs");
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto& n = discs[i].numbers;
    shaft.discs.push_back({indexIn(discs[i], fmt::format("discs[{}]", i), "node", last),
                           n.at("mass"), n.at("polar_inertia"), n.at("transverse_inertia")});
  }
  addBearings(settings, shaft);
  const std::vector<TableRow>& unbalances = table(settings, "unbalances");
  for (std::size_t i = 0; i < unbalances.size(); ++i) {
    const auto& n = unbalances[i].numbers;
    shaft.unbalances.push_back(
        {indexIn(unbalances[i], fmt::format("unbalances[{}]", i), "node", last), n.at("magnitude"),
         n.at("angle")});
  }
  return shaft;
}

std::vector<NodeMagnet> nodeMagnets(const Settings& settings, int nodes) {
  std::vector<NodeMagnet> magnets;
  const std::vector<TableRow>& rows = magnetRows(settings);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("magnets[{}]", i);
    const int node = indexIn(rows[i], key, "node", nodes - 1);
    if (std::any_of(magnets.begin(), magnets.end(),
                    [node](const NodeMagnet& other) { return other.node == node; })) {
      throw SetupError(key + ".node", fmt::format("stands twice, found {}", node));
    }
    magnets.push_back({node, rotorMagnet(rows[i], key)});
  }
  return magnets;
}

std::vector<int> publishedNodes(const Settings& settings, const FlexibleShaft& shaft) {
  std::vector<int> nodes;
  const std::vector<TableRow>& rows = table(settings, "stations");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("stations[{}]", i);
    const int node = indexIn(rows[i], key, "node", shaft.nodes() - 1);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
      throw SetupError(key + ".node", fmt::format("stands twice, found {}", node));
    }
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace whirl_twin
