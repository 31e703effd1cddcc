#include "models/flexible_shaft_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/local_element_settings.h"
#include "models/settings.h"
#include "models/shaft_materials.h"
#include "models/shaft_supports.h"

namespace whirl_twin {

namespace {

constexpr int kMaxElements = 100;
constexpr double kMaxShaft = 100.0;  // [m], of a machine
// Ip / Id of a disc without thickness is 2, of any other less; and data sheets round.
constexpr double kThinnest = 2.0 * 1.01;
constexpr double kSameDiameter = 1.0e-9;

/// A hollow cylinder or cone: both its diameters at both its ends.
struct Ring {
  double inner, outer, inner_end, outer_end;  ///< [m]

  double innerAt(double share) const { return inner + share * (inner_end - inner); }
  double outerAt(double share) const { return outer + share * (outer_end - outer); }
  ShaftSection section(double length, double from = 0.0, double to = 1.0) const {
    return {length, outerAt(from), innerAt(from), outerAt(to) - outerAt(from),
            innerAt(to) - innerAt(from)};
  }
};

void requireBelow(double inner, double outer, const std::string& key, const char* end) {
  if (!(inner < outer)) {
    throw SetupError(fmt::format("{}.inner_diameter{}", key, end),
                     fmt::format("must be < outer_diameter{} = {} m, found {}", end, outer, inner));
  }
}

std::vector<ShaftSection> elementsOf(const Settings& settings, const ShaftMaterials& materials) {
  std::vector<ShaftSection> elements;
  const std::vector<TableRow>& rows = rowsOf(settings, "elements");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("elements[{}]", i);
    const auto& row = rows[i].numbers;
    const Ring ring{row.at("inner_diameter"), row.at("outer_diameter"),
                    row.at("inner_diameter_end"), row.at("outer_diameter_end")};
    requireBelow(ring.inner, ring.outer, key, "");
    requireBelow(ring.inner_end, ring.outer_end, key, "_end");
    const double count = row.at("count");
    const double all = static_cast<double>(elements.size()) + count;
    if (all > kMaxElements) {
      throw SetupError(
          key + ".count",
          fmt::format("must give at most {} elements in total, found {}", kMaxElements, all));
    }
    for (int part = 0; part < static_cast<int>(count); ++part) {
      ShaftSection section = ring.section(row.at("length"), part / count, (part + 1) / count);
      section.material = materials.of(rows[i], key);
      section.axial_force = row.at("axial_force");
      section.torque = row.at("torque");
      elements.push_back(section);
    }
  }
  if (elements.empty()) {
    throw SetupError("elements", "missing; the shaft's elements, from node 0 on");
  }
  return elements;
}

/// Elements that are a coupling's: without mass, which is in the discs at their nodes.
void addCouplings(const Settings& settings, FlexibleShaft& shaft) {
  const std::vector<TableRow>& rows = rowsOf(settings, "couplings");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("couplings[{}]", i);
    const auto& n = rows[i].numbers;
    const int element = indexIn(rows[i], key, "element", shaft.nodes() - 2);
    ShaftSection& section = shaft.elements[static_cast<std::size_t>(element)];
    if (section.coupling) {
      throw SetupError(key + ".element",
                       fmt::format("duplicate: element {} already has a coupling", element));
    }
    section.coupling = {n.at("lateral_stiffness"), n.at("bending_stiffness"),
                        n.at("lateral_damping"), n.at("bending_damping")};
    section.material = section.material.value_or(shaft.material);
    section.material->density = 0.0;
  }
}

std::vector<DampingRatio> modalDampingOf(const Settings& settings) {
  std::vector<DampingRatio> ratios;
  const std::vector<TableRow>& rows = rowsOf(settings, "modal_damping");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double frequency = rows[i].numbers.at("frequency");
    if (!ratios.empty() && !(frequency > ratios.back().frequency)) {
      throw SetupError(fmt::format("modal_damping[{}].frequency", i),
                       fmt::format("must be > {} rad/s, the row before, found {}",
                                   ratios.back().frequency, frequency));
    }
    ratios.push_back({frequency, rows[i].numbers.at("ratio")});
  }
  return ratios;
}

