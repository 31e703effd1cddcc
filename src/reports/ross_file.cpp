#include "reports/ross_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <toml.hpp>
#include <tuple>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

nlohmann::json jsonOf(const toml::value& value) {
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
      nlohmann::json all = nlohmann::json::array();
      for (const toml::value& one : value.as_array()) {
        all.push_back(jsonOf(one));
      }
      return all;
    }
    case toml::value_t::table: {
      nlohmann::json all = nlohmann::json::object();
      for (const auto& [key, one] : value.as_table()) {
        all[key] = jsonOf(one);
      }
      return all;
    }
    default:
      return nullptr;
  }
}

nlohmann::json treeOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw InputError(path + ": cannot be read; must be a rotor saved by ROSS");
  }
  try {
    nlohmann::json tree = std::filesystem::path(path).extension() == ".json"
                              ? nlohmann::json::parse(in)
                              : jsonOf(toml::parse(in, path));
    if (!tree.is_object()) {
      throw InputError(path + ": must be a rotor saved by ROSS, found a list or a value");
    }
    return tree;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: must be JSON: {}", path, error.what()));
  } catch (const toml::exception& error) {
    throw InputError(
        fmt::format("{}: must be TOML, found an error in line {}", path, error.location().line()));
  }
}

}  // namespace

bool RossEntry::isSupport() const {
  return fields->contains("kxx") && !is("Magnetic") && !is("Coupling");
}

bool RossEntry::isDisc() const {
  const bool like_one = fields->contains("m") && fields->contains("Ip") && fields->contains("Id");
  return is("DiskElement") || (like_one && !is("ShaftElement") && !is("CouplingElement"));
}

RossFile::RossFile(const std::string& path, Diagnostics& diagnostics)
    : tree_(treeOf(path)), diagnostics_(diagnostics) {
  for (const auto& [key, value] : tree_.items()) {
    const std::size_t bar = key.find('_');
    if (value.is_object() && bar != std::string::npos && bar > 0) {
      entries_.push_back({key.substr(0, bar), key, &value});
    }
  }
}

double RossFile::parameter(const char* name, const char* unit) {
  const auto found = tree_.find("parameters");
  return found != tree_.end() && found->is_object() ? number(*found, "parameters", name, unit, 0.0)
                                                    : 0.0;
}

double RossFile::number(const nlohmann::json& fields, const std::string& where, const char* name,
                        const char* unit, std::optional<double> fallback) {
  const auto found = fields.find(name);
  if (found != fields.end() && found->is_number() && std::isfinite(found->get<double>())) {
    return found->get<double>();
  }
  const bool given = found != fields.end() && !found->is_null();
  if (given || !fallback) {
    diagnostics_.add(fmt::format("{}.{}", where, name),
                     fmt::format("must be a number{}{}, found {}", *unit == '\0' ? "" : " in ",
                                 unit, given ? printable(found->dump()) : "nothing"));
  }
  return fallback.value_or(0.0);
}

double RossFile::number(const RossEntry& entry, const char* name, const char* unit,
                        std::optional<double> fallback) {
  return number(*entry.fields, entry.key, name, unit, fallback);
}

int RossFile::node(const RossEntry& entry, const char* name) {
  const double value = number(entry, name, "");
  const bool sound = value >= 0.0 && value < 1.0e6 && value == std::floor(value);
  if (!sound) {
    diagnostics_.add(fmt::format("{}.{}", entry.key, name),
                     fmt::format("must be the number of a node, found {}", value));
  }
  return sound ? static_cast<int>(value) : 0;
}

bool RossFile::flag(const RossEntry& entry, const char* name) {
  const auto found = entry.fields->find(name);
  return found == entry.fields->end() || !found->is_boolean() || found->get<bool>();
}

std::pair<double, double> RossFile::mass(const RossEntry& entry) {
  const auto found = entry.fields->find("m");
  if (found != entry.fields->end() && found->is_number()) {
    return {found->get<double>(), found->get<double>()};
  }
  const double along_x = number(entry, "mx", "kg");
  return {along_x, number(entry, "my", "kg", along_x)};
}

RossMaterial RossFile::material(const RossEntry& entry) {
  const auto found = entry.fields->find("material");
  if (found == entry.fields->end() || !found->is_object()) {
    diagnostics_.add(entry.key + ".material", "must be a table with rho, E and G_s");
    return {};
  }
  const std::string where = entry.key + ".material";
  const auto name = found->find("name");
  return {number(*found, where, "E", "Pa"), number(*found, where, "G_s", "Pa"),
          number(*found, where, "rho", "kg/m^3"),
          name != found->end() && name->is_string() ? name->get<std::string>() : "material"};
}

