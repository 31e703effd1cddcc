#include "reports/model_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "models/model_registry.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kCommentColumn = 38;

/// Lines of YAML with what they mean behind them.
class Lines {
 public:
  void plain(const std::string& text) { out_ += text + "\n"; }
  void add(int indent, const std::string& yaml, const std::string& comment) {
    std::string line = std::string(static_cast<std::size_t>(indent), ' ') + yaml;
    if (!comment.empty()) {
      line.resize(std::max(line.size() + 2, kCommentColumn), ' ');
      line += "# " + comment;
    }
    plain(line);
  }
  /// A default: behind a #.
  void off(int indent, const std::string& yaml, const std::string& comment) {
    add(indent, "# " + yaml, comment);
  }
  const std::string& text() const { return out_; }

 private:
  std::string out_;
};

/// On one line, as it is written in the example.
std::string flow(const YAML::Node& node) {
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  std::string line = emitter.c_str();
  // The emitter breaks long ones.
  for (std::size_t at = line.find('\n'); at != std::string::npos; at = line.find('\n', at)) {
    const std::size_t end = line.find_first_not_of(" \n", at);
    line.replace(at, end - at, at > 0 && line[at - 1] == ' ' ? "" : " ");
  }
  return line;
}

/// `key: value`, of a list of rows or of lists each below the other.
void addValue(Lines& lines, int indent, const std::string& key, const YAML::Node& value,
              const std::string& comment) {
  const bool rows = value.IsSequence() && value.size() > 0 && !value[0].IsScalar();
  if (!rows) {
    lines.add(indent, key + ": " + flow(value), comment);
    return;
  }
  lines.add(indent, key + ":", comment);
  for (const YAML::Node& row : value) {
    lines.add(indent + 2, "- " + flow(row), "");
  }
}

std::string meaningOf(const ParameterInfo& p) {
  const std::string range = describe(p.range);
  return fmt::format("{}{}: {}", p.unit, range == "finite" ? "" : ", " + range, p.meaning);
}

/// The columns of a table with their units; the options of a choice, its default first.
std::string contentsText(const SettingInfo& s) {
  if (s.kind == SettingKind::kChoice) {
    return fmt::format("{} (default {})", fmt::join(s.choices, " | "), s.choices.front());
  }
  if (s.kind == SettingKind::kWordOrCount) {
    return fmt::format("a whole number or {} (default {})", fmt::join(s.choices, " | "),
                       s.choices.front());
  }
  std::vector<std::string> columns = s.word_columns;
  columns.insert(columns.end(), s.optional_words.begin(), s.optional_words.end());
  for (const ColumnInfo& c : s.columns) {
    columns.push_back(fmt::format("{} ({})", c.name, c.unit));
  }
  const std::string need = s.required ? "required" : "optional";
  if (s.kind == SettingKind::kTable) {
    return fmt::format("list of {{{}}}, {}", fmt::join(columns, ", "), need);
  }
  return s.kind == SettingKind::kMatrix ? fmt::format("rows of numbers ({}), {}", s.unit, need)
                                        : fmt::format("list of names, {}", need);
}

void addParameters(Lines& lines, const ModelInfo& model, const YAML::Node& given) {
  lines.add(4, "parameters:", "");
  for (const ParameterInfo& p : model.parameters) {
    if (given[p.name]) {
      addValue(lines, 6, p.name, given[p.name], meaningOf(p));
    } else if (p.fallback) {
      lines.off(6, fmt::format("{}: {:g}", p.name, *p.fallback), meaningOf(p));
    } else if (!p.fallback_parameter.empty()) {
      lines.off(6, fmt::format("{}:", p.name),
                fmt::format("{}; default: {}", meaningOf(p), p.fallback_parameter));
    } else {
      lines.add(6, fmt::format("{}: 1.0", p.name), meaningOf(p));
    }
  }
  for (const SettingInfo& s : model.settings) {
    const std::string comment = fmt::format("{}: {}", contentsText(s), s.meaning);
    if (given[s.name]) {
      addValue(lines, 6, s.name, given[s.name], comment);
    } else {
      lines.off(6, s.name + ":" + (s.choices.empty() ? "" : " " + s.choices.front()), comment);
    }
  }
}

