#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "controllers/controller_registry.h"
#include "messages/names.h"
#include "messages/refusal.h"
#include "reports/csv_table.h"
#include "reports/model_text.h"
#include "tools/arguments.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Lists the controllers a scene can name as type: their parameters with units, ranges and\n"
    "defaults.";

constexpr const char* kFooter =
    "Examples:\n"
    "  twin controllers\n"
    "  twin controllers pid\n"
    "  twin controllers --json";

struct Request {
  std::vector<std::string> controllers;  // none: all of them
  std::optional<std::string> csv;
  bool json = false;
};

std::string text(const ControllerInfo& controller) {
  std::string out = fmt::format("{}: {}\n", controller.name, controller.summary);
  for (const ParameterInfo& p : controller.parameters) {
    out += parameterText(p);
  }
  for (const SettingInfo& s : controller.settings) {
    out += settingText(s);
  }
  return out;
}

Json json(const ControllerInfo& controller) {
  Json json;
  json["summary"] = controller.summary;
  json["parameters"] = Json::object();
  for (const ParameterInfo& p : controller.parameters) {
    json["parameters"][p.name] = parameterJson(p);
  }
  for (const SettingInfo& s : controller.settings) {
    json["settings"][s.name] = settingJson(s);
  }
  return json;
}

/// Throws Refusal with every name that no controller has.
void requireControllers(const std::vector<std::string>& asked) {
  std::vector<std::string> errors;
  for (const std::string& name : asked) {
    if (findController(name) == nullptr) {
      errors.push_back(fmt::format("no controller '{}'{}", name, hint(name, controllerNames())));
    }
  }
  if (!errors.empty()) {
    throw Refusal(fmt::format("{}", fmt::join(errors, "\ntwin: ")));
  }
}

int list(const Request& request) {
  requireControllers(request.controllers);
  requireCsvName(request.csv);
  const auto& asked = request.controllers;
  Json all;
  std::string texts;
  CsvTable parameters{
      "", {"controller", "parameter", "unit", "range", "default", "required", "meaning"}};
  for (const ControllerInfo& controller : controllers()) {
    if (!asked.empty() && std::find(asked.begin(), asked.end(), controller.name) == asked.end()) {
      continue;
    }
    all["controllers"][controller.name] = json(controller);
    texts += (texts.empty() ? "" : "\n") + text(controller);
    for (const ParameterInfo& p : controller.parameters) {
      Json row = parameterJson(p);
      row.update({{"controller", controller.name}, {"parameter", p.name}});
      parameters.rows.push_back(row);
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

void addControllersCommand(CLI::App& twin, int& status) {
  CLI::App* command = twin.add_subcommand("controllers", kDescription);
  const auto request = std::make_shared<Request>();
  command->add_option("CONTROLLER", request->controllers, "these controllers only")->type_name("");
  addCsvOption(command, request->csv);
  command->add_flag("--json", request->json, "print one JSON object");
  command->footer(kFooter);
  command->callback([request, &status] { status = list(*request); });
}

}  // namespace whirl_twin
