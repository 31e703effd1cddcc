// Rotors of ROSS, as its Rotor.save() writes them: a table for each element, "ShaftElement_TAG",
// "DiskElement_TAG", "BearingElement_TAG" ..., whose keys are the arguments that made it (SI). What
// it calls a node's number is ours, too; several shaft elements of one number are layers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <toml.hpp>

#include "messages/names.h"
#include "messages/refusal.h"
#include "reports/rotor_drawing.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"

namespace whirl_twin {

namespace {

using nlohmann::json;

constexpr double kNoStiffness = 1.0e-3;  // of the shaft's modulus: a layer that is mass only

json jsonOf(const toml::value& value) {
  switch (value.type()) {
    case toml::value_t::boolean:
      return value.as_boolean();
    case toml::value_t::integer:
      return value.as_integer();
    case toml::value_t::floating:
      return value.as_floating();
    case toml::value_t::string:
      return value.as_string().str;
    case toml::value_t::array: {
      json all = json::array();
      for (const toml::value& one : value.as_array()) {
        all.push_back(jsonOf(one));
      }
      return all;
    }
    case toml::value_t::table: {
      json all = json::object();
      for (const auto& [key, one] : value.as_table()) {
        all[key] = jsonOf(one);
      }
      return all;
    }
    default:
      return nullptr;
  }
}

json treeOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw Refusal(path + ": cannot be read; must be a rotor that ROSS has saved");
  }
  try {
    json tree = std::filesystem::path(path).extension() == ".json" ? json::parse(in)
                                                                   : jsonOf(toml::parse(in, path));
    if (!tree.is_object()) {
      throw Refusal(path + ": must be a rotor that ROSS has saved, found a list or a value");
    }
    return tree;
  } catch (const json::exception& error) {
    throw Refusal(fmt::format("{}: is no JSON: {}", path, error.what()));
  } catch (const toml::exception& error) {
    throw Refusal(fmt::format("{}: is no TOML, in line {}", path, error.location().line()));
  }
}

/// An entry of the file.
struct Entry {
  std::string kind;  ///< "ShaftElement"
  std::string key;   ///< "ShaftElement_Shaft Element 0"
  const json* fields;
};

class RossReader {
 public:
  explicit RossReader(const std::string& path) : tree_(treeOf(path)), complaints_(path) {
    drawing_.name = nameOf(path);
    drawing_.origin =
        fmt::format("A rotor of ROSS, from {}.", std::filesystem::path(path).filename().string());
    for (const auto& [key, value] : tree_.items()) {
      const std::size_t bar = key.find('_');
      if (value.is_object() && bar != std::string::npos && bar > 0) {
        entries_.push_back({key.substr(0, bar), key, &value});
      }
    }
  }

  RotorDrawing read() {
    readOperation();
    readShaft();
    readDiscs();
    readSupports();
    nameOthers();
    if (!complaints_.all().empty()) {
      throw SceneError(complaints_.all());
    }
    return drawing_;
  }

 private:
  struct Material {
    double youngs_modulus = 0.0, shear_modulus = 0.0, density = 0.0;
    bool operator==(const Material& other) const {
      return youngs_modulus == other.youngs_modulus && shear_modulus == other.shear_modulus &&
             density == other.density;
    }
  };
  struct Layer {
    int node = 0;
    double length = 0.0, inner = 0.0, inner_end = 0.0, outer = 0.0, outer_end = 0.0;
    double axial_force = 0.0;
    Material material;
    std::string name;  ///< of the material
    Entry entry;
  };

  static bool is(const Entry& entry, const char* kind) { return entry.kind.rfind(kind, 0) == 0; }
  static bool isSupport(const Entry& entry) {
    return entry.fields->contains("kxx") && !is(entry, "Magnetic") && !is(entry, "Coupling");
  }

