#include "scene/parameter_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/speed_profile.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxMatrix = 200;  // rows and columns

/// A list of the tree, or nothing after a diagnostic.
std::optional<YAML::Node> list(const MapReader& map, const std::string& name, const std::string& of,
                               Diagnostics& diagnostics) {
  const YAML::Node node = map.at(name);
  if (!node.IsSequence() || node.size() == 0) {
    diagnostics.add(map.key(name), fmt::format("must be a list of {}, found {}", of,
                                               node.IsSequence() ? "an empty list" : shown(node)));
    return std::nullopt;
  }
  if (node.size() > kMaxMatrix) {
    diagnostics.add(map.key(name),
                    fmt::format("must have up to {} entries, found {}", kMaxMatrix, node.size()));
    return std::nullopt;
  }
  return node;
}

std::string rowKey(const MapReader& map, const std::string& name, std::size_t row) {
  return fmt::format("{}[{}]", map.key(name), row);
}

/// A list of lists; a list of numbers is a matrix of one row.
std::optional<Eigen::MatrixXd> readMatrix(const MapReader& map, const SettingInfo& info,
                                          Diagnostics& diagnostics) {
  const auto given =
      list(map, info.name, fmt::format("rows of numbers ({})", info.unit), diagnostics);
  if (!given) {
    return std::nullopt;
  }
  const bool one_row = given->size() > 0 && (*given)[0].IsScalar();
  const std::vector<YAML::Node> rows = one_row
                                           ? std::vector<YAML::Node>{*given}
                                           : std::vector<YAML::Node>(given->begin(), given->end());
  const std::size_t before = diagnostics.all().size();
  Eigen::MatrixXd matrix;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const YAML::Node row = rows[i];
    const std::string key = one_row ? map.key(info.name) : rowKey(map, info.name, i);
    if (!row.IsSequence()) {
      diagnostics.add(
          key, fmt::format("must be a list of numbers ({}), found {}", info.unit, shown(row)));
      continue;
    }
    if (i == 0) {
      if (row.size() == 0 || row.size() > kMaxMatrix) {
        diagnostics.add(key,
                        fmt::format("must have 1 to {} numbers, found {}", kMaxMatrix, row.size()));
        return std::nullopt;
      }
      matrix.setZero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(row.size()));
    }
    if (static_cast<Eigen::Index>(row.size()) != matrix.cols()) {
      diagnostics.add(key, fmt::format("must have {} numbers like the first row, found {}",
                                       matrix.cols(), row.size()));
      continue;
    }
    for (std::size_t j = 0; j < row.size(); ++j) {
      const YAML::Node entry = row[j];
      const std::optional<double> value =
          entry.IsScalar() ? parseQuantity(entry.Scalar(), info.unit) : std::optional<double>();
      if (!value) {
        diagnostics.add(fmt::format("{}[{}]", key, j),
                        fmt::format("must be a finite number ({}), found {}{}", info.unit,
                                    shown(entry), unitDiagnostic(entry, info.unit)));
        continue;
      }
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = *value;
    }
  }
  return diagnostics.all().size() == before ? std::optional<Eigen::MatrixXd>(matrix) : std::nullopt;
}

std::vector<std::string> readNames(const MapReader& map, const SettingInfo& info,
                                   Diagnostics& diagnostics) {
  std::vector<std::string> names;
  const auto entries = list(map, info.name, "names", diagnostics);
  for (std::size_t i = 0; entries && i < entries->size(); ++i) {
    const YAML::Node entry = (*entries)[i];
    if (!entry.IsScalar() || entry.Scalar().empty()) {
      diagnostics.add(rowKey(map, info.name, i),
                      fmt::format("must be a name, found {}", shown(entry)));
      continue;
    }
    names.push_back(entry.Scalar());
  }
  return names;
}

/// The entries of a list of maps.
std::optional<std::vector<YAML::Node>> maps(const MapReader& map, const std::string& name,
                                            Diagnostics& diagnostics) {
  const auto entries = list(map, name, "maps", diagnostics);
  if (!entries) {
    return std::nullopt;
  }
  return std::vector<YAML::Node>(entries->begin(), entries->end());
}

