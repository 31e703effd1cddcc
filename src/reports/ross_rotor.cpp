// Rotors of ROSS. What it calls a node's number is ours, too; several shaft elements of one number
// are layers.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "messages/names.h"
#include "reports/ross_file.h"
#include "reports/rotor_drawing.h"
#include "scene/scene_error.h"

namespace whirl_twin {

namespace {

constexpr double kCouplingLength = 0.2;  // m, and its diameter, unless they are given
constexpr double kNoStiffness = 1.0e-3;  // of the shaft's modulus: a layer that is mass only

/// Whatever they are called.
bool sameMaterial(const RossMaterial& a, const RossMaterial& b) {
  return a.youngs_modulus == b.youngs_modulus && a.shear_modulus == b.shear_modulus &&
         a.density == b.density;
}

class RossReader {
 public:
  explicit RossReader(const std::string& path) : diagnostics_(path), file_(path, diagnostics_) {
    drawing_.name = nameOf(path);
    drawing_.origin =
        fmt::format("A rotor of ROSS, from {}.", std::filesystem::path(path).filename().string());
  }

  RotorDrawing read() {
    readOperation();
    readShaft();
    readDiscs();
    readSupports();
    nameOthers();
    if (!diagnostics_.all().empty()) {
      throw SceneError(diagnostics_.all());
    }
    return drawing_;
  }

 private:
  struct Layer {
    int node = 0;
    double length = 0.0, inner = 0.0, inner_end = 0.0, outer = 0.0, outer_end = 0.0;
    double axial_force = 0.0, torque = 0.0;
    bool coupling = false;
    RossMaterial material;
    RossEntry entry;
  };

  void leaveOut(const std::string& line) { drawing_.left_out.push_back(printable(line, 200)); }

  void readOperation() {
    drawing_.speed = file_.parameter("rated_w", "rad/s");
    const double highest = file_.parameter("max_w", "rad/s");
    if (highest > 0.0) {
      drawing_.highest_speed = highest;
    }
  }

  Layer coupling(const RossEntry& entry) {
    Layer layer;
    layer.coupling = true;
    layer.node = file_.node(entry);
    layer.length = file_.number(entry, "L", "m", kCouplingLength);
    layer.outer = layer.outer_end = file_.number(entry, "o_d", "m", kCouplingLength);
    layer.entry = entry;
    return layer;
  }

