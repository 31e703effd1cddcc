#include "estimation/import_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

namespace {

KeyphasorImport readKeyphasor(const MapReader& map) {
  KeyphasorImport keyphasor;
  keyphasor.column = map.text("column", "");
  for (const auto& [key, value] : {std::pair("threshold", &keyphasor.threshold),
                                   std::pair("hysteresis", &keyphasor.hysteresis)}) {
    if (map.has(key)) {
      *value = map.number(key, key[0] == 'h' ? Range::kNotNegative : Range::kAny, "V", 0.0);
    }
  }
  keyphasor.slope = map.choice("slope", {"rising", "falling"}, "a slope", "");
  return keyphasor;
}

}  // namespace

ImportSettings readImportSettings(const std::string& path) {
  Diagnostics diagnostics(path);
  ImportSettings settings;
  std::vector<std::string> keys = tableKeys();
  keys.insert(keys.end(), {"columns", "keyphasor"});
  const MapReader map(readYamlFile(path, "settings of an import", "columns"), "", keys,
                      "key of an import", diagnostics);
  if (map.usable()) {
    settings.table = readTableSettings(map, diagnostics);
  }
  if (map.usable() && map.has("columns")) {
    const MapReader columns(map.at("columns"), "columns", {}, "channel", diagnostics);
    for (const std::string& name :
         columns.usable() ? columns.names() : std::vector<std::string>()) {
      ColumnImport& column = settings.channels[name];
      if (columns.at(name).IsScalar()) {
        column.column = columns.text(name, "");
        continue;
      }
      const MapReader entry(columns.at(name), columns.key(name), {"column", "unit", "scale", "gap"},
                            "key of a column", diagnostics);
      if (entry.usable()) {
        column = {entry.text("column", ""), entry.text("unit", ""), entry.text("scale", ""),
                  entry.has("gap") ? entry.number("gap", Range::kAny, "V", 0.0) : 0.0};
      }
      if (column.gap != 0.0 && column.scale.empty()) {
        diagnostics.add(entry.key("gap"), "needs a `scale`, such as 200 mV/mil");
      }
    }
  }
  if (map.usable() && map.has("keyphasor")) {
    const std::vector<std::string> known = {"column", "threshold", "slope", "hysteresis"};
    const YAML::Node node = map.at("keyphasor");
    const bool one = !node.IsMap() || std::any_of(known.begin(), known.end(), [&](const auto& key) {
      return node[key].IsDefined();
    });
    const MapReader keyphasors(node, "keyphasor", one ? known : std::vector<std::string>(),
                               "key of a keyphasor", diagnostics);
    if (keyphasors.usable() && one) {
      settings.keyphasors[""] = readKeyphasor(keyphasors);
    }
    for (const std::string& name :
         keyphasors.usable() && !one ? keyphasors.names() : std::vector<std::string>()) {
      const MapReader entry(keyphasors.at(name), keyphasors.key(name), known, "key of a keyphasor",
                            diagnostics);
      if (entry.usable()) {
        settings.keyphasors[name] = readKeyphasor(entry);
      }
    }
  }
  if (!diagnostics.all().empty()) {
    throw InputError(errorList(diagnostics.all(), "\ntwin: "));
  }
  return settings;
}

void ImportSettings::requireChannelsOf(const std::vector<EstimatorSource>& sources) const {
  std::vector<std::string> known_channels, known_keyphasors = {""};
  for (const EstimatorSource& source : sources) {
    for (const EstimatorSource::Channel& channel : source.channels) {
      known_channels.push_back(source.name + "/" + channel.name);
      known_channels.push_back(channel.name);
    }
    if (source.keyphasor) {
      known_keyphasors.push_back(source.name);
    }
  }
  const auto require = [](const auto& given, const std::vector<std::string>& known,
                          const char* what) {
    for (const auto& [name, unused] : given) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw InputError(fmt::format("settings of the import: the scene has no {} {}{}", what,
                                     inQuotes(name), hint(name, known)));
      }
    }
  };
  require(channels, known_channels, "channel");
  require(keyphasors, known_keyphasors, "keyphasor");
}

const KeyphasorImport* ImportSettings::keyphasorOf(const std::string& source) const {
  for (const std::string& name : {source, std::string()}) {
    if (const auto found = keyphasors.find(name); found != keyphasors.end()) {
      return &found->second;
    }
  }
  return nullptr;
}

ImportScale importScale(const EstimatorSource::Channel& channel, const ColumnImport& given,
                        const TableColumn& column) {
  const std::string unit = given.unit.empty() ? column.unit : given.unit;
  if (given.scale.empty()) {
    const double scale = unitScale(unit, channel.unit);
    if (scale == 0.0) {
      throw InputError(fmt::format(
          "column {}: must be in {} or another unit of that kind, or be a voltage with `scale` "
          "in "
          "the settings of the import ({}: {{scale: 200 mV/mil, gap: -10 V}}), found {}",
          inQuotes(column.heading), channel.unit, channel.name, printable(unit)));
    }
    return {scale, 0.0};
  }
  const double volts = unitScale(unit, "V");
  const std::optional<double> scale = parseQuantity(given.scale, "V/(" + channel.unit + ")");
  if (volts == 0.0 || scale.value_or(0.0) == 0.0) {
    throw InputError(fmt::format(
        "column {}: must be in V with a scale in V/({}), such as 200 mV/mil, found {} and {}",
        inQuotes(column.heading), channel.unit, unit.empty() ? "V" : printable(unit),
        inQuotes(given.scale)));
  }
  return {volts / *scale, given.gap / volts};
}

bool isKeyphasorName(const std::string& name, const std::string& source) {
  std::string word;
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  static const std::vector<std::string> words = {"keyphasor", "tacho", "tach",    "tachometer",
                                                 "keyphase",  "kph",   "trigger", "phasereference"};
  return name == source || std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace whirl_twin