void addDrive(Lines& lines, const YAML::Node& drive) {
  lines.plain("drives:");
  lines.add(2, "shaft:", "a drive, for the systems that name it; any name");
  const YAML::Node speed = drive["speed"];
  lines.add(4, "speed: " + (speed ? flow(speed) : std::string("0.0")), "rad/s, at the start");
  lines.off(4, "angle: 0.0", "rad, at the start");
  lines.add(4, "profile:", "moves, one after the other; without any the speed is constant");
  lines.add(4, "  # rad/s; rad/s^2; rad/s^3 (none: no limit); s, time at this speed", "");
  if (drive["profile"]) {
    for (const YAML::Node& move : drive["profile"]) {
      lines.add(6, "- " + flow(move), "");
    }
  } else {
    lines.add(6, "- {speed: 10.0, max_acceleration: 5.0, max_jerk: 50.0, dwell: 5.0}", "");
  }
}

bool feelsGravity(const ModelInfo& model) {
  return std::any_of(model.settings.begin(), model.settings.end(),
                     [](const SettingInfo& setting) { return setting.name == "gravity_on_shaft"; });
}

void addInitial(Lines& lines, const ModelInfo& model, const YAML::Node& given) {
  const std::string fallback = feelsGravity(model)
                                   ? "or: equilibrium, the default with gravity; else all 0"
                                   : "or: equilibrium; default: all 0";
  if (given.IsScalar()) {
    lines.add(4, "initial: " + flow(given), fallback);
    return;
  }
  if (model.variants.front().coordinates.empty()) {  // as many as the parameters give
    if (given.IsMap()) {
      lines.add(4, "initial: " + flow(given), "rad or m, and their rates; " + fallback);
    } else {
      lines.off(4, "initial: {q1: 0.0, q1_rate: 0.0}", "rad or m, and their rates; " + fallback);
    }
    lines.off(4, "", model.coordinates_meaning);
    return;
  }
  const bool any = given.IsMap() && given.size() > 0;
  if (any) {
    lines.add(4, "initial:", fallback);
  } else {
    lines.off(4, "initial:", fallback);
  }
  for (const CoordinateInfo& c : model.variants.front().coordinates) {
    const std::string meaning = c.meaning.empty() ? c.unit : c.unit + ": " + c.meaning;
    for (const auto& [name, unit] :
         {std::pair{c.name, meaning}, std::pair{c.name + "_rate", c.unit + "/s"}}) {
      if (any && given[name]) {
        lines.add(6, fmt::format("{}: {}", name, flow(given[name])), unit);
      } else if (any) {
        lines.off(6, name + ": 0.0", unit);
      } else {
        lines.off(4, "  " + name + ": 0.0", unit);
      }
    }
  }
}

void addInputs(Lines& lines, const ModelInfo& model) {
  const std::vector<InputInfo>& inputs = model.variants.front().inputs;
  if (inputs.empty()) {
    return;
  }
  lines.off(4, "inputs:", "external inputs: a number, or {amplitude, frequency, phase},");
  lines.off(4, "", "or {table: FILE.csv, time: COLUMN, value: COLUMN, hold: true}");
  for (const InputInfo& input : inputs) {
    lines.off(4, fmt::format("  {}: 0.0", input.name),
              fmt::format("{}: {}", input.unit, input.meaning));
  }
}

}  // namespace

std::vector<std::string> integratorsOf(const ModelVariant& variant) {
  std::vector<std::string> all{"auto"};
  all.insert(all.end(), variant.integrators.begin(), variant.integrators.end());
  return all;
}

std::string parameterText(const ParameterInfo& p, const std::string& without) {
  const std::string fallback = !p.fallback_parameter.empty() ? "default " + p.fallback_parameter
                               : p.fallback ? fmt::format("default {:g}", *p.fallback)
                                            : without;
  return fmt::format("  parameter   {:<18} {:<9} {:<6} {:<18} {}\n", p.name, p.unit,
                     describe(p.range), fallback, p.meaning);
}