  double number(const json& fields, const std::string& where, const char* name, const char* unit,
                std::optional<double> fallback = std::nullopt) {
    const auto found = fields.find(name);
    if (found != fields.end() && found->is_number() && std::isfinite(found->get<double>())) {
      return found->get<double>();
    }
    const bool given = found != fields.end() && !found->is_null();
    if (given || !fallback) {
      complaints_.add(fmt::format("{}.{}", where, name),
                      fmt::format("must be a number{}{}, found {}", *unit == '\0' ? "" : " in ",
                                  unit, given ? printable(found->dump()) : "nothing"));
    }
    return fallback.value_or(0.0);
  }
  double number(const Entry& entry, const char* name, const char* unit,
                std::optional<double> fallback = std::nullopt) {
    return number(*entry.fields, entry.key, name, unit, fallback);
  }
  int node(const Entry& entry, const char* name = "n") {
    const double value = number(entry, name, "");
    const bool sound = value >= 0.0 && value < 1.0e6 && value == std::floor(value);
    if (!sound) {
      complaints_.add(fmt::format("{}.{}", entry.key, name),
                      fmt::format("must be the number of a node, found {}", value));
    }
    return sound ? static_cast<int>(value) : 0;
  }
  static bool flag(const Entry& entry, const char* name) {
    const auto found = entry.fields->find(name);
    return found == entry.fields->end() || !found->is_boolean() || found->get<bool>();
  }
  void leaveOut(const std::string& line) { drawing_.left_out.push_back(printable(line)); }

  void readOperation() {
    const auto found = tree_.find("parameters");
    if (found != tree_.end() && found->is_object()) {
      drawing_.speed = number(*found, "parameters", "rated_w", "rad/s", 0.0);
      const double highest = number(*found, "parameters", "max_w", "rad/s", 0.0);
      if (highest > 0.0) {
        drawing_.highest_speed = highest;
      }
    }
  }

  Material materialOf(const Entry& entry) {
    const auto found = entry.fields->find("material");
    if (found == entry.fields->end() || !found->is_object()) {
      complaints_.add(entry.key + ".material", "must be a table with rho, E and G_s");
      return {};
    }
    const std::string where = entry.key + ".material";
    return {number(*found, where, "E", "Pa"), number(*found, where, "G_s", "Pa"),
            number(*found, where, "rho", "kg/m^3")};
  }

  std::vector<Layer> layers() {
    std::vector<Layer> all;
    for (const Entry& entry : entries_) {
      if (!is(entry, "ShaftElement")) {
        continue;
      }
      Layer layer;
      layer.node = node(entry);
      layer.length = number(entry, "L", "m");
      layer.inner = number(entry, "idl", "m");
      layer.outer = number(entry, "odl", "m");
      layer.inner_end = number(entry, "idr", "m", layer.inner);
      layer.outer_end = number(entry, "odr", "m", layer.outer);
      layer.axial_force = number(entry, "axial_force", "N", 0.0);
      layer.material = materialOf(entry);
      if (const auto found = entry.fields->find("material");
          found != entry.fields->end() && found->is_object()) {
        layer.name = found->value("name", "material");
      }
      layer.entry = entry;
      all.push_back(layer);
      if (number(entry, "torque", "N m", 0.0) != 0.0) {
        leaveOut(entry.key + ": torque");
      }
      for (const char* effect : {"rotary_inertia", "gyroscopic"}) {
        if (!flag(entry, effect)) {
          leaveOut(fmt::format("{}: {}: false; elements have it here", entry.key, effect));
        }
      }
    }
    // Of a node from within, in the order that sleeves sit upon each other.
    std::stable_sort(all.begin(), all.end(), [](const Layer& a, const Layer& b) {
      return std::pair(a.node, a.inner) < std::pair(b.node, b.inner);
    });
    return all;
  }

