#include "scene/parameter_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace whirl_twin {

namespace {

/// Spec is SystemSpec, const or not.
template <class Spec, class Visit>
void eachNumber(const ModelInfo& model, Spec& spec, const Visit& visit) {
  for (const ParameterInfo& p : model.parameters) {
    visit(p.name, spec.parameters.at(p.name));
  }
  for (const SettingInfo& setting : model.settings) {
    const auto table = spec.settings.tables.find(setting.name);
    const auto matrix = spec.settings.matrices.find(setting.name);
    if (table != spec.settings.tables.end()) {
      for (std::size_t row = 0; row < table->second.size(); ++row) {
        for (const ColumnInfo& column : setting.columns) {
          visit(fmt::format("{}[{}].{}", setting.name, row, column.name),
                table->second[row].numbers.at(column.name));
        }
      }
    } else if (matrix != spec.settings.matrices.end() &&
               matrix->second.size() <= kMostMatrixEntries) {
      for (Eigen::Index i = 0; i < matrix->second.rows(); ++i) {
        for (Eigen::Index j = 0; j < matrix->second.cols(); ++j) {
          visit(fmt::format("{}[{}][{}]", setting.name, i, j), matrix->second(i, j));
        }
      }
    }
  }
}

/// A path taken apart: "bearings[0].kxx" is bearings, {0}, kxx.
struct Path {
  std::string name;
  std::vector<std::size_t> indices;
  std::string column;
};

std::optional<Path> parsed(const std::string& text) {
  Path path;
  std::size_t at = std::min(text.find_first_of("[."), text.size());
  path.name = text.substr(0, at);
  while (at < text.size() && text[at] == '[') {
    std::size_t index = 0;
    const char* end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data() + at + 1, end, index);
    if (error != std::errc() || after == end || *after != ']') {
      return std::nullopt;
    }
    path.indices.push_back(index);
    at = static_cast<std::size_t>(after - text.data()) + 1;
  }
  if (at < text.size() && text[at] == '.') {
    path.column = text.substr(at + 1);
    return path.column.empty() ? std::nullopt : std::optional<Path>(path);
  }
  return at == text.size() ? std::optional<Path>(path) : std::nullopt;
}

/// Asks a scene's questions of one number: is there such a name, and is it in range?
bool fits(const std::string& key, const std::string& name, double value,
          const std::vector<std::string>& known, const std::string& kind, Range range,
          const std::string& unit, Complaints& complaints) {
  const std::size_t before = complaints.all().size();
  YAML::Node map(YAML::NodeType::Map);
  map[name] = fmt::format("{}", value);
  const MapReader reader(map, key, known, kind, complaints);
  if (reader.has(name)) {
    static_cast<void>(reader.number(name, range, unit, std::nullopt));
  }
  return complaints.all().size() == before;
}

class Assignment {
 public:
  Assignment(const std::string& text, double value, const ModelInfo& model, SystemSpec& spec,
             Complaints& complaints)
      : text_(text),
        value_(value),
        model_(model),
        spec_(spec),
        complaints_(complaints),
        key_("systems." + spec.name + ".parameters") {}

  std::optional<double> done() {
    const std::optional<Path> path = parsed(text_);
    if (!path) {
      return refused(text_, "must be a name such as damping, bearings[0].kxx or stiffness[0][1]");
    }
    const auto setting =
        std::find_if(model_.settings.begin(), model_.settings.end(),
                     [&](const SettingInfo& info) { return info.name == path->name; });
    return setting == model_.settings.end() ? ofParameter(*path) : ofSetting(*path, *setting);
  }

 private:
  std::optional<double> refused(const std::string& path, const std::string& why) {
    complaints_.add(key_ + "." + path, why);
    return std::nullopt;
  }
  std::optional<double> set(double& number) { return std::exchange(number, value_); }

  std::optional<double> ofParameter(const Path& path) {
    if (path.name == "speed" && model_.has_shaft) {
      return refused("speed",
                     "belongs to the shaft: turn it by a drive of the scene, whose speed "
                     "set_speed changes");
    }
    std::vector<std::string> known;
    for (const ParameterInfo& p : model_.parameters) {
      known.push_back(p.name);
    }
    for (const SettingInfo& s : model_.settings) {
      known.push_back(s.name);
    }
    const auto parameter =
        std::find_if(model_.parameters.begin(), model_.parameters.end(),
                     [&](const ParameterInfo& p) { return p.name == path.name; });
    const bool found = parameter != model_.parameters.end();
    if (!fits(key_, path.name, value_, known, "parameter of " + model_.name,
              found ? parameter->range : Range::kAny, found ? parameter->unit : "-", complaints_) ||
        !found) {
      return std::nullopt;
    }
    if (!path.indices.empty() || !path.column.empty()) {
      return refused(text_, "is one number: leave out what follows the name");
    }
    return set(spec_.parameters.at(path.name));
  }