std::string settingText(const SettingInfo& s) {
  return fmt::format("  parameter   {:<18} {}: {}\n", s.name, contentsText(s), s.meaning);
}

Json parameterJson(const ParameterInfo& p) {
  const Json fallback = p.fallback                     ? Json(*p.fallback)
                        : p.fallback_parameter.empty() ? Json()
                                                       : Json(p.fallback_parameter);
  return {{"unit", p.unit},
          {"range", describe(p.range)},
          {"default", fallback},
          {"required", fallback.is_null()},
          {"meaning", p.meaning}};
}

Json settingJson(const SettingInfo& s) {
  constexpr const char* kKinds[] = {"choice", "matrix", "names", "table", "word_or_count"};
  Json json{
      {"kind", kKinds[static_cast<int>(s.kind)]}, {"required", s.required}, {"meaning", s.meaning}};
  if (s.kind == SettingKind::kChoice || s.kind == SettingKind::kWordOrCount) {
    json["choices"] = s.choices;
    json["default"] = s.choices.front();
  }
  for (const ColumnInfo& c : s.columns) {
    json["columns"][c.name] = {{"unit", c.unit}, {"range", describe(c.range)}};
  }
  for (const auto* columns : {&s.word_columns, &s.optional_words}) {
    for (const std::string& c : *columns) {
      json["columns"][c] = {{"unit", "name"}};
    }
  }
  return json;
}

std::string newScene(const ModelInfo& model, const YAML::Node& example, const std::string& system) {
  const YAML::Node nothing(YAML::NodeType::Map);
  const YAML::Node of = system.empty() ? nothing : example["systems"][system];
  const YAML::Node parameters = of["parameters"] ? of["parameters"] : nothing;
  const bool constant_speed = static_cast<bool>(parameters["speed"]);
  const bool drive = model.has_shaft && !constant_speed;

  Lines lines;
  lines.plain(fmt::format("# {}: {}", model.name, model.summary));
  lines.plain("#");
  lines.plain(
      "# Values are in SI units (m, kg, s, rad, N) or have a unit (250 mm, 3000 rpm). Keys in "
      "comments show their defaults: "
      "remove the");
  lines.plain("# comment sign to set them. `twin check FILE` prints all errors of the file,");
  lines.plain("# or what is modelled.");
  lines.plain(fmt::format("name: my_{}", model.name));
  lines.add(0, "step: " + (example["step"] ? flow(example["step"]) : std::string("0.001")),
            "s, of the simulation");
  lines.off(0, "time: 0.0", "s, at the start");
  if (example["gravity"]) {
    lines.add(0, "gravity: " + flow(example["gravity"]), "m/s^2");
  } else {
    lines.off(0, "gravity: 9.80665", "m/s^2");
  }
  if (drive) {
    addDrive(lines, of["drive"] ? example["drives"][of["drive"].Scalar()] : nothing);
  }
  lines.plain("systems:");
  lines.add(2, (system.empty() ? model.name : system) + ":",
            "its name is in topics and channels; any number of systems");
  lines.add(4, "model: " + model.name, "");
  if (drive) {
    lines.add(4, "drive: shaft", "or parameters: {speed: ...} [rad/s] for a constant speed");
  }
  addParameters(lines, model, parameters);
  if (constant_speed) {
    lines.add(6, "speed: " + flow(parameters["speed"]), "rad/s, constant; or a drive instead");
  }
  addInitial(lines, model, of["initial"] ? of["initial"] : YAML::Node());
  lines.off(4, "integrator: auto",
            fmt::format("{}", fmt::join(integratorsOf(model.variants.front()), " | ")));
  lines.off(4, "tolerance: 1.0e-6", "-: error bound of `auto`");
  lines.off(4, "horizon: 10.0", "s: time over which the bound holds");
  lines.off(4, "substeps: 1", "sub-steps per step, for a named method");
  addInputs(lines, model);
  return lines.text();
}

}  // namespace whirl_twin