std::vector<TableRow> readSettingTable(const MapReader& map, const SettingInfo& info,
                                       Diagnostics& diagnostics) {
  std::vector<std::string> known = info.word_columns;
  known.insert(known.end(), info.optional_words.begin(), info.optional_words.end());
  for (const ColumnInfo& column : info.columns) {
    known.push_back(column.name);
  }
  std::vector<TableRow> table;
  const YAML::Node node = map.at(info.name);
  // A single row may be given without a list.
  const auto rows = node.IsMap() ? std::optional(std::vector<YAML::Node>{node})
                                 : maps(map, info.name, diagnostics);
  for (std::size_t i = 0; rows && i < rows->size(); ++i) {
    const MapReader row((*rows)[i], rowKey(map, info.name, i), known, "key of " + info.name,
                        diagnostics);
    TableRow values;
    for (const std::string& word : info.word_columns) {
      if (row.usable() && !row.has(word)) {
        diagnostics.add(row.key(word), "missing; must be a name");
      }
      values.words[word] = row.text(word, "");
    }
    for (const std::string& word : info.optional_words) {
      values.words[word] = row.text(word, "");
    }
    for (const ColumnInfo& column : info.columns) {
      if (!column.fallback_column.empty() && !row.has(column.name)) {
        values.numbers[column.name] = values.numbers.at(column.fallback_column);
        values.following[column.name] = column.fallback_column;
        continue;
      }
      const std::optional<double> fallback =
          std::isnan(column.fallback) ? std::nullopt : std::optional<double>(column.fallback);
      values.numbers[column.name] = row.number(column.name, column.range, column.unit, fallback);
    }
    table.push_back(values);
  }
  return table;
}

/// One of the words, or an integer of 0 or more.
std::string readWordOrCount(const MapReader& map, const SettingInfo& info,
                            Diagnostics& diagnostics) {
  constexpr double kMaxCount = 1.0e6;
  if (!map.has(info.name)) {
    return info.choices.front();
  }
  const YAML::Node node = map.at(info.name);
  std::string text = node.IsScalar() ? node.Scalar() : "";
  if (std::find(info.choices.begin(), info.choices.end(), text) != info.choices.end()) {
    return text;
  }
  const std::optional<double> count = parseNumber(text);
  if (!count || *count < 0.0 || *count > kMaxCount || *count != std::floor(*count)) {
    diagnostics.add(map.key(info.name), fmt::format("must be a whole number >= 0 or {}, found {}",
                                                    fmt::join(info.choices, ", "), shown(node)));
    return info.choices.front();
  }
  return fmt::format("{:.0f}", *count);
}

void readSetting(const MapReader& map, const SettingInfo& info, Settings& settings,
                 Diagnostics& diagnostics) {
  if (info.kind == SettingKind::kChoice) {
    settings.choices[info.name] =
        map.choice(info.name, info.choices, "one of its values", info.choices.front());
    return;
  }
  if (info.kind == SettingKind::kWordOrCount) {
    settings.choices[info.name] = readWordOrCount(map, info, diagnostics);
    return;
  }
  if (!map.has(info.name)) {
    if (info.required && map.usable()) {
      diagnostics.add(map.key(info.name), fmt::format("missing; {}", info.meaning));
    }
    return;
  }
  if (info.kind == SettingKind::kMatrix) {
    if (const auto matrix = readMatrix(map, info, diagnostics)) {
      settings.matrices[info.name] = *matrix;
    }
  } else if (info.kind == SettingKind::kNames) {
    settings.names[info.name] = readNames(map, info, diagnostics);
  } else {
    settings.tables[info.name] = readSettingTable(map, info, diagnostics);
  }
}

}  // namespace

MapReader readParameterValues(const MapReader& owner, const std::string& of,
                              const std::vector<ParameterInfo>& parameters,
                              const std::vector<SettingInfo>& settings,
                              const std::vector<std::string>& further, ParameterValues& values,
                              std::map<std::string, std::string>& following, Settings& given,
                              Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const ParameterInfo& parameter : parameters) {
    known.push_back(parameter.name);
  }
  for (const SettingInfo& setting : settings) {
    known.push_back(setting.name);
  }
  known.insert(known.end(), further.begin(), further.end());
  const MapReader map(
      owner.has("parameters") ? owner.at("parameters") : YAML::Node(YAML::NodeType::Map),
      owner.key("parameters"), known, "parameter of " + of, diagnostics);
  for (const ParameterInfo& p : parameters) {
    std::optional<double> fallback = p.fallback;
    if (!p.fallback_parameter.empty()) {
      fallback = values.at(p.fallback_parameter);
      if (!map.has(p.name)) {
        following[p.name] = p.fallback_parameter;
      }
    }
    values[p.name] = map.number(p.name, p.range, p.unit, fallback);
  }
  for (const SettingInfo& setting : settings) {
    readSetting(map, setting, given, diagnostics);
  }
  return map;
}

void readParameters(const MapReader& system, const ModelInfo& model, SystemSpec& spec,
                    Diagnostics& diagnostics) {
  const std::vector<std::string> further =
      model.has_shaft ? std::vector<std::string>{"speed"} : std::vector<std::string>{};
  const MapReader map =
      readParameterValues(system, model.name, model.parameters, model.settings, further,
                          spec.parameters, spec.following, spec.settings, diagnostics);
  if (map.has("speed")) {
    spec.speed = map.numberBetween("speed", -kMaxSpeed, kMaxSpeed, "rad/s", std::nullopt);
  }
}

}  // namespace whirl_twin