  void readShaft() {
    const std::vector<Layer> all = layers();
    if (all.empty()) {
      complaints_.add("", "has no ShaftElement");
      return;
    }
    const Material& shaft = all.front().material;
    drawing_.youngs_modulus = shaft.youngs_modulus;
    drawing_.shear_modulus = shaft.shear_modulus;
    drawing_.density = shaft.density;
    const Entry& first = all.front().entry;
    drawing_.shear_deformation = flag(first, "shear_effects");
    drawing_.mass_damping = number(first, "alpha", "1/s", 0.0);
    drawing_.stiffness_damping = number(first, "beta", "s", 0.0);
    for (const Layer& layer : all) {
      if (flag(layer.entry, "shear_effects") != drawing_.shear_deformation) {
        leaveOut(layer.entry.key + ": shear_effects other than the first element's");
      }
      if (number(layer.entry, "alpha", "1/s", 0.0) != drawing_.mass_damping ||
          number(layer.entry, "beta", "s", 0.0) != drawing_.stiffness_damping) {
        leaveOut(layer.entry.key + ": alpha or beta other than the first element's");
      }
      const bool within = layer.node < last_node_;
      if (within) {
        addSleeve(layer);
      } else {
        addElement(layer);
      }
    }
  }

  void addElement(const Layer& layer) {
    if (layer.node != last_node_) {
      complaints_.add(layer.entry.key + ".n",
                      fmt::format("there is no shaft element from node {}", last_node_));
    }
    last_node_ = layer.node + 1;
    DrawnRow row;
    if (const std::string name = nameOfMaterial(layer, false); !name.empty()) {
      row.emplace_back("material", name);
    }
    row.emplace_back("length", drawn(layer.length));
    row.emplace_back("outer_diameter", drawn(layer.outer));
    const bool tapers = layer.outer_end != layer.outer || layer.inner_end != layer.inner;
    if (tapers) {
      row.emplace_back("outer_diameter_end", drawn(layer.outer_end));
    }
    if (layer.inner != 0.0 || layer.inner_end != 0.0) {
      row.emplace_back("inner_diameter", drawn(layer.inner));
      if (tapers) {
        row.emplace_back("inner_diameter_end", drawn(layer.inner_end));
      }
    }
    if (layer.axial_force != 0.0) {
      row.emplace_back("axial_force", drawn(layer.axial_force));
    }
    drawing_.elements.push_back(row);
  }

  void addSleeve(const Layer& layer) {
    const bool mass_only = layer.material.youngs_modulus < kNoStiffness * drawing_.youngs_modulus;
    if (layer.outer_end != layer.outer || layer.inner_end != layer.inner) {
      leaveOut(layer.entry.key + ": the taper of a layer; it has the diameters of its left end");
    }
    DrawnRow row;
    if (const std::string name = nameOfMaterial(layer, mass_only); !name.empty()) {
      row.emplace_back("material", name);
    }
    row.emplace_back("from", std::to_string(layer.node));
    row.emplace_back("to", std::to_string(layer.node + 1));
    row.emplace_back("outer_diameter", drawn(layer.outer));
    row.emplace_back("inner_diameter", drawn(layer.inner));
    if (mass_only) {
      row.emplace_back("stiffness_share", "0.0");
    }
    drawing_.sleeves.push_back(row);
  }

  /// "" of the shaft's own.
  std::string nameOfMaterial(const Layer& layer, bool mass_only) {
    Material material = layer.material;
    if (mass_only) {  // its stiffness has no part in anything
      material.youngs_modulus = drawing_.youngs_modulus;
      material.shear_modulus = drawing_.shear_modulus;
    }
    const Material shaft{drawing_.youngs_modulus, drawing_.shear_modulus, drawing_.density};
    if (material == shaft) {
      return "";
    }
    const auto known = std::find_if(materials_.begin(), materials_.end(),
                                    [&](const auto& other) { return other.second == material; });
    if (known != materials_.end()) {
      return known->first;
    }
    std::string name = nameOf(layer.name) + (mass_only ? "_mass_only" : "");
    for (int i = 2; materials_.count(name) > 0; ++i) {
      name = fmt::format("{}_{}", nameOf(layer.name), i);
    }
    materials_[name] = material;
    drawing_.materials.push_back({{"name", name},
                                  {"youngs_modulus", drawn(material.youngs_modulus)},
                                  {"shear_modulus", drawn(material.shear_modulus)},
                                  {"density", drawn(material.density)}});
    return name;
  }

