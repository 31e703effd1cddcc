#include <fmt/format.h>

#include "controllers/controller_registry.h"
#include "reports/model_text.h"
#include "tools/commands.h"
#include "tools/listing.h"

namespace whirl_twin {

namespace {

constexpr const char* kControllersDescription =
    "Lists the controllers a scene can name as type: their parameters with units, ranges and\n"
    "defaults.";

constexpr const char* kControllersFooter =
    "Examples:\n"
    "  twin controllers\n"
    "  twin controllers pid\n"
    "  twin controllers --json";

std::string listedControllerText(const ControllerInfo& controller) {
  std::string out = fmt::format("{}: {}\n", controller.name, controller.summary);
  for (const ParameterInfo& p : controller.parameters) {
    out += parameterText(p);
  }
  for (const SettingInfo& s : controller.settings) {
    out += settingText(s);
  }
  return out;
}

Json listedControllerJson(const ControllerInfo& controller) {
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

std::vector<ListedThing> listedControllers() {
  std::vector<ListedThing> things;
  for (const ControllerInfo& controller : controllers()) {
    things.push_back(
        {controller.name, listedControllerText(controller), listedControllerJson(controller)});
  }
  return things;
}

}  // namespace

void addControllersCommand(const ProgramCommand& twin, int& status) {
  addListing(twin, status,
             {"controller", kControllersDescription, kControllersFooter, listedControllers});
}

}  // namespace whirl_twin
