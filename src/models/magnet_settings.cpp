#include "models/magnet_settings.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "algebra/constants.h"
#include "mechanics/magnetic_bearing.h"
#include "models/model_info.h"

namespace whirl_twin {

SettingInfo magnetsSetting(std::vector<ColumnInfo> first, const std::string& inputs) {
  SettingInfo info{"magnets", SettingKind::kTable, "",
                   "active magnetic bearings, linearized force ki current + ks displacement: give "
                   "ks, or bias and gap; inputs " +
                       inputs + " [A]"};
  info.columns = std::move(first);
  info.columns.insert(info.columns.end(), {{"ki", "N/A", Range::kPositive, kRequired},
                                           {"ks", "N/m", Range::kNotNegative, 0.0},
                                           {"bias", "A", Range::kNotNegative, 0.0},
                                           {"gap", "m", Range::kNotNegative, 0.0},
                                           {"saturation", "N", Range::kNotNegative, 0.0}});
  return info;
}

const std::vector<TableRow>& magnetRows(const Settings& settings) {
  static const std::vector<TableRow> none;
  const auto found = settings.tables.find("magnets");
  return found == settings.tables.end() ? none : found->second;
}

RotorMagnet rotorMagnet(const TableRow& row, const std::string& key) {
  const auto& n = row.numbers;
  RotorMagnet magnet{n.at("ki"), n.at("ks"), n.at("gap"), n.at("bias"), n.at("saturation")};
  if (!(magnet.gap > 0.0)) {
    for (const char* name : {"bias", "saturation"}) {
      if (n.at(name) > 0.0) {
        throw SetupError(key + ".gap", fmt::format("must be > 0 m with {}", name));
      }
    }
    if (!(magnet.ks > 0.0)) {
      throw SetupError(key + ".ks", "must be > 0 N/m, unless bias and gap are given");
    }
    return magnet;
  }
  if (!(magnet.bias > 0.0)) {
    throw SetupError(key + ".bias", "must be > 0 A with gap");
  }
  if (magnet.ks > 0.0) {
    throw SetupError(
        key + ".ks",
        fmt::format(
            "must not be given with gap, which gives ki bias / gap = {:.6g} N/m, found {:.6g}",
            magnet.ki * magnet.bias / magnet.gap, magnet.ks));
  }
  const double of_bias = 0.25 * magnet.ki * magnet.bias;
  if (magnet.saturation > 0.0 && !(magnet.saturation > of_bias)) {
    throw SetupError(
        key + ".saturation",
        fmt::format(
            "must be > ki bias / 4 = {:.6g} N, the force of a pole at its bias, found {:.6g}",
            of_bias, magnet.saturation));
  }
  magnet.ks = magnet.ki * magnet.bias / magnet.gap;
  return magnet;
}

std::vector<InputInfo> currentsOf(const PlacedMagnet& placed) {
  const std::string suffix = placed.suffix.empty() ? "" : "_" + placed.suffix;
  const std::string of = placed.suffix.empty() ? "of the magnet" : "of magnet " + placed.suffix;
  return {{"current_x" + suffix, "A", placed.magnet.ki * placed.along_x, of + ", along x"},
          {"current_y" + suffix, "A", placed.magnet.ki * placed.along_y, of + ", along y"}};
}

std::vector<LocalForce> localForcesOf(const std::vector<PlacedMagnet>& magnets,
                                      std::size_t first_input) {
  std::vector<LocalForce> forces;
  for (const PlacedMagnet& placed : magnets) {
    const RotorMagnet& m = placed.magnet;
    if (m.gap > 0.0) {
      const double saturation = m.saturation > 0.0 ? m.saturation : kInfinity;
      forces.push_back({placed.suffix.empty() ? "magnet" : "magnet_" + placed.suffix,
                        placed.along_x,
                        placed.along_y,
                        {first_input, first_input + 1},
                        std::make_shared<MagneticBearing>(m.ki, m.bias, m.gap, saturation)});
    }
    first_input += 2;
  }
  return forces;
}

}  // namespace whirl_twin