/// The cross-section of an element with its sleeves.
Ring ringOf(const ShaftSection& section) {
  return {section.inner_diameter, section.outer_diameter,
          section.inner_diameter + section.inner_growth,
          section.outer_diameter + section.outer_growth};
}

/// A sleeve around what is there, or a liner within; what is there grows by it.
ShaftSection sleeveOn(Ring& there, double length, const std::map<std::string, double>& row,
                      const std::string& key) {
  const double outer = row.at("outer_diameter");
  const double inner = row.at("inner_diameter");
  Ring ring{inner, outer, inner, outer};
  if (inner == 0.0) {
    ring.inner = there.outer;
    ring.inner_end = there.outer_end;
  }
  const double around = std::max(there.outer, there.outer_end);
  const double bore = std::min(there.inner, there.inner_end);
  const bool liner = inner > 0.0 && outer <= bore * (1.0 + kSameDiameter);
  if (liner) {
    there.inner = there.inner_end = inner;
  } else if (!(outer > around)) {
    throw SetupError(
        key + ".outer_diameter",
        fmt::format("must be > {} m, the outer diameter below it, found {}", around, outer));
  } else if (inner > 0.0 && !(inner >= around * (1.0 - kSameDiameter))) {
    throw SetupError(
        key + ".inner_diameter",
        fmt::format("must be >= {} m, the outer diameter below it, or omitted, found {}", around,
                    inner));
  } else {
    there.outer = there.outer_end = outer;
  }
  requireBelow(inner, outer, key, "");
  return ring.section(length);
}

void addSleeves(const Settings& settings, const ShaftMaterials& materials, FlexibleShaft& shaft) {
  const int last = shaft.nodes() - 1;
  std::vector<Ring> taken;
  for (const ShaftSection& element : shaft.elements) {
    taken.push_back(ringOf(element));
  }
  const std::vector<TableRow>& rows = rowsOf(settings, "sleeves");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("sleeves[{}]", i);
    const auto& row = rows[i].numbers;
    const int from = indexIn(rows[i], key, "from", last);
    const int to = indexIn(rows[i], key, "to", last);
    if (!(from < to)) {
      throw SetupError(key + ".to", fmt::format("must be > from = {}, found {}", from, to));
    }
    const double share = row.at("stiffness_share");
    if (!(share <= 1.0)) {
      throw SetupError(key + ".stiffness_share",
                       fmt::format("must be from 0 to 1, found {}", share));
    }
    for (int element = from; element < to; ++element) {
      const auto e = static_cast<std::size_t>(element);
      if (shaft.elements[e].coupling) {
        throw SetupError(key, fmt::format("must sit on a shaft; element {} is a coupling", e));
      }
      const ShaftSection section = sleeveOn(taken[e], shaft.elements[e].length, row, key);
      shaft.sleeves.push_back({element, {materials.of(rows[i], key), section, share}});
    }
  }
}

/// By its inertias, or a hollow cylinder.
RotorDisc discOf(const TableRow& row, const ShaftMaterials& materials, int last,
                 const std::string& key) {
  const auto& n = row.numbers;
  RotorDisc disc{indexIn(row, key, "node", last), n.at("mass"), n.at("polar_inertia"),
                 n.at("transverse_inertia"),      n.at("skew"), n.at("skew_angle")};
  const double outer = n.at("outer_diameter");
  const double inner = n.at("inner_diameter");
  const double width = n.at("width");
  const bool by_inertias =
      disc.mass > 0.0 || disc.polar_inertia > 0.0 || disc.transverse_inertia > 0.0;
  if (outer == 0.0 && width == 0.0 && inner == 0.0 && row.words.at("material").empty()) {
    if (!by_inertias) {
      throw SetupError(key + ".mass", "missing; in kg, or outer_diameter and width in m");
    }
    return disc;
  }
  if (by_inertias) {
    throw SetupError(key, "must give a mass and inertias, or outer_diameter and width, not both");
  }
  for (const auto& [name, value] :
       {std::pair{"outer_diameter", outer}, std::pair{"width", width}}) {
    if (!(value > 0.0)) {
      throw SetupError(fmt::format("{}.{}", key, name), "must be > 0 m for a disc by its geometry");
    }
  }
  requireBelow(inner, outer, key, "");
  const ElementBody body = elementBody({{materials.of(row, key), {width, outer, inner}}});
  disc.mass = body.mass;
  disc.polar_inertia = body.polar_inertia;
  disc.transverse_inertia = body.transverse_inertia;
  disc.diameter = outer;
  disc.width = width;
  return disc;
}

}  // namespace

