#include <fmt/format.h>

#include <memory>
#include <optional>

#include "messages/names.h"
#include "messages/refusal.h"
#include "models/model_registry.h"
#include "reports/output.h"
#include "tools/arguments.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Lists the models a scene can name: their coordinates, inputs, parameters with units, ranges\n"
    "and defaults, and the integrators they can step with.";

constexpr const char* kFooter =
    "Examples:\n"
    "  twin models\n"
    "  twin models jeffcott_rotor\n"
    "  twin models --json";

/// The parameters of a model, its shaft speed included.
std::vector<ParameterInfo> allParameters(const ModelInfo& model) {
  std::vector<ParameterInfo> all = model.parameters;
  if (model.has_shaft) {
    all.push_back({"speed", "rad/s", Range::kAny, "of the shaft, constant, unless it has a drive",
                   std::nullopt, ""});
  }
  return all;
}

std::vector<std::string> integratorsOf(const ModelVariant& variant) {
  std::vector<std::string> all{"auto"};
  all.insert(all.end(), variant.integrators.begin(), variant.integrators.end());
  return all;
}

/// The names of a table's columns with their units; the words of a choice, its default first.
std::string contents(const SettingInfo& s) {
  if (s.kind == SettingKind::kChoice) {
    return fmt::format("{} (default {})", fmt::join(s.choices, " | "), s.choices.front());
  }
  if (s.kind == SettingKind::kWordOrCount) {
    return fmt::format("a whole number or {} (default {})", fmt::join(s.choices, " | "),
                       s.choices.front());
  }
  std::vector<std::string> columns = s.word_columns;
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

std::string defaultText(const ParameterInfo& p) {
  if (!p.fallback_parameter.empty()) {
    return "default " + p.fallback_parameter;
  }
  if (p.fallback) {
    return fmt::format("default {:g}", *p.fallback);
  }
  return p.name == "speed" ? "or a drive" : "required";
}

std::string text(const ModelInfo& model) {
  std::string out = fmt::format("{}: {}\n", model.name, model.summary);
  for (const ModelVariant& v : model.variants) {
    out += fmt::format("  {}{}{}\n", v.when.empty() ? "" : "with " + v.when + ": ",
                       v.linear ? "linear" : "nonlinear",
                       model.has_shaft ? ", on a turning shaft" : "");
    for (const CoordinateInfo& c : v.coordinates) {
      out += fmt::format("  coordinate  {0} ({1}), rate {0}_rate ({1}/s)\n", c.name, c.unit);
    }
    if (v.coordinates.empty()) {
      out += "  coordinate  as many as the parameters give\n";
    }
    for (const InputInfo& input : v.inputs) {
      out += fmt::format("  input       {:<18} {:<9} {}\n", input.name, input.unit, input.meaning);
    }
  }
  for (const ParameterInfo& p : allParameters(model)) {
    out += fmt::format("  parameter   {:<18} {:<9} {:<6} {:<18} {}\n", p.name, p.unit,
                       describe(p.range), defaultText(p), p.meaning);
  }
  for (const SettingInfo& s : model.settings) {
    out += fmt::format("  parameter   {:<18} {}: {}\n", s.name, contents(s), s.meaning);
  }
  return out +
         fmt::format("  integrators {}\n", fmt::join(integratorsOf(model.variants.front()), ", "));
}

Json parameterJson(const ParameterInfo& p) {
  Json json;
  json["unit"] = p.unit;
  json["range"] = describe(p.range);
  json["default"] = p.fallback                     ? Json(*p.fallback)
                    : p.fallback_parameter.empty() ? Json()
                                                   : Json(p.fallback_parameter);
  json["required"] = !p.fallback && p.fallback_parameter.empty() && p.name != "speed";
  json["meaning"] = p.meaning;
  return json;
}

Json settingJson(const SettingInfo& s) {
  constexpr const char* kKinds[] = {"choice", "matrix", "names", "table", "word_or_count"};
  Json json;
  json["kind"] = kKinds[static_cast<int>(s.kind)];
  json["required"] = s.required;
  json["meaning"] = s.meaning;
  if (s.kind == SettingKind::kChoice || s.kind == SettingKind::kWordOrCount) {
    json["choices"] = s.choices;
    json["default"] = s.choices.front();
  }
  for (const ColumnInfo& c : s.columns) {
    json["columns"][c.name] = {{"unit", c.unit}, {"range", describe(c.range)}};
  }
  for (const std::string& c : s.word_columns) {
    json["columns"][c] = {{"unit", "name"}};
  }
  return json;
}

/// What is said of one form of a model.
Json variantJson(const ModelVariant& v) {
  Json json;
  json["linear"] = v.linear;
  json["rotor"] = v.rotor;
  json["coordinates"] = Json::object();
  for (const CoordinateInfo& c : v.coordinates) {
    json["coordinates"][c.name] = {{"unit", c.unit}};
  }
  json["inputs"] = Json::object();
  for (const InputInfo& input : v.inputs) {
    json["inputs"][input.name] = {{"unit", input.unit}, {"meaning", input.meaning}};
  }
  json["integrators"] = integratorsOf(v);
  return json;
}

Json json(const ModelInfo& model) {
  Json json = variantJson(model.variants.front());
  json["summary"] = model.summary;
  json["shaft"] = model.has_shaft;
  for (std::size_t i = 1; i < model.variants.size(); ++i) {
    json["variants"][model.variants[i].when] = variantJson(model.variants[i]);
  }
  for (const ParameterInfo& p : allParameters(model)) {
    json["parameters"][p.name] = parameterJson(p);
  }
  for (const SettingInfo& s : model.settings) {
    json["settings"][s.name] = settingJson(s);
  }
  return json;
}

struct Request {
  std::optional<std::string> model;
  bool json = false;
};

int list(const Request& request) {
  std::vector<std::string> names;
  Json all;
  std::string texts;
  for (const ModelInfo& model : models()) {
    names.push_back(model.name);
    if (!request.model || *request.model == model.name) {
      all["models"][model.name] = json(model);
      texts += (texts.empty() ? "" : "\n") + text(model);
    }
  }
  if (texts.empty()) {
    throw Refusal(fmt::format("no model '{}'{}", *request.model, hint(*request.model, names)));
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(texts);
  }
  return kDone;
}

}  // namespace

void addModelsCommand(CLI::App& twin, int& status) {
  CLI::App* command = twin.add_subcommand("models", kDescription);
  const auto request = std::make_shared<Request>();
  command->add_option("MODEL", request->model, "this model only")->type_name("");
  command->add_flag("--json", request->json, "print one JSON object");
  command->footer(kFooter);
  command->callback([request, &status] { status = list(*request); });
}

}  // namespace whirl_twin
