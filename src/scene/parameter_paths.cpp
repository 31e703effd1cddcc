#include "scene/parameter_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <type_traits>

#include "scene/parameter_limits.h"

namespace whirl_twin {

namespace {

/// For a model and a system, or a controller type and a controller.
template <class Info, class Spec, class Visit>
void eachNumber(const Info& info, const Spec& spec, const Visit& visit) {
  for (const ParameterInfo& p : info.parameters) {
    visit(p.name, spec.parameters.at(p.name));
  }
  for (const SettingInfo& setting : info.settings) {
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
               matrix->second.size() <= kMaxMatrixEntries) {
      for (Eigen::Index i = 0; i < matrix->second.rows(); ++i) {
        for (Eigen::Index j = 0; j < matrix->second.cols(); ++j) {
          visit(fmt::format("{}[{}][{}]", setting.name, i, j), matrix->second(i, j));
        }
      }
    }
  }
}

/// A parsed path: "bearings[0].kxx" is bearings, {0}, kxx.
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

/// Location of the parameter of a path, or why there is none.
template <class Number>
struct Place {
  using Row = std::conditional_t<std::is_const_v<Number>, const TableRow, TableRow>;
  Number* number = nullptr;
  Range range = Range::kAny;
  std::string unit = "-";
  std::string path;  ///< for diagnostics
  std::string objection;
  Row* row = nullptr;  ///< of a table; else a parameter or an entry of a matrix
  std::string column = "";
};

bool turnsShaft(const ModelInfo& model) {
  return model.has_shaft;
}
bool turnsShaft(const ControllerInfo&) {
  return false;
}

/// Finds the number of a path; Spec may be const.
template <class Info, class Spec>
class Search {
 public:
  using Number = std::conditional_t<std::is_const_v<Spec>, const double, double>;

  Search(const std::string& text, const Info& info, Spec& spec)
      : text_(text), info_(info), spec_(spec) {}

  Place<Number> found() const {
    const std::optional<Path> path = parsed(text_);
    if (!path) {
      return none(text_, "must be a name such as damping, bearings[0].kxx or stiffness[0][1]");
    }
    const auto setting =
        std::find_if(info_.settings.begin(), info_.settings.end(),
                     [&](const SettingInfo& info) { return info.name == path->name; });
    return setting == info_.settings.end() ? ofParameter(*path) : ofSetting(*path, *setting);
  }

 private:
  static Place<Number> none(const std::string& path, const std::string& why) {
    return {nullptr, Range::kAny, "-", path, why};
  }

  Place<Number> ofParameter(const Path& path) const {
    if (path.name == "speed" && turnsShaft(info_)) {
      return none("speed",
                  "must not be changed as a parameter: give the shaft a drive and change its speed "
                  "with set_speed");
    }
    const auto parameter =
        std::find_if(info_.parameters.begin(), info_.parameters.end(),
                     [&](const ParameterInfo& p) { return p.name == path.name; });
    if (parameter == info_.parameters.end()) {
      std::vector<std::string> known;
      for (const ParameterInfo& p : info_.parameters) {
        known.push_back(p.name);
      }
      for (const SettingInfo& s : info_.settings) {
        known.push_back(s.name);
      }
      return none(path.name, nameDiagnostic(path.name, known, "parameter of " + info_.name));
    }
    if (!path.indices.empty() || !path.column.empty()) {
      return none(text_, "is a single number: write the name without an index");
    }
    return {&spec_.parameters.at(path.name), parameter->range, parameter->unit, text_, ""};
  }

  Place<Number> ofSetting(const Path& path, const SettingInfo& setting) const {
    if (setting.kind == SettingKind::kTable) {
      return ofTable(path, setting);
    }
    if (setting.kind == SettingKind::kMatrix) {
      return ofMatrix(path);
    }
    return none(text_, "is not a number: only numbers can be changed while the twin runs");
  }