std::vector<SettingInfo> flexibleShaftSettings() {
  const auto rows = [](const char* name, const char* meaning, std::vector<ColumnInfo> columns) {
    SettingInfo info{name, SettingKind::kTable, "", meaning};
    info.columns = std::move(columns);
    return info;
  };
  const auto ofMaterial = [](SettingInfo info) {
    info.optional_words = {"material"};
    return info;
  };
  const ColumnInfo node{"node", "-", Range::kNotNegative, kRequired};
  std::vector<SettingInfo> all{
      ofMaterial(
          rows("elements",
               "of the shaft; element i joins node i and node i + 1. length is that of each of its "
               "count elements, which are count times as long together. A row tapers evenly over "
               "all of them to its diameters at its _end; a positive axial force is tension, a "
               "positive torque rotates the following part from x to y",
               {{"length", "m", Range::kPositive, kRequired},
                {"outer_diameter", "m", Range::kPositive, kRequired},
                {"outer_diameter_end", "m", Range::kPositive, 0.0, "outer_diameter"},
                {"inner_diameter", "m", Range::kNotNegative, 0.0},
                {"inner_diameter_end", "m", Range::kNotNegative, 0.0, "inner_diameter"},
                {"axial_force", "N", Range::kAny, 0.0},
                {"torque", "N m", Range::kAny, 0.0},
                {"count", "-", Range::kCount, 1.0}})),
      rows("couplings",
           "elements that are a joint between two rigid arms: without mass (add discs at their "
           "nodes); the row in elements gives their length and drawing. They rotate with the "
           "shaft",
           {{"element", "-", Range::kNotNegative, kRequired},
            {"lateral_stiffness", "N/m", Range::kNotNegative, kRequired},
            {"bending_stiffness", "N m/rad", Range::kNotNegative, kRequired},
            {"lateral_damping", "N s/m", Range::kNotNegative, 0.0},
            {"bending_damping", "N m s/rad", Range::kNotNegative, 0.0}}),
      materialsSetting(),
      ofMaterial(rows("sleeves",
                      "on the elements between two nodes, or in their bore, in layers; "
                      "inner_diameter 0: the diameter below it; stiffness_share 0: mass only",
                      {{"from", "-", Range::kNotNegative, kRequired},
                       {"to", "-", Range::kNotNegative, kRequired},
                       {"outer_diameter", "m", Range::kPositive, kRequired},
                       {"inner_diameter", "m", Range::kNotNegative, 0.0},
                       {"stiffness_share", "-", Range::kNotNegative, 1.0}})),
      ofMaterial(rows("discs",
                      "rigid, at nodes, by mass and inertias or by diameters, width and material; "
                      "mass alone: a point mass",
                      {node,
                       {"mass", "kg", Range::kNotNegative, 0.0},
                       {"polar_inertia", "kg m^2", Range::kNotNegative, 0.0},
                       {"transverse_inertia", "kg m^2", Range::kNotNegative, 0.0},
                       {"outer_diameter", "m", Range::kNotNegative, 0.0},
                       {"inner_diameter", "m", Range::kNotNegative, 0.0},
                       {"width", "m", Range::kNotNegative, 0.0},
                       {"skew", "rad", Range::kNotNegative, 0.0},
                       {"skew_angle", "rad", Range::kAny, 0.0}}))};
  for (SettingInfo& info : supportSettings()) {
    all.push_back(std::move(info));
  }
  all.insert(
      all.end(),
      {rows("unbalances", "at nodes",
            {node,
             {"magnitude", "kg m", Range::kNotNegative, kRequired},
             {"angle", "rad", Range::kAny, 0.0}}),
       rows("modal_damping",
            "damping ratio over the natural frequency at standstill, non-rotating, for every mode "
            "of rotor and undamped bearings; linear between rows, constant outside",
            {{"frequency", "rad/s", Range::kNotNegative, 0.0},
             {"ratio", "-", Range::kNotNegative, kRequired}}),
       rows("stations",
            "nodes whose whirl is published as SYSTEM_node_N, besides that of probe_node", {node}),
       {"shear_deformation",
        SettingKind::kChoice,
        "",
        "true: Timoshenko beam; false: Rayleigh beam",
        {"true", "false"}},
       {"gravity_on_shaft",
        SettingKind::kChoice,
        "",
        "the rotor's weight, along -y",
        {"false", "true"}}});
  all.front().required = true;
  return all;
}

