#include <fmt/format.h>

#include <memory>
#include <optional>

#include "scene/model_registry.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/output.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Lists the models a scene can name: their coordinates, parameters with units, ranges and\n"
    "defaults, and the integrators they can step with.";

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

std::vector<std::string> integratorsOf(const ModelInfo& model) {
  std::vector<std::string> all{"auto"};
  all.insert(all.end(), model.integrators.begin(), model.integrators.end());
  return all;
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
  out += fmt::format("  {}{}\n", model.linear ? "linear" : "nonlinear",
                     model.has_shaft ? ", on a turning shaft" : "");
  for (const Coordinate& c : model.coordinates) {
    out += fmt::format("  coordinate  {0} ({1}), rate {0}_rate ({1}/s)\n", c.name, c.unit);
  }
  for (const ParameterInfo& p : allParameters(model)) {
    out += fmt::format("  parameter   {:<18} {:<9} {:<6} {:<18} {}\n", p.name, p.unit,
                       describe(p.range), defaultText(p), p.meaning);
  }
  return out + fmt::format("  integrators {}\n", fmt::join(integratorsOf(model), ", "));
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

Json json(const ModelInfo& model) {
  Json json;
  json["summary"] = model.summary;
  json["linear"] = model.linear;
  json["shaft"] = model.has_shaft;
  json["rotor"] = model.rotor;
  for (const Coordinate& c : model.coordinates) {
    json["coordinates"][c.name] = {{"unit", c.unit}};
  }
  for (const ParameterInfo& p : allParameters(model)) {
    json["parameters"][p.name] = parameterJson(p);
  }
  json["integrators"] = integratorsOf(model);
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
    throw BadInput(fmt::format("no model '{}'{}", *request.model, hint(*request.model, names)));
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