  void readDiscs() {
    for (const Entry& entry : entries_) {
      if (is(entry, "DiskElement")) {
        drawing_.discs.push_back({{"node", std::to_string(node(entry))},
                                  {"mass", drawn(number(entry, "m", "kg"))},
                                  {"polar_inertia", drawn(number(entry, "Ip", "kg m^2"))},
                                  {"transverse_inertia", drawn(number(entry, "Id", "kg m^2"))}});
      } else if (is(entry, "PointMass") && node(entry) <= last_node_) {
        const auto [along_x, along_y] = massOf(entry);
        drawing_.discs.push_back({{"node", std::to_string(node(entry))}, {"mass", drawn(along_x)}});
        if (along_x != along_y) {
          leaveOut(entry.key + ": my other than mx, which is taken");
        }
      }
    }
  }

  std::pair<double, double> massOf(const Entry& entry) {
    const auto found = entry.fields->find("m");
    if (found != entry.fields->end() && found->is_number()) {
      return {found->get<double>(), found->get<double>()};
    }
    const double along_x = number(entry, "mx", "kg");
    return {along_x, number(entry, "my", "kg", along_x)};
  }

  /// A coefficient at each of the frequencies; one number is one at all.
  std::vector<double> coefficient(const Entry& entry, const std::string& name, std::size_t count) {
    const auto found = entry.fields->find(name);
    if (found == entry.fields->end() || found->is_null()) {
      return std::vector<double>(count, 0.0);
    }
    std::vector<double> values;
    for (const json& value : found->is_array() ? *found : json::array({*found})) {
      if (!value.is_number()) {
        complaints_.add(fmt::format("{}.{}", entry.key, name),
                        fmt::format("must be numbers, found {}", printable(value.dump())));
        return std::vector<double>(count, 0.0);
      }
      values.push_back(value.get<double>());
    }
    if (values.size() == 1) {
      values.resize(count, values.front());
    }
    if (values.size() != count) {
      complaints_.add(
          fmt::format("{}.{}", entry.key, name),
          fmt::format("must have {} numbers as frequency has, found {}", count, values.size()));
      values.resize(count, 0.0);
    }
    return values;
  }

  std::vector<double> frequencies(const Entry& entry) {
    const auto found = entry.fields->find("frequency");
    if (found == entry.fields->end() || found->is_null()) {
      return {};
    }
    const std::size_t count = found->is_array() ? found->size() : 1;
    return coefficient(entry, "frequency", count);
  }

  /// Behind what is in `row`; k of frequency, of a table.
  void addCoefficients(const Entry& entry, std::size_t k, std::size_t count, DrawnRow& row) {
    for (const char letter : {'k', 'c'}) {
      for (const char* axes : {"xx", "yy", "xy", "yx"}) {
        const std::string name = letter + std::string(axes);
        std::vector<double> values = coefficient(entry, name, count);
        const bool as_x = axes == std::string("yy") && entry.fields->count(name) == 0;
        if (!as_x && (values[k] != 0.0 || axes == std::string("yy"))) {
          row.emplace_back(name, drawn(values[k]));
        }
      }
    }
  }

  void readSupports() {
    for (const Entry& entry : entries_) {
      if (isSupport(entry) && node(entry) <= last_node_) {
        addBearing(entry);
        addPedestals(entry, node(entry));
      }
    }
  }

