#include "estimation/import_settings.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "messages/input_error.h"
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

}  // namespace whirl_twin