  std::optional<double> ofSetting(const Path& path, const SettingInfo& setting) {
    if (setting.kind == SettingKind::kTable) {
      return ofTable(path, setting);
    }
    if (setting.kind == SettingKind::kMatrix) {
      return ofMatrix(path);
    }
    return refused(text_, "is not a number: only numbers can be changed while the twin runs");
  }

  std::optional<double> ofTable(const Path& path, const SettingInfo& setting) {
    const auto table = spec_.settings.tables.find(path.name);
    if (table == spec_.settings.tables.end()) {
      return refused(text_, "the scene gives no " + path.name);
    }
    if (path.indices.size() != 1 || path.column.empty()) {
      return refused(text_, fmt::format("must be {}[row].{}", path.name,
                                        setting.columns.empty() ? "key" : setting.columns[0].name));
    }
    if (path.indices[0] >= table->second.size()) {
      return refused(text_, fmt::format("there are {} rows, counted from 0", table->second.size()));
    }
    std::vector<std::string> known;
    for (const ColumnInfo& c : setting.columns) {
      known.push_back(c.name);
    }
    const auto column = std::find_if(setting.columns.begin(), setting.columns.end(),
                                     [&](const ColumnInfo& c) { return c.name == path.column; });
    const bool found = column != setting.columns.end();
    if (!fits(fmt::format("{}.{}[{}]", key_, path.name, path.indices[0]), path.column, value_,
              known, "number of " + path.name, found ? column->range : Range::kAny,
              found ? column->unit : "-", complaints_) ||
        !found) {
      return std::nullopt;
    }
    return set(table->second[path.indices[0]].numbers.at(path.column));
  }

  std::optional<double> ofMatrix(const Path& path) {
    const auto matrix = spec_.settings.matrices.find(path.name);
    if (matrix == spec_.settings.matrices.end()) {
      return refused(text_, "the scene gives no " + path.name);
    }
    Eigen::MatrixXd& m = matrix->second;
    if (path.indices.size() != 2 || !path.column.empty()) {
      return refused(text_, fmt::format("must be {}[row][column]", path.name));
    }
    if (m.size() > kMostMatrixEntries) {
      return refused(text_, fmt::format("a matrix of up to {} entries can be changed while the "
                                        "twin runs, this one has {}",
                                        kMostMatrixEntries, m.size()));
    }
    const auto row = static_cast<Eigen::Index>(path.indices[0]);
    const auto column = static_cast<Eigen::Index>(path.indices[1]);
    if (row >= m.rows() || column >= m.cols()) {
      return refused(text_, fmt::format("there are {} rows and {} columns, counted from 0",
                                        m.rows(), m.cols()));
    }
    if (!fits(key_, text_, value_, {text_}, "", Range::kAny, "-", complaints_)) {
      return std::nullopt;
    }
    return set(m(row, column));
  }

  const std::string& text_;
  double value_;
  const ModelInfo& model_;
  SystemSpec& spec_;
  Complaints& complaints_;
  std::string key_;
};

}  // namespace

state::ParameterChange parametersOf(const ModelInfo& model, const SystemSpec& spec) {
  state::ParameterChange set;
  set.system = spec.name;
  eachNumber(model, spec, [&](const std::string& path, double value) {
    set.names.push_back(path);
    set.values.push_back(value);
  });
  return set;
}

std::optional<double> setParameter(const std::string& path, double value, const ModelInfo& model,
                                   SystemSpec& spec, Complaints& complaints) {
  return Assignment(path, value, model, spec, complaints).done();
}

bool takeParameters(const state::ParameterChange& from, const ModelInfo& model, SystemSpec& spec) {
  if (from.system != spec.name || from.names != parametersOf(model, spec).names ||
      from.values.size() != from.names.size()) {
    return false;
  }
  std::size_t i = 0;
  eachNumber(model, spec, [&](const std::string&, double& value) { value = from.values[i++]; });
  return true;
}

}  // namespace whirl_twin
