#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "messages/names.h"
#include "messages/refusal.h"
#include "models/model_registry.h"
#include "reports/csv_table.h"
#include "reports/model_text.h"
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
    "  twin models pendulum spinning_pendulum\n"
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
    out += parameterText(p);
  }
  for (const SettingInfo& s : model.settings) {
    out += settingText(s);
  }
  return out +
         fmt::format("  integrators {}\n", fmt::join(integratorsOf(model.variants.front()), ", "));
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
  std::vector<std::string> models;  // none: all of them
  std::optional<std::string> csv;
  bool json = false;
};

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws Refusal with every name that no model has.
void requireModels(const std::vector<std::string>& asked) {
  std::vector<std::string> names;
  for (const ModelInfo& model : models()) {
    names.push_back(model.name);
  }
  std::vector<std::string> errors;
  for (const std::string& name : asked) {
    if (!isIn(names, name)) {
      errors.push_back(fmt::format("no model '{}'{}", name, hint(name, names)));
    }
  }
  if (!errors.empty()) {
    throw Refusal(fmt::format("{}", fmt::join(errors, "\ntwin: ")));
  }
}

int list(const Request& request) {
  requireModels(request.models);
  requireCsvName(request.csv);
  Json all;
  std::string texts;
  CsvTable parameters{"",
                      {"model", "parameter", "unit", "range", "default", "required", "meaning"}};
  for (const ModelInfo& model : models()) {
    if (request.models.empty() || isIn(request.models, model.name)) {
      all["models"][model.name] = json(model);
      texts += (texts.empty() ? "" : "\n") + text(model);
      for (const ParameterInfo& p : allParameters(model)) {
        Json row = parameterJson(p);
        row.update({{"model", model.name}, {"parameter", p.name}});
        parameters.rows.push_back(row);
      }
    }
  }
  if (request.csv) {
    writeCsv(*request.csv, {parameters});
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
  command->add_option("MODEL", request->models, "these models only")->type_name("");
  addCsvOption(command, request->csv);
  command->add_flag("--json", request->json, "print one JSON object");
  command->footer(kFooter);
  command->callback([request, &status] { status = list(*request); });
}

}  // namespace whirl_twin