  void addBearing(const Entry& entry) {
    const std::vector<double> speeds = frequencies(entry);
    DrawnRow row{{"node", std::to_string(node(entry))}};
    const std::size_t count = std::max<std::size_t>(speeds.size(), 1);
    if (speeds.size() < 2) {
      addCoefficients(entry, 0, count, row);
    }
    for (std::size_t k = 0; speeds.size() >= 2 && k < count; ++k) {
      DrawnRow of_speed{{"bearing", std::to_string(drawing_.bearings.size())},
                        {"speed", drawn(speeds[k])}};
      addCoefficients(entry, k, count, of_speed);
      drawing_.bearing_tables.push_back(of_speed);
    }
    for (const char* name : {"mxx", "myy", "mxy"}) {
      const std::vector<double> values = coefficient(entry, name, count);
      if (std::any_of(values.begin(), values.end(), [&](double m) { return m != values[0]; })) {
        leaveOut(fmt::format("{}: {} over speed; its mean is taken", entry.key, name));
      }
      double mean = 0.0;
      for (const double value : values) {
        mean += value / static_cast<double>(count);
      }
      if (mean != 0.0 || (name == std::string("myy") && row.back().first == "mxx")) {
        row.emplace_back(name, drawn(mean));
      }
    }
    if (coefficient(entry, "myx", count) != coefficient(entry, "mxy", count)) {
      leaveOut(entry.key + ": myx other than mxy, which is taken");
    }
    for (const char* name : {"kzz", "czz", "mzz"}) {
      const std::vector<double> values = coefficient(entry, name, count);
      if (std::any_of(values.begin(), values.end(), [](double z) { return z != 0.0; })) {
        leaveOut(fmt::format("{}: {}, along the shaft", entry.key, name));
      }
    }
    drawing_.bearings.push_back(row);
  }

  /// What an element stands on: n_link is the node of a mass, which the support of that node holds.
  void addPedestals(const Entry& bearing, int of_node) {
    const Entry* above = &bearing;
    for (std::size_t i = 0; i < entries_.size(); ++i) {  // a chain that ends in itself ends here
      const auto link = above->fields->find("n_link");
      if (link == above->fields->end() || link->is_null()) {
        return;
      }
      const int place = node(*above, "n_link");
      const auto at = [&](const Entry& entry) {
        const auto n = entry.fields->find("n");
        return n != entry.fields->end() && n->is_number() && n->get<double>() == place;
      };
      const auto mass = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return is(entry, "PointMass") && at(entry);
      });
      const auto below = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return isSupport(entry) && at(entry);
      });
      if (mass == entries_.end() || below == entries_.end()) {
        leaveOut(fmt::format("{}: its n_link {} has no {}: it stands on the ground", above->key,
                             place, mass == entries_.end() ? "PointMass" : "bearing below"));
        return;
      }
      const auto [along_x, along_y] = massOf(*mass);
      DrawnRow row{{"node", std::to_string(of_node)}, {"mass", drawn(along_x)}};
      if (along_x != along_y) {
        row.emplace_back("mass_y", drawn(along_y));
      }
      const std::size_t count = std::max<std::size_t>(frequencies(*below).size(), 1);
      if (count > 1) {
        leaveOut(below->key + ": a pedestal over frequency; its first coefficients are taken");
      }
      addCoefficients(*below, 0, count, row);
      drawing_.pedestals.push_back(row);
      above = &*below;
    }
  }

  void nameOthers() {
    for (const Entry& entry : entries_) {
      if (!is(entry, "ShaftElement") && !is(entry, "DiskElement") && !is(entry, "PointMass") &&
          !isSupport(entry)) {
        leaveOut(fmt::format("{}: a {}", entry.key, entry.kind));
      }
    }
  }

  json tree_;
  std::vector<Entry> entries_;
  Complaints complaints_;
  RotorDrawing drawing_;
  std::map<std::string, Material> materials_;
  int last_node_ = 0;
};

}  // namespace

RotorDrawing drawingOfRoss(const std::string& path) {
  return RossReader(path).read();
}

}  // namespace whirl_twin