FlexibleShaft flexibleShaft(const ParameterValues& values, const Settings& settings,
                            double gravity) {
  const ShaftMaterials materials(values, settings);
  FlexibleShaft shaft;
  shaft.material = materials.own();
  shaft.internal_damping = values.at("internal_damping");
  shaft.mass_damping = values.at("mass_damping");
  shaft.stiffness_damping = values.at("stiffness_damping");
  shaft.elements = elementsOf(settings, materials);
  shaft.gravity = settings.choices.at("gravity_on_shaft") == "true" ? gravity : 0.0;
  shaft.modal_damping = modalDampingOf(settings);
  addCouplings(settings, shaft);
  addSleeves(settings, materials, shaft);
  const int last = shaft.nodes() - 1;
  const std::vector<TableRow>& discs = rowsOf(settings, "discs");
  for (std::size_t i = 0; i < discs.size(); ++i) {
    shaft.discs.push_back(discOf(discs[i], materials, last, fmt::format("discs[{}]", i)));
  }
  addSupports(settings, shaft);
  for (const NodeMagnet& magnet : nodeMagnets(settings, shaft.nodes())) {
    shaft.pushed.push_back(magnet.node);
  }
  for (const NodeElement& element : nodeElements(settings, shaft.nodes())) {
    shaft.pushed.push_back(element.node);
  }
  const std::vector<TableRow>& unbalances = rowsOf(settings, "unbalances");
  for (std::size_t i = 0; i < unbalances.size(); ++i) {
    const auto& n = unbalances[i].numbers;
    shaft.unbalances.push_back(
        {indexIn(unbalances[i], fmt::format("unbalances[{}]", i), "node", last), n.at("magnitude"),
         n.at("angle")});
  }
  return shaft;
}

std::vector<std::string> shaftNotes(const ParameterValues& values, const Settings& settings,
                                    const FlexibleShaft& shaft) {
  std::vector<std::string> notes = ShaftMaterials(values, settings).notes();
  for (const char* table : {"bearings", "bearing_tables", "pedestal_tables"}) {
    for (std::string& note : followingNotes(settings, table)) {
      notes.push_back(std::move(note));
    }
  }
  const double length = shaft.positions().back();
  if (length > kMaxShaft) {
    notes.push_back(fmt::format("the shaft is {:.6g} m long; lengths are in m", length));
  }
  double thickest = 0.0;
  for (const ShaftSection& element : shaft.elements) {
    thickest = std::max(thickest, element.outer_diameter);
  }
  if (thickest > length) {
    notes.push_back(fmt::format("the shaft is {:.6g} m thick and {:.6g} m long; lengths are in m",
                                thickest, length));
  }
  for (std::size_t i = 0; i < shaft.discs.size(); ++i) {
    const RotorDisc& disc = shaft.discs[i];
    if (disc.transverse_inertia > 0.0 && disc.polar_inertia > kThinnest * disc.transverse_inertia) {
      notes.push_back(
          fmt::format("discs[{}]: polar_inertia, {:.6g} kg m^2, should be at most twice "
                      "transverse_inertia, {:.6g} kg m^2",
                      i, disc.polar_inertia, disc.transverse_inertia));
    }
  }
  return notes;
}

std::vector<int> publishedNodes(const Settings& settings, const FlexibleShaft& shaft) {
  std::vector<int> nodes;
  const std::vector<TableRow>& rows = rowsOf(settings, "stations");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = fmt::format("stations[{}]", i);
    const int node = indexIn(rows[i], key, "node", shaft.nodes() - 1);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
      throw SetupError(key + ".node", fmt::format("duplicate: node {} already has one", node));
    }
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace whirl_twin