  Place<Number> ofTable(const Path& path, const SettingInfo& setting) const {
    const auto table = spec_.settings.tables.find(path.name);
    if (table == spec_.settings.tables.end()) {
      return none(text_, "the scene does not give " + path.name);
    }
    if (path.indices.size() != 1 || path.column.empty()) {
      return none(text_, fmt::format("must be {}[row].{}", path.name,
                                     setting.columns.empty() ? "key" : setting.columns[0].name));
    }
    if (path.indices[0] >= table->second.size()) {
      return none(text_, fmt::format("there are {} rows, counted from 0", table->second.size()));
    }
    const auto column = std::find_if(setting.columns.begin(), setting.columns.end(),
                                     [&](const ColumnInfo& c) { return c.name == path.column; });
    if (column == setting.columns.end()) {
      std::vector<std::string> known;
      for (const ColumnInfo& c : setting.columns) {
        known.push_back(c.name);
      }
      return none(text_, nameDiagnostic(path.column, known, "parameter of " + path.name));
    }
    auto& row = table->second[path.indices[0]];
    return {
        &row.numbers.at(path.column), column->range, column->unit, text_, "", &row, path.column};
  }

  Place<Number> ofMatrix(const Path& path) const {
    const auto matrix = spec_.settings.matrices.find(path.name);
    if (matrix == spec_.settings.matrices.end()) {
      return none(text_, "the scene does not give " + path.name);
    }
    auto& m = matrix->second;
    if (path.indices.size() != 2 || !path.column.empty()) {
      return none(text_, fmt::format("must be {}[row][column]", path.name));
    }
    if (m.size() > kMaxMatrixEntries) {
      return none(
          text_,
          fmt::format("matrices of at most {} entries can be changed while the twin runs, found {}",
                      kMaxMatrixEntries, m.size()));
    }
    const auto row = static_cast<Eigen::Index>(path.indices[0]);
    const auto column = static_cast<Eigen::Index>(path.indices[1]);
    if (row >= m.rows() || column >= m.cols()) {
      return none(text_, fmt::format("there are {} rows and {} columns, counted from 0", m.rows(),
                                     m.cols()));
    }
    return {&m(row, column), Range::kAny, "-", text_, ""};
  }

  const std::string& text_;
  const Info& info_;
  Spec& spec_;
};

template <class Info, class Spec>
state::ParameterChange allNumbers(const Info& info, const Spec& spec) {
  state::ParameterChange set;
  set.system = spec.name;
  eachNumber(info, spec, [&](const std::string& path, double value) {
    set.names.push_back(path);
    set.values.push_back(value);
  });
  return set;
}

template <class Info, class Spec>
std::optional<double> numberAt(const std::string& path, const Info& info, const Spec& spec) {
  const double* const number = Search(path, info, spec).found().number;
  return number == nullptr ? std::nullopt : std::optional(*number);
}

template <class Info, class Spec>
bool setNumber(const std::string& path, double value, const Info& info, Spec& spec,
               const std::string& key, Diagnostics& diagnostics) {
  const Place<double> place = Search(path, info, spec).found();
  const std::string why =
      place.number == nullptr ? place.objection : objection(place.range, place.unit, value);
  if (!why.empty()) {
    diagnostics.add(fmt::format("{}.{}.parameters.{}", key, spec.name, place.path), why);
    return false;
  }
  if (place.row != nullptr) {
    place.row->set(place.column, value);
    return true;
  }
  *place.number = value;
  spec.following.erase(path);
  for (const ParameterInfo& p : info.parameters) {  // in order: followers may be chained
    const auto followed = spec.following.find(p.name);
    if (followed != spec.following.end()) {
      spec.parameters.at(p.name) = spec.parameters.at(followed->second);
    }
  }
  return true;
}

}  // namespace

state::ParameterChange parametersOf(const ModelInfo& model, const SystemSpec& spec) {
  return allNumbers(model, spec);
}
state::ParameterChange parametersOf(const ControllerInfo& info, const ControllerSpec& spec) {
  return allNumbers(info, spec);
}

std::optional<double> parameterAt(const std::string& path, const ModelInfo& model,
                                  const SystemSpec& spec) {
  return numberAt(path, model, spec);
}
std::optional<double> parameterAt(const std::string& path, const ControllerInfo& info,
                                  const ControllerSpec& spec) {
  return numberAt(path, info, spec);
}

std::string unitAt(const std::string& path, const ModelInfo& model, const SystemSpec& spec) {
  const auto place = Search(path, model, spec).found();
  return place.number == nullptr ? "" : place.unit;
}

bool setParameter(const std::string& path, double value, const ModelInfo& model, SystemSpec& spec,
                  Diagnostics& diagnostics) {
  return setNumber(path, value, model, spec, "systems", diagnostics);
}
bool setParameter(const std::string& path, double value, const ControllerInfo& info,
                  ControllerSpec& spec, Diagnostics& diagnostics) {
  return setNumber(path, value, info, spec, "controllers", diagnostics);
}

}  // namespace whirl_twin
