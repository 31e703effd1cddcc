#include "models/shaft_supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "mechanics/rotors/bearing_laws.h"
#include "models/local_element_settings.h"
#include "models/model_info.h"
#include "models/settings.h"

namespace whirl_twin {

namespace {

BearingCoefficients coefficientsOf(const TableRow& row) {
  const auto& n = row.numbers;
  return {n.at("kxx"), n.at("kxy"), n.at("kyx"), n.at("kyy"),
          n.at("cxx"), n.at("cxy"), n.at("cyx"), n.at("cyy")};
}

bool isGiven(const BearingCoefficients& b) {
  return b.kxx != 0.0 || b.kxy != 0.0 || b.kyx != 0.0 || b.kyy != 0.0 || b.cxx != 0.0 ||
         b.cxy != 0.0 || b.cyx != 0.0 || b.cyy != 0.0;
}

/// With the mass that moves along with the journal.
BearingCoefficients withMass(BearingCoefficients b, const TableRow& row, const std::string& key) {
  b.mxx = row.numbers.at("mxx");
  b.mxy = row.numbers.at("mxy");
  b.myy = row.numbers.at("myy");
  if (!(b.mxy * b.mxy <= b.mxx * b.myy)) {
    throw SetupError(
        key + ".mxy",
        fmt::format(
            "must give a positive semidefinite mass matrix, mxy^2 <= mxx myy = {:.6g} kg^2, found "
            "{}",
            b.mxx * b.myy, b.mxy));
  }
  return b;
}

SpeedBearing withMass(SpeedBearing bearing, const BearingCoefficients& mass) {
  bearing.coefficients = [law = bearing.coefficients, mass](double speed) {
    BearingCoefficients b = law(speed);
    b.mxx = mass.mxx;
    b.mxy = mass.mxy;
    b.myy = mass.myy;
    return b;
  };
  return bearing;
}

/// The rows of `name`, by the `of` of `count` that each is of.
std::vector<std::vector<BearingRow>> speedTables(const Settings& settings, const std::string& name,
                                                 const char* of, std::size_t count) {
  std::vector<std::vector<BearingRow>> tables(count);
  const std::vector<TableRow>& rows = rowsOf(settings, name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("{}[{}]", name, i);
    if (count == 0) {
      throw SetupError(fmt::format("{}.{}", key, of),
                       fmt::format("needs a row in {}s to refer to", of));
    }
    const auto which =
        static_cast<std::size_t>(indexIn(rows[i], key, of, static_cast<int>(count) - 1));
    const double speed = rows[i].numbers.at("speed");
    if (!tables[which].empty() && !(speed > tables[which].back().speed)) {
      throw SetupError(key + ".speed",
                       fmt::format("must be > {} rad/s, the row before of this {}, found {}",
                                   tables[which].back().speed, of, speed));
    }
    tables[which].push_back({speed, coefficientsOf(rows[i])});
  }
  return tables;
}

/// Of a word that is yes or no.
bool isTrue(const TableRow& row, const char* word, const std::string& key) {
  const auto found = row.words.find(word);
  const std::string& given = found == row.words.end() ? std::string() : found->second;
  if (!given.empty() && given != "true" && given != "false") {
    throw SetupError(fmt::format("{}.{}", key, word),
                     fmt::format("must be true or false, found '{}'", given));
  }
  return given == "true";
}

/// Which of a row's rigid supports it is; nothing of a bearing with coefficients.
std::optional<RigidSupport> rigidSupport(const TableRow& row, int node, bool over_speed,
                                         const std::string& key) {
  const bool pins = isTrue(row, "pin", key);
  const bool clamps = isTrue(row, "clamp", key);
  if (!pins && !clamps) {
    return std::nullopt;
  }
  const char* what = clamps ? "clamp" : "pin";
  if (pins && clamps) {
    throw SetupError(key, "must give pin or clamp, not both: a clamp includes a pin");
  }
  if (over_speed) {
    throw SetupError(
        key, fmt::format("must not have rows in bearing_tables, because a {} is rigid", what));
  }
  for (const auto& [name, value] : row.numbers) {
    if (name != "node" && value != 0.0) {
      throw SetupError(fmt::format("{}.{}", key, name),
                       fmt::format("a {} is rigid: must not have {}, found {}", what, name, value));
    }
  }
  return RigidSupport{node, clamps};
}

/// Nothing else holds a node that is held rigidly.
void requireRigidAlone(const Settings& settings, const FlexibleShaft& shaft) {
  const std::vector<NodeElement> elements = nodeElements(settings, shaft.nodes());
  for (std::size_t i = 0; i < shaft.rigid_supports.size(); ++i) {
    const int node = shaft.rigid_supports[i].node;
    const auto here = [node](const auto& each) { return each.node == node; };
    const auto others = [&](const auto& all) { return std::any_of(all.begin(), all.end(), here); };
    const bool by_element = std::any_of(elements.begin(), elements.end(), [&](const auto& one) {
      return one.node == node && one.between != NodeElement::Between::kPedestalAndGround;
    });
    const auto same = std::count_if(shaft.rigid_supports.begin(), shaft.rigid_supports.end(), here);
    if (same > 1 || others(shaft.bearings) || others(shaft.speed_bearings) || by_element) {
      throw SetupError("bearings",
                       fmt::format("node {} has a pin or clamp: no other bearing, film, magnet, "
                                   "spring or rub can act on the shaft there",
                                   node));
    }
  }
}

void addBearings(const Settings& settings, FlexibleShaft& shaft) {
  const int last = shaft.nodes() - 1;
  const std::vector<TableRow>& rows = rowsOf(settings, "bearings");
  const auto tables = speedTables(settings, "bearing_tables", "bearing", rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("bearings[{}]", i);
    const int node = indexIn(rows[i], key, "node", last);
    if (const auto rigid = rigidSupport(rows[i], node, !tables[i].empty(), key)) {
      shaft.rigid_supports.push_back(*rigid);
      continue;
    }
    const RotorBearing bearing{node, withMass(coefficientsOf(rows[i]), rows[i], key)};
    if (tables[i].empty()) {
      shaft.bearings.push_back(bearing);
    } else if (isGiven(bearing.coefficients)) {
      throw SetupError(key, "must give its node only: bearing_tables gives its coefficients");
    } else {
      shaft.speed_bearings.push_back(
          withMass(tabulatedBearing(bearing.node, tables[i]), bearing.coefficients));
    }
  }
  for (const NodeMagnet& at : nodeMagnets(settings, shaft.nodes())) {
    BearingCoefficients coefficients;
    coefficients.kxx = coefficients.kyy = -at.magnet.ks;
    shaft.bearings.push_back({at.node, coefficients});
  }
  const std::vector<TableRow>& journals = rowsOf(settings, "journal_bearings");
  for (std::size_t i = 0; i < journals.size(); ++i) {
    const auto& n = journals[i].numbers;
    if (!(n.at("load") > 0.0)) {
      continue;  // a film by its own law: models/local_element_settings.h
    }
    const ShortJournalBearing journal{n.at("length"), n.at("diameter"), n.at("clearance"),
                                      n.at("viscosity")};
    const int node = indexIn(journals[i], fmt::format("journal_bearings[{}]", i), "node", last);
    shaft.speed_bearings.push_back(journalBearing(node, journal, n.at("load")));
  }
}

void addPedestals(const Settings& settings, FlexibleShaft& shaft) {
  const std::vector<NodeMagnet> magnets = nodeMagnets(settings, shaft.nodes());
  const std::vector<NodeElement> elements = nodeElements(settings, shaft.nodes());
  const std::vector<TableRow>& rows = rowsOf(settings, "pedestals");
  const auto tables = speedTables(settings, "pedestal_tables", "pedestal", rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("pedestals[{}]", i);
    const auto& n = rows[i].numbers;
    const int node = indexIn(rows[i], key, "node", shaft.nodes() - 1);
    const auto here = [node](const auto& each) { return each.node == node; };
    if (std::any_of(magnets.begin(), magnets.end(), here)) {
      throw SetupError(key + ".node", fmt::format("must be a node without a magnet, whose force "
                                                  "acts between shaft and ground, found {}",
                                                  node));
    }
    if (std::none_of(shaft.bearings.begin(), shaft.bearings.end(), here) &&
        std::none_of(shaft.speed_bearings.begin(), shaft.speed_bearings.end(), here) &&
        std::none_of(shaft.rigid_supports.begin(), shaft.rigid_supports.end(), here) &&
        std::none_of(elements.begin(), elements.end(), [node](const NodeElement& element) {
          return element.node == node && element.between == NodeElement::Between::kShaftAndPedestal;
        })) {
      throw SetupError(key + ".node", fmt::format("must be a node with a bearing, found {}", node));
    }
    for (const char* mass : {"mass", "mass_y"}) {
      if (!(n.at(mass) > 0.0)) {
        throw SetupError(fmt::format("{}.{}", key, mass),
                         fmt::format("must be > 0 kg, found {}; a spring without a mass is part of "
                                     "the bearing, k1 k2 / (k1 + k2)",
                                     n.at(mass)));
      }
    }
    shaft.pedestals.push_back({node, n.at("mass"), n.at("mass_y"), coefficientsOf(rows[i])});
    if (tables[i].empty()) {
      continue;
    }
    RotorPedestal& pedestal = shaft.pedestals.back();
    if (isGiven(pedestal.coefficients)) {
      throw SetupError(key,
                       "must give its node and mass only: pedestal_tables gives its coefficients");
    }
    const SpeedBearing law = tabulatedBearing(node, tables[i]);
    pedestal.over_speed = law.coefficients;
    pedestal.knots = law.knots;
    pedestal.data = law.data;
  }
}

/// Along y as along x unless they are given.
std::vector<ColumnInfo> coefficientColumns(std::vector<ColumnInfo> columns) {
  for (const auto& [letter, unit] : {std::pair{'k', "N/m"}, std::pair{'c', "N s/m"}}) {
    const std::string xx = fmt::format("{}xx", letter);
    columns.push_back({xx, unit, Range::kAny, 0.0});
    columns.push_back({fmt::format("{}yy", letter), unit, Range::kAny, 0.0, xx});
    columns.push_back({fmt::format("{}xy", letter), unit, Range::kAny, 0.0});
    columns.push_back({fmt::format("{}yx", letter), unit, Range::kAny, 0.0});
  }
  return columns;
}

}  // namespace

std::vector<SettingInfo> supportSettings() {
  const auto rows = [](const char* name, const char* meaning, std::vector<ColumnInfo> columns) {
    SettingInfo info{name, SettingKind::kTable, "", meaning};
    info.columns = std::move(columns);
    return info;
  };
  const ColumnInfo node{"node", "-", Range::kNotNegative, kRequired};
  std::vector<ColumnInfo> bearing = coefficientColumns({node});
  bearing.insert(bearing.end(), {{"mxx", "kg", Range::kNotNegative, 0.0},
                                 {"myy", "kg", Range::kNotNegative, 0.0, "mxx"},
                                 {"mxy", "kg", Range::kAny, 0.0}});
  SettingInfo bearings =
      rows("bearings",
           "by eight coefficients and the added mass of a film; default of kyy, cyy, myy: kxx, "
           "cxx, mxx; pin: true instead of coefficients: rigid; clamp: true: rigid, with the slope "
           "fixed; no bearing at all: a free rotor",
           bearing);
  bearings.optional_words = {"pin", "clamp"};
  return {bearings,
          rows("bearing_tables", "coefficients of bearings[bearing] over the shaft's speed",
               coefficientColumns({{"bearing", "-", Range::kNotNegative, kRequired},
                                   {"speed", "rad/s", Range::kAny, kRequired}})),
          rows("journal_bearings",
               "short plain bearings: linearized (eight coefficients) under a load along -y, or, "
               "without one, nonlinear film forces",
               {node,
                {"length", "m", Range::kPositive, kRequired},
                {"diameter", "m", Range::kPositive, kRequired},
                {"clearance", "m", Range::kPositive, kRequired},
                {"viscosity", "Pa s", Range::kPositive, kRequired},
                {"load", "N", Range::kNotNegative, 0.0}}),
          rows("pedestals",
               "supports of the bearings of a node, by mass and eight coefficients; several of a "
               "node are in series, the last on the ground",
               coefficientColumns({node,
                                   {"mass", "kg", Range::kNotNegative, kRequired},
                                   {"mass_y", "kg", Range::kNotNegative, 0.0, "mass"}})),
          rows("pedestal_tables",
               "coefficients of pedestals[pedestal] over the shaft's speed (synchronous frequency)",
               coefficientColumns({{"pedestal", "-", Range::kNotNegative, kRequired},
                                   {"speed", "rad/s", Range::kAny, kRequired}})),
          magnetsSetting({node}, "current_x_NODE, current_y_NODE")};
}

void addSupports(const Settings& settings, FlexibleShaft& shaft) {
  addBearings(settings, shaft);
  requireRigidAlone(settings, shaft);
  addPedestals(settings, shaft);
}

std::vector<NodeMagnet> nodeMagnets(const Settings& settings, int nodes) {
  std::vector<NodeMagnet> magnets;
  const std::vector<TableRow>& rows = magnetRows(settings);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("magnets[{}]", i);
    const int node = indexIn(rows[i], key, "node", nodes - 1);
    if (std::any_of(magnets.begin(), magnets.end(),
                    [node](const NodeMagnet& other) { return other.node == node; })) {
      throw SetupError(key + ".node", fmt::format("duplicate: node {} already has one", node));
    }
    magnets.push_back({node, rotorMagnet(rows[i], key)});
  }
  return magnets;
}

}  // namespace whirl_twin