std::vector<double> RossFile::coefficient(const RossEntry& entry, const std::string& name,
                                          const RossAxes& axes) {
  const auto found = entry.fields->find(name);
  if (found == entry.fields->end() || found->is_null()) {
    return std::vector<double>(axes.count(), 0.0);
  }
  const std::string where = fmt::format("{}.{}", entry.key, name);
  std::vector<double> values;
  for (const nlohmann::json& value : found->is_array() ? *found : nlohmann::json::array({*found})) {
    const bool is_row = value.is_array() && values.size() < axes.places.size() &&
                        value.size() == axes.frequencies.size() &&
                        std::all_of(value.begin(), value.end(),
                                    [](const nlohmann::json& one) { return one.is_number(); });
    if (!is_row && !value.is_number()) {
      diagnostics_.add(
          where, axes.frequencies.empty() || !value.is_array()
                     ? fmt::format("must be numbers, found {}", printable(value.dump()))
                     : fmt::format("must have {} rows of {} numbers, as speed and frequency have",
                                   axes.places.size(), axes.frequencies.size()));
      return std::vector<double>(axes.count(), 0.0);
    }
    values.push_back(is_row ? synchronous(value, axes.places[values.size()], axes)
                            : value.get<double>());
  }
  if (values.size() == 1) {
    values.resize(axes.count(), values.front());
  }
  if (values.size() != axes.count()) {
    diagnostics_.add(
        where,
        axes.places.empty()
            ? fmt::format("must be one number without speed or frequency, found {}", values.size())
            : fmt::format("must have {} numbers as {} has, found {}", axes.count(), axes.name,
                          values.size()));
    values.resize(axes.count(), 0.0);
  }
  return values;
}

double RossFile::synchronous(const nlohmann::json& row, double speed, const RossAxes& axes) {
  const std::vector<double>& at = axes.frequencies;
  const auto above = std::upper_bound(at.begin(), at.end(), speed);
  if (above == at.begin() || above == at.end()) {
    return row[above == at.begin() ? 0 : at.size() - 1].get<double>();
  }
  const auto i = static_cast<std::size_t>(above - at.begin());
  const double part = (speed - at[i - 1]) / (at[i] - at[i - 1]);
  return (1.0 - part) * row[i - 1].get<double>() + part * row[i].get<double>();
}

std::vector<double> RossFile::numbers(const RossEntry& entry, const char* name) {
  const auto found = entry.fields->find(name);
  if (found == entry.fields->end() || found->is_null()) {
    return {};
  }
  RossAxes own;
  own.name = name;
  own.places.resize(found->is_array() ? found->size() : 1);
  std::vector<double> values = coefficient(entry, name, own);
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end()) {
    diagnostics_.add(fmt::format("{}.{}", entry.key, name), "must increase");
  }
  return values;
}

RossAxes RossFile::axes(const RossEntry& entry) {
  RossAxes axes;
  axes.places = numbers(entry, "speed");
  std::vector<double> frequencies = numbers(entry, "frequency");
  if (axes.places.empty()) {
    const auto version = tree_.find("ross_version");
    axes.places = std::move(frequencies);
    axes.name = "frequency";
    axes.of_whirl = !axes.places.empty() && version != tree_.end() && version->is_string() &&
                    std::atoi(version->get_ref<const std::string&>().c_str()) >= 3;
  } else {
    axes.frequencies = std::move(frequencies);
  }
  return axes;
}

RossCoupling rossCoupling(RossFile& file, const RossEntry& entry, int node) {
  RossCoupling coupling;
  coupling.row.emplace_back("element", std::to_string(node));
  for (const auto& [kind, ours, unit] :
       {std::tuple{"kt", "lateral_stiffness", "N/m"}, std::tuple{"kr", "bending_stiffness", "N m"},
        std::tuple{"ct", "lateral_damping", "N s/m"},
        std::tuple{"cr", "bending_damping", "N m s"}}) {
    const double along_x = file.number(entry, fmt::format("{}_x", kind).c_str(), unit, 0.0);
    coupling.row.emplace_back(ours, drawn(along_x));
    if (file.number(entry, fmt::format("{}_y", kind).c_str(), unit, 0.0) != along_x) {
      coupling.left_out.push_back(
          fmt::format("{0}: {1}_y differs from {1}_x, which is used", entry.key, kind));
    }
    if (file.number(entry, fmt::format("{}_z", kind).c_str(), unit, 0.0) != 0.0) {
      coupling.left_out.push_back(
          fmt::format("{}: {}_z, along or about the shaft", entry.key, kind));
    }
  }
  for (const auto& [end, at] : {std::pair{"l", node}, std::pair{"r", node + 1}}) {
    const auto of = [&file, &entry, side = end](const char* name, const char* unit) {
      return file.number(entry, fmt::format("{}_{}", name, side).c_str(), unit, 0.0);
    };
    const double polar = of("Ip", "kg m^2");
    const double across = of("Id", "kg m^2");
    coupling.hubs.push_back({{"node", std::to_string(at)},
                             {"mass", drawn(of("m", "kg"))},
                             {"polar_inertia", drawn(polar)},
                             {"transverse_inertia", drawn(across != 0.0 ? across : 0.5 * polar)}});
  }
  return coupling;
}

}  // namespace whirl_twin