  std::vector<Layer> layers() {
    std::vector<Layer> all;
    for (const RossEntry& entry : file_.entries()) {
      if (entry.is("CouplingElement")) {
        all.push_back(coupling(entry));
      }
      if (!entry.is("ShaftElement")) {
        continue;
      }
      Layer layer;
      layer.node = file_.node(entry);
      layer.length = file_.number(entry, "L", "m");
      layer.inner = file_.number(entry, "idl", "m");
      layer.outer = file_.number(entry, "odl", "m");
      layer.inner_end = file_.number(entry, "idr", "m", layer.inner);
      layer.outer_end = file_.number(entry, "odr", "m", layer.outer);
      layer.axial_force = file_.number(entry, "axial_force", "N", 0.0);
      layer.torque = file_.number(entry, "torque", "N m", 0.0);
      layer.material = file_.material(entry);
      layer.entry = entry;
      all.push_back(layer);
      for (const char* effect : {"rotary_inertia", "gyroscopic"}) {
        if (!file_.flag(entry, effect)) {
          leaveOut(fmt::format("{}: {}: false; always included here", entry.key, effect));
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
    const auto real =
        std::find_if(all.begin(), all.end(), [](const Layer& layer) { return !layer.coupling; });
    if (real == all.end()) {
      diagnostics_.add("", "must have a ShaftElement, found none");
      return;
    }
    const RossMaterial& shaft = real->material;
    drawing_.youngs_modulus = shaft.youngs_modulus;
    drawing_.shear_modulus = shaft.shear_modulus;
    drawing_.density = shaft.density;
    const RossEntry& first = real->entry;
    drawing_.shear_deformation = file_.flag(first, "shear_effects");
    drawing_.mass_damping = file_.number(first, "alpha", "1/s", 0.0);
    drawing_.stiffness_damping = file_.number(first, "beta", "s", 0.0);
    for (const Layer& layer : all) {
      if (layer.coupling) {
        addCoupling(layer);
        continue;
      }
      if (file_.flag(layer.entry, "shear_effects") != drawing_.shear_deformation) {
        leaveOut(layer.entry.key + ": shear_effects differs from the first element's");
      }
      if (file_.number(layer.entry, "alpha", "1/s", 0.0) != drawing_.mass_damping ||
          file_.number(layer.entry, "beta", "s", 0.0) != drawing_.stiffness_damping) {
        leaveOut(layer.entry.key + ": alpha or beta differs from the first element's");
      }
      const bool within = layer.node < last_node_;
      if (within) {
        addSleeve(layer);
      } else {
        addElement(layer);
      }
    }
  }

  void takeNodes(const Layer& layer) {
    if (layer.node != last_node_) {
      diagnostics_.add(layer.entry.key + ".n",
                       fmt::format("must have a shaft element at node {}, found none", last_node_));
    }
    last_node_ = layer.node + 1;
  }

  void addCoupling(const Layer& layer) {
    takeNodes(layer);
    drawing_.elements.push_back(
        {{"length", drawn(layer.length)}, {"outer_diameter", drawn(layer.outer)}});
    const RossCoupling coupling = rossCoupling(file_, layer.entry, layer.node);
    drawing_.couplings.push_back(coupling.row);
    drawing_.discs.insert(drawing_.discs.end(), coupling.hubs.begin(), coupling.hubs.end());
    for (const std::string& line : coupling.left_out) {
      leaveOut(line);
    }
  }

  void addElement(const Layer& layer) {
    takeNodes(layer);
    DrawnRow row;
    if (const std::string name = nameOfMaterial(layer, false); !name.empty()) {
      row.emplace_back("material", name);
    }
    const auto put = [&](const char* key, double value, bool needed) {
      if (needed) {
        row.emplace_back(key, drawn(value));
      }
    };
    const bool tapers = layer.outer_end != layer.outer || layer.inner_end != layer.inner;
    const bool hollow = layer.inner != 0.0 || layer.inner_end != 0.0;
    put("length", layer.length, true);
    put("outer_diameter", layer.outer, true);
    put("outer_diameter_end", layer.outer_end, tapers);
    put("inner_diameter", layer.inner, hollow);
    put("inner_diameter_end", layer.inner_end, hollow && tapers);
    put("axial_force", layer.axial_force, layer.axial_force != 0.0);
    put("torque", layer.torque, layer.torque != 0.0);
    drawing_.elements.push_back(row);
  }

  void addSleeve(const Layer& layer) {
    const bool mass_only = layer.material.youngs_modulus < kNoStiffness * drawing_.youngs_modulus;
    if (layer.outer_end != layer.outer || layer.inner_end != layer.inner) {
      leaveOut(layer.entry.key + ": the taper of a layer; the diameters of its left end are used");
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
    RossMaterial material = layer.material;
    if (mass_only) {  // its stiffness has no part in anything
      material.youngs_modulus = drawing_.youngs_modulus;
      material.shear_modulus = drawing_.shear_modulus;
    }
    const RossMaterial shaft{drawing_.youngs_modulus, drawing_.shear_modulus, drawing_.density, ""};
    if (sameMaterial(material, shaft)) {
      return "";
    }
    const auto known = std::find_if(materials_.begin(), materials_.end(), [&](const auto& other) {
      return sameMaterial(other.second, material);
    });
    if (known != materials_.end()) {
      return known->first;
    }
    std::string name = nameOf(layer.material.name) + (mass_only ? "_mass_only" : "");
    for (int i = 2; materials_.count(name) > 0; ++i) {
      name = fmt::format("{}_{}", nameOf(layer.material.name), i);
    }
    materials_[name] = material;
    drawing_.materials.push_back({{"name", name},
                                  {"youngs_modulus", drawn(material.youngs_modulus)},
                                  {"shear_modulus", drawn(material.shear_modulus)},
                                  {"density", drawn(material.density)}});
    return name;
  }

  void readDiscs() {
    for (const RossEntry& entry : file_.entries()) {
      if (entry.isDisc()) {
        if (!entry.is("DiskElement")) {
          leaveOut(fmt::format("{}: properties of a {} besides mass and inertias of a disc",
                               entry.key, entry.kind));
        }
        drawing_.discs.push_back(
            {{"node", std::to_string(file_.node(entry))},
             {"mass", drawn(file_.number(entry, "m", "kg"))},
             {"polar_inertia", drawn(file_.number(entry, "Ip", "kg m^2"))},
             {"transverse_inertia", drawn(file_.number(entry, "Id", "kg m^2"))}});
      } else if (entry.is("PointMass") && file_.node(entry) <= last_node_) {
        const auto [along_x, along_y] = file_.mass(entry);
        drawing_.discs.push_back(
            {{"node", std::to_string(file_.node(entry))}, {"mass", drawn(along_x)}});
        if (along_x != along_y) {
          leaveOut(entry.key + ": my differs from mx, which is used");
        }
      }
    }
  }

  /// Behind what is in `row`; the kth of a table.
  void addCoefficients(const RossEntry& entry, std::size_t k, const RossAxes& axes, DrawnRow& row) {
    for (const char letter : {'k', 'c'}) {
      for (const char* pair : {"xx", "yy", "xy", "yx"}) {
        const std::string name = letter + std::string(pair);
        std::vector<double> values = file_.coefficient(entry, name, axes);
        const bool as_x = pair == std::string("yy") && entry.fields->count(name) == 0;
        if (!as_x && (values[k] != 0.0 || pair == std::string("yy"))) {
          row.emplace_back(name, drawn(values[k]));
        }
      }
    }
  }

  void readSupports() {
    for (const RossEntry& entry : file_.entries()) {
      if (entry.isSupport() && file_.node(entry) <= last_node_) {
        addBearing(entry);
        addPedestals(entry, file_.node(entry));
      }
    }
  }

  /// Coefficients behind what is in `row`, or in a row of `table` for each speed: `of` names whose.
  void addTable(const RossEntry& entry, const RossAxes& axes, const DrawnRow::value_type& of,
                DrawnRow& row, std::vector<DrawnRow>& table) {
    if (axes.of_whirl || !axes.frequencies.empty()) {
      leaveOut(
          fmt::format("{}: coefficients over the whirl frequency; those at the speed (1X) are used "
                      "for all whirl frequencies",
                      entry.key));
    }
    if (axes.places.size() < 2) {
      addCoefficients(entry, 0, axes, row);
      return;
    }
    for (std::size_t k = 0; k < axes.places.size(); ++k) {
      table.push_back({of, {"speed", drawn(axes.places[k])}});
      addCoefficients(entry, k, axes, table.back());
    }
  }

  void addBearing(const RossEntry& entry) {
    const RossAxes axes = file_.axes(entry);
    DrawnRow row{{"node", std::to_string(file_.node(entry))}};
    addTable(entry, axes, {"bearing", std::to_string(drawing_.bearings.size())}, row,
             drawing_.bearing_tables);
    std::vector<double> across;
    for (const char* name : {"mxx", "myy", "mxy"}) {
      const std::vector<double> values = file_.coefficient(entry, name, axes);
      if (std::any_of(values.begin(), values.end(), [&](double m) { return m != values[0]; })) {
        leaveOut(fmt::format("{}: {} over speed; its mean is used", entry.key, name));
      }
      double mean = 0.0;
      for (const double value : values) {
        mean += value / static_cast<double>(values.size());
      }
      across = values;
      if (mean != 0.0 || (name == std::string("myy") && row.back().first == "mxx")) {
        row.emplace_back(name, drawn(mean));
      }
    }
    if (file_.coefficient(entry, "myx", axes) != across) {
      leaveOut(entry.key + ": myx differs from mxy, which is used");
    }
    for (const char* name : {"kzz", "czz", "mzz"}) {
      const std::vector<double> values = file_.coefficient(entry, name, axes);
      if (std::any_of(values.begin(), values.end(), [](double z) { return z != 0.0; })) {
        leaveOut(fmt::format("{}: {}, along the shaft", entry.key, name));
      }
    }
    drawing_.bearings.push_back(row);
  }

  /// Pedestals: n_link is the node of a mass, which the support of that node holds.
  void addPedestals(const RossEntry& bearing, int of_node) {
    const RossEntry* above = &bearing;
    for (std::size_t i = 0; i < file_.entries().size();
         ++i) {  // a chain that ends in itself ends here
      const auto link = above->fields->find("n_link");
      if (link == above->fields->end() || link->is_null()) {
        return;
      }
      const int place = file_.node(*above, "n_link");
      const auto at = [&](const RossEntry& entry) {
        const auto n = entry.fields->find("n");
        return n != entry.fields->end() && n->is_number() && n->get<double>() == place;
      };
      const auto mass =
          std::find_if(file_.entries().begin(), file_.entries().end(),
                       [&](const RossEntry& entry) { return entry.is("PointMass") && at(entry); });
      const auto below =
          std::find_if(file_.entries().begin(), file_.entries().end(),
                       [&](const RossEntry& entry) { return entry.isSupport() && at(entry); });
      if (mass == file_.entries().end() || below == file_.entries().end()) {
        leaveOut(fmt::format("{}: its n_link {} has no {}: it is connected to ground", above->key,
                             place, mass == file_.entries().end() ? "PointMass" : "bearing below"));
        return;
      }
      const auto [along_x, along_y] = file_.mass(*mass);
      DrawnRow row{{"node", std::to_string(of_node)}, {"mass", drawn(along_x)}};
      if (along_x != along_y) {
        row.emplace_back("mass_y", drawn(along_y));
      }
      addTable(*below, file_.axes(*below), {"pedestal", std::to_string(drawing_.pedestals.size())},
               row, drawing_.pedestal_tables);
      drawing_.pedestals.push_back(row);
      above = &*below;
    }
  }

  void nameOthers() {
    for (const RossEntry& entry : file_.entries()) {
      if (!entry.is("ShaftElement") && !entry.isDisc() && !entry.is("PointMass") &&
          !entry.is("CouplingElement") && !entry.isSupport()) {
        leaveOut(fmt::format("{}: a {}", entry.key, entry.kind));
      }
    }
  }

  Diagnostics diagnostics_;
  RossFile file_;
  RotorDrawing drawing_;
  std::map<std::string, RossMaterial> materials_;
  int last_node_ = 0;
};

}  // namespace

RotorDrawing drawingOfRoss(const std::string& path) {
  return RossReader(path).read();
}

}  // namespace whirl_twin
